"""Functions of generated code that only send: they fill a message from what they get, and send it.

Whatever else such a function does makes it a function of the model. The readers of each language
tell what its statements do, one by one.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import prod
from typing import TypeAlias

from tree_sitter import Node

from rebsync.model import Type
from rebsync.records import dataclass
from rebsync.static.types import PRIMITIVES


@dataclass(frozen=True, slots=True)
class MessageMade:
    """A message of a type is made, by its name without the package."""

    type: str


@dataclass(frozen=True, slots=True)
class Filled:
    """A field of that message gets a value, which is the name of a parameter if it is one."""

    field: str
    value: str


@dataclass(frozen=True, slots=True)
class Signed:
    """The message says who sends it."""


@dataclass(frozen=True, slots=True)
class MessagePublished:
    """A message is published; `as_asked`: that one, to whom and when the function is told."""

    as_asked: bool


@dataclass(frozen=True, slots=True)
class MessagePosted:
    """A message is posted to the rebec itself with these values; None: otherwise than generated."""

    given: tuple[str, ...] | None


# What one statement does; None for anything else.
Step: TypeAlias = MessageMade | Filled | Signed | MessagePublished | MessagePosted | None


@dataclass(frozen=True, slots=True)
class SendFunction:
    """A function that sends: `given` are its parameters but for the receiver and the time.

    `message` is the type that its publisher is for, empty where it posts, `fields` are those of the
    type in their order, if they are known. `is_signed`: such messages say who sends them.
    """

    given: tuple[str, ...]
    message: str
    fields: Sequence[str] | None
    is_signed: bool

    def odd(self, steps: Iterable[tuple[Node, Step]], whole: Node) -> list[Node]:
        """The statements that do not put each parameter into its field, or send that once.

        Of what is left out `whole` is told, if nothing else is.
        """
        odd: dict[int, Node] = {}
        waiting, made = list(self.given), None
        is_signed = is_sent = False
        for node, step in steps:
            match step:
                case MessageMade(type_):
                    is_right = made is None and type_ == (self.message or type_)
                    made = made or node
                case Filled(field, value):
                    is_right = made is not None and self._is_own(field, value, waiting)
                    waiting = [name for name in waiting if name != value]
                case Signed():
                    is_right = made is not None
                    is_signed = True
                case MessagePublished(as_asked):
                    is_right = as_asked and not waiting
                case MessagePosted(given):
                    is_right = given is not None and list(given) == waiting
                case None:
                    is_right = False
            if is_sent or not is_right:
                odd.setdefault(node.id, node)
            if isinstance(step, MessagePublished | MessagePosted):
                is_sent, waiting = True, []
        if made is not None and self.is_signed and not is_signed:
            odd.setdefault(made.id, made)
        if not odd and (waiting or not is_sent):
            odd[whole.id] = whole
        return [*odd.values()]

    def _is_own(self, field: str, value: str, waiting: Sequence[str]) -> bool:
        """Whether a field is that of a parameter; where none are known, it is in its turn."""
        if self.fields is None or len(self.fields) != len(self.given):
            return value in waiting[:1]
        return value in waiting and field == dict(zip(self.given, self.fields, strict=True))[value]


def in_order_of_fields(
    given: Sequence[str], fields: Iterable[str], steps: Iterable[tuple[Node, Step]]
) -> tuple[str, ...]:
    """Parameters in the order of the fields that they are stored in, if each field has one."""
    into = {step.field: step.value for _, step in steps if isinstance(step, Filled)}
    order = tuple(into.get(name, "") for name in fields)
    return order if sorted(order) == sorted(given) else tuple(given)


def is_kept(field: Type | None, type_: Type | None) -> bool:
    """Whether a field has all values of a parameter; a rebec's name is a string."""
    if field is None or type_ is None:
        return type_ is None or type_.name not in PRIMITIVES
    return field.name == type_.name and prod(field.dimensions) == prod(type_.dimensions)
