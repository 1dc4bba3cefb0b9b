"""The facts of a launch file in XML: of each node its package, type, namespace and remaps."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from rebsync.records import dataclass
from rebsync.reverse.launch.launch_files import read_launch
from rebsync.reverse.launch.launch_values import Surroundings
from rebsync.reverse.launch.xml_tree import XmlElement, read_xml
from rebsync.reverse.scaffold.fact import (
    NOT_GIVEN,
    OWN,
    PARAMETERS,
    SHOWN,
    SPACE,
    TYPE,
    Fact,
    has_bearing,
    speaks,
)
from rebsync.reverse.scaffold.prefixes import is_harmless
from rebsync.reverse.scaffold.texts import conditions, is_of_package, space, squeezed
from rebsync.reverse.unknowns import Unknown
from rebsync.source import Source

_ENTRY = re.compile(r"\s*(\w+):\s*(?:-?\d+|true|false)\s*")
Load = Callable[[str], "Source | None"]
_STARTED = ("pkg", "respawn", "args", "launch-prefix", "machine")
_BY_NAMES = "topic_tools"  # whose programs publish under names alone that they are handed


def facts_of_launch(source: Source, package: str) -> Iterator[Fact]:
    """The facts of a file; remaps outside of nodes, which all that follow have, are of no node."""
    root = read_xml(source)
    if not isinstance(root, Unknown):  # what cannot be read, extraction lists
        found = set(_defaults(root))
        names = [name for name, _ in found]
        given = {name: value for name, value in found if names.count(name) == 1}
        yield from _Tags(source, package, frozenset(_nodes(root)), given).facts(root)


def facts_of_settings(source: Source, load: Load) -> Iterator[Fact]:
    """What a launch file with all that it loads sets of the run-time part.

    The file of parameters that is generated has facts of its own.
    """
    launch = read_launch(source, Surroundings(load, lambda _: ""))
    for given in launch.parameters:
        name = "/".join(given.name.split("/")[-2:])
        if has_bearing(name) and not given.source.path.endswith(PARAMETERS):
            yield Fact("setting", "", name, str(given.value), given.source, given.span)


def _is_plain(text: str) -> bool:
    """Whether YAML in a node only says single numbers, none of them of the run-time part."""
    lines = [line for line in text.splitlines() if line.strip()]
    found = [_ENTRY.fullmatch(line) for line in lines]
    return bool(found) and None not in found


def _nodes(element: XmlElement) -> Iterator[str]:
    """The names of the nodes in a tag."""
    for each in element.elements():
        if each.name == "node" and (name := each.attributes.get("name")) is not None:
            yield name.value
        yield from _nodes(each)


def _defaults(root: XmlElement) -> Iterator[tuple[str, str]]:
    """The arguments that a file, and the groups in it, take, with their defaults: `$(arg name)`."""
    for each in root.elements():
        if each.name == "group":
            yield from _defaults(each)
        given = {name: attribute.value for name, attribute in each.attributes.items()}
        if each.name == "arg" and "default" in given and "name" in given:
            yield f"$(arg {given['name']})", given["default"]


@dataclass(frozen=True, slots=True)
class _Tags:
    """The tags in one place of a launch file: in the groups `around`, and in a node or in none.

    `nodes` are the names of all nodes in the file, `defaults` those of its arguments.
    """

    source: Source
    package: str
    nodes: frozenset[str]
    defaults: Mapping[str, str]
    around: tuple[Mapping[str, str], ...] = ()
    node: str = ""

    def facts(self, element: XmlElement) -> Iterator[Fact]:
        """What a tag and those in it say."""
        given = {name: attribute.value for name, attribute in element.attributes.items()}
        yield from self._own(element, given)
        inside = self
        match element.name:
            case "group":
                inside = replace(self, around=(*self.around, given))
            case "node":
                inside = replace(self, node=given.get("name", ""))
            case _:
                pass
        for each in element.elements():
            yield from inside.facts(each)

    def _own(self, element: XmlElement, given: Mapping[str, str]) -> Iterator[Fact]:
        name, value = given.get("name", ""), given.get("value", "")
        is_absolute = name.startswith("/")  # whatever it is in
        if element.name in ("param", "rosparam") and not (self.node or is_absolute):
            yield self._fact(SPACE, "", str(element.span.start), space(self.around), element)
        match element.name:
            case "node":
                yield from self._node(element, given)
            case "env" if not name.startswith(SHOWN):
                yield self._fact("environment", self.node, name, value, element)
            case "machine" if given.get("default", "never") not in ("false", "never"):
                yield self._fact("environment", "", "machine", name, element)
            case "include" if not is_of_package(given.get("file", ""), self.package):
                yield self._fact("launch file", "", given.get("file", ""), "included", element)
            case "remap":
                old, new = given.get("from", ""), given.get("to", "")
                yield self._fact("remap", self.node, old, new, element)
            case "rosparam" if self.node and not given.get("param", "").startswith("/"):
                said = squeezed(element.text) or given.get("file", "")
                if {*given} <= {"command"} and _is_plain(element.text):
                    return  # arguments of the model's constructor, which the model shows
                yield self._fact("setting", self.node, given.get("param", ""), said, element)
            case "rosparam" if element.text.strip() and "param" in given:
                yield self._fact("parameter", "", given["param"], squeezed(element.text), element)
            case "rosparam" if given.get("command") == "load":
                loaded = given.get("file", "").rpartition("/")[2]
                yield self._fact("parameter file", "", loaded, "loaded", element)
            case "param" if has_bearing(name) and not (self.node and not is_absolute):
                pass  # what all tags together set of these counts
            case "param" if self._is_aside(name):
                yield self._fact("setting", self.node, name, value, element)
            case _:
                pass

    def _is_aside(self, name: str) -> bool:
        """Whether a parameter may be another one than those that stand beside it are."""
        if self.node:
            return name.startswith("/")
        return name.strip("/").partition("/")[0] in self.nodes

    def _node(self, element: XmlElement, given: Mapping[str, str]) -> Iterator[Fact]:
        """What a node is, and what else than parameters and remaps it is started with."""
        name, tags = given.get("name", ""), (*self.around, given)
        command = f"{given.get('pkg', '')} {given.get('type', '')} {given.get('args', '')}".strip()
        if given.get("pkg") not in (self.package, _BY_NAMES) and speaks(command.split()):
            yield self._fact("command", "", command, "started", element)
        told = {key: given.get(key, "") for key in _STARTED}
        if told["pkg"] == self.package:
            told["pkg"] = OWN
        if not _may_rename(told["args"]):
            told["args"] = ""
        if is_harmless(self.defaults.get(told["launch-prefix"], told["launch-prefix"])):
            told["launch-prefix"] = ""
        if self.defaults.get(told["respawn"], told["respawn"]) == "false":
            told["respawn"] = ""  # as roslaunch has it without
        for key, value in {**told, "ns": space(tags), "if": conditions(tags)}.items():
            yield self._fact("node", name, key, value or NOT_GIVEN, element)
        yield self._fact(TYPE, name, "", given.get("type", ""), element)

    def _fact(self, kind: str, owner: str, name: str, value: str, element: XmlElement) -> Fact:
        return Fact(kind, owner, name, value, self.source, element.span)


def _may_rename(arguments: str) -> bool:
    """Whether arguments of a program are more than what generated programs do not look at."""
    return any(sign in arguments for sign in (":=", "$(", "__"))
