"""What messages of ROS refuse in Python: fields that they have not, and values of other types.

Client libraries refuse a value where it is stored, or where the message is sent.
"""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.reverse.analysis.facts import Facts
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.python.argument_types import message_name
from rebsync.reverse.analysis.python.operand_kinds import OperandKinds
from rebsync.reverse.analysis.python.value_types import (
    LibraryType,
    MessageType,
    OwnType,
    ValueTypes,
    own_type,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.libraries.attributes import SAME_TIMES

_WRONG = "is of another type"
_LACKS = "has no such attribute"
_REFUSED = "gets other arguments than it takes"
_STAMP = "builtin_interfaces/Time"
_LISTED = frozenset({OwnType.LIST, OwnType.TUPLE, OwnType.ARRAY, OwnType.QUEUE, OwnType.SET})


class MessageErrors:
    """The messages of one function."""

    def __init__(self, notes: ProblemNotes, kinds: OperandKinds) -> None:
        self._notes = notes
        self._kinds = kinds
        self._types = notes.counts.rules.types

    def made(self, node: s.Call, name: str, facts: Facts) -> None:
        """Notes that a message gets other fields than its type has, or all but some by place."""
        fields = self._notes.table.fields(message_name(name) or "")
        if fields is None or any(a.stars for a in node.arguments):
            return
        by_place = [a.value for a in node.arguments if a.name is None]
        named = {a.name: a.value for a in node.arguments if a.name is not None}
        takes_none = self._notes.table.fields(_STAMP) is not None  # in ROS 2 all are by name
        is_short = bool(by_place) and (takes_none or bool(named) or len(by_place) != len(fields))
        if is_short or not named.keys() <= fields.keys():
            self._notes.fails(node, _REFUSED)
            return
        given = {**dict(zip(fields, by_place, strict=False)), **named}
        if any(not self._fits(fields[f], value, facts) for f, value in given.items()):
            self._notes.fails(node, _WRONG)

    def stored(self, target: e.Attribute, value: e.Expression | None, facts: Facts) -> None:
        """Notes that something is stored in a field that a message has not, or of another type."""
        for type_ in self._kinds.types(target.object, facts):
            if isinstance(type_, MessageType):
                fields: Mapping[str, str] = self._notes.table.fields(type_.name) or {}
                if target.name not in fields:
                    self._notes.fails(target, _LACKS)
                elif value is not None and not self._fits(fields[target.name], value, facts):
                    self._notes.fails(target, _WRONG)

    def _fits(self, field: str, value: e.Expression, facts: Facts) -> bool:
        """Whether a field of a type takes a value, as far as its types are known."""
        return _takes(
            self._types.attributes.field(field), self._kinds.known(self._kinds.types(value, facts))
        )


def _takes(expected: ValueTypes, given: ValueTypes) -> bool:
    if None in expected or not given:
        return bool(given)
    kinds = frozenset(map(own_type, expected))
    if any(isinstance(type_, LibraryType) for type_ in expected):  # times of ROS 1
        known = (t.name for t in given if isinstance(t, LibraryType))
        return len(given) == len([n for n in known if SAME_TIMES.get(n, n) in SAME_TIMES.values()])
    if None in kinds:  # bytes, and what has a length of its own
        return (
            frozenset(map(own_type, given)) <= _LISTED | {OwnType.BYTES, None} and None not in given
        )
    if kinds == {OwnType.ARRAY}:
        return frozenset(map(own_type, given)) <= _LISTED
    if kinds == {OwnType.MESSAGE}:
        return given <= expected
    return frozenset(map(own_type, given)) <= kinds
