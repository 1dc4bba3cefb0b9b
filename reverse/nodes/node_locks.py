"""Mutexes by which a node may wait for itself for ever: the model has none."""

from __future__ import annotations

from rebsync.reverse.bodies.cpp_locks import odd_locks
from rebsync.reverse.findings import Unread
from rebsync.reverse.nodes.node_bodies import Bodies


def note_locks(bodies: Bodies) -> None:
    """Lists the locks of a node that may be held already, or for longer than a block."""
    unit = bodies.unit
    for cpp, node, why in odd_locks(bodies.code, unit.lineage, unit.functions):
        bodies.findings.unreadable(cpp.source, Unread(cpp.span(node), why), unit.name)
