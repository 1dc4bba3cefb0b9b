"""What nodes of ROS 2 are given as parameters: tables, files, and words of the command line."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import field, replace

import yaml

from rebsync.records import dataclass
from rebsync.reverse.launch.parameter_sections import (
    ALL_NODES,
    ANY,
    ParameterSection,
    in_order,
)
from rebsync.reverse.launch.parameters import Parameter, ParameterValue, read_parameters
from rebsync.reverse.launch.ros2_actions import (
    FromFile,
    LaunchParameter,
    NodeAction,
    ParameterSource,
    Unlisted,
)
from rebsync.reverse.launch.ros2_arguments import RosArguments
from rebsync.reverse.launch.ros2_scope import Ros2Scope
from rebsync.reverse.launch.ros2_words import Words
from rebsync.reverse.unknowns import Open, Text, Unknown
from rebsync.source import Source, Span
from rebsync.unions import assert_never

At = Callable[[str], "tuple[str, Source | None]"]

_MIDDLE = "/ros__parameters/"
_COMPUTED = "it is computed when the file runs"
_WHAT = "parameters of a node"


@dataclass(slots=True)
class Ros2Parameters:
    """Makes sections of what launch files say; `at` gives a file and the path it is known by.

    `common` are the parameters that files give all nodes; `files` are those that were read.
    """

    at: At
    unknowns: list[Unknown]
    common: dict[str, Parameter] = field(default_factory=dict)
    files: dict[str, Source] = field(default_factory=dict)

    def of_node(
        self, start: NodeAction, words: RosArguments | Open, own: Text, scope: Ros2Scope
    ) -> tuple[ParameterSection, ...]:
        """All sections that the command line of a node has, in the order of launch_ros.

        `own` is the full name that the launch file gives the node. The words of the file come
        first, then what holds for all nodes here, then what the node itself is given.
        """
        mine = own if isinstance(own, str) else ALL_NODES
        told = self._told(words, start.span, scope)
        around = (s for p in scope.parameters for s in self._sections(p, ALL_NODES, scope))
        inside = (s for p in start.parameters for s in self._sections(p, mine, scope))
        return in_order(s for each in (told, around, inside) for s in each)

    def of_nobody(self, scope: Ros2Scope) -> None:
        """Reads what holds for all nodes where there are none: a system may have constants only."""
        for source in scope.parameters:
            tuple(self._sections(source, ALL_NODES, scope))

    def _told(
        self, words: RosArguments | Open, span: Span, scope: Ros2Scope
    ) -> Iterator[ParameterSection]:
        if isinstance(words, Open):
            yield self._unread("the arguments of a node", words.why, span, scope)
            return
        for setting in words.settings:
            if isinstance(setting, str):
                yield from self._from_path(setting, span, scope)
            else:
                node, name, text = setting
                given = Parameter(name.replace(".", "/"), from_yaml(text), scope.source, span)
                yield ParameterSection(ALL_NODES if node == "*" else node, (given,))

    def _sections(
        self, source: ParameterSource, own: str, scope: Ros2Scope
    ) -> Iterator[ParameterSection]:
        match source:
            case LaunchParameter():
                yield ParameterSection(own, (self._parameter(source, scope),))
            case FromFile(words):
                path = scope.text(words)
                if isinstance(path, Open):
                    yield self._unread(_WHAT, path.why, words.span, scope)
                else:
                    yield from self._from_path(path, words.span, scope)
            case Unlisted(what, span, why):
                yield self._unread(what, why, span, scope)
            case _:
                assert_never(source)

    def _unread(self, what: str, why: str, span: Span, scope: Ros2Scope) -> ParameterSection:
        """What may set any parameter of any node."""
        scope.note(what, why, span)
        return ParameterSection(ALL_NODES, (Parameter(ANY, Open(why), scope.source, span),))

    def _parameter(self, given: LaunchParameter, scope: Ros2Scope) -> Parameter:
        name = scope.known(given.name, "the name of a parameter")
        if isinstance(name, Open):
            return Parameter(ANY, name, scope.source, given.span)
        path = name.replace(".", "/")
        value: ParameterValue | Open
        if given.value is None:
            value = Open(_COMPUTED)
            scope.note(f"the parameter `{path}`", _COMPUTED, given.span)
        elif isinstance(given.value, Words):
            text = scope.known(given.value, f"the parameter `{path}`")
            value = text if isinstance(text, Open) or given.typed else from_yaml(text)
        else:
            value = given.value
        return Parameter(path, value, scope.source, given.span)

    # --- files ----------------------------------------------------------------------------------

    def _from_path(self, path: str, span: Span, scope: Ros2Scope) -> Iterator[ParameterSection]:
        inside, file = self.at(path)
        if file is None:
            yield self._unread(_WHAT, f"`{path}` is not at hand", span, scope)
            return
        yield from self.parameter_file(inside, file)

    def parameter_file(self, path: str, file: Source) -> Iterator[ParameterSection]:
        """The sections of a file; what it sets for all nodes goes to `common`, too."""
        read = read_parameters(file)
        if path not in self.files:
            self.files[path] = file
            self.unknowns += read.unknowns
        for entry in read.entries:
            pattern, found, key = entry.name.partition(_MIDDLE)
            key = key.replace(".", "/")
            if found:
                if pattern == ALL_NODES:
                    self.common[f"/{key}"] = replace(entry, name=f"/{key}")
                yield ParameterSection(pattern, (replace(entry, name=key),))


def from_yaml(text: str) -> ParameterValue | Open:
    """A text as the value of a parameter: as YAML has it, if that is a plain value."""
    try:
        found = yaml.safe_load(text)
    except yaml.YAMLError:
        return text
    return found if isinstance(found, bool | int | float | str) else _listed(found, text)


def _listed(found: object, text: str) -> ParameterValue | Open:
    if isinstance(found, list) and all(isinstance(v, bool | int | float | str) for v in found):
        return tuple(found)
    return text if found is None else Open("this is no value of a parameter")
