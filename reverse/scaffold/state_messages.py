"""The facts of state messages: what a node tells of itself after each body, field by field.

Nodes take nothing from them, but whoever compares a run with the model does: a field that holds
something else than its state variable has a right run look wrong, or a wrong one right.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rebsync.reverse.scaffold.fact import TOLD, TOLD_TYPE, Fact
from rebsync.reverse.scaffold.texts import squeezed
from rebsync.source import Source, Span

_SUFFIX = "State"
_TELLING = re.compile(
    r"\b(\w+)\s*::\s*publishState\s*\([^)]*?\b(\w+)\s*\)\s*(?:override\s*)?\{([^{}]*)\}"
)
_MADE = re.compile(rf"\b(\w+){_SUFFIX}\s+\w+\s*[;({{=]")
_STATEMENT = re.compile(r"[^;]*;")
_SET = re.compile(r"\w+\s*\.\s*(\w+)\s*([^=]*?)\s*([-+*/%&|^<>]*=)(?!=)\s*(.*?)\s*;", re.DOTALL)
_DECLARED = re.compile(r"(?:const\s+)?[\w:<>]+[\s&*]+(\w+)\s*(?:=|\{|\(|;)")
_FLAT = re.compile(r"flatten\s*\(\s*(.*?)\s*,\s*\w+\s*\.\s*(\w+)\s*\)\s*;", re.DOTALL)
_SENT = re.compile(r"(?:this\s*->\s*)?(\w+)\s*(?:\.|->)\s*publish\s*\(")
_MESSAGE = re.compile(r"^string server\nstring arguments$", re.MULTILINE)
FIELD = re.compile(r"^[ \t]*([\w/\[\]]+)[ \t]+(\w+)[ \t]*(?:#.*)?$", re.MULTILINE)


def is_state_message(text: str) -> bool:
    """Whether the text of a message type is that of a state message."""
    return _MESSAGE.search(text) is not None


def facts_of_state_message(message: str, source: Source) -> Iterator[Fact]:
    """The types of the fields of a state message, which is called after its class."""
    owner = message.removesuffix(_SUFFIX)
    for m in FIELD.finditer(source.text):
        yield Fact(TOLD_TYPE, owner, m[2], m[1], source, Span(*m.span()))


def told_in_cpp(source: Source, text: str) -> Iterator[Fact]:
    """What a class of C++ puts into its state message; `text` is the source without remarks."""
    for telling in _TELLING.finditer(text):
        owner, served, body = telling.groups()
        if (made := _MADE.search(body)) is not None:
            owner = made[1]  # messages of ROS have no underscores in their names
        is_sent = False
        for m in _STATEMENT.finditer(text, *telling.span(3)):
            start = m.end() - len(m[0].lstrip())
            span, found = Span(start, m.end()), _told_by(m[0].strip(), served)
            if found is not None:
                name, value = found
                late = " once it is published" if is_sent else ""
                yield Fact(TOLD, owner, name, f"{value}{late}", source, span)
                is_sent |= value.startswith("published")


def _told_by(statement: str, served: str) -> tuple[str, str] | None:
    """The field that a statement sets and its value, or by whom it has the message published."""
    if (flat := _FLAT.fullmatch(statement)) is not None:
        return flat[2], f"flatten({_value(flat[1], served)})"
    if (sent := _SENT.match(statement)) is not None:
        return "", f"published by {sent[1]}"
    if (found := _SET.fullmatch(statement)) is not None:
        name, part, operator, value = found.groups()
        how = "" if (part, operator) == ("", "=") else f"{part} {operator} "
        return name, f"{how}{_value(value, served)}"
    declared = _DECLARED.match(statement)  # which may hide a state variable
    is_message = _MADE.match(statement) is not None
    return ("", f"local {declared[1]}") if declared is not None and not is_message else None


def _value(text: str, served: str) -> str:
    plain = re.sub(r"\bthis\s*->\s*", "", text)
    return squeezed(re.sub(rf"\b{served}\b", "served", plain))
