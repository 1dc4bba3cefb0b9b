"""Nodes with a life cycle: what they do when somebody changes their state."""

from __future__ import annotations

from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import PublisherFact
from rebsync.reverse.libraries.cpp import managed
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.syntax.cpp_index import CppFunction

_TRANSITIONS = frozenset(
    {"on_configure", "on_activate", "on_deactivate", "on_cleanup", "on_shutdown", "on_error"}
)
_RUNS = "this runs when somebody changes the state of the node's life cycle: the model has none"
_SENDS = "this sends only while the life cycle of the node is active: the model always does"
_HINT = (
    "publishers and subscriptions that it makes are there from the start;"
    " add message servers to the model for what else it does"
)


def has_life_cycle(unit: Unit) -> bool:
    """Whether a unit is a node whose state others change."""
    return any(b in managed() for c in unit.lineage for b in (*c.roots, *c.bases))


def is_transition(unit: Unit, function: CppFunction) -> bool:
    """Whether a function runs when the state changes."""
    return function.name in _TRANSITIONS and has_life_cycle(unit)


def note_life_cycle(unit: Unit, findings: Findings) -> None:
    """Lists what a change of state runs or decides."""
    if not has_life_cycle(unit):
        return
    for function in unit.functions:
        if is_transition(unit, function):
            name = function.node.child_by_field_name("declarator")
            span = function.cpp.span(name if name is not None else function.node)
            within = f"{unit.name}.{function.name}"
            findings.unreadable(function.cpp.source, Unread(span, _RUNS, _HINT), within)
    for fact in unit.facts:
        if isinstance(fact, PublisherFact):
            place = fact.site.place
            findings.unreadable(place.source, Unread(place.span, _SENDS), unit.name)
