"""Of which types the arguments of a program are that `argparse` reads, by how they are added."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.python.value_types import (
    A_NUMBER,
    A_TEXT,
    ANY_TYPE,
    NO_TYPES,
    ValueTypes,
    union,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import walk_all

_NUMBERED = frozenset({"store_true", "store_false", "count"})
_CONVERTING = {"builtins.int": A_NUMBER, "builtins.float": A_NUMBER, "builtins.str": A_TEXT}


class ArgumentParsers:
    """The parsers of one program, which are not told apart."""

    def __init__(self, origins: Origins) -> None:
        self._program = origins.graph.program

    def of(self, name: str) -> ValueTypes:
        """The types of an argument, by the attribute that it becomes."""
        return union(self._added.get(name, ())) or ANY_TYPE

    @cached_property
    def _added(self) -> dict[str, list[ValueTypes]]:
        found: dict[str, list[ValueTypes]] = {}
        for _, node in walk_all(self._program):
            match node:
                case s.Call(_, s.MethodCallee(_, "add_argument")):
                    found.setdefault(_attribute(node), []).append(_types(node))
                case s.Call(_, s.MethodCallee(_, "set_defaults"), arguments):
                    for argument in arguments:
                        types = _of_default(argument.value)
                        found.setdefault(argument.name or "", []).append(types)
                case _:
                    pass
        return found


def _attribute(call: s.Call) -> str:
    """The attribute that an argument becomes: as it is said, or by its first long name."""
    named = {a.name: a.value for a in call.arguments if a.name is not None}
    match named.get("dest"):
        case e.Literal(str() as text):
            return text
        case None:
            names = list(_names(call))
            long = [name for name in names if name.startswith("--")] or names
            return long[0].lstrip("-").replace("-", "_") if long else ""
        case _:
            return ""


def _names(call: s.Call) -> Iterator[str]:
    for argument in call.arguments:
        match argument:
            case s.CallArgument(e.Literal(str() as text), None):
                yield text
            case _:
                pass


def _types(call: s.Call) -> ValueTypes:
    """The types of an argument that is given, and of its default; without one it may be None."""
    named = {a.name: a.value for a in call.arguments if a.name is not None}
    match named.get("action", e.Literal("store")):
        case e.Literal(action) if action in _NUMBERED:
            return A_NUMBER
        case e.Literal("store") if "nargs" not in named:
            pass
        case _:
            return ANY_TYPE
    match named.get("type"):
        case None:
            types = A_TEXT
        case e.LibraryReference(name):
            types = _CONVERTING.get(name, ANY_TYPE)
        case _:
            types = ANY_TYPE
    is_there = named.get("required") == e.Literal(True) or _is_placed(call)
    return types if is_there else types | _of_default(named.get("default"))


def _is_placed(call: s.Call) -> bool:
    """Whether an argument is given by its place, so that it must be there."""
    return not any(name.startswith("-") for name in _names(call))


def _of_default(value: e.Expression | None) -> ValueTypes:
    match value:
        case e.Literal(int() | float()):
            return A_NUMBER
        case e.Literal(str()):
            return NO_TYPES  # which is read as what is given
        case _:
            return ANY_TYPE
