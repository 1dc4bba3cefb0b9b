"""Launch files of ROS 1: the nodes that they start, without starting anything.

Tags are read in order with the scopes, conversions and precedence of roslaunch. What depends on
the machine, on a command or on a file that is not at hand is open, never guessed; each such place
is in the list of unknowns.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field, replace

from rebsync.records import dataclass
from rebsync.reverse.launch.graph_names import canonical, join
from rebsync.reverse.launch.launch_nodes import NodeTag, environment, marker, node_tag
from rebsync.reverse.launch.launch_parameters import settings
from rebsync.reverse.launch.launch_scope import LaunchReading, LaunchScope
from rebsync.reverse.launch.launch_values import Surroundings
from rebsync.reverse.launch.launched import Launch, LaunchedNode
from rebsync.reverse.launch.parameter_sections import ANY, is_any, overridden
from rebsync.reverse.launch.parameters import Parameter
from rebsync.reverse.launch.xml_tree import Comment, XmlElement, read_xml
from rebsync.reverse.unknowns import Open, Text, Unknown
from rebsync.source import Source

_DEEPEST = 60
_MOST_FILES = 1000
_ARG = frozenset({"name", "value", "default", "doc"})
_GROUP = frozenset({"ns", "clear_params"})
_INCLUDE = frozenset({"file", "ns", "clear_params", "pass_all_args"})


def read_launch(source: Source, surroundings: Surroundings | None = None) -> Launch:
    """What a launch file and all that it includes start and set."""
    outside = surroundings or Surroundings()
    reading = LaunchReading(outside, sources=[source])
    loader = _Loader(reading)
    loader.file(LaunchScope(reading, source, arguments=dict(outside.arguments)))
    return loader.result()


@dataclass(slots=True)
class _Loader:
    reading: LaunchReading
    started: list[tuple[int, NodeTag]] = field(default_factory=list)
    server: dict[str, tuple[int, Parameter]] = field(default_factory=dict)
    paths: set[str] = field(default_factory=set)
    step: int = 0

    def file(self, scope: LaunchScope) -> None:
        """Reads the file of a scope."""
        root = read_xml(scope.source)
        if isinstance(root, Unknown):
            self.reading.unknowns.append(root)
        elif root.name != "launch":
            scope.unknown("the launch file", "its root is no <launch>", root.span)
        else:
            self._tags(root, scope)

    def _tags(self, parent: XmlElement, scope: LaunchScope) -> None:
        markers: list[str] = []
        for child in parent.children:
            if isinstance(child, Comment):
                found = marker(child.text)
                markers += [found] if found is not None else []
            else:
                self.step += 1
                self._tag(child, scope, markers)
                markers = []

    def _tag(self, element: XmlElement, scope: LaunchScope, markers: list[str]) -> None:
        match element.name:
            case "arg":
                self._arg(element, scope, scope)
            case "group":
                self._group(element, scope)
            case "include":
                self._include(element, scope)
            case "node" | "test":
                self._node(node_tag(element, scope, markers), scope)
            case "param" | "rosparam":
                for parameter in settings(element, scope):
                    self._set(parameter, scope)
            case "remap":
                scope.remap(element, scope.remaps)
            case "env":
                environment(element, scope)
            case "machine" | "master":
                pass
            case _:
                scope.unknown(
                    f"the tag <{element.name}>", "roslaunch does not know it", element.span
                )

    def _arg(self, element: XmlElement, scope: LaunchScope, declared_in: LaunchScope) -> None:
        """An `<arg>`, whose value is worked out in one scope and belongs to another."""
        scope.check(element, _ARG)
        condition = scope.condition(element)
        name = scope.needed(element, "name") if condition else None
        if name is None:
            return
        value, default = scope.text(element, "value"), scope.text(element, "default")
        if not isinstance(condition, bool):
            value, default = None, Open(f"the argument `{name}` is set only `{condition[0]}`")
        if value is not None and default is not None:
            wrong: str | None = "roslaunch takes no `value` together with `default`"
        elif declared_in is not scope and value is None and default is None:
            wrong = "it is passed to a file without a value"
        else:
            wrong = declared_in.declare(name, value, default)
        if wrong:
            scope.unknown(f"the argument `{name}`", wrong, element.span)

    def _group(self, element: XmlElement, scope: LaunchScope) -> None:
        scope.check(element, _GROUP)
        condition = scope.condition(element)
        if condition is False:
            return
        namespace = self._namespace(element, scope)
        self._tags(element, scope.group(namespace, () if condition is True else condition))

    def _namespace(self, element: XmlElement, scope: LaunchScope) -> Text:
        namespace = scope.below(scope.text(element, "ns"))
        if isinstance(namespace, Open) and "ns" in element.attributes:
            what = f"the namespace of a <{element.name}>"
            scope.unknown(what, namespace.why, element.place_of("ns"))
        return namespace

    # --- <include> --------------------------------------------------------------------------------

    def _include(self, element: XmlElement, scope: LaunchScope) -> None:
        scope.check(element, _INCLUDE)
        condition = scope.condition(element)
        path = scope.needed(element, "file") if condition else None
        if path is None:
            return
        source = self._included(path, scope)
        if isinstance(source, Open):
            scope.unknown(f"the file `{path}`", source.why, element.place_of("file"))
            return
        all_ = scope.text(element, "pass_all_args") or "false"
        if isinstance(all_, Open) or all_.lower() not in ("true", "false"):
            why = all_.why if isinstance(all_, Open) else f"`{all_}` is no bool"
            scope.unknown("which arguments are passed", why, element.place_of("pass_all_args"))
            return
        passes_all = all_.lower() == "true"
        arguments = self._passed(element, scope, passes_all=passes_all)
        inner = scope.included(
            source,
            self._namespace(element, scope),
            arguments,
            () if isinstance(condition, bool) else condition,
            passes_all=passes_all,
        )
        self.file(inner)
        if not passes_all and (unused := sorted(arguments.keys() - inner.declared)):
            why = f"it declares no argument {', '.join(f'`{name}`' for name in unused)}"
            scope.unknown(f"the file `{path}`", why, element.span)

    def _included(self, path: str, scope: LaunchScope) -> Source | Open:
        if scope.depth >= _DEEPEST or len(self.reading.sources) >= _MOST_FILES:
            return Open("files include each other too often to be read")
        source = self.reading.load(path)
        return Open("it is not at hand") if source is None else source

    def _passed(
        self, element: XmlElement, scope: LaunchScope, *, passes_all: bool
    ) -> dict[str, Text]:
        """The arguments that the tags in an `<include>` pass."""
        receiver = LaunchScope(self.reading, scope.source, passes_all=passes_all)
        for tag in element.elements():
            match tag.name.lower():
                case "arg":
                    self._arg(tag, scope, receiver)
                case "env":
                    environment(tag, scope)
                case _:
                    scope.unknown(f"the tag <{tag.name}>", "roslaunch takes none here", tag.span)
        return receiver.arguments

    # --- parameters and nodes ---------------------------------------------------------------------

    def _set(self, parameter: Parameter, scope: LaunchScope) -> None:
        """Sets a parameter of a scope: a `~` one for the nodes that follow, others at once."""
        if parameter.name.startswith("~"):
            scope.private.pop(parameter.name, None)
            scope.private[parameter.name] = parameter
            return
        name = join(scope.namespace, parameter.name)
        if isinstance(name, Open):
            what = f"the name of the parameter `{parameter.name}`"
            self.reading.unknowns.append(Unknown(what, name.why, parameter.source, parameter.span))
            return
        if scope.only_if and not isinstance(parameter.value, Open):
            parameter = replace(parameter, value=Open(f"it is set only `{scope.only_if[-1]}`"))
        self._store(replace(parameter, name=canonical(name)))

    def _store(self, parameter: Parameter) -> None:
        """Sets a parameter of the server; of what any parameter may be, all so far is open."""
        if is_any(parameter.name):
            for name, (when, earlier) in self.server.items():
                if name.startswith(parameter.name[: -len(ANY)]):
                    self.server[name] = when, replace(earlier, value=parameter.value)
        self.server[parameter.name] = self.step, parameter

    def _node(self, tag: NodeTag | None, scope: LaunchScope) -> None:
        if tag is None:
            return
        path = tag.node.path
        if isinstance(path, str) and not tag.node.only_if:
            if path in self.paths:
                why = f"another node has the name `{path}`"
                scope.unknown("a node", why, tag.node.span)
                return
            self.paths.add(path)
        self.started.append((self.step, tag))
        if tag.node.package == tag.node.type == "rosparam":
            runs = Open("`rosparam` sets parameters when it runs")
            self._store(Parameter(f"/{ANY}", runs, tag.node.source, tag.node.span))
        for parameter in tag.outside:
            self._set(parameter, scope)

    # --- the whole --------------------------------------------------------------------------------

    def result(self) -> Launch:
        """All that has been read, parameters sorted to the nodes that have them."""
        nodes = tuple(self._complete(step, tag) for step, tag in self.started)
        spaces = tuple(s for s in (n.private_namespace for n in nodes) if isinstance(s, str))
        rest = [p for _, p in self.server.values() if not p.name.startswith(spaces)]
        self._conflicts(nodes)
        return Launch(nodes, tuple(rest), tuple(self.reading.unknowns), tuple(self.reading.sources))

    def _complete(self, step: int, tag: NodeTag) -> LaunchedNode:
        own = {p.name: p for p in tag.own}
        space = tag.node.private_namespace
        for name, (when, parameter) in self.server.items():
            if isinstance(space, str) and name.startswith(space):
                inner = name[len(space) :]
            elif isinstance(space, Open) or (is_any(name) and space.startswith(name[: -len(ANY)])):
                inner, parameter = ANY, replace(parameter, value=_any(space, parameter))
            else:
                continue
            if is_any(inner) and when > step:
                overridden(own, replace(parameter, name=inner))
            elif when > step or inner not in own:
                own[inner] = replace(parameter, name=inner)
        for parameter in tag.given:
            overridden(own, parameter)
        return replace(tag.node, parameters=tuple(own.values()))

    def _conflicts(self, nodes: tuple[LaunchedNode, ...]) -> None:
        """Notes parameters with others below them: the last one set removes the other."""
        named = {name: p for name, (_, p) in self.server.items()}
        named |= {f"{n.private_namespace}{p.name}": p for n in nodes for p in n.parameters}
        for name, parameter in named.items():
            for above in _above(name) if not is_any(name) else ():
                if above in named:
                    why = f"`{above}` and `{name}` cannot both be set"
                    self.reading.unknowns.append(
                        Unknown("a parameter", why, parameter.source, parameter.span)
                    )


def _any(space: Text, parameter: Parameter) -> Open:
    """Why any parameter of a node may be set by one of the server."""
    if isinstance(space, Open):
        return Open(f"the name of its node is not known: {space.why}")
    return parameter.value if isinstance(parameter.value, Open) else Open("it is not known")


def _above(name: str) -> Iterator[str]:
    at = name.rfind("/")
    while at > 0:
        yield name[:at]
        at = name.rfind("/", 0, at)
