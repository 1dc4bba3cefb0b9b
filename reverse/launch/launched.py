"""What a launch file starts: nodes with their parameters and remappings, and global parameters."""

from __future__ import annotations

from rebsync.records import dataclass
from rebsync.reverse.launch.graph_names import as_namespace, join, resolve
from rebsync.reverse.launch.parameters import Parameter
from rebsync.reverse.unknowns import Open, Text, Unknown
from rebsync.source import Source, Span

# Why the name of a node is open that has that of its program.
NOT_GIVEN = "it is not given here"


@dataclass(frozen=True, slots=True)
class LaunchedRemap:
    """A name as the node has it, and what it stands for, both as they are written."""

    private: str
    target: Text
    source: Source
    span: Span


@dataclass(frozen=True, slots=True)
class Nodelet:
    """What a node of the package `nodelet` runs.

    `command` is `load`, `standalone` or `manager`; a manager has no class.
    """

    command: str
    class_name: str | None


@dataclass(frozen=True, slots=True)
class LaunchedNode:
    """A node that a launch file starts.

    `namespace` is absolute and ends with a slash. Names of `parameters` are relative to the node;
    all that end up under its name are here, wherever they are set. `arguments` are those of the
    command line that ROS leaves to the program. `markers` are the texts of the comments
    `rebsync: ...` before it. `only_if` holds the conditions that cannot be decided: the node is
    started if all of them hold. `anonymous` says that `$(anon)` makes its name, which stands for
    another one in each run. `test` marks a node that only `rostest` starts. `texts` are those of
    the command line in a launch file of ROS 2, and the values of the node's environment.
    """

    name: Text
    namespace: Text
    package: Text
    type: Text
    parameters: tuple[Parameter, ...]
    remaps: tuple[LaunchedRemap, ...]
    arguments: tuple[str, ...] | Open
    nodelet: Nodelet | None
    test: bool
    anonymous: bool
    only_if: tuple[str, ...]
    markers: tuple[str, ...]
    source: Source
    span: Span
    texts: tuple[str, ...] | Open = ()

    @property
    def path(self) -> Text:
        """The absolute name of the node."""
        return join(self.namespace, self.name)

    def resolved(self, name: str, within: str = "") -> Text:
        """The absolute name that the node's code means by `name`, remapped.

        `within` is the namespace that a NodeHandle was given, if any.
        """
        inner = join(within, name)
        if isinstance(inner, Open):
            return inner
        meant = resolve(inner, self.namespace, self.name)
        # as in roscpp: both sides of a remapping are resolved, of several the last one counts
        for remap in reversed(self.remaps):
            if resolve(remap.private, self.namespace, self.name) == meant:
                if isinstance(remap.target, Open):
                    return remap.target
                return resolve(remap.target, self.namespace, self.name)
        return meant

    def parameter(self, name: str) -> Parameter | None:
        """The private parameter of that name."""
        return next((p for p in self.parameters if p.name == name), None)

    @property
    def private_namespace(self) -> Text:
        """The namespace of the private names, with a slash at its end."""
        return as_namespace(self.path)


@dataclass(frozen=True, slots=True)
class LaunchedCommand:
    """A program that is started as a shell does it, by its command line."""

    arguments: tuple[str, ...] | Open
    source: Source
    span: Span


@dataclass(frozen=True, slots=True)
class Launch:
    """All that a launch file and the files it includes say.

    `parameters` are those under no node; their names are absolute. `sources` are the texts read.
    """

    nodes: tuple[LaunchedNode, ...]
    parameters: tuple[Parameter, ...]
    unknowns: tuple[Unknown, ...]
    sources: tuple[Source, ...]
    commands: tuple[LaunchedCommand, ...] = ()
