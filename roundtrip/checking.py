"""The verdicts on many packages: what must be read for them is read on all processors."""

from __future__ import annotations

import gc
import os
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import TypeAlias, cast

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.roundtrip.check import begin, finish_proved
from rebsync.roundtrip.checked import Begun, Checked
from rebsync.roundtrip.kept import Kept
from rebsync.roundtrip.manifest import ACCEPTED

# Findings say why it cannot be told how a package stands.
Result: TypeAlias = "Checked | tuple[Findings, ...]"


def check_all(packages: Iterable[Kept], depth: str) -> Iterator[Result]:
    """How each package stands, in their order."""
    begun = [_tried(kept.root, partial(begin, kept, depth)) for kept in packages]
    pending = [b for b in begun if isinstance(b, Begun)]
    finished = _in_processes(pending, depth) if _is_much(pending) else _in_turn(pending, depth)
    for each in begun:
        yield _as_accepted(next(finished) if isinstance(each, Begun) else each)


def _as_accepted(result: Result) -> Result:
    """The same with what the user has accepted, where anything is."""
    if not isinstance(result, Checked) or result.drift is None:
        return result
    root = result.kept.root
    if not os.path.lexists(f"{root}/{ACCEPTED}"):
        return result
    from rebsync.roundtrip.accepted import with_accepted

    return cast("Result", _tried(root, lambda: with_accepted(result)))


def _tried(root: str, task: Callable[[], Checked | Begun]) -> Result | Begun:
    try:
        return task()
    except RebsyncError as error:
        return error.findings
    except RecursionError:
        return _too_deep(root)


def _too_deep(root: str) -> tuple[Findings, ...]:
    why = "something in it nests deeper than rebsync reads"
    return RebsyncError.of(root, "RS111", why).findings


def _finished(begun: Begun, depth: str) -> Result:
    return cast("Result", _tried(begun.kept.root, lambda: finish_proved(begun, depth)))


def _in_turn(pending: list[Begun], depth: str) -> Iterator[Result]:
    yield from (_finished(begun, depth) for begun in pending)


# --- processes ----------------------------------------------------------------------------------


def _is_much(pending: list[Begun]) -> bool:
    """Whether more processes are worth while; what they need is loaded for that only."""
    if len(pending) < 3:
        return False
    from rebsync.reverse.files.parallel import ENOUGH, processors

    return sum(b.standing.listing.size for b in pending) >= ENOUGH and processors() > 1


def _in_processes(pending: list[Begun], depth: str) -> Iterator[Result]:
    from rebsync.reverse.files.parallel import in_processes
    from rebsync.roundtrip.serialisation import deserialised

    first, *others = pending
    yield _finished(first, depth)  # what it loads, copies of this process have then
    for text in in_processes(iter(others), partial(_sent, depth), lambda b: b.kept.root):
        yield cast("Result", deserialised(text))


def _sent(depth: str, begun: Begun) -> str:
    """The result in the form in which values keep what they are."""
    from rebsync.roundtrip.serialisation import serialised

    try:
        return serialised(_finished(begun, depth))
    finally:
        gc.collect()  # commands run without it, but this one may take long
