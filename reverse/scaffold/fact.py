"""A fact that joins generated nodes, and the kinds of those that others ask for by name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.source import Source, Span

PROGRAM, PLAYED, TYPE, SPACE = "program", "played sensor", "type of a node", "space of parameters"
PYTHON_SETTING = "setting of the packages of Python"
CONSTANT, CLOCK = "type of the constant", "use_sim_time"
TOLD, TOLD_TYPE = "state field", "type of the state field"
PARAMETERS = "config/params.yaml"  # the file of parameters that is generated
UNKNOWN = "unknown"  # what a file leaves open, with the reason as its value
NOT_GIVEN, OWN = "not given", "this package"
# What nodes of other packages are given; and a text of which the files do not tell what it is.
HANDED, OPEN = "given", "what only the launch knows"
_BEARING = {
    "mailbox": ("time_unit", "settle"),
    "drive": ("cell_size", "kind", "heading", "move_time", "odometry"),
}
# How variables of the environment begin that only decide what is logged, and where.
SHOWN = ("ROSCONSOLE_", "RCUTILS_", "ROS_LOG_DIR")
# Programs of ROS by their names, and what they are told to do, that act on what others hear.
_SPEAKING = frozenset(
    {"pub", "play", "call", "set", "load", "relay", "mux", "throttle", "drop", "transform", "kill"}
    | {"pkill", "killall"}
)

Facts: TypeAlias = "dict[tuple[str, str, str], list[Fact]]"


@dataclass(frozen=True, slots=True)
class Fact:
    """Something that joins nodes: its kind, whose it is, its name, what it is, and the place."""

    kind: str
    owner: str
    name: str
    value: str
    source: Source
    span: Span

    @property
    def key(self) -> tuple[str, str, str]:
        """By what it is known in another state of the package."""
        return self.kind, self.owner, self.name


def numbered(facts: Iterable[Fact]) -> Iterator[Fact]:
    """The facts of a file; what it says again is another fact: a message may come twice."""
    seen: Counter[tuple[str, ...]] = Counter()
    for fact in facts:
        told = (*fact.key, fact.value)
        seen[told] += 1
        again = "again " * (seen[told] - 1)
        yield replace(fact, value=f"{again}{fact.value}")


def speaks(words: Iterable[str]) -> bool:
    """Whether a command that is started beside the nodes may publish, call or set for them."""
    return not _SPEAKING.isdisjoint(words)


def has_bearing(name: str) -> bool:
    """Whether a parameter of the run-time part decides what nodes do."""
    section, _, rest = name.strip("/").partition("/")
    return rest in _BEARING.get(section, ())


def is_of_runtime(section: str) -> bool:
    """Whether parameters in this section are those of the run-time part."""
    return section in _BEARING
