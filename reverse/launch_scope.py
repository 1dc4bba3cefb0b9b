"""The scopes of a launch file: what a tag sees of arguments, namespace, remappings, parameters.

They nest as roslaunch nests them: a group sees all of what is around it and leaks nothing but
global parameters and nodes; an included file sees everything but the arguments, of which it has
those that are passed to it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rebsync.reverse.graph_names import as_namespace, canonical, is_legal, join
from rebsync.reverse.launch_values import Substitution, Surroundings
from rebsync.reverse.launched import LaunchedRemap
from rebsync.reverse.parameters import Parameter
from rebsync.reverse.unknowns import Open, Text
from rebsync.source import Source


@dataclass(slots=True)
class Scope:
    """The state of a scope while its tags are read in order.

    `private` are the `~` parameters that later nodes get, by name. `only_if` are the conditions
    around the scope that cannot be decided.
    """

    surroundings: Surroundings
    source: Source
    taken: set[str]
    namespace: Text = "/"
    arguments: dict[str, Text] = field(default_factory=dict)
    anonymous: dict[str, str] = field(default_factory=dict)
    declared: set[str] = field(default_factory=set)
    passes_all: bool = False
    remaps: dict[str, LaunchedRemap] = field(default_factory=dict)
    private: dict[str, tuple[Parameter, ...]] = field(default_factory=dict)
    only_if: tuple[str, ...] = ()
    depth: int = 0

    def substitution(self) -> Substitution:
        """What `$(...)` stands for here."""
        return Substitution(
            self.surroundings, self.source.path, self.arguments, self.anonymous, self.taken
        )

    def below(self, namespace: Text | None) -> Text:
        """The namespace of what has this `ns` attribute."""
        if namespace is None:
            return self.namespace
        if namespace == "":
            return Open("roslaunch takes no empty `ns`")
        return as_namespace(join(self.namespace, namespace))

    def group(self, namespace: Text, condition: str | None) -> Scope:
        """The scope of a `<group>`."""
        return Scope(
            self.surroundings,
            self.source,
            self.taken,
            namespace,
            dict(self.arguments),
            dict(self.anonymous),
            set(self.declared),
            remaps=dict(self.remaps),
            private=dict(self.private),
            only_if=self.only_if + ((condition,) if condition else ()),
            depth=self.depth + 1,
        )

    def included(
        self, source: Source, namespace: Text, arguments: dict[str, Text], condition: str | None
    ) -> Scope:
        """The scope of a file that an `<include>` reads."""
        return Scope(
            self.surroundings,
            source,
            self.taken,
            namespace,
            arguments,
            remaps=dict(self.remaps),
            # roslaunch shares the list of ~ parameters with the included file unless it is empty
            private=self.private or {},
            only_if=self.only_if + ((condition,) if condition else ()),
            depth=self.depth + 1,
        )

    def declare(self, name: str, value: Text | None, default: Text | None) -> str | None:
        """Takes an `<arg>` in; says why roslaunch would not."""
        if name in self.declared and not self.passes_all:
            return "it is declared a second time"
        self.declared.add(name)
        if value is not None:
            if name in self.arguments and not self.passes_all:
                return "it has a fixed value, but is given another"
            self.arguments[name] = value
        elif default is not None:
            self.arguments.setdefault(name, default)
        return None

    def remap(self, remap: LaunchedRemap) -> str | None:
        """Takes a `<remap>` in; says why roslaunch would not."""
        return add_remap(self.remaps, remap)


def add_remap(remaps: dict[str, LaunchedRemap], remap: LaunchedRemap) -> str | None:
    """Puts a remapping last, in the place of one of the same name; says why it is not legal."""
    for name in (remap.private, remap.target):
        if not isinstance(name, Open) and (not name or not is_legal(canonical(name))):
            return f"`{name}` is no name of ROS"
    remaps.pop(remap.private, None)
    remaps[remap.private] = remap
    return None


def passed(arguments: Mapping[str, Text], scope: Scope, *, passes_all: bool) -> dict[str, Text]:
    """The arguments that an included file starts with."""
    return {**(scope.arguments if passes_all else {}), **arguments}
