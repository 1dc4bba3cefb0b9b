"""What an expression of Python may be worth while nothing runs, and how such values combine."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import TypeAlias

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import FromParameter, OneOf, Plain, Resolved, Unresolved
from rebsync.reverse.syntax.py_index import Scope

# More ways than these to go are not followed one by one.
MOST = 24
_TEXT_BEFORE = re.compile(r"\(*'([^'\\]*)' \+ ")
_TEXT_BEHIND = re.compile(r" \+ '([^'\\]*)'\Z")
_ENDS_IN_TEXT = re.compile(r"(value \+ )'([^'\\]*)'")


@dataclass(frozen=True, slots=True)
class NoneValue:
    """None."""


@dataclass(frozen=True, slots=True)
class Items:
    """The elements of a list or tuple, each with all that it may be."""

    each: tuple[Ways, ...]


@dataclass(frozen=True, slots=True)
class Table:
    """The keys and values of a dictionary."""

    pairs: tuple[tuple[Ways, Ways], ...]


@dataclass(frozen=True, slots=True)
class Duration:
    """A span of time in seconds."""

    seconds: Resolved


@dataclass(frozen=True, slots=True)
class External:
    """Something of a module that is not in the files: `std_msgs.msg.String`."""

    name: str

    @property
    def last(self) -> str:
        return self.name.rpartition(".")[2]

    @property
    def root(self) -> str:
        return self.name.partition(".")[0]


@dataclass(frozen=True, eq=False, slots=True)
class Module:
    """A module of the files."""

    scope: Scope


@dataclass(frozen=True, eq=False, slots=True)
class Class:
    """A class of the files."""

    scope: Scope


@dataclass(frozen=True, eq=False, slots=True)
class Instance:
    """An object of a class of the files; `made` is the call that makes it, with its scope."""

    scope: Scope
    made: tuple[Node, Scope] | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Function:
    """A function or lambda of the files; `owner` is the class of the object that it is bound to.

    `bound` are the arguments that a partial application puts first.
    """

    scope: Scope
    owner: Scope | None = None
    bound: tuple[Node, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Bound:
    """A method of something that a library made."""

    holder: Value
    name: str


@dataclass(frozen=True, eq=False, slots=True)
class Made:
    """What a call of something external gives."""

    by: str
    call: Node
    scope: Scope


@dataclass(frozen=True, slots=True)
class Declared:
    """A parameter as an object whose `value` it is."""

    value: FromParameter | Unresolved


@dataclass(frozen=True, slots=True)
class EnumMember:
    """A member of an enumeration of the files, which is equal to no number or text.

    `name` is the first of those that have its `value`.
    """

    owner: Scope
    name: str
    value: Ways

    @property
    def text(self) -> str:
        """What tells it from all else."""
        return f"{self.owner.py.source.path}:{self.owner.name}.{self.name}"


Value: TypeAlias = (
    "Plain | FromParameter | Unresolved | NoneValue | Items | Table | Duration | External | Module"
    " | Class | Instance | Function | Bound | Made | Declared | EnumMember"
)
Ways: TypeAlias = "tuple[Value, ...]"


def distinct(values: Iterable[Value]) -> Ways:
    """Each value once; what is equal but of another type, as 1 and True, is not the same."""
    found: list[Value] = []
    for value in values:
        if not any(_same(v, value) for v in found):
            found.append(value)
    return tuple(found)


def resolved(ways: Ways, otherwise: Unresolved) -> Resolved:
    """The ways as a value of a graph; what is nothing does not count beside something."""
    values: list[Resolved] = []
    for way in ways:
        value = _plain(way, otherwise) if not isinstance(way, NoneValue) else None
        if value is not None and not any(_same(value, v) for v in values):
            values.append(value)
    defaults = [v.default for v in values if isinstance(v, FromParameter) and not v.expression]
    values = [v for v in values if not any(_same(d, v) for d in defaults)]
    if not values:
        return otherwise
    return values[0] if len(values) == 1 else OneOf(tuple(values))


def _same(one: object, other: object) -> bool:
    return type(one) is type(other) and one == other


def _plain(value: Value, otherwise: Unresolved) -> Resolved | None:
    match value:
        case Items(each):
            inner = [resolved(ways, otherwise) for ways in each]
            if all(isinstance(v, (bool, int, float, str, tuple)) for v in inner):
                return tuple(v for v in inner if isinstance(v, (bool, int, float, str, tuple)))
            return next((v for v in inner if isinstance(v, Unresolved)), otherwise)
        case Table(pairs):
            return () if not pairs else otherwise
        case Duration(seconds):
            return seconds
        case Declared(inner):
            return inner
        case bool() | int() | float() | str() | tuple() | FromParameter() | Unresolved():
            return value
        case _:
            return otherwise


# --- operations ---------------------------------------------------------------------------------


def used(
    value: FromParameter, before: str, after: str, do: Callable[[Plain], Value]
) -> FromParameter:
    """A parameter's value used in an expression, between two texts; so is its default."""
    inner = value.expression or "value"
    text = before + (inner if inner == "value" or not before + after else f"({inner})") + after
    default = value.default
    given = do(default) if isinstance(default, (bool, int, float, str)) else None
    known = given if isinstance(given, (bool, int, float, str)) else None
    return replace(value, default=known, expression=text)


