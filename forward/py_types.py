"""The types of the model in Python."""

from __future__ import annotations

import re

from rebsync.forward.cpp_types import is_text
from rebsync.literals import plain_float
from rebsync.model import Type
from rebsync.names import carry
from rebsync.package import Draw, Value
from rebsync.reserved import NO_PYTHON_CLASSES

_PLAIN = {
    "byte": "Byte",
    "short": "Short",
    "int": "int",
    "float": "Float",
    "double": "float",
    "boolean": "bool",
    "void": "None",
}
# What makes a value of a type out of another.
_FORMATS = {
    "byte": "int8",
    "short": "int16",
    "int": "int32",
    "float": "float32",
    "double": "float64",
    "boolean": "boolean",
}
_ZEROS = {
    **dict.fromkeys(("byte", "short", "int"), "0"),
    **dict.fromkeys(("float", "double"), "0.0"),
    "boolean": "False",
}


_PARTS = re.compile(r"\\.|[^\\]")
_QUOTES = ("\\'", '\\"')


def class_type(name: str) -> str:
    """The Python class of a reactive class or interface."""
    return carry(name, NO_PYTHON_CLASSES)


def py_type(type_: Type) -> str:
    """`int`, `Array[bool, Literal[2]]`, `Rebec[Robot]` for the name of a rebec."""
    text = _PLAIN.get(type_.name) or f"Rebec[{class_type(type_.name)}]"
    for length in reversed(type_.dimensions):
        text = f"Array[{text}, Literal[{length}]]"
    return text


def py_format(type_: Type) -> str:
    """What converts to the type: `int32`, `float32`, `Rebec`."""
    return _FORMATS.get(type_.name, "Rebec")


def plain_type(type_: Type) -> str:
    """The class whose call gives the value of what is unset: `int()`, `Byte()`, `Rebec()`."""
    return _PLAIN.get(type_.name, "Rebec")


def unset_value(type_: Type) -> str:
    """What a variable holds that nothing has been stored in."""
    if type_.dimensions:
        return f"array({plain_type(type_)}, {', '.join(map(str, type_.dimensions))})"
    return f"{plain_type(type_)}()"


def first_value(type_: Type) -> str:
    """What a state variable holds at first: `0`, `0.0`, `False`, `Rebec()`, an array of these.

    A local that is not set is `int()` instead, which the reader tells from one that is set to 0.
    """
    zero = _ZEROS.get(type_.name)
    return unset_value(type_) if type_.dimensions or zero is None else zero


def from_message(value: str, type_: Type) -> str:
    """A field of a message as a value of the type."""
    if type_.dimensions:
        lengths = ", ".join(map(str, type_.dimensions))
        return f"unflatten({value}, {py_format(type_)}, {lengths})"
    return f"Rebec({value})" if is_text(type_) else value


def py_value(value: Value) -> str:
    """A constant in Python."""
    match value:
        case bool():
            return "True" if value else "False"
        case str():
            return py_string('"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"')
        case tuple():
            return f"Array([{', '.join(py_value(v) for v in value)}])"
        case float():
            return plain_float(repr(value))
        case _:
            return repr(value)


def py_string(literal: str) -> str:
    """A text in double quotes with the quotes that need fewer escapes, as a formatter has it."""
    parts = [p[1] if p in _QUOTES else p for p in _PARTS.findall(literal[1:-1])]
    quote = "'" if parts.count('"') > parts.count("'") else '"'
    return quote + "".join(f"\\{p}" if p == quote else p for p in parts) + quote


def py_choices(draw: Draw) -> str:
    """What a sensor that is played draws from."""
    return ", ".join(map(py_value, draw.alternatives))
