"""The facts in a source or header of C++: what a class is joined by, what a program makes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import chain

from rebsync.reverse.files.compiled_text import LINE_COMMENT
from rebsync.reverse.scaffold.fact import PLAYED, PROGRAM, Fact, numbered
from rebsync.reverse.scaffold.state_messages import told_in_cpp
from rebsync.reverse.scaffold.texts import joined, squeezed
from rebsync.reverse.syntax.cpp_text import with_one_alternative
from rebsync.source import Source, Span

MAIN = re.compile(r"\bint\s+main\s*\(")
_STARTED = re.compile(r"\bmailbox_\s*\.\s*start\s*\(\s*\)")
_SHOWS = re.compile(r"\bmailbox_\s*\.\s*onServed\s*\(")
_STRING = r'"(?:\\.|[^"\\\n])*"'
_COMMENT = re.compile(rf"({_STRING})|{LINE_COMMENT}|/\*.*?\*/", re.DOTALL)
_BROKEN = re.compile(r'\w+(?:\s*::\s*\w+)+|"[^"\n\\]*"(?:\s*"[^"\n\\]*")+')
_SENSOR = re.compile(r'[:,]\s*(\w+)\s*[({]\s*\*?\s*\w+\s*,\s*("[^"]*")\s*[)}]')
_PLAYED = re.compile(r'\bnode\s*\.\s*advertise\s*<[^;()]*>\s*\(\s*"([^"]*)"')
_MADE = re.compile(r"\b(?:\w+\s*::\s*)*(\w+)\s+\w+\s*[({]\s*node\s*[,)}]")
_SHARED = re.compile(
    r"\bmake_shared\s*<\s*(?:\w+\s*::\s*)*(\w+)\s*>\s*\(\s*rclcpp\s*::\s*NodeOptions\b"
)
_OWNER = re.compile(r"\b(\w+)\s*::\s*\1\s*\(")
_SUBSCRIBED = re.compile(r'\b(subscribe\w*)\s*(?:<[^;()]*>\s*)?\(\s*("[^"]*")\s*,')
_HANDLER = re.compile(r"&\s*(?:\w+\s*::\s*)+(\w+)|\b(k[A-Z]\w*)")
_ADVERTISED = re.compile(r"\b(\w+)\s*=\s*mailbox_\s*\.\s*(advertise\w*\s*<[^;]*?\([^;]*\))\s*;")
_OFFERED = re.compile(r"\b(\w+)\s*=\s*mailbox_\s*\.\s*(offer\w*\s*<[^;]*?\([^;]*\))\s*;")
_SERVER = re.compile(r'\bServer\s+(\w+)\s*\{\s*("[^"]*")\s*,\s*([^}]*?)\s*\}')
_FAR = 400  # characters within which a subscription names its handler
_POSTED = re.compile(r"\bk[A-Z]\w*")
_DECLARED = re.compile(r'\bdeclare_parameter\s*<\s*([\w:]+)\s*>\s*\(\s*"([^"]*)"')
_STATE = re.compile(
    r"\b(?:create_publisher|advertise)\s*<\s*[\w:]*State\s*>\s*\(\s*\"(?:~/)?state\"\s*,([^;]*)\)\s*;"
)
_KEPT_LAST = re.compile(r"\brclcpp::KeepLast\((\w+)\)")
_STOPPED = re.compile(r"~(\w+)\s*\([^;{]*\{[^}]*\bmailbox_\s*\.\s*stop\s*\(\s*\)")
_REGISTER = "RCLCPP_COMPONENTS_REGISTER_NODE"
_COMPONENT = re.compile(rf"\b{_REGISTER}\s*\(\s*(?:\w+\s*::\s*)*(\w+)\s*\)")
_WHOLE = frozenset({"int", "int64_t", "std::int64_t", "long"})


def facts_in_cpp(program: str, source: Source) -> Iterator[Fact]:
    """The facts in a file; `program` is the name of a program that has its `main` there."""
    text = with_one_alternative(source.text)
    text = _COMMENT.sub(lambda m: m[1] or " " * len(m[0]), text)
    text = _BROKEN.sub(joined, text)
    joints, told = _joints(source, text), told_in_cpp(source, text)
    found = chain(joints, told, _made(program, source, text), _in_ros2(source, text))
    return numbered(found)


def _joints(source: Source, text: str) -> Iterator[Fact]:
    """Subscriptions by the server that they are for, publishers, sensors."""
    owner = _OWNER.search(text)
    if owner is None:
        return
    servers = {m[1]: m[2].strip('"') for m in _SERVER.finditer(text)}
    bare = _without_strings(text)
    for m in _STARTED.finditer(bare):
        yield Fact("start of serving", owner[1], "", "there", source, Span(*m.span()))
    for m in _SHOWS.finditer(bare):
        yield Fact("state after each body", owner[1], "", "shown", source, Span(*m.span()))
    for m in _SENSOR.finditer(text):
        yield Fact("sensor", owner[1], m[1], m[2], source, Span(*m.span(2)))
    for m in _SUBSCRIBED.finditer(text):
        server = _server_of(text, m.end(), servers)
        yield Fact("subscription", owner[1], server, f"{m[1]} {m[2]}", source, Span(*m.span()))
    for m in _ADVERTISED.finditer(text):
        value = squeezed(m[2])
        yield Fact("publisher", owner[1], m[1], value, source, Span(*m.span()))
    for m in _OFFERED.finditer(text):
        yield Fact("service", owner[1], m[1], squeezed(m[2]), source, Span(*m.span()))


def _made(program: str, source: Source, text: str) -> Iterator[Fact]:
    """What a program makes a rebec of, or what sensors it plays."""
    if not MAIN.search(text):
        return
    for m in chain(_MADE.finditer(text), _SHARED.finditer(text)):
        yield Fact(PROGRAM, program, "", m[1], source, Span(*m.span()))
    for m in _PLAYED.finditer(text):
        yield Fact(PLAYED, program, m[1], m[1], source, Span(*m.span()))


def _server_of(text: str, start: int, servers: Mapping[str, str]) -> str:
    """The server that a subscription is for: what it, or else its handler, posts to."""
    for method, constant in _HANDLER.findall(text[start : start + _FAR]):
        if constant in servers:
            return servers[constant]
        if method:
            return _posted_in(text, method, servers)
    return ""


def _posted_in(text: str, handler: str, servers: Mapping[str, str]) -> str:
    """The server that a handler posts to; its own name if it posts to none."""
    body = re.search(rf"::\s*{handler}\s*\([^{{;]*\)\s*\{{(.*?)\n\}}", text, re.DOTALL)
    for constant in _POSTED.findall(body[1]) if body is not None else ():
        if constant in servers:
            return servers[constant]
    return handler


def _in_ros2(source: Source, text: str) -> Iterator[Fact]:
    """Of a source or header: parameters with their types, the state's quality, components."""
    bare = _without_strings(text)
    for m in _STOPPED.finditer(bare):
        yield Fact("end of serving", m[1], "", "there", source, Span(*m.span()))
    owner = _OWNER.search(text)
    if owner is None:
        return
    for m in _DECLARED.finditer(text):
        type_ = "int" if m[1] in _WHOLE else m[1]
        yield Fact("type of the parameter", owner[1], m[2], type_, source, Span(*m.span()))
    for m in _STATE.finditer(text):
        quality = _plain_quality("".join(m[1].split()))
        yield Fact("quality of the state", owner[1], "", quality, source, Span(*m.span()))
    is_redefined = f"define {_REGISTER}" in text
    for m in _COMPONENT.finditer(bare) if not is_redefined else ():
        yield Fact("component", m[1], "", "registered", source, Span(*m.span()))


def _without_strings(text: str) -> str:
    """The text with blanks for all strings, which only name what other code does."""
    return re.sub(_STRING, lambda m: " " * len(m[0]), text)


def _plain_quality(said: str) -> str:
    """A quality of service in the words of generated code: `rclcpp::QoS` is reliable by itself."""
    plain = _KEPT_LAST.sub(r"\1", said)
    return plain if "best_effort" in plain else plain.replace(".reliable()", "")
