"""Launch files of ROS 2 in XML and YAML: the same tags, written in two ways."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

import yaml

from rebsync.records import dataclass
from rebsync.reverse.launch.parameters import yaml_span
from rebsync.reverse.launch.ros2_actions import (
    Action,
    CommandAction,
    Condition,
    DeclareArgument,
    ForAll,
    FromFile,
    Group,
    Include,
    LaunchParameter,
    Let,
    NodeAction,
    Only,
    ParameterSource,
    Push,
    Remapping,
    Unlisted,
)
from rebsync.reverse.launch.ros2_words import Words
from rebsync.reverse.launch.tag_words import tag_words
from rebsync.reverse.launch.xml_tree import Comment, XmlElement, read_xml
from rebsync.reverse.unknowns import Unknown
from rebsync.source import Source, Span

_NODES = frozenset({"node", "lifecycle_node", "composable_node"})
_CONTAINERS = frozenset({"node_container", "load_composable_node"})
_SILENT = frozenset({"log", "shutdown", "set_env", "unset_env", "append_env", "reset"})
_MARKER = re.compile(r"\s*rebsync:\s*(.*?)\s*\Z", re.DOTALL)
# Words by which a launch file in XML is known to be for ROS 2.
_OF_ROS_2 = re.compile(
    r"<(?:let|push[-_]ros[-_]namespace|node_container|set_remap|set_parameter|executable)\b"
    r"|<node\b[^>]*\bexec\s*="
    r"|\$\((?:var|find-pkg-share)\s"
)


@dataclass(frozen=True, slots=True)
class Tag:
    """A tag, or what stands for one in YAML."""

    name: str
    given: Mapping[str, Words]
    inner: tuple[Tag, ...]
    markers: tuple[str, ...]
    span: Span

    def children(self, name: str) -> list[Tag]:
        """The tags of a name directly inside."""
        return [t for t in self.inner if t.name == name]


def has_words_of_ros_2(text: str) -> bool:
    """Whether a launch file in XML is for ROS 2."""
    return _OF_ROS_2.search(text) is not None


# --- trees --------------------------------------------------------------------------------------


def actions_of_xml(source: Source) -> tuple[Action, ...] | Unknown:
    """The actions of a file in XML, or why there are none."""
    root = read_xml(source)
    if isinstance(root, Unknown):
        return root
    return tuple(_actions(_of_element(root, ()).inner))


def actions_of_yaml(source: Source) -> tuple[Action, ...] | Unknown:
    """The actions of a file in YAML, or why there are none."""
    try:
        root = yaml.compose(source.text, Loader=yaml.SafeLoader)
    except (yaml.YAMLError, RecursionError) as error:
        why = f"this is no YAML that can be read: {' '.join(str(error).split())}"
        return Unknown("the launch file", why, source, Span(0, 0))
    for key, value in _pairs(root):
        if key == "launch":
            return tuple(_actions(_entities(value)))
    return Unknown("the launch file", "it has no list `launch`", source, Span(0, 0))


def _of_element(element: XmlElement, markers: tuple[str, ...]) -> Tag:
    inner: list[Tag] = []
    above: list[str] = []
    for child in element.children:
        if isinstance(child, Comment):
            found = _MARKER.match(child.text)
            above += [found[1]] if found is not None else []
        else:
            inner.append(_of_element(child, tuple(above)))
            above = []
    given = {k: tag_words(a.value, a.span) for k, a in element.attributes.items()}
    return Tag(_name(element.name), given, tuple(inner), markers, element.span)


def _name(name: str) -> str:
    return name.replace("-", "_")


def _pairs(node: yaml.Node | None) -> Iterator[tuple[str, yaml.Node]]:
    for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
        if isinstance(key, yaml.ScalarNode):
            yield key.value, value


def _entities(node: yaml.Node) -> tuple[Tag, ...]:
    """The tags of a list, each a mapping with one key."""
    items = node.value if isinstance(node, yaml.SequenceNode) else ()
    return tuple(_of_yaml(key, value) for item in items for key, value in _pairs(item))


def _of_yaml(name: str, node: yaml.Node) -> Tag:
    given: dict[str, Words] = {}
    inner: list[Tag] = list(_entities(node))
    for key, value in _pairs(node):
        if isinstance(value, yaml.ScalarNode):
            given[key] = tag_words(value.value, yaml_span(value))
        elif isinstance(value, yaml.SequenceNode):
            inner += [_of_yaml(key, item) for item in value.value]
        else:
            inner.append(_of_yaml(key, value))
    return Tag(_name(name), given, tuple(inner), (), yaml_span(node))


# --- actions ------------------------------------------------------------------------------------


def _actions(tags: tuple[Tag, ...]) -> Iterator[Action]:
    for tag in tags:
        action: Action
        for action in _made(tag):
            for word, holds in (("if", True), ("unless", False)):
                if word in tag.given:
                    text = f"{word}={_shown(tag.given[word])}"
                    action = Only(Condition(tag.given[word], holds, text), action)
            yield action


def _shown(words: Words) -> str:
    return "".join(part if isinstance(part, str) else "$(...)" for part in words.parts)


def _made(tag: Tag) -> Iterator[Action]:
    given = tag.given
    match tag.name:
        case name if name in _NODES:
            yield _start(tag)
        case name if name in _CONTAINERS:
            yield Group(tuple(_actions(tuple(tag.children("composable_node")))), False)
        case "arg" if "name" in given:
            yield DeclareArgument(given["name"], given.get("default"))
        case "let" if "name" in given and "value" in given:
            yield Let(given["name"], given["value"])
        case "push_ros_namespace" if "namespace" in given:
            yield Push(given["namespace"])
        case "set_remap" if "from" in given and "to" in given:
            yield ForAll(remaps=(Remapping(given["from"], given["to"], tag.span),))
        case "set_parameter" if "name" in given and "value" in given:
            yield ForAll(parameters=(LaunchParameter(given["name"], given["value"], tag.span),))
        case "set_parameters_from_file" if "filename" in given:
            yield ForAll(parameters=(FromFile(given["filename"]),))
        case "group":
            scoped = given.get("scoped")
            inner = tuple(t for t in tag.inner if t.name != "keep")
            yield Group(tuple(_actions(inner)), scoped is None or _shown(scoped) != "false")
        case "timer":
            yield from _actions(tag.inner)
        case "include" if "file" in given:
            pairs = [t.given for t in (*tag.children("arg"), *tag.children("let"))]
            named = tuple((p["name"], p["value"]) for p in pairs if {"name", "value"} <= {*p})
            yield Include(given["file"], named, tag.span)
        case "executable":
            yield CommandAction(_texts(tag, "cmd"), tag.span)
        case name if name in _SILENT:
            return
        case name:
            why = "launch does not know it, or it lacks what it needs"
            yield Unlisted(f"the tag <{name}>", tag.span, why)


def _start(tag: Tag) -> NodeAction:
    given = tag.given
    return NodeAction(
        name=given.get("name"),
        namespace=given.get("namespace"),
        package=given.get("pkg"),
        type=given.get("exec", given.get("plugin")),
        parameters=tuple(p for t in tag.children("param") for p in _parameters(t, "")),
        remaps=tuple(_remaps(tag)),
        markers=tag.markers,
        span=tag.span,
        texts=_texts(tag, "args", "ros_args"),
        arguments=(given["args"],) if "args" in given else (),
        ros_arguments=(given["ros_args"],) if "ros_args" in given else (),
        is_split=True,
    )


def _texts(tag: Tag, *names: str) -> tuple[Words, ...]:
    """What a tag gives a program: some attributes, and the values of its environment."""
    environment = (t.given.get("value") for t in tag.children("env"))
    found = (*(tag.given.get(name) for name in names), *environment)
    return tuple(words for words in found if words is not None)


def _parameters(tag: Tag, prefix: str) -> Iterator[ParameterSource]:
    """A parameter, a file of them, or a name with parameters below it."""
    given = tag.given
    if "from" in given:
        yield FromFile(given["from"])
        return
    if "name" not in given:
        yield Unlisted("parameters of a node", tag.span, "a parameter has no name")
        return
    name = Words((prefix, *given["name"].parts), given["name"].span)
    if "value" in given:
        kind = given.get("type")
        typed = kind is not None and _shown(kind) == "str"
        yield LaunchParameter(name, given["value"], tag.span, typed)
    below = _shown(name)
    for inner in tag.children("param"):
        yield from _parameters(inner, f"{below}/")


def _remaps(tag: Tag) -> Iterator[Remapping | Unlisted]:
    for inner in tag.children("remap"):
        if "from" in inner.given and "to" in inner.given:
            yield Remapping(inner.given["from"], inner.given["to"], inner.span)
        else:
            yield Unlisted("a remapping", inner.span, "it lacks `from` or `to`")
