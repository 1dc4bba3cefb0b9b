"""Sends to overloads: the model chooses among them by the types of what is sent, the code does not.

A class has a server several times where its overloads take equally many arguments. The code names
one of them; what it passes on then is written so that the model chooses the same.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import field
from functools import cached_property
from typing import TypeAlias

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.models.building import binary, cast, chosen
from rebsync.static.types import converts, is_boolean, is_integer, is_numeric

# The types of parameters; None for what is no plain number or truth value.
Signature: TypeAlias = "tuple[m.Type | None, ...]"

WHY = "it is not known which overload takes this: the model tells them apart by types"
HINT = "keep what is sent in a variable of the type that the server takes"


@dataclass(frozen=True)
class Served:
    """What classes serve: by class the servers, those above included, by their messages' types.

    `fields` are those of the types, in their order.
    """

    classes: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    fields: Mapping[str, Sequence[m.Type | None]] = field(default_factory=dict)

    def joined(self, classes: Mapping[str, Mapping[str, str]]) -> Served:
        """The same with classes more."""
        return Served({**self.classes, **classes}, self.fields)

    @cached_property
    def servers(self) -> dict[str, str]:
        """The servers of all classes by the types of their messages."""
        return {t: s for of_class in self.classes.values() for t, s in of_class.items()}

    def rivals(self, message: str, own: Signature) -> frozenset[Signature]:
        """The signatures of servers of a name that take as many arguments as this one.

        Those that all classes have that serve this type of message.
        """
        having = (c for c in self.classes.values() if message in c)
        found = [self._of(each, each[message], own) for each in having]
        return frozenset.intersection(*found) if found else frozenset()

    def rivals_in(self, owner: str, server: str, own: Signature) -> frozenset[Signature]:
        """The same of a server of a class."""
        return self._of(self.classes.get(owner, {}), server, own)

    def _of(self, of_class: Mapping[str, str], server: str, own: Signature) -> frozenset[Signature]:
        told = (self.fields[t] for t, s in of_class.items() if s == server and t in self.fields)
        return frozenset(plain(types) for types in told if len(types) == len(own)) - {own}


def plain(types: Sequence[m.Type | None]) -> Signature:
    """Types of which only plain ones are told."""
    return tuple(t if t is not None and (is_numeric(t) or is_boolean(t)) else None for t in types)


def telling(
    values: tuple[m.Expression, ...],
    own: Signature,
    rivals: Collection[Signature],
    kind: Callable[[m.Expression], m.Type | None],
) -> tuple[m.Expression, ...] | None:
    """Arguments by which the model chooses the server `own`; None where their types are not known.

    `kind` tells the type of an expression. Arguments that tell already are left as they are.
    """
    if not rivals or _tells(values, own, rivals, kind):
        return values
    pairs = [(v, kind(v), t) for v, t in zip(values, own, strict=True)]
    if any(of is None and t is not None for _, of, t in pairs):
        return None
    alike = tuple(_of_kind(v, of, t) for v, of, t in pairs)
    if _tells(alike, own, rivals, kind):
        return alike
    exact = tuple(
        v if t is None or kind(v) == t else cast(t, v) for v, t in zip(alike, own, strict=True)
    )
    return exact if _tells(exact, own, rivals, kind) else None


def _tells(
    values: tuple[m.Expression, ...],
    own: Signature,
    rivals: Collection[Signature],
    kind: Callable[[m.Expression], m.Type | None],
) -> bool:
    """Whether these arguments are just those of a server, or can be those of no other."""
    given = [kind(v) for v in values]
    if all(t is None or t == of for t, of in zip(own, given, strict=True)):
        return True
    return _fits(given, own) and not any(_fits(given, other) for other in rivals)


def _fits(given: Sequence[m.Type | None], signature: Signature) -> bool:
    pairs = zip(given, signature, strict=True)
    return all(of is None or t is None or converts(of, t, {}) for of, t in pairs)


def _of_kind(value: m.Expression, of: m.Type | None, wanted: m.Type | None) -> m.Expression:
    """A number where one is wanted, and a truth value where that is, as the code converts them."""
    if of is None or wanted is None:
        return value
    if is_boolean(of) and is_numeric(wanted):
        return chosen(value, m.IntLiteral(1), m.IntLiteral(0))
    if is_numeric(of) and is_boolean(wanted):
        zero = m.IntLiteral(0) if is_integer(of) else m.FloatLiteral("0.0")
        return binary("!=", value, zero)
    return value