def joined(parts: Iterable[Value], unknown: Callable[[], Unresolved]) -> Value:
    """Texts one behind the other: values are put as `str` writes them."""
    found: Value = ""
    for part in parts:
        found = _behind(found, part, unknown)
    return found


def _behind(left: Value, right: Value, unknown: Callable[[], Unresolved]) -> Value:
    match left, right:
        case str(), (bool() | int() | float() | str()):
            return left + str(right)
        case str(), FromParameter():
            if not left:
                return right
            return used(right, f"{left!r} + ", "", lambda v: left + str(v))
        case FromParameter(), (bool() | int() | float() | str()):
            return _with_text_behind(left, str(right))
        case _:
            why = next((v for v in (left, right) if isinstance(v, Unresolved)), None) or unknown()
            partial = (_known(left) + _known(right)).replace("**", "*")
            return Unresolved(why.why, why.place, partial if partial != "*" else None)


def _with_text_behind(value: FromParameter, text: str) -> FromParameter:
    """A parameter's value with a text behind it; two texts become one."""
    if not text:
        return value
    found = used(value, "", f" + {text!r}", lambda v: str(v) + text)
    before = _ENDS_IN_TEXT.fullmatch(value.expression or "")
    if before is None:
        return found
    return replace(found, expression=f"{before[1]}{before[2] + text!r}")


def _known(value: Value) -> str:
    match value:
        case bool() | int() | float() | str():
            return str(value)
        case Unresolved():
            return value.partial or "*"
        case FromParameter(expression=str() as text):
            before, behind = _TEXT_BEFORE.match(text), _TEXT_BEHIND.search(text)
            first, last = before[1] if before else "", behind[1] if behind else ""
            default = value.default
            if isinstance(default, str):  # which has not been through the whole expression
                first = first if default.startswith(first) else ""
                last = last if default.endswith(last) else ""
                first = "" if len(first) + len(last) > len(default) else first
            return f"{first}*{last}"
        case _:
            return "*"


def computed(operator: str, left: Plain, right: Plain) -> Plain | None:
    """The result of an operation on plain values; None where it has none."""
    if isinstance(left, str) or isinstance(right, str):
        if isinstance(left, str) and isinstance(right, int) and operator == "*":
            return left * right
        both = isinstance(left, str) and isinstance(right, str)
        return left + right if both and operator == "+" else None  # type: ignore[operator]
    if isinstance(left, tuple) or isinstance(right, tuple):
        return None
    if operator in ("/", "//", "%") and not right:
        return None
    match operator:
        case "+":
            return left + right
        case "-":
            return left - right
        case "*":
            return left * right
        case "/":
            return left / right
        case "//":
            return left // right
        case "%":
            return left % right
        case "**" if abs(right) < MOST and (left or right >= 0):
            found = left**right
            return found if isinstance(found, (int, float)) else None
        case _:
            return None
