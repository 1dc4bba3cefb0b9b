"""The order in which fields of messages are parameters of servers: as code hands them on.

What a message file says of their order means nothing to nodes, which know fields by their names:
those that the parameters of the handlers have.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from rebsync.model import Type
from rebsync.names import field_names
from rebsync.reserved import RESPONSE_FIELD, RUNTIME_FIELDS

Messages: TypeAlias = Mapping[str, Mapping[str, Type | None]]
Orders: TypeAlias = Iterable[tuple[str, Sequence[str]]]  # by message type, without its package


def in_order(messages: Messages, orders: Orders) -> Messages:
    """Message types with their fields in these orders; as they are where there are several."""
    handed_on: dict[str, set[tuple[str, ...]]] = {}
    for name, fields in orders:
        handed_on.setdefault(name, set()).add(tuple(fields))
    found: dict[str, Mapping[str, Type | None]] = {}
    for type_, fields_of in messages.items():
        known = handed_on.get(type_.rpartition("/")[2], set())
        order = next(iter(known)) if len(known) == 1 else ()
        fits = len(order) == len(fields_of) and set(order) == set(fields_of)
        found[type_] = {name: fields_of[name] for name in order} if fits else fields_of
    return found


def are_named(fields: Sequence[str], parameters: Iterable[str]) -> bool:
    """Whether fields are those that a handler's parameters have in a message, in their order."""
    return tuple(fields) == field_names(parameters, (*RUNTIME_FIELDS, RESPONSE_FIELD))
