"""The types of the model in C++."""

from __future__ import annotations

from rebsync.model import Type
from rebsync.names import carry
from rebsync.package import Draw, Value
from rebsync.reserved import NO_CLASSES

_PLAIN = {
    "byte": "int8_t",
    "short": "int16_t",
    "int": "int32_t",
    "float": "float",
    "double": "double",
    "boolean": "bool",
    "void": "void",
}

# A literal of this value would be a long with a minus.
LOWEST = "INT32_MIN"


def class_type(name: str) -> str:
    """The C++ class of a reactive class or interface."""
    return carry(name, NO_CLASSES)


def cpp_type(type_: Type) -> str:
    """`int32_t`, `std::array<bool, 2>`, `Rebec<Robot>` for the name of a rebec."""
    return _in_arrays(_PLAIN.get(type_.name) or f"Rebec<{class_type(type_.name)}>", type_)


def stored_type(type_: Type) -> str:
    """The type that `cpp_type` is for the compiler: what it can tell overloads apart by."""
    return _in_arrays(_PLAIN.get(type_.name, "std::string"), type_)


def _in_arrays(text: str, type_: Type) -> str:
    for length in reversed(type_.dimensions):
        text = f"std::array<{text}, {length}>"
    return text


def parameter_type(type_: Type) -> str:
    """How a value of the type is passed: by value where it is small."""
    text = cpp_type(type_)
    return text if text in _PLAIN.values() else f"const {text}&"


def is_text(type_: Type) -> bool:
    """Whether values of the type are names of rebecs."""
    return type_.name not in _PLAIN


def cpp_value(value: Value) -> str:
    """A constant in C++; nested braces for arrays."""
    match value:
        case bool():
            return "true" if value else "false"
        case str():
            return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
        case tuple():
            return "{{" + ", ".join(cpp_value(v) for v in value) + "}}"
        case -0x80000000:
            return LOWEST
        case _:
            return repr(value)


def cpp_choices(draw: Draw) -> str:
    """What a sensor that is played draws from."""
    values = ", ".join(map(cpp_value, draw.alternatives))
    return f"std::initializer_list<{cpp_type(draw.type)}>{{{values}}}"
