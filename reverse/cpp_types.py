"""The types of C++ as types of the model."""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.model import Type
from rebsync.names import uncarry
from rebsync.reserved import NO_CLASSES
from rebsync.reverse.cpp_tree import named, part, text_of

_INTEGERS = {
    "byte": ("int8_t", "signed char"),
    "short": ("int16_t", "short", "short int"),
    "int": ("int32_t", "int", "signed", "signed int"),
}
_PLAIN = {spelled: name for name, all_of in _INTEGERS.items() for spelled in all_of}
_PLAIN |= {"bool": "boolean", "float": "float", "double": "double", "void": "void"}
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
            length = text_of(arguments[1])
            if inner is None or not length.isdecimal():
                return None
            return Type(inner.name, (int(length), *inner.dimensions))
        case "Rebec", 1:
            return Type(class_name(text_of(arguments[0])))
        case _:
            return None


def class_name(text: str) -> str:
    """The reactive class of a C++ class."""
    return uncarry(text.rpartition("::")[2], NO_CLASSES)
