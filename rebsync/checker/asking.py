"""How C asks Python, now and then, whether what takes long is to go on."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from rebsync.checker.look import Look
from rebsync.records import dataclass

Question = ctypes.CFUNCTYPE(None, ctypes.POINTER(ctypes.c_int))


@dataclass(slots=True)
class Answer:
    """What C was told when it asked: why to end, or what was raised."""

    reason: str | None = None
    error: BaseException | None = None


@contextmanager
def asking(
    look: Callable[[], str | None] | Look, watch: Callable[[Any], object]
) -> Iterator[Answer]:
    """Lets C ask `look` what ends a step that takes long; `watch` gives the question to C.

    What is raised meanwhile, as by handlers of signals, is raised after C has returned.
    """
    answer = Answer()

    def ask(goes_on: Any) -> None:  # noqa: ANN401 - a pointer, which is 0 until it is known
        answer.reason = look()
        goes_on[0] = answer.reason is None

    def note(raised: sys.UnraisableHookArgs) -> None:
        if raised.object in (ask, None):
            answer.error = raised.exc_value
        else:
            before(raised)

    # A handler may raise before the first line of `ask`, where nothing can catch it.
    before, sys.unraisablehook = sys.unraisablehook, note
    question = Question(ask)
    watch(question)
    try:
        yield answer
    finally:
        sys.unraisablehook = before
        watch(Question())
    if answer.error is not None:
        raise answer.error
