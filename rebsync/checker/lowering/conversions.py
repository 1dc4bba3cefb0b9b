"""Numbers of one kind as numbers of another."""

from __future__ import annotations

from rebsync.checker.lowering.emitter import Emitter
from rebsync.checker.program import Kind
from rebsync.checker.values import stored
from rebsync.static.constants import Value

_WHOLE = ("byte", "short", "int")
_REAL = ("float", "double")
_WIDTH = {"byte": 0, "short": 1, "int": 2}


def promoted(kind: Kind) -> Kind:
    """The kind in which arithmetic on a value is done."""
    return "int" if kind in _WHOLE else kind


def met(left: Kind, right: Kind) -> Kind:
    """The kind in which an operator on two numbers works."""
    for kind in ("double", "float"):
        if kind in (left, right):
            return kind
    return promoted(left)


def convert(source: Kind, target: Kind, e: Emitter) -> None:
    """Makes the value on the stack one of another kind: wrapped, rounded or cut."""
    if source == target or source in ("boolean", "rebec"):
        return
    if target in _REAL:
        if source in _WHOLE:
            e.emit("REAL")
        if target == "float":
            e.emit("SINGLE")
        return
    if source in _REAL:
        e.emit("WHOLE")
        source = "int"
    if _WIDTH[target] < _WIDTH[source]:
        e.emit(target.upper())


def constant(value: Value, kind: Kind, e: Emitter, mark: int = 0) -> None:
    """Pushes a constant as a value of a kind; `mark` says which one of the model it is."""
    e.emit("CONST", stored(value, kind), mark)
