"""The facts of state messages: what a node tells of itself after each body, field by field.

Nodes take nothing from them, but whoever compares a run with the model does: a field that holds
something else than its state variable has a right run look wrong, or a wrong one right.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from rebsync.records import dataclass
from rebsync.reverse.build.messages import MessageFile
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.scaffold.fact import TOLD, TOLD_TYPE, Fact
from rebsync.reverse.scaffold.texts import squeezed
from rebsync.source import Source, Span

_SUFFIX = "State"
_BLOCK = r"\{(?:[^{}]|\{[^{}]*\})*\}"
_TELLING = re.compile(
    r"\b(\w+)\s*::\s*publishState\s*\([^)]*?\b(\w+)\s*\)\s*(?:override\s*)?"
    rf"\{{((?:[^{{}}]|{_BLOCK})*)\}}"
)
_INNER = re.compile(_BLOCK)
_MADE = re.compile(rf"\b(\w+){_SUFFIX}\s+(\w+)\s*[;({{=]")
_OFFERED = re.compile(
    r"\b(\w+)\s*=\s*[^;=]*?\b(?:advertise|create_publisher)\s*<[^;()]*>\s*\(\s*\"([^\"]*)\""
)
_STATEMENT = re.compile(r"[^;]*;")
_SET = re.compile(r"(\w+)\s*\.\s*(\w+)\s*([^=]*?)\s*([-+*/%&|^<>]*=)(?!=)\s*(.*?)\s*;", re.DOTALL)
_DECLARED = re.compile(r"(?:const\s+)?[\w:<>]+[\s&*]+(\w+)\s*(?:=|\{|\(|;)")
_FLAT = re.compile(r"flatten\s*\(\s*(.*?)\s*,\s*\w+\s*\.\s*(\w+)\s*\)\s*;", re.DOTALL)
_SENT = re.compile(
    r"(?:this\s*->\s*)?(\w+)\s*(?:\.|->)\s*publish\s*\(\s*(?:std::move\()?\s*\*?(\w*)"
)
_MACRO = re.compile(r"([A-Z][A-Z0-9_]+)\s*[(;]")  # what it stands for may set anything
_NAMING = frozenset({"enum", "using"})  # these may name something else as a state variable is
_ALWAYS = frozenset({"server", "arguments", "arrival", "start", "now"})
FIELD = re.compile(r"^[ \t]*([\w/\[\]]+)[ \t]+(\w+)[ \t]*(?:#.*)?$", re.MULTILINE)


def is_state_message(message: MessageFile) -> bool:
    """Whether a message type is a state message, by the fields that each of them has."""
    return {field.name for field in message.fields} >= _ALWAYS


def facts_of_state_message(message: str, source: Source) -> Iterator[Fact]:
    """The types of the fields of a state message, which is called after its class."""
    owner = message.removesuffix(_SUFFIX)
    for m in FIELD.finditer(source.text):
        yield Fact(TOLD_TYPE, owner, m[2], m[1], source, Span(*m.span()))


def told_in_cpp(source: Source, text: str) -> Iterator[Fact]:
    """What a class of C++ puts into its state message; `text` is the source without remarks."""
    topics: dict[str, str] = {}
    for m in _OFFERED.finditer(text):
        topics[m[1]] = f"{topics[m[1]]} or {m[2]}" if m[1] in topics else m[2]
    for telling in _TELLING.finditer(text):
        owner, served, body = telling.groups()
        message = ""
        if (made := _MADE.search(body)) is not None:
            owner, message = made.groups()  # messages of ROS have no underscores in their names
        if any(re.search(r"\breturn\b", block) for block in _INNER.findall(body)):
            continue  # what is behind it depends on it
        told, sent = _Telling(served, message, topics, body), len(body)
        for span, statement, is_inner in _statements(body, message):
            if (found := told.by(statement)) is None:
                continue
            name, value = found
            late = " once it is published" if span.start > sent else ""
            value = f"{value} in a block" if is_inner else value
            place = Span(telling.start(3) + span.start, telling.start(3) + span.end)
            yield Fact(TOLD, owner, name, f"{value}{late}", source, place)
            if value.startswith("published") and not is_inner:
                sent = min(sent, span.start)


def _statements(body: str, message: str) -> Iterator[tuple[Span, str, bool]]:
    """The statements and their places; behind them those of inner blocks that name the message."""
    rest = _INNER.sub(lambda m: ";".rjust(len(m[0])), body)
    for m in _STATEMENT.finditer(rest):
        yield Span(m.end() - len(m[0].lstrip()), m.end()), m[0].strip(), False
    for block in _INNER.finditer(body):
        for m in _STATEMENT.finditer(body, block.start() + 1, block.end() - 1):
            if message and re.search(rf"\b{message}\b(?!\s*::)", m[0]):
                yield Span(m.end() - len(m[0].lstrip()), m.end()), m[0].strip(), True


@dataclass(frozen=True, slots=True)
class _Telling:
    """What is told after a body that was `served`, by a `message`, and what by others is left out.

    `topics` are those that members publish on; `body` is all that is done.
    """

    served: str
    message: str
    topics: Mapping[str, str]
    body: str

    def by(self, statement: str) -> tuple[str, str] | None:
        """The field that a statement sets and its value, or on what the message is published.

        Anything else that it does with the message is told as it is.
        """
        if (found := self._plain(statement)) is not None or _MADE.match(statement) is not None:
            return found
        is_told = re.search(rf"\b{self.message}\b(?!\s*::)", statement) is not None
        return ("", squeezed(statement)) if self.message and is_told else None

    def _plain(self, statement: str) -> tuple[str, str] | None:
        """What a statement does that generated code may do too."""
        if (flat := _FLAT.fullmatch(statement)) is not None:
            return flat[2], f"flatten({_value(flat[1], self.served)})"
        if (sent := _SENT.match(statement)) is not None:
            on = self.topics.get(sent[1], f"that of {sent[1]}").removeprefix("~/")
            is_other = self.message and sent[2] and sent[2] != self.message
            return None if is_other else ("", f"published on the topic {on}")
        if (found := _SET.fullmatch(statement)) is not None:
            of, name, part, operator, value = found.groups()
            how = "" if (part, operator) == ("", "=") else f"{part} {operator} "
            return (name, f"{how}{_value(value, self.served)}") if of == self.message else None
        macro = _MACRO.match(statement)
        is_macro = macro is not None and not macro[1].startswith(libraries.logging())
        if is_macro or statement.partition(" ")[0] in _NAMING:
            return "", squeezed(statement)
        declared = _DECLARED.match(statement)
        if declared is None or _MADE.match(statement) is not None or not self._hides(declared[1]):
            return None
        return "", f"local {declared[1]}"

    def _hides(self, name: str) -> bool:
        """Whether a local of a name may be told for a state variable."""
        told = re.finditer(rf"\b{self.message}\s*\.[^;]*=[^;]*|flatten\s*\([^;]*", self.body)
        return any(re.search(rf"\b{name}\b", m[0]) for m in told)


def _value(text: str, served: str) -> str:
    plain = re.sub(r"\bthis\s*->\s*", "", text)
    return squeezed(re.sub(rf"\b{served}\b", "served", plain))
