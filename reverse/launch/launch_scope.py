"""The scopes of a launch file: what a tag sees of arguments, namespace, remappings, parameters.

They nest as roslaunch nests them: a group sees all of what is around it and leaks nothing but
global parameters and nodes; an included file sees everything but the arguments, of which it has
those that are passed to it.
"""

from __future__ import annotations

from dataclasses import field

from rebsync.records import dataclass
from rebsync.reverse.launch.graph_names import as_namespace, canonical, is_legal, join
from rebsync.reverse.launch.launch_values import Substitution, Surroundings, truth
from rebsync.reverse.launch.launched import LaunchedRemap
from rebsync.reverse.launch.parameters import Parameter
from rebsync.reverse.launch.xml_tree import XmlElement
from rebsync.reverse.unknowns import Open, Text, Unknown
from rebsync.source import Source, Span

_STARTING = frozenset({"group", "include", "node"})


@dataclass(slots=True)
class LaunchReading:
    """What the scopes of one reading share: the outside, and what has been found so far.

    `taken` are the names made up for `$(anon)`.
    """

    surroundings: Surroundings
    taken: set[str] = field(default_factory=set)
    unknowns: list[Unknown] = field(default_factory=list)
    sources: list[Source] = field(default_factory=list)

    def load(self, path: str) -> Source | None:
        """The text of a file, which then counts as read."""
        source = self.surroundings.load(path)
        if source is not None:
            self.sources.append(source)
        return source


@dataclass(slots=True)
class LaunchScope:
    """The state of a scope while its tags are read in order.

    `private` are the `~` parameters that later nodes get, by name. `only_if` are the conditions
    around the scope that cannot be decided.
    """

    reading: LaunchReading
    source: Source
    namespace: Text = "/"
    arguments: dict[str, Text] = field(default_factory=dict)
    anonymous: dict[str, str] = field(default_factory=dict)
    declared: set[str] = field(default_factory=set)
    passes_all: bool = False
    remaps: dict[str, LaunchedRemap] = field(default_factory=dict)
    private: dict[str, Parameter] = field(default_factory=dict)
    only_if: tuple[str, ...] = ()
    depth: int = 0

    def group(self, namespace: Text, condition: tuple[str, ...]) -> LaunchScope:
        """The scope of a `<group>`."""
        return LaunchScope(
            self.reading,
            self.source,
            namespace,
            dict(self.arguments),
            dict(self.anonymous),
            set(self.declared),
            remaps=dict(self.remaps),
            private=dict(self.private),
            only_if=self.only_if + condition,
            depth=self.depth + 1,
        )

    def included(
        self,
        source: Source,
        namespace: Text,
        arguments: dict[str, Text],
        condition: tuple[str, ...],
        *,
        passes_all: bool,
    ) -> LaunchScope:
        """The scope of a file that an `<include>` reads, with the arguments passed to it."""
        return LaunchScope(
            self.reading,
            source,
            namespace,
            {**self.arguments, **arguments} if passes_all else arguments,
            passes_all=passes_all,
            remaps=dict(self.remaps),
            # roslaunch shares the ~ parameters with the included file unless there are none yet
            private=self.private or {},
            only_if=self.only_if + condition,
            depth=self.depth + 1,
        )

    def below(self, namespace: Text | None) -> Text:
        """The namespace of what has this `ns` attribute."""
        if namespace is None:
            return self.namespace
        if namespace == "":
            return Open("roslaunch takes no empty `ns`")
        return as_namespace(join(self.namespace, namespace))

    def declare(self, name: str, value: Text | None, default: Text | None) -> str | None:
        """Takes an `<arg>` in; says why roslaunch would not."""
        if name in self.declared and not self.passes_all:
            return "it is declared a second time"
        self.declared.add(name)
        if value is not None:
            if name in self.arguments and not self.passes_all:
                return "its value is fixed, but another is passed"
            self.arguments[name] = value
        elif default is not None:
            self.arguments.setdefault(name, default)
        return None

    # --- the tags in it ---------------------------------------------------------------------------

    def substituted(self, text: str) -> Text:
        """The text with its `$(...)` replaced."""
        return Substitution(
            self.reading.surroundings,
            self.source.path,
            self.arguments,
            self.anonymous,
            self.reading.taken,
        ).of(text)

    def text(self, element: XmlElement, attribute: str) -> Text | None:
        """The value of an attribute with its `$(...)` replaced; None where there is none."""
        value = element.get(attribute)
        return None if value is None else self.substituted(value)

    def needed(self, element: XmlElement, attribute: str) -> str | None:
        """The value of an attribute that has to be known; if it is not, that is noted."""
        value = self.text(element, attribute)
        if isinstance(value, str):
            return value
        why = value.why if value else "the attribute is missing"
        self.unknown(f"the `{attribute}` of a <{element.name}>", why, element.place_of(attribute))
        return None

    def condition(self, element: XmlElement) -> bool | tuple[str, ...]:
        """Whether a tag counts by its `if` and `unless`; as a text where that is open."""
        given = [a for a in ("if", "unless") if a in element.attributes]
        if not given:
            return True
        attribute = given[0]
        value = truth(self.text(element, attribute) or "")
        if len(given) > 1:
            value = Open("roslaunch takes no `if` together with `unless`")
        text = element.get(attribute) or ""
        is_asked = "$(" in text and element.name in _STARTING
        if not isinstance(value, Open):
            counts = value is (attribute == "if")
            may = is_asked and self.reading.surroundings.any_way
            return counts if counts or not may else (f"{attribute} {text}",)
        what = f"whether the <{element.name}> counts"
        self.unknown(what, value.why, element.place_of(attribute))
        return (f"{attribute} {element.get(attribute)}",)

    def unknown(self, what: str, why: str, span: Span) -> None:
        """Notes something that cannot be known or read."""
        self.reading.unknowns.append(Unknown(what, why, self.source, span))

    def check(self, element: XmlElement, attributes: frozenset[str]) -> None:
        """Notes the attributes that roslaunch does not know; it ignores them."""
        for name, attribute in element.attributes.items():
            if name not in attributes and name not in ("if", "unless"):
                what = f"the attribute `{name}` of <{element.name}>"
                self.unknown(what, "roslaunch does not know it", attribute.span)

    def remap(self, element: XmlElement, remaps: dict[str, LaunchedRemap]) -> None:
        """Puts a `<remap>` last among these, in the place of one of the same name."""
        self.check(element, frozenset({"from", "to"}))
        condition = self.condition(element)
        private = self.needed(element, "from") if condition else None
        if private is None:
            return
        target = self.text(element, "to")
        if target is None:
            target = Open("the attribute `to` is missing")
        if not isinstance(condition, bool):
            target = Open(f"it is remapped only `{condition[0]}`")
        names = [canonical(n) for n in (private, target) if isinstance(n, str)]
        wrong = [n for n in names if not n or not is_legal(n)]
        if isinstance(target, Open) or wrong:
            why = target.why if isinstance(target, Open) else f"`{wrong[0]}` is no name of ROS"
            self.unknown(f"the remapping of `{private}`", why, element.span)
        if not wrong:
            remaps.pop(names[0], None)
            target = target if isinstance(target, Open) else names[1]
            remaps[names[0]] = LaunchedRemap(names[0], target, self.source, element.span)
