"""One text of Python, run by Python and as the intermediate form: both must do the same."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType, ModuleType
from typing import Any

from rebsync.reverse.ir.program import Program
from rebsync.reverse.ir.python.lowering import python_program
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import parse
from rebsync.source import Source
from tests.reverse.ir.interpreter import Interpreter

MODULE = "case.py"
SHORT = 3000  # lines that are run
_OBJECT = re.compile(r"<[\w.]*?(\w+) object at 0x\w+>")
_PREFIX = "LOG = []\ndef log(x):\n    LOG.append(x)\n    return x\n"


class _TooLong(BaseException):
    """A text runs for more lines than the interpreter is to go through."""


def program_of(text: str, prefix: str = _PREFIX) -> Program:
    """The program of one file."""
    return python_program(PyCode.of([parse(Source(MODULE, prefix + text))]))


def natively(text: str) -> list[str]:
    """What `run()` of a text gives or raises, and what it logs, by Python."""
    module = ModuleType(MODULE)
    with _known(module):
        exec(compile(_PREFIX + text, MODULE, "exec"), vars(module))
        return _outcome(vars(module))


def is_short(text: str) -> bool:
    """Whether Python runs few lines of a text: the interpreter takes hundreds of times as long."""
    lines = 0

    def counted(frame: FrameType, event: str, _: object) -> Any:  # noqa: ANN401
        nonlocal lines
        if frame.f_code.co_filename != MODULE:
            return None
        lines += event == "line"
        if lines > SHORT:
            raise _TooLong
        return counted

    before = sys.gettrace()
    sys.settrace(counted)
    try:
        with suppress(_TooLong):
            natively(text)
    finally:
        sys.settrace(before)
    return lines <= SHORT


def by_form(text: str, interpreter: Interpreter | None = None) -> list[str]:
    """The same by the interpreter of the form."""
    made = interpreter or Interpreter(program_of(text))
    with _known(ModuleType(MODULE)):
        return _outcome(vars(made.module(MODULE)))


@contextmanager
def _known(module: ModuleType) -> Iterator[None]:
    """Libraries look a module up by its name."""
    sys.modules[MODULE] = module
    try:
        yield
    finally:
        del sys.modules[MODULE]


def _outcome(space: dict[str, Any]) -> list[str]:
    try:
        last = f"gives {space['run']()!r}"
    except Exception as raised:
        last = f"raises {type(raised).__name__}"
    return [*_shown(space["LOG"]), last]


def _shown(log: Iterable[object]) -> list[str]:
    return [_OBJECT.sub(r"<\1>", repr(entry)) for entry in log]
