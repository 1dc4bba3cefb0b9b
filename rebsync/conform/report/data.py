"""The answer for other programs: one JSON object, described by docs/conform.schema.json."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

from rebsync.checker.show.data import dump, value_of
from rebsync.conform.conformance import (
    Allowed,
    Conformance,
    Deviation,
    Lateness,
)
from rebsync.conform.matching import Subject
from rebsync.conform.properties import Evaluated
from rebsync.conform.recording import Served

Json: TypeAlias = dict[str, Any]


def conformance_json(
    found: Conformance, subject: Subject, paths: Sequence[str], times: Json | None = None
) -> str:
    """The answer of `rebsync conform`; `times` is what the run took, where it was measured."""
    late = found.lateness
    return dump(
        {
            "version": 1,
            "model": subject.source.path,
            "recordings": list(paths),
            "verdict": found.verdict,
            "reason": found.reason or None,
            "compared": found.compared,
            "recorded": found.recorded,
            "start": found.start,
            "end": found.end,
            "possible_states": found.widest,
            "deviation": found.deviation and _deviation(found.deviation, subject, paths),
            "last": [_served(served, subject) for served in found.last],
            "lateness": {
                "basis": late.basis,
                "zero": late.zero,
                "greatest": _greatest(late),
            },
            "properties": [_property(evaluated) for evaluated in found.properties],
            "notes": list(found.notes),
            "times": times,
        }
    )


def _greatest(late: Lateness) -> Json | None:
    if late.greatest is None:
        return None
    time, rebec, seconds = late.greatest
    return {"time": time, "rebec": rebec, "seconds": seconds}


def _deviation(deviation: Deviation, subject: Subject, paths: Sequence[str]) -> Json:
    place = deviation.place
    return {
        "kind": deviation.kind,
        "rebec": deviation.rebec or None,
        "time": deviation.time,
        "message": deviation.message,
        "line": deviation.line or None,
        "code": deviation.code and {"path": deviation.code.path, "line": deviation.code.line},
        "recording": paths[place.file] if place is not None else None,
        "number": place.number if place is not None else None,
        "served": deviation.served and _served(deviation.served, subject),
        "allowed": [_allowed(allowed) for allowed in deviation.allowed],
        "differences": [
            {
                "variable": d.variable,
                "recorded": value_of(d.recorded),
                "allowed": [value_of(text) for text in d.allowed],
            }
            for d in deviation.differences
        ],
        "explanation": list(deviation.explanation),
    }


def _served(served: Served, subject: Subject) -> Json:
    observable = subject.observable
    return {
        "rebec": observable.nodes[served.rebec],
        "server": served.server,
        "arguments": served.arguments,
        "arrival": served.arrival,
        "start": served.start,
        "now": served.now,
        "stamp": served.stamp,
        "state": {
            name: value_of(text)
            for name, text in observable.shown(served.rebec, served.cells).items()
        },
    }


def _allowed(allowed: Allowed) -> Json:
    return {
        "rebec": allowed.rebec,
        "server": allowed.server,
        "arguments": allowed.arguments,
        "arrival": allowed.arrival,
        "start": allowed.start,
        "state": {name: value_of(text) for name, text in allowed.state},
        "line": allowed.line or None,
    }


def _property(evaluated: Evaluated) -> Json:
    return {
        "name": evaluated.name,
        "kind": evaluated.kind,
        "verdict": evaluated.verdict,
        "time": evaluated.time,
        "margin": evaluated.margin,
        "holds_so_far": evaluated.is_fulfilled if evaluated.verdict == "open" else None,
        "reason": evaluated.reason or None,
    }
