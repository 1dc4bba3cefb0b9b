"""What `isinstance` and `in` of Python ask of the values on their right."""

from __future__ import annotations

from rebsync.reverse.analysis.held_values import held_by
from rebsync.reverse.analysis.origins import ClassOrigin, LibraryOrigin
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.python.operator_types import ITERABLE
from rebsync.reverse.analysis.python.value_types import (
    ContainerType,
    InstanceType,
    ValueType,
    own_type,
)
from rebsync.reverse.ir import expressions as e


def are_classes(notes: ProblemNotes, value: e.Expression) -> bool:
    """Whether a value is a class, or a tuple of classes."""
    if isinstance(value, e.Build):
        parts = value.elements
        return all(not isinstance(v, e.Spread) and are_classes(notes, v) for v in parts)
    if isinstance(value, e.Binary):  # of types: `int | str`
        return are_classes(notes, value.left) and are_classes(notes, value.right)
    held = held_by(notes.origins, value, notes.function.name)
    built = [v for _, v in held if isinstance(v, e.Build)]
    if held and len(built) == len(held):
        return all(are_classes(notes, each) for each in built)
    return all(
        isinstance(o, ClassOrigin | LibraryOrigin) and not o.of_object
        for o in notes.origins.of(value, notes.function.name)
    )


def is_in_class(notes: ProblemNotes, left: e.Expression, right: e.Expression) -> bool:
    """Whether something is looked for in a class, other than members in their enumeration."""
    held, name = notes.origins.of, notes.function.name
    found = {o for o in held(right, name) if isinstance(o, ClassOrigin) and not o.of_object}
    members = {o.name for o in held(left, name) if isinstance(o, ClassOrigin) and o.of_object}
    return bool(found) and members != {o.name for o in found}


def is_searched(type_: ValueType | None) -> bool:
    """Whether `in` looks for something in values of a type; objects answer for themselves."""
    is_range = isinstance(type_, ContainerType) and type_.own is None
    return is_range or isinstance(type_, InstanceType) or own_type(type_) in ITERABLE
