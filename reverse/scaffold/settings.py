"""The facts of files that only say values: messages, parameters, manifests, `setup.cfg`."""

from __future__ import annotations

import configparser
import math
import re
from collections.abc import Iterator
from pathlib import Path

from rebsync.reverse.build.messages import read_message
from rebsync.reverse.launch.parameters import YAML, read_parameters
from rebsync.reverse.launch.xml_tree import XmlElement, read_xml
from rebsync.reverse.scaffold.fact import (
    CONSTANT,
    NOT_GIVEN,
    OWN,
    PYTHON_SETTING,
    UNKNOWN,
    Fact,
    has_bearing,
    is_of_runtime,
)
from rebsync.reverse.scaffold.state_messages import FIELD, facts_of_state_message, is_state_message
from rebsync.reverse.unknowns import Unknown
from rebsync.source import NOWHERE, Source, Span

_ALL_NODES = "/**/"  # under what ROS 2 has the parameters that all nodes are given
_ANCHOR = re.compile(r"&\S+\s+")
_WHOLE, _FRACTION, _TEXT = "a whole number", "a fraction", "a text"
_TYPES = {
    _WHOLE: re.compile(r"[+-]?(?:0x[\da-fA-F]+|\d[\d_]*)"),
    _FRACTION: re.compile(r"[+-]?(?:\d+\.\d*|\.\d+)(?:[eE][+-]?\d+)?"),
    "a truth": re.compile(r"true|false|yes|no|on|off", re.IGNORECASE),
}
# How many metres a cell has, no model says, as long as it has some.
_METRES = "metres"
# Within which seconds a node waits long enough for more urgent messages, and no model time passes.
_SETTLES, _LEAST, _MOST = "long enough", 0.05, 0.2
_ROS2 = "ros__parameters:"
_UNIT = re.compile(r"^[ \t]*time_unit:[ \t]*([\d.]+)[ \t]*(?:#.*)?$", re.MULTILINE)
_FOLDERS = frozenset({("develop", "script_dir"), ("install", "install_scripts")})
_BUILDING = re.compile(
    r"options.*|entry_points|build(?!_scripts).*|install.*|develop|global|easy_install|aliases"
)


def facts_of_message(source: Source, package: str) -> Iterator[Fact]:
    message = Path(source.path).stem
    read = read_message(source, package, message)
    for unknown in read.unknowns if _is_message(source) else ():
        yield Fact(UNKNOWN, message, unknown.what, unknown.why, source, unknown.span)
    if is_state_message(read):
        yield from facts_of_state_message(message, source)
        return
    for m in FIELD.finditer(source.text):
        type_ = m[1].removeprefix(f"{package}/")
        yield Fact("field", message, m[2], type_, source, Span(*m.span()))


def _is_message(source: Source) -> bool:
    """Whether it is a message type alone, not the two of a service or the three of an action."""
    return source.path.endswith(".msg")


def facts_of_parameters(source: Source) -> Iterator[Fact]:
    """What in the parameters has a bearing on what nodes do, but for the values of constants."""
    read = read_parameters(source)
    for unknown in read.unknowns:
        if unknown.what == YAML:
            yield Fact(UNKNOWN, "", unknown.what, unknown.why, source, unknown.span)
    alone = set[str]()
    for given in (*read.replaced, *read.entries):
        node, is_ros2, path = given.name.rpartition("ros__parameters/")
        if is_ros2 and node != _ALL_NODES and node not in alone:
            alone.add(node)
            yield Fact("parameters", "", node[:-1], "given for it alone", source, given.span)
        name = path.replace(".", "/") if is_ros2 else path
        section, _, last = name.rpartition("/")
        value = _ANCHOR.sub("", source.text[given.span.start : given.span.end])
        if not section:
            yield Fact(CONSTANT, "", last, _type_of(value), source, given.span)
        else:
            yield from _parameter(section.rpartition("/")[2], last, value, source, given.span)


