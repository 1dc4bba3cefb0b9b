"""The types of Timed Rebeca and how values of one become values of another."""

from __future__ import annotations

from rebsync.model import Type
from rebsync.static.symbols import Classes

BYTE = Type("byte")
SHORT = Type("short")
INT = Type("int")
FLOAT = Type("float")
DOUBLE = Type("double")
BOOLEAN = Type("boolean")
STRING = Type("String")
VOID = Type("void")
NULL = Type("null")
REACTIVE_CLASS = Type("ReactiveClass")

INT_MIN, INT_MAX = -(2**31), 2**31 - 1

_RANK = {"byte": 0, "short": 1, "int": 2, "float": 3, "double": 4}
_NO_REBEC = frozenset((*_RANK, "boolean", "String", "void", "null"))

PRIMITIVES = {t.name: t for t in (BYTE, SHORT, INT, FLOAT, DOUBLE, BOOLEAN)}
REFUSED = {
    "char": "a ROS node exchanges numbers, booleans and names of rebecs",
    "String": "a ROS node exchanges numbers, booleans and names of rebecs",
    "Timer": "keep the time in an int (started = now); now - started is what has passed since",
    "ArrayList": "declare an array of fixed length, such as int[4], instead",
}
TYPE_NAMES = frozenset((*PRIMITIVES, *REFUSED, "void", "null", "ReactiveClass"))


def is_integer(type_: Type) -> bool:
    """Whether the type is byte, short or int."""
    return not type_.dimensions and _RANK.get(type_.name, 9) <= 2


def is_numeric(type_: Type) -> bool:
    """Whether the type is an integer type, float or double."""
    return not type_.dimensions and type_.name in _RANK


def is_floating(type_: Type) -> bool:
    """Whether the type is float or double."""
    return is_numeric(type_) and _RANK[type_.name] > 2


def is_boolean(type_: Type) -> bool:
    """Whether the type is boolean."""
    return type_.name == "boolean" and not type_.dimensions


def is_rebec(type_: Type) -> bool:
    """Whether values of the type are rebecs; `null` is not counted."""
    return not type_.dimensions and type_.name not in _NO_REBEC


def integer_type(value: int) -> Type:
    """The smallest integer type that holds a value: the type of its literal."""
    if -128 <= value <= 127:
        return BYTE
    return SHORT if -32768 <= value <= 32767 else INT


def element(type_: Type, depth: int = 1) -> Type:
    """The type of an array's element after `depth` indices."""
    return Type(type_.name, type_.dimensions[depth:])


def wider(left: Type, right: Type) -> Type:
    """The wider of two numeric types."""
    return left if _RANK[left.name] >= _RANK[right.name] else right


def converts(source: Type, target: Type, classes: Classes) -> bool:
    """Whether a value of `source` may stand where `target` is expected, without a cast."""
    if source.name == target.name:
        return source.dimensions == target.dimensions
    if source.dimensions or target.dimensions:
        return False
    if source.name in _RANK and target.name in _RANK:
        return _RANK[source.name] < _RANK[target.name]
    if source.name == "null":
        return is_rebec(target)
    return is_rebec(source) and is_rebec(target) and _descends(source.name, target.name, classes)


def casts(source: Type, target: Type, classes: Classes) -> bool:
    """Whether `(target) source` is allowed: a conversion, up or down."""
    return converts(source, target, classes) or converts(target, source, classes)


def common(left: Type, right: Type, classes: Classes) -> Type | None:
    """The type that both convert to, if it is one of the two."""
    if converts(left, right, classes):
        return right
    return left if converts(right, left, classes) else None


def _descends(name: str, ancestor: str, classes: Classes) -> bool:
    if ancestor == "ReactiveClass":
        return True
    info = classes.get(name)
    return info is not None and (info.partial or ancestor in info.ancestors)
