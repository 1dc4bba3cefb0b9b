"""The tags `<node>` and `<test>` of launch files."""

from __future__ import annotations

import re
import shlex
from collections.abc import Sequence
from dataclasses import field, replace

from rebsync.records import dataclass
from rebsync.reverse.launch.graph_names import canonical
from rebsync.reverse.launch.launch_parameters import settings
from rebsync.reverse.launch.launch_scope import LaunchScope
from rebsync.reverse.launch.launched import LaunchedNode, LaunchedRemap, Nodelet
from rebsync.reverse.launch.parameter_sections import ANY, overridden
from rebsync.reverse.launch.parameters import Parameter
from rebsync.reverse.launch.xml_tree import XmlElement
from rebsync.reverse.unknowns import Open, Text
from rebsync.source import Span

_NODE = frozenset(
    {
        *("args", "clear_params", "cwd", "launch-prefix", "machine", "name", "ns", "output"),
        *("pkg", "required", "respawn", "respawn_delay", "type"),
    }
)
_TEST = _NODE - {"output", "respawn", "respawn_delay"} | {"retry", "test-name", "time-limit"}
_INTEGER = re.compile(r"[+-]?\d+\Z", re.ASCII)
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\Z", re.ASCII)
_MARKER = re.compile(r"\s*rebsync:\s*(.*?)\s*\Z", re.DOTALL)


@dataclass(slots=True)
class NodeTag:
    """A node, the private parameters that its tag sets, and those that it sets elsewhere.

    `given` are private parameters of the command line: the node sets them itself when it starts.
    """

    node: LaunchedNode
    own: tuple[Parameter, ...]
    given: tuple[Parameter, ...]
    outside: tuple[Parameter, ...]


@dataclass(slots=True)
class _Inside:
    """What the tags in a node say."""

    remaps: dict[str, LaunchedRemap]
    loaded: dict[str, Parameter] = field(default_factory=dict)
    params: dict[str, Parameter] = field(default_factory=dict)
    outside: list[Parameter] = field(default_factory=list)


def node_tag(element: XmlElement, scope: LaunchScope, markers: Sequence[str]) -> NodeTag | None:
    """The node that a `<node>` or `<test>` starts; None where roslaunch starts none."""
    test = element.name == "test"
    scope.check(element, _TEST if test else _NODE)
    condition = scope.condition(element)
    if condition is False:
        return None
    name = _name(element, scope)
    package, type_ = _required(element, "pkg", scope), _required(element, "type", scope)
    if name is None or package is None or type_ is None:
        return None
    inside = _inside(element, scope)
    words = _words(scope.text(element, "args") or "")
    if isinstance(words, Open):
        scope.unknown("the arguments of a node", words.why, element.place_of("args"))
    given, arguments = _command_line(words, scope, element.place_of("args"))
    namespace = scope.below(scope.text(element, "ns"))
    if isinstance(namespace, Open) and "ns" in element.attributes:
        scope.unknown("the namespace of a node", namespace.why, element.place_of("ns"))
    if not isinstance(words, Open) and any(word.startswith("__ns:=") for word in words):
        namespace = Open("the command line may give another one")
    node = LaunchedNode(
        name=name,
        namespace=namespace,
        package=package,
        type=type_,
        parameters=(),
        remaps=(*given.remaps.values(), *inside.remaps.values()),
        arguments=arguments,
        nodelet=_nodelet(package, type_, arguments),
        test=test,
        anonymous="$(anon " in (element.get("name") or ""),
        only_if=scope.only_if + (() if condition is True else condition),
        markers=tuple(markers),
        source=scope.source,
        span=element.span,
    )
    # roslaunch sets what is loaded first, then ~ parameters of the scope, then <param> tags
    own = dict(inside.loaded)
    for parameter in (*_private(scope).values(), *inside.params.values()):
        overridden(own, parameter)
    return NodeTag(node, tuple(own.values()), tuple(given.params.values()), tuple(inside.outside))


def _required(element: XmlElement, attribute: str, scope: LaunchScope) -> Text | None:
    """The value of a necessary attribute; None, and noted, where there is none."""
    value = scope.text(element, attribute)
    if not value:
        scope.unknown(f"a <{element.name}>", f"it has no `{attribute}`", element.span)
        return None
    if isinstance(value, Open):
        what = f"the `{attribute}` of a <{element.name}>"
        scope.unknown(what, value.why, element.place_of(attribute))
    return value