def _parameter(section: str, name: str, value: str, source: Source, at: Span) -> Iterator[Fact]:
    """An entry of a section: the type of a constant, or a value of the run-time part, or its type.

    ROS 1 takes a whole number for a fraction, ROS 2 ends the node; for a text all end it.
    """
    if section == "env":
        yield Fact(CONSTANT, "", name, _type_of(value), source, at)
    elif is_of_runtime(section) and not has_bearing(f"{section}/{name}"):
        type_ = _type_of(value)
        is_taken = type_ == _WHOLE and _ROS2 not in source.text
        yield Fact(CONSTANT, "", f"{section}/{name}", _FRACTION if is_taken else type_, source, at)
    elif has_bearing(whole := f"{section}/{name}"):
        if whole == "drive/cell_size" and _is_length(value):
            value = _METRES
        elif whole == "mailbox/settle" and _settles(value, source.text):
            value = _SETTLES
        elif value[:1] in ("'", '"') and value[1:-1].isalpha() and _type_of(value[1:-1]) == _TEXT:
            value = value[1:-1]
        yield Fact("parameter", "", whole, value, source, at)


def _settles(value: str, text: str) -> bool:
    """Whether a node waits long enough, and far less than a unit of time."""
    units = [float(m[1]) for m in _UNIT.finditer(text) if _type_of(m[1]) != _TEXT]
    is_plain = _type_of(value) == _FRACTION and "e" not in value.lower()
    return is_plain and _LEAST <= float(value) <= _MOST and all(u >= 1 for u in units)


def _is_length(value: str) -> bool:
    """Whether a value is a length, as all of ROS read it."""
    is_plain = _type_of(value) == _FRACTION and "e" not in value.lower()
    return is_plain and 0 < float(value) < math.inf


def _type_of(value: str) -> str:
    """The type that a value has in YAML, as ROS tells them apart."""
    return next((name for name, pattern in _TYPES.items() if pattern.fullmatch(value)), _TEXT)


def facts_of_setup(source: Source) -> Iterator[Fact]:
    """Where programs are installed, from where launch files start them, and what else is.

    Sections of tools that only look at code say nothing of it.
    """
    read = configparser.RawConfigParser()
    try:
        read.read_string(source.text)
    except configparser.Error as error:
        why = " ".join(error.message.split())
        yield Fact(UNKNOWN, "", Path(source.path).name, why, source, NOWHERE)
        return
    for section in (s for s in read.sections() if _BUILDING.fullmatch(s)):
        for option, given in read.items(section):
            at, value = _place(source, section, option), " ".join(given.split())
            name = option.replace("-", "_")  # as distutils takes it
            if (section, name) in _FOLDERS:
                yield Fact("folder of programs", "", name, value, source, at)
            else:
                yield Fact(PYTHON_SETTING, "", f"[{section}] {name}", value, source, at)


def _place(source: Source, section: str, option: str) -> Span:
    """The line of an option in a section."""
    start = max(source.text.find(f"[{section}]"), 0)
    line = re.compile(rf"^{re.escape(option)}[ \t]*[=:].*$", re.MULTILINE | re.IGNORECASE)
    found = line.search(source.text, start)
    return Span(*found.span()) if found is not None else NOWHERE


def facts_of_other_package(source: Source, package: str) -> Iterator[Fact]:
    """What a package is built by, and its name if it is not that of the nodes, `package`."""
    root = read_xml(source)
    found = [] if isinstance(root, Unknown) else [e for e in root.elements() if e.name == "name"]
    if isinstance(root, Unknown) or not found:
        return  # what is missing extraction lists
    named = " and ".join(" ".join(each.text.split()) for each in found)
    every = [tool for e in root.elements() for tool in _build_tools(e)]
    told = [tool for tool in every if tool[1].name == "build_type"] or every
    tools = " and ".join(tool for tool, _ in told) or NOT_GIVEN
    name = "of the nodes" if named == package else "of messages"
    yield Fact("build tool", "", name, tools, source, (told[0][1] if told else found[0]).span)
    if package and named != package:
        value = named.replace(package, OWN)
        yield Fact("name of the package", "", "messages", value, source, found[0].span)


def _build_tools(element: XmlElement) -> Iterator[tuple[str, XmlElement]]:
    """What a tag of a package.xml has the package built by, and under which condition."""
    if element.name == "export":
        for each in (e for e in element.elements() if e.name == "build_type"):
            condition = each.get("condition")
            yield each.text.strip() + (f" if {condition}" if condition else ""), each
    elif element.name == "buildtool_depend" and element.text.strip() == "catkin":
        yield "catkin", element
