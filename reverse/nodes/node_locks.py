"""Mutexes by which a node may wait for itself for ever: the model has none."""

from __future__ import annotations

from rebsync.reverse.findings import Unread
from rebsync.reverse.nodes.node_bodies import Bodies


def note_locks(bodies: Bodies) -> None:
    """Lists locks of a node, and of what helps it, that may be held already, or for too long."""
    unit, form = bodies.unit, bodies.common.form(bodies.code)
    for cpp, place, why in form.odd_locks((*unit.functions, *form.run_by(unit.functions))):
        bodies.findings.unreadable(cpp.source, Unread(place, why), unit.name)
