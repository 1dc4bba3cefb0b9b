"""Mutexes by which a node may wait for itself for ever: the model has none."""

from __future__ import annotations

from rebsync.reverse.bodies.runtime_part import runtime_part
from rebsync.reverse.findings import Unread
from rebsync.reverse.nodes.node_bodies import Bodies


def note_locks(bodies: Bodies, generated: bool) -> None:
    """Lists locks of a node, and of what helps it, that may be held already, or for too long.

    Those of the run-time part of `generated` classes are known: `check` compares its text.
    """
    unit, form = bodies.unit, bodies.common.form(bodies.code)
    runtime = runtime_part(bodies.code, generated)
    helping = [f for f in form.run_by(unit.functions) if f.cpp not in runtime]
    for cpp, place, why in form.odd_locks((*unit.functions, *helping)):
        bodies.findings.unreadable(cpp.source, Unread(place, why), unit.name)
