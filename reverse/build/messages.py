"""Message files of ROS 1 (`.msg`): fields, constants and the comments beside them.

Read as genmsg reads them: `#` starts a comment, except in the value of a text constant; types
without a package are built in, `Header`, or of the message's own package.
"""

from __future__ import annotations

import ast
import re
from dataclasses import replace
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.unknowns import Open, Unknown
from rebsync.source import Source, Span

ConstantValue: TypeAlias = "bool | int | float | str"

_INTEGERS = {
    **{f"int{bits}": (-(1 << bits - 1), (1 << bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (0, (1 << bits) - 1) for bits in (8, 16, 32, 64)},
    "byte": (-128, 127),
    "char": (0, 255),
}
_PRIMITIVE = frozenset({*_INTEGERS, "bool", "float32", "float64", "string"})
BUILT_IN = _PRIMITIVE | {"time", "duration"}
_ALIASES = {"byte": "int8", "char": "uint8"}

_TYPE = re.compile(r"([A-Za-z][\w/]*)((?:\[\d*\])?)\Z", re.ASCII)
_NAME = re.compile(r"[A-Za-z]\w*\Z", re.ASCII)
_CONSTANT_NAME = re.compile(r"[A-Za-z_]\w*\Z", re.ASCII)


@dataclass(frozen=True, slots=True)
class MessageField:
    """A field. `type` is a built-in type or `package/Type`, without the brackets of an array.

    `length` is None for what is no array, 0 for an array of any length, else the fixed length.
    `comments` are those above it and the one beside it, without `#`.
    """

    name: str
    type: str
    length: int | None
    comments: tuple[str, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class MessageConstant:
    """A constant: its built-in type and its value."""

    name: str
    type: str
    value: ConstantValue
    comments: tuple[str, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class MessageFile:
    """A message type as its file declares it; what cannot be read is in `unknowns`."""

    package: str
    name: str
    fields: tuple[MessageField, ...]
    constants: tuple[MessageConstant, ...]
    unknowns: tuple[Unknown, ...]
    source: Source

    @property
    def full_name(self) -> str:
        """The type with its package: `package/Name`."""
        return f"{self.package}/{self.name}"

    def field(self, name: str) -> MessageField | None:
        """The field of that name."""
        return next((f for f in self.fields if f.name == name), None)


def plain_type(type_: str) -> str:
    """The type in today's words: `byte` and `char` are old names of `int8` and `uint8`."""
    return _ALIASES.get(type_, type_)


def full_type(name: str, package: str) -> str:
    """A type as it is written in a message of this package, with its package if it has one."""
    if name == "Header":
        return "std_msgs/Header"
    return name if name in BUILT_IN or "/" in name else f"{package}/{name}"


def read_message(source: Source, package: str, name: str) -> MessageFile:
    """What the file of the message type `package/name` declares."""
    fields: dict[str, MessageField] = {}
    constants: dict[str, MessageConstant] = {}
    unknowns: list[Unknown] = []
    above: tuple[str, ...] = ()
    start = 0
    for raw in source.text.split("\n"):
        line = raw.rstrip("\r")
        code, hash_, comment = line.partition("#")
        comments = (*above, comment.strip()) if hash_ else above
        if not code.strip():
            above = comments if hash_ else ()
        else:
            above = ()
            span = _trimmed(code, start)
            read = _line(line, code.strip(), package, span)
            read = _first(read, fields, constants) if not isinstance(read, Open) else read
            match read:
                case MessageField():
                    fields[read.name] = replace(read, comments=comments)
                case MessageConstant():
                    beside = above if read.type == "string" else comments
                    constants[read.name] = replace(read, comments=beside)
                case Open(why):
                    unknowns.append(Unknown(f"`{code.strip()}`", why, source, span))
        start += len(raw) + 1
    return MessageFile(
        package, name, tuple(fields.values()), tuple(constants.values()), tuple(unknowns), source
    )


def _trimmed(code: str, start: int) -> Span:
    return Span(start + len(code) - len(code.lstrip()), start + len(code.rstrip()))


def _first(
    read: MessageField | MessageConstant,
    fields: dict[str, MessageField],
    constants: dict[str, MessageConstant],
) -> MessageField | MessageConstant | Open:
    """The declaration, unless its name is taken."""
    if read.name in fields or read.name in constants:
        return Open(f"the name `{read.name}` is declared above")
    return read


def _line(line: str, code: str, package: str, span: Span) -> MessageField | MessageConstant | Open:
    type_, _, rest = code.partition(" ")
    if "=" in code:
        return _constant(type_, line, code, span)
    match = _TYPE.match(type_)
    name = rest.strip()
    if not match or "//" in type_:
        return Open(f"`{type_}` is no type of a field")
    if not _NAME.match(name):
        return Open(f"`{name}` is no name of a field" if name else "a field needs a name")
    brackets = match[2]
    length = int(brackets[1:-1] or 0) if brackets else None
    if brackets and brackets != "[]" and not length:
        return Open("an array of no elements")
    # genmsg takes `Header` alone for that of std_msgs, `Header[]` for one of the package
    own_header = match[1] == "Header" and bool(brackets)
    full = f"{package}/Header" if own_header else full_type(match[1], package)
    return MessageField(name, full, length, (), span)


def _constant(type_: str, line: str, code: str, span: Span) -> MessageConstant | Open:
    if type_ not in _PRIMITIVE:
        return Open(f"`{type_}` is no type of a constant")
    # the value of a text goes on to the end of the line, `#` and all
    whole = line.strip() if type_ == "string" else code
    name, _, value = whole[len(type_) :].partition("=")
    name, value = name.strip(), value.strip()
    if not _CONSTANT_NAME.match(name):
        return Open(f"`{name}` is no name of a constant")
    try:
        return MessageConstant(name, type_, _constant_value(type_, value), (), span)
    except (ValueError, SyntaxError, TypeError, MemoryError, RecursionError):
        return Open(f"`{value}` is no {type_}")


def _constant_value(type_: str, text: str) -> ConstantValue:
    if type_ == "string":
        return text
    if type_ == "bool":
        return bool(ast.literal_eval(text))
    if type_ not in _INTEGERS:
        return float(text)
    value = int(text)
    low, high = _INTEGERS[type_]
    if not low <= value <= high:
        raise ValueError(text)
    return value
