"""Mutexes by which a node may wait for itself for ever: the model has none."""

from __future__ import annotations

from rebsync.reverse.findings import Unread
from rebsync.reverse.nodes.node_bodies import Bodies


def note_locks(bodies: Bodies) -> None:
    """Lists the locks of a node that may be held already, or for longer than a block."""
    unit = bodies.unit
    for cpp, place, why in bodies.common.form(bodies.code).odd_locks(unit.functions):
        bodies.findings.unreadable(cpp.source, Unread(place, why), unit.name)
