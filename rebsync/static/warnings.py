"""Runs the warnings about a model that is accepted."""

from __future__ import annotations

from rebsync.model import Model
from rebsync.static.facts import Facts
from rebsync.static.flow import check_flow
from rebsync.static.robotic import check_robotic
from rebsync.static.unset import check_unset
from rebsync.static.usage import check_usage


def check_warnings(facts: Facts, model: Model) -> None:
    """All warnings that need the whole model; after some mistakes most would be noise."""
    check_flow(facts)
    if facts.knows_uses:
        check_usage(facts, model.main)
        check_unset(facts)
        # With an annotation out of place, what is a robot or a sensor is open.
        if not any(d.code == "RS427" for d in facts.diagnostics):
            check_robotic(facts, model.main)
