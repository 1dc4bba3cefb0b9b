"""Topics of generated code that go to another rebec than the one that the node is told it knows."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rebsync.names import graph_name
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.launch.launched import LaunchedNode

_HINT = "write the same rebec in the parameter and in the remapping"


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
