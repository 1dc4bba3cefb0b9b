"""Topics of generated code that go to another rebec than the one that the node is told it knows."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rebsync.names import graph_name
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.launch.launched import LaunchedNode, LaunchedRemap

_HINT = "write the same rebec in the parameter and in the remapping"


def redirected(node: LaunchedNode, known: str, nodes: Iterable[LaunchedNode]) -> str | None:
    """The rebec that all topics for a known rebec lead to, if it is another one of its program.

    The servers must be those of the known rebec, under the names that they are generated with.
    """
    key = graph_name(known)
    told = node.parameter(f"knownrebecs/{key}")
    remaps = [(_own_name(r), str(r.target)) for r in node.remaps]
    own = [(p.removeprefix(f"{key}/"), to) for p, to in remaps if p.startswith(f"{key}/")]
    to = {target.partition("/")[0] for _, target in own}
    started = {n.name: (n.package, n.type) for n in nodes if isinstance(n.name, str)}
    if told is None or not isinstance(told.value, str) or len(to) != 1:
        return None
    (name,) = to
    programs = {started.get(told.value), started.get(name)}
    is_alike = len(programs) == 1 and None not in programs
    is_plain = all(target in (f"{name}/{p}", f"{name}/port/{p}") for p, target in own)
    return name if name != told.value and is_alike and is_plain else None


def _own_name(remap: LaunchedRemap) -> str:
    """The name below the node that a remapping is of; empty if it is another one."""
    private = str(remap.private)
    return private.removeprefix("~").removeprefix("/") if private.startswith("~") else ""


def list_misdirected(
    node: LaunchedNode,
    known: Sequence[str],
    nodes: Iterable[LaunchedNode],
    findings: Findings,
    within: str,
) -> None:
    """Lists remappings `~left/part` to `right/part` of a node whose `knownrebecs/left` is `left`.

    `known` are the known rebecs of its class, `nodes` all that are started. A target that begins
    with the name of no node is another matter: topics may be called anything.
    """
    names = {n.name for n in nodes if isinstance(n.name, str)}
    for key in map(graph_name, known):
        told = node.parameter(f"knownrebecs/{key}")
        for remap in node.remaps:
            private, target = str(remap.private), str(remap.target)
            if told is None or not private.lstrip("~").lstrip("/").startswith(f"{key}/"):
                continue
            to = target.lstrip("/").partition("/")[0]
            if private.startswith("~") and to in names and to != told.value:
                why = f'this goes to "{to}", and the node is told that "{key}" is "{told.value}"'
                findings.unreadable(remap.source, Unread(remap.span, why, _HINT), within)


def is_reached(node: LaunchedNode, topic: str, nodes: Iterable[LaunchedNode]) -> bool:
    """Whether a remapping of any node leads to a topic below a node."""
    wanted = (f"{node.name}/{topic}", f"control_bridge/{node.name}/{topic}")
    return any(str(r.target).lstrip("/") in wanted for each in nodes for r in each.remaps)