def _name(element: XmlElement, scope: LaunchScope) -> Text | None:
    attribute = "test-name" if element.name == "test" and not element.get("name") else "name"
    name = _required(element, attribute, scope)
    if isinstance(name, str) and "/" in name:
        why = f"roslaunch takes no namespace in the name `{name}` of a node"
        scope.unknown(f"a <{element.name}>", why, element.place_of(attribute))
        return None
    return name


def _private(scope: LaunchScope) -> dict[str, Parameter]:
    return {p.name: p for p in map(_relative, scope.private.values())}


def _relative(parameter: Parameter) -> Parameter:
    """With the name relative to the node: a <param> in a node is private, whatever is in front."""
    name = canonical(parameter.name.removeprefix("~")).strip("/")
    return replace(parameter, name=name)


def _inside(element: XmlElement, scope: LaunchScope) -> _Inside:
    inside = _Inside(dict(scope.remaps))
    for tag in element.elements():
        match tag.name.lower():
            case "remap":
                scope.remap(tag, inside.remaps)
            case "param":
                for parameter in map(_relative, settings(tag, scope)):
                    overridden(inside.params, parameter)
            case "rosparam":
                for parameter in settings(tag, scope):
                    if parameter.name[:1] in ("/", "~"):
                        inside.outside.append(parameter)
                    else:
                        overridden(inside.loaded, _relative(parameter))
            case "env":
                environment(tag, scope)
            case _:
                scope.unknown(f"the tag <{tag.name}>", "roslaunch takes none here", tag.span)
    return inside


def environment(element: XmlElement, scope: LaunchScope) -> None:
    """Notes an `<env>` that changes what names mean; others do not matter to ROS."""
    name = scope.text(element, "name")
    if name == "ROS_NAMESPACE" and scope.condition(element) is not False:
        why = "ROS_NAMESPACE is set by hand, against the namespace of the launch file"
        scope.unknown("the namespace of a node", why, element.span)


# --- the command line -----------------------------------------------------------------------------


def _words(text: Text) -> tuple[str, ...] | Open:
    if isinstance(text, Open):
        return text
    try:
        return tuple(shlex.split(text))
    except ValueError as error:
        return Open(f"the shell cannot split `{text}`: {error}")


def _command_line(
    words: tuple[str, ...] | Open, scope: LaunchScope, place: Span
) -> tuple[_Inside, tuple[str, ...] | Open]:
    """Remappings and private parameters (`_x:=1`) of the arguments, and the arguments left."""
    given = _Inside({})
    if isinstance(words, Open):
        given.params[ANY] = Parameter(ANY, words, scope.source, place)
        return given, words
    left = []
    for word in words:
        name, separator, value = word.partition(":=")
        if not separator or not name:
            left.append(word)
        elif name.startswith("__"):
            if name != "__name" and name != "__log":  # roslaunch overrides these two itself
                scope.unknown("a node", f"`{word}` changes what its names mean", place)
        elif name.startswith("_"):
            parameter = Parameter(name[1:], _typed(value), scope.source, place)
            given.params[parameter.name] = parameter
        else:
            given.remaps.pop(name, None)
            given.remaps[name] = LaunchedRemap(name, value, scope.source, place)
    return given, tuple(left)


def _typed(text: str) -> bool | int | float | str:
    """The value of `_x:=text` as roscpp takes it."""
    if _INTEGER.match(text) and -(1 << 31) <= int(text[:12]) < 1 << 31 and len(text) <= 11:
        return int(text)
    if _NUMBER.match(text):
        return float(text)
    if text in ("true", "True", "TRUE", "false", "False", "FALSE"):
        return text.lower() == "true"
    return text


def _nodelet(package: Text, type_: Text, arguments: tuple[str, ...] | Open) -> Nodelet | None:
    if package != "nodelet" or type_ != "nodelet" or isinstance(arguments, Open):
        return None
    match arguments:
        case ("load", class_name, _, *_) | ("standalone", class_name, *_):
            return Nodelet(arguments[0], class_name)
        case ("manager", *_):
            return Nodelet("manager", None)
        case _:
            return None


def marker(comment: str) -> str | None:
    """The text of a comment `rebsync: ...`, on one line; XML allows no `--` in comments."""
    match = _MARKER.match(comment)
    if not match:
        return None
    return re.sub(r"\s*\n\s*", " ", match[1]).replace("-&#45;", "--")
