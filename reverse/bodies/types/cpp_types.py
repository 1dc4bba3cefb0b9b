"""The types of C++ as types of the model."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from functools import lru_cache

from tree_sitter import Node

from rebsync.model import Type
from rebsync.names import uncarry
from rebsync.records import dataclass
from rebsync.reserved import NO_CLASSES
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.syntax.cpp_numerals import whole_number
from rebsync.reverse.syntax.cpp_tree import named, part, text_of

SCALARS = frozenset({"boolean", "byte", "short", "int", "float", "double"})
_INTEGERS = {
    "byte": ("int8_t", "signed char"),
    "short": ("int16_t", "short", "short int"),
    "int": ("int32_t", "int", "signed", "signed int"),
}
_PLAIN = {spelled: name for name, all_of in _INTEGERS.items() for spelled in all_of}
_PLAIN |= {"bool": "boolean", "float": "float", "double": "double", "void": "void"}
_UNSIGNED = {
    **dict.fromkeys(("uint8_t", "unsigned char", "u_char", "u_int8_t"), ("short", 8)),
    **dict.fromkeys(("uint16_t", "unsigned short", "unsigned short int"), ("int", 16)),
}
# By the bits that values have, the sign not counted: of these types is what one word names.
_WIDE = {
    **dict.fromkeys(("uint32_t", "uint", "u_int", "u_int32_t"), 32),
    **dict.fromkeys(("int64_t", "ssize_t", "ptrdiff_t", "intptr_t"), 63),
    **{f"int_fast{bits}_t": 63 for bits in (8, 16, 32, 64)},
    **dict.fromkeys(("uint64_t", "size_t", "u_long", "u_int64_t", "uintptr_t"), 64),
}
_TIMES = frozenset({"Time", "Duration", "WallTime", "WallDuration", "SteadyTime"})
_ATOMIC = re.compile(r"(?:::)?std::atomic(?:_(?=bool$|int$)| ?< ?)((?:\w|:| )*\w) ?>?$")
_SCOPES = re.compile(r"^(?:::)?(?:std::)?")


def type_of(node: Node) -> Type | None:
    """The model's type for a C++ type, or None where it has none: `Rebec<C>` is C."""
    match node.type:
        case "type_descriptor":
            return type_of(part(node, "type"))
        case "qualified_identifier":
            return type_of(part(node, "name"))
        case "template_type":
            return _of_template(node)
        case _:
            name = _PLAIN.get(_SCOPES.sub("", text_of(node)))
            return Type(name) if name else None


def _of_template(node: Node) -> Type | None:
    arguments = named(part(node, "arguments"))
    match text_of(part(node, "name")), len(arguments):
        case "array", 2:
            inner = type_of(arguments[0])
            length = whole_number(text_of(arguments[1]))
            if inner is None or length is None:
                return None
            return Type(inner.name, (length, *inner.dimensions))
        case "Rebec", 1:
            return Type(class_name(text_of(arguments[0])))
        case _:
            return None


def arguments_of(type_: Node, name: str) -> Sequence[Node]:
    """The types that `std::name<...>` has in its angle brackets; nothing of other types."""
    scope = type_.child_by_field_name("scope")  # `::name` has none
    if type_.type == "qualified_identifier" and scope is not None and text_of(scope) == "std":
        type_ = part(type_, "name")
        if type_.type == "template_type" and text_of(part(type_, "name")) == name:
            return named(part(type_, "arguments"))
    return ()


def class_name(text: str) -> str:
    """The reactive class of a C++ class."""
    return uncarry(text.rpartition("::")[2].strip(), NO_CLASSES)


# --- types that people write --------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Carried:
    """What the model keeps of the values of a type of C++.

    `bits` is the width of an unsigned type that wraps sooner than `type`; `wide` are the bits
    without the sign of one that holds more, and `why` says so: 32, 63 or 64.
    """

    type: Type
    bits: int = 0
    why: str = ""
    wide: int = 0


def carried(node: Node, enums: Collection[str] = (), *, texts: bool = True) -> Carried | None:
    """What the model keeps of a type that a person wrote, or None if it has nothing like it.

    Times and durations of ROS are whole numbers of the model's unit of time. Generated code has no
    `texts`.
    """
    kind = node.type
    if kind == "type_descriptor":
        return carried(part(node, "type"), enums, texts=texts)
    text = text_of(node)
    if texts and (atomic := _ATOMIC.match(text)) is not None:
        text = atomic[1]
    elif kind == "template_type" or (kind == "qualified_identifier" and "<" in text):
        array = type_of(node)
        return Carried(array) if array is not None else None
    if (known := _spelled(text)) is not None:
        return known if texts or known.type != TEXT else None
    text = " ".join(text.split())
    last = text.rpartition("::")[2]
    return Carried(Type("int")) if text in enums or last in enums else None


def carried_in(type_: Node, enums: Collection[str]) -> Carried | None:
    """What the model keeps of the type of a member; nothing of a bit-field, which holds less."""
    above = type_.parent
    if above is not None and any(map(_is_width, above.named_children)):
        return None
    return carried(type_, enums)


def _is_width(node: Node) -> bool:
    """Whether it is the width of a bit-field; the grammar has it in an error if a value follows."""
    return node.type == "bitfield_clause" or (node.type == "ERROR" and text_of(node)[:1] == ":")


@lru_cache(maxsize=512)  # the same few types are written again and again
def _spelled(text: str) -> Carried | None:
    """What the model keeps of a type of C++ or ROS by how it is written."""
    if _is_time(text):
        return Carried(Type("int"))
    text = " ".join(text.split())
    name = _SCOPES.sub("", text)
    if name in _PLAIN and name != "void":
        return Carried(Type(_PLAIN[name]))
    if name == "char":
        return Carried(Type("byte"))
    if name == "string":
        return Carried(TEXT)
    if name in _UNSIGNED:
        return Carried(Type(_UNSIGNED[name][0]), _UNSIGNED[name][1])
    if wide := _wide(name):
        return Carried(Type("int"), 0, wider(text), wide)
    return None


def _wide(name: str) -> int:
    """The bits without the sign of an integer that holds more than an int; 0 for other types."""
    words = name.split()
    if not words or not set(words) <= {"long", "int", "unsigned", "signed"}:
        return _WIDE.get(name, 0)
    if "long" in words:
        return 64 if "unsigned" in words else 63
    return 32 if "unsigned" in words else 0


def is_time(node: Node) -> bool:
    """Whether a type is a time or a duration of ROS."""
    return _is_time(text_of(node))


def _is_time(text: str) -> bool:
    scope, _, last = text.strip().rpartition("::")
    return last in _TIMES and scope.strip(":") == "ros"


def wider(what: str) -> str:
    """What is said of a type, or of a field of a message, that is wider than the model's."""
    return f'"{what}" holds more than the model\'s int does'
