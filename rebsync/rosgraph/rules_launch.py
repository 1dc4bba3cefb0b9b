"""Rules about what launch files give their nodes: remappings and parameters that have no effect.

They speak of a node only if all of its names are known, and it hands itself to no library that
could have more.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from rebsync.reverse.graph import OneOf, Place, Resolved
from rebsync.reverse.launch.launched import LaunchedNode, LaunchedRemap
from rebsync.reverse.launch.parameter_sections import is_any
from rebsync.reverse.launch.parameters import Parameter
from rebsync.rosgraph.ends import NodeCode
from rebsync.rosgraph.findings import GraphFinding
from rebsync.rosgraph.graph import RosNode
from rebsync.rosgraph.naming import KnownName

_SYSTEM = re.compile(
    r"/?(?:tf|tf_static|clock|rosout|parameter_events|diagnostics)\Z|__|.*[:*\\]|.*/_action/"
)
_BUILT_IN = re.compile(
    r"(?:use_sim_time|start_type_description_service|enable_logger_service)\Z|qos_overrides/"
)


def by_tag(nodes: Iterable[RosNode]) -> Iterator[tuple[LaunchedNode, list[RosNode]]]:
    """The nodes that each tag of a launch file starts."""
    found: dict[int, tuple[LaunchedNode, list[RosNode]]] = {}
    for node in nodes:
        if node.launched is not None:
            found.setdefault(id(node.launched), (node.launched, []))[1].append(node)
    yield from found.values()


def unused_remappings(nodes: Iterable[RosNode]) -> Iterator[GraphFinding]:
    """RS995: a remapping in a node's own tag of a name that the node does not use."""
    for tag, run in by_tag(nodes):
        if not _is_known(run) or any(e.name is None for n in run for e in n.ends):
            continue
        used = {name for node in run for name in _used(node)}
        for remap in tag.remaps:
            if not _is_own(tag, remap) or _SYSTEM.match(remap.private):
                continue
            meant = run[0].naming.before_remapping(remap.private)
            if not isinstance(meant, str) or any(_is_of(meant, name) for name in used):
                continue
            yield _unused(run[0], remap, used)


def _is_own(tag: LaunchedNode, remap: LaunchedRemap) -> bool:
    """Whether a remapping stands in the node itself, not in a group for several.

    The place of an element of XML is that of its first tag.
    """
    start, at = tag.span.start, remap.span.start
    if remap.source is not tag.source or at < start:
        return False
    between = tag.source.text[start + 1 : at]
    in_xml = tag.source.text.startswith("<", start)
    return at < tag.span.end or (in_xml and not re.search(r"<node\b|</node>", between))


def _is_of(meant: str, name: str) -> bool:
    """Whether a name is that of an end, or one that a transport makes of it."""
    return meant == name or meant.startswith(f"{name}/")


def _used(node: RosNode) -> Iterator[str]:
    """The names that the code has, before any remapping."""
    for end in node.code.ends if node.code is not None else ():
        for value in node.naming.values(end.name):
            if isinstance(value, KnownName):
                meant = node.naming.before_remapping(value.text)
                if isinstance(meant, str):
                    yield meant


def _unused(node: RosNode, remap: LaunchedRemap, used: set[str]) -> GraphFinding:
    target = remap.target if isinstance(remap.target, str) else ""
    turned = node.naming.before_remapping(target) in used
    hint = (
        f"the node uses {target}: the two sides may be the wrong way round"
        if turned
        else f"its names are {', '.join(sorted(used))}"
        if used
        else "it has no names"
    )
    message = f"{node.name} does not use the name {remap.private}, which is remapped here"
    return GraphFinding("RS995", Place(remap.source, remap.span), message, hint)


def unknown_parameters(nodes: Iterable[RosNode]) -> Iterator[GraphFinding]:
    """RS996: a parameter that is set of a node whose code neither declares nor reads it."""
    for tag, run in by_tag(nodes):
        uses = [use for node in run for use in (node.code.parameters if node.code else ())]
        names = [name for use in uses for name in _plain(use.name)]
        if not _is_known(run) or tag.nodelet is not None or None in names:
            continue
        known = {_relative(name, run[0]) for name in names if name is not None}
        for parameter in tag.parameters:
            if is_any(parameter.name) or _is_for_all(parameter, tag):
                continue
            if _BUILT_IN.match(parameter.name) or _has(known, parameter.name):
                continue
            place = Place(parameter.source, parameter.span)
            listed = ", ".join(sorted(n for n in known if n))
            message = f"{run[0].name} has no parameter {parameter.name}, which is set here"
            hint = f"its parameters are {listed}" if listed else "it has no parameters"
            yield GraphFinding("RS996", place, message, hint)


def _is_for_all(parameter: Parameter, tag: LaunchedNode) -> bool:
    """Whether a file sets a parameter for several nodes: one of them may have it."""
    sections = (s.parameters for s in tag.sections if "*" in s.pattern)
    return parameter.source is not tag.source and any(parameter in each for each in sections)


def _is_known(run: Sequence[RosNode]) -> bool:
    return all(node.code is not None and node.code.closed for node in run)


def _plain(name: Resolved) -> Iterator[str | None]:
    """The names that a parameter of the code may have; None for one that is not known."""
    match name:
        case str():
            yield name
        case OneOf(values):
            for value in values:
                yield from _plain(value)
        case _:
            yield None


def _relative(name: str, node: RosNode) -> str:
    """The name of a parameter as launch files have it: relative to the node."""
    plain = name.removeprefix("~").strip("/").replace(".", "/")
    own = node.name.strip("/")
    return plain.removeprefix(f"{own}/") if not _is_flat(node.code) else plain


def _is_flat(code: NodeCode | None) -> bool:
    return code is not None and code.is_flat


def _has(known: set[str], name: str) -> bool:
    """Whether a parameter is one of these, or a part of one."""
    parts = (name == k or name.startswith(f"{k}/") or k.startswith(f"{name}/") for k in known)
    return "" in known or any(parts)
