"""Methods of generated Python that nothing runs: nothing names them, be it by a text."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TypeVar

from rebsync.reverse.findings import Findings
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file

T = TypeVar("T")
R = TypeVar("R")
# What may ask an object for attributes by names that are values, or for all of them.
_BY_NAME = re.compile(
    r"\b(?:getattr|methodcaller|attrgetter|inspect|getmembers|eval|exec|dir|vars)\b|__dict__|__get"
)


def unless_dead(
    code: PyCode, function: Scope, findings: Findings, noted: list[T], read: Callable[[Scope], R]
) -> R | None:
    """A method as it is read; None for one with something unread that nothing runs.

    `noted` is what reading keeps for later, which a dead method has no part in.
    """
    before, count = findings.mark(), len(noted)
    found = read(function)
    if before[0] == len(findings.all) or not _is_dead(code, function):
        return found
    findings.back_to(before)
    del noted[count:]
    return None


def _is_dead(code: PyCode, function: Scope) -> bool:
    """Whether a method is named nowhere but where it is defined, and has no meaning for Python.

    What the library asks of its nodes is for the caller to tell.
    """
    name = function.name
    if function.decorators or name.startswith("__") or len(code.methods.get(name, ())) != 1:
        return False
    word = re.compile(rf"\b{re.escape(name)}\b")
    texts = [module.py.source.text for module in code.modules.values()]
    own = [m for m in code.modules.values() if not is_runtime_file(m.py.source)]
    if any(_BY_NAME.search(module.py.source.text) for module in own):
        return False
    return sum(len(word.findall(text)) for text in texts) == 1
