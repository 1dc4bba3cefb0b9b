"""Which sections of ROS 2's parameter files are for a node, and which of several values counts.

After rcl and rclcpp (`parameter_map.cpp`): sections are kept in the order in which their names
first occur, whatever file they are in; of those that match the full name of the node, the last one
that sets a parameter counts. What a command line sets by `-p` is in the section of all nodes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from rebsync.records import dataclass
from rebsync.reverse.launch.parameters import Parameter
from rebsync.reverse.unknowns import Open, Text

ALL_NODES = "/**"
# The name of what may be any parameter below what stands before it: no name of ROS has it.
ANY = "**"
_WHICH = "a file has a section for some nodes, and the name of this one is not known"


@dataclass(frozen=True, slots=True)
class ParameterSection:
    """The parameters for the nodes that a pattern matches, in the order in which they are set."""

    pattern: str
    parameters: tuple[Parameter, ...]


def is_any(name: str) -> bool:
    """Whether a name stands for any parameter of a namespace."""
    return name == ANY or name.endswith(f"/{ANY}")


def asked(parameters: tuple[Parameter, ...], name: str) -> Parameter | None:
    """The parameter of that name; open where something that is not known may set it."""
    exact = next((p for p in parameters if p.name == name), None)
    if exact is not None:
        return exact
    covering = (p for p in parameters if is_any(p.name) and name.startswith(p.name[: -len(ANY)]))
    return next((replace(p, name=name) for p in covering), None)


def overridden(found: dict[str, Parameter], parameter: Parameter) -> None:
    """Sets a parameter among others: of what any parameter may be, all that is set is open."""
    if is_any(parameter.name):
        space = parameter.name[: -len(ANY)]
        for name, earlier in found.items():
            if name.startswith(space):
                found[name] = replace(earlier, value=parameter.value)
    found.pop(parameter.name, None)
    found[parameter.name] = parameter


def in_order(sections: Iterator[ParameterSection]) -> tuple[ParameterSection, ...]:
    """Sections with those of one pattern put together, where it first occurs."""
    found: dict[str, tuple[Parameter, ...]] = {}
    for section in sections:
        pattern = f"/{section.pattern.strip('/')}".replace("//", "/")
        found[pattern] = found.get(pattern, ()) + section.parameters
    return tuple(ParameterSection(p, parameters) for p, parameters in found.items())


def of_node(sections: tuple[ParameterSection, ...], path: Text) -> tuple[Parameter, ...]:
    """The parameters of the node with that full name."""
    found: dict[str, Parameter] = {}
    for section in sections:
        if isinstance(path, Open) and section.pattern != ALL_NODES:
            for parameter in section.parameters:
                overridden(found, replace(parameter, value=Open(_WHICH)))
        elif isinstance(path, Open) or _matches(section.pattern, path):
            for parameter in section.parameters:
                overridden(found, parameter)
    return tuple(found.values())


def _matches(pattern: str, path: str) -> bool:
    regex = re.escape(pattern).replace(r"/\*\*", r"(/\w+)*").replace(r"/\*", r"/\w+")
    return re.fullmatch(regex, path) is not None
