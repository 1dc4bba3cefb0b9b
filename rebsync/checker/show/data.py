"""Results and runs for other programs: one JSON object, described by docs/verify.schema.json."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from typing import Any, TypeAlias

from rebsync.checker.movement.ways import Moving, nowhere
from rebsync.checker.result import Coverage, Extreme, MeasureRange, Result, Violation
from rebsync.checker.show import words
from rebsync.checker.show.movement_data import movement_json
from rebsync.checker.trace import ShownMessage, ShownRebec, Trace, TraceStep
from rebsync.terminal import json_text

Json: TypeAlias = dict[str, Any]
Value: TypeAlias = bool | int | float | str | None

_WHOLE = re.compile(r"-?[0-9]+")
_REAL = re.compile(r"-?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?")
_WORDS: dict[str, Value] = {"true": True, "false": False, "null": None}


def result_json(result: Result, moving: Moving = nowhere) -> str:
    """The answer of `rebsync verify`; `moving` gives the movement of robots in its runs."""
    return dump(
        {
            "verdict": result.verdict,
            "reason": result.reason,
            "caveats": list(result.caveats),
            "properties": dict(result.properties),
            "violations": [_violation(violation, moving) for violation in result.violations],
            "coverage": _coverage(result.coverage),
            "measures": [_measure(measure, moving) for measure in result.measures],
            "states": result.states,
            "transitions": result.transitions,
            "depth": result.depth,
            "semantics": result.semantics,
            "engine": result.engine,
            "seconds": result.seconds,
            "search_seconds": result.search_seconds,
            "build_seconds": result.build_seconds,
            "peak_memory_bytes": result.peak_memory_bytes,
            "states_per_second": words.rate(result.states, result.search_seconds),
        }
    )


def trace_json(trace: Trace, moving: Moving = nowhere) -> str:
    """A run by itself, as `--replay` takes it."""
    return dump(_trace(trace, moving))


def dump(value: Json) -> str:
    """The text of an object; every program that reads JSON reads it."""
    return json_text(value, indent=2) + "\n"


def value_of(text: str) -> Value:
    """A shown value as JSON has it; what JSON cannot hold (`inf`, `nan`, a rebec) stays a text."""
    if text in _WORDS:
        return _WORDS[text]
    if _WHOLE.fullmatch(text):
        return int(text)
    if _REAL.fullmatch(text) and math.isfinite(number := float(text)):
        return number
    return text


def rebec_json(rebec: ShownRebec) -> Json:
    """A rebec in a state."""
    return {
        "name": rebec.name,
        "variables": _values(rebec.variables),
        "bag": [_message(message) for message in rebec.bag],
        "busy_until": rebec.busy_until,
        "suspended_at": rebec.suspended_at,
    }


def _violation(violation: Violation, moving: Moving) -> Json:
    return {
        "kind": violation.kind,
        "name": violation.name,
        "message": violation.message,
        "path": violation.path,
        "line": violation.line,
        "formula": violation.formula or None,
        "true": [list(names) for names in violation.true],
        **_trace(violation.trace, moving),
    }


def _measure(measure: MeasureRange, moving: Moving) -> Json:
    def extreme(found: Extreme | None) -> Json | None:
        if found is None:
            return None
        value = words.NEVER if found.value is None else found.value
        return {"value": value, **_trace(found.trace, moving)}

    return {
        "expression": measure.expression,
        "least": extreme(measure.least),
        "greatest": extreme(measure.greatest),
        "undefined": measure.undefined and _trace(measure.undefined, moving),
    }


def _trace(trace: Trace, moving: Moving) -> Json:
    return {
        "model": trace.model,
        "semantics": trace.semantics,
        "loop": trace.loop,
        "trace": [_step(step) for step in trace.steps],
        "movement": movement_json(moving(trace)),
    }


def _step(step: TraceStep) -> Json:
    action = step.action
    return {
        "number": step.number,
        "kind": step.kind,
        "time": step.time,
        "until": step.until,
        "rebec": step.rebec or None,
        "message": step.message and _message(step.message),
        "choices": [value_of(choice) for choice in step.choices],
        "sent": [{"receiver": m.receiver, **_message(m)} for m in step.sent],
        "changes": [
            {
                "rebec": change.rebec,
                "variable": change.variable,
                "before": value_of(change.before),
                "after": value_of(change.after),
            }
            for change in step.changes
        ],
        "line": step.line,
        "code": step.code or None,
        "failure": step.failure,
        "action": {"actor": action.actor, "slot": action.slot, "choices": list(action.choices)},
        "state": [rebec_json(rebec) for rebec in step.rebecs],
    }


def _message(message: ShownMessage) -> Json:
    return {
        "server": message.server,
        "arguments": _values(message.arguments),
        "sender": message.sender,
        "arrival": message.arrival,
        "deadline": message.deadline,
    }


def _values(named: Iterable[tuple[str, str]]) -> Json:
    return {name: value_of(text) for name, text in named}


def _coverage(coverage: Coverage) -> Json:
    return {
        "servers": list(coverage.servers),
        "lines": list(coverage.lines),
        "branches": [{"line": line, "what": what} for line, what in coverage.branches],
        "largest_bags": [
            {"rebec": rebec, "most": most, "capacity": capacity}
            for rebec, most, capacity in coverage.largest_bags
        ],
    }
