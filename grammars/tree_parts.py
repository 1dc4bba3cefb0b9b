"""What the tree builders share: places, and values between a rule and its parent."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, TypeAlias, TypeVar

from lark import Token

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.source import Span

_TOO_LARGE = 10**100

Children: TypeAlias = list[Any]
_Kind = TypeVar("_Kind")


class _Node(Protocol):
    @property
    def span(self) -> Span: ...


_Placed: TypeAlias = "Token | _Node"


def start_of(item: _Placed) -> int:
    """Where a token or node begins."""
    return item.start_pos or 0 if isinstance(item, Token) else item.span.start


def end_of(item: _Placed) -> int:
    """Where a token or node ends."""
    return start_of(item) + len(item) if isinstance(item, Token) else item.span.end


def span_of(items: Sequence[Any]) -> Span:
    """From the first to the last of the items; leading annotations may be an empty tuple."""
    first = items[0]
    if isinstance(first, tuple):
        first = first[0] if first else items[1]
    return Span(start_of(first), end_of(items[-1]))


def tokens_of(items: Sequence[Any], *kinds: str) -> list[Token]:
    """The tokens of these kinds."""
    return [i for i in items if isinstance(i, Token) and i.type in kinds]


def nodes_of(items: Sequence[Any], *kinds: type) -> tuple[Any, ...]:
    """The nodes of these kinds."""
    return tuple(i for i in items if isinstance(i, kinds))


def first_of(items: Sequence[Any], kind: type[_Kind]) -> _Kind | None:
    """The first node of a kind, if there is one."""
    return next((i for i in items if isinstance(i, kind)), None)


def place_of(token: Token) -> Span:
    """The place of a token."""
    return Span(start_of(token), end_of(token))


@dataclass(frozen=True, slots=True)
class Names:
    """A list of names after `extends` or `implements`."""

    keyword: str
    names: tuple[Token, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Listed:
    """Expressions between commas."""

    items: tuple[m.Expression, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Parameters:
    items: tuple[m.Parameter, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Timing:
    keyword: str
    value: m.Expression
    span: Span


@dataclass(frozen=True, slots=True)
class CallTail:
    """What follows the name of a call: arguments, after, deadline."""

    arguments: tuple[m.Expression, ...]
    after: m.Expression | None
    deadline: m.Expression | None
    span: Span


@dataclass(frozen=True, slots=True)
class CaseLabel:
    value: m.Expression | None
    annotations: tuple[m.Annotation, ...]
    span: Span


def listed(item: object) -> tuple[m.Expression, ...]:
    """The expressions of a list; none where there is no list."""
    return item.items if isinstance(item, Listed) else ()


def case_of(label: CaseLabel, statements: list[m.Statement]) -> m.Case:
    """A label with its statements."""
    end = statements[-1] if statements else label
    return m.Case(label.value, tuple(statements), label.annotations, label.span.to(end.span))


def body_of(item: m.Block | Token) -> m.Block | None:
    """A body, or None where a semicolon stands for it."""
    return item if isinstance(item, m.Block) else None


def call_of(target: m.Expression | None, name: Token, tail: CallTail, span: Span) -> m.Call:
    return m.Call(
        target, str(name), tail.arguments, tail.after, tail.deadline, span, place_of(name)
    )


def integer(token: Token) -> int:
    """The value of an integer literal: decimal, hexadecimal, binary or octal (leading 0).

    What is too large for every place of a model is the same number, one that is a float as well.
    """
    return min(_whole(token), _TOO_LARGE)


def _whole(token: Token) -> int:
    digits = token.rstrip("lL").replace("_", "").lower()
    if len(digits) > 1 and digits[0] == "0" and digits.isdigit():
        return int(digits, 8 if set(digits) <= set("01234567") else 10)
    return int(digits, 0)
