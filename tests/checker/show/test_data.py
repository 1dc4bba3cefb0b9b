"""JSON of results and runs: the published schema, the kinds of values, reading runs back."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any, TypeAlias

import jsonschema  # type: ignore[import-untyped]
import pytest

from rebsync.checker.exploration import Limits
from rebsync.checker.problem import Options, Problem
from rebsync.checker.result import Result
from rebsync.checker.show.data import result_json, trace_json, value_of
from rebsync.checker.show.replay import Recorded, trace_from_json
from rebsync.checker.trace import Trace
from rebsync.checker.verify import verify
from rebsync.diagnostics import RebsyncError
from rebsync.files import read_source
from rebsync.grammars.parser import parse_model
from rebsync.model import Binary, IntLiteral, Member, Name
from rebsync.properties import Measure
from rebsync.source import Source
from rebsync.static import analyse
from tests.checker.show.runs import crossing, lasso, long_run, result, violation
from tests.consoles import ROOT

SCHEMA = json.loads((ROOT / "docs" / "verify.schema.json").read_text(encoding="utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
RESULTS = {
    "satisfied": result(),
    "violated": result(violation(crossing()), violation(lasso(), "property", "Ends")),
    "undetermined": replace(
        result(), verdict="undetermined", reason="2 states of more", search_seconds=0.0
    ),
}
CONTRACT = {
    "verdict",
    "reason",
    "caveats",
    "properties",
    "violations",
    "coverage",
    "measures",
    "states",
    "transitions",
    "semantics",
    "engine",
    "seconds",
    "search_seconds",
    "build_seconds",
    "peak_memory_bytes",
    "states_per_second",
}
Data: TypeAlias = dict[str, Any]


def as_data(found: Result) -> Data:
    """The JSON of a result, parsed again."""
    data: Data = json.loads(result_json(found))
    return data


def changed(data: Data, place: str, value: object) -> Data:
    """Data with one part replaced, or taken out for `...`."""
    *way, last = [int(key) if key.isdigit() else key for key in place.split(".")]
    inner: Any = data
    for key in way:
        inner = inner[key]
    if value is ...:
        del inner[last]
    else:
        inner[last] = value
    return data


def test_measures_are_as_the_schema_says() -> None:
    source = read_source(str(ROOT / "examples" / "experiment1" / "experiment1.rebeca"))
    robot = Member(Name("robot1"), "current_segment")
    measures = Measure("segment", robot), Measure("never", Binary("/", robot, IntLiteral(0)))
    problem = Problem(source, analyse(parse_model(source).model), measures=measures)
    found = json.loads(result_json(verify(problem, Options(engine="interpreted"))))
    VALIDATOR.validate(found)
    segment, never = found["measures"]
    assert (segment["least"]["value"], segment["greatest"]["value"]) == (0, 10)
    assert segment["undefined"] is None
    assert (never["least"], never["greatest"]) == (None, None)
    assert never["undefined"]["trace"][-1]["number"] == 0


def test_the_schema_is_one() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("found", RESULTS.values(), ids=RESULTS)
def test_results_keep_to_the_schema(found: Result) -> None:
    VALIDATOR.validate(as_data(found))


@pytest.mark.parametrize(
    ("name", "verdict"),
    [
        ("experiment2_unsafe", "violated"),
        ("experiment3_unsafe", "satisfied"),
        ("warehouse", "undetermined"),
    ],
)
def test_what_verify_finds_keeps_to_the_schema(name: str, verdict: str) -> None:
    source = read_source(str(ROOT / "examples" / name / f"{name}.rebeca"))
    problem = Problem(source, analyse(parse_model(source).model))
    data = as_data(verify(problem, Options(engine="interpreted", limits=Limits(states=300))))
    VALIDATOR.validate(data)
    assert data["verdict"] == verdict


def test_runs_keep_to_the_schema() -> None:
    run = {**SCHEMA, "$ref": "#/$defs/run"}
    for key in ("required", "properties", "additionalProperties"):
        del run[key]
    jsonschema.Draft202012Validator(run).validate(json.loads(trace_json(long_run(4, 30))))


@pytest.mark.parametrize(
    ("place", "value"),
    [
        ("verdict", ...),
        ("more", 1),
        ("violations.0.more", 1),
        ("violations.0.kind", "bug"),
        ("violations.0.trace.0.time", "0"),
        ("violations.0.trace.1.message.receiver", "left"),
        ("violations.0.trace.1.sent.0.receiver", ...),
        ("violations.0.trace.1.state.0.variables.granted", []),
    ],
)
def test_the_schema_refuses_what_is_not_in_it(place: str, value: object) -> None:
    assert not VALIDATOR.is_valid(changed(as_data(RESULTS["violated"]), place, value))


def test_the_keys_of_the_contract() -> None:
    assert CONTRACT | {"depth"} == set(as_data(RESULTS["violated"]))


def test_a_step_has_all_of_it() -> None:
    step = as_data(RESULTS["violated"])["violations"][0]["trace"][1]
    taken = {"server": "begin", "arguments": {}, "sender": "left", "arrival": 0, "deadline": None}
    asked = {
        "receiver": "controller",
        "server": "request",
        "arguments": {"id": 0, "urgent": True},
        "sender": "left",
        "arrival": 0,
        "deadline": 5,
    }
    state = step.pop("state")
    assert step == {
        "number": 1,
        "kind": "take",
        "time": 0,
        "until": 0,
        "rebec": "left",
        "message": taken,
        "choices": [True],
        "sent": [asked],
        "changes": [{"rebec": "left", "variable": "moving", "before": False, "after": True}],
        "line": 31,
        "code": None,
        "failure": None,
        "action": {"actor": 1, "slot": 0, "choices": [0]},
    }
    assert state[1] == {
        "name": "left",
        "variables": {"at": 1, "speed": 0.5, "moving": True},
        "bag": [],
        "busy_until": None,
        "suspended_at": None,
    }
    assert state[0]["variables"]["granted"] is None


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("true", True),
        ("false", False),
        ("null", None),
        ("-12", -12),
        ("0.1", 0.1),
        ("1e-05", 1e-05),
        ("-2.5e+30", -2.5e30),
        ("inf", "inf"),
        ("-inf", "-inf"),
        ("nan", "nan"),
        ("infinity", "infinity"),
        ("e1", "e1"),
        ("robot1", "robot1"),
        ("²", "²"),
    ],
)
def test_values(text: str, value: object) -> None:
    made = value_of(text)
    assert made == value
    assert type(made) is type(value)


def test_a_search_of_no_time_has_no_speed() -> None:
    assert as_data(RESULTS["undetermined"])["states_per_second"] == 0


# --- reading back ------------------------------------------------------------------------------


def read(text: str, violation: str | None = None) -> Recorded:
    """What a text records."""
    return trace_from_json(Source("run.json", text), violation)


@pytest.mark.parametrize(
    "trace", [crossing(), lasso(), long_run(5, 40)], ids=["end", "loop", "long"]
)
def test_a_run_comes_back(trace: Trace) -> None:
    recorded = read(trace_json(trace))
    assert recorded.actions == tuple(step.action for step in trace.steps)
    assert recorded.model == trace.model
    assert recorded.semantics == trace.semantics
    assert recorded.loop == trace.loop


def test_a_violation_of_a_result_comes_back() -> None:
    text = result_json(RESULTS["violated"])
    assert read(text).model == "crossing.rebeca"
    assert read(text, "Ends").model == "ball.rebeca"


def broken(place: str, value: object) -> str:
    """A run with one part that is changed."""
    return json.dumps(changed(json.loads(trace_json(crossing())), place, value))


@pytest.mark.parametrize(
    ("text", "code", "message"),
    [
        ("", "RS921", "this is no JSON: Expecting value in line 1, column 1"),
        ("{", "RS921", "this is no JSON"),
        ("[" * 100_000, "RS921", "this nests deeper than rebsync reads"),
        ("9" * 20_000, "RS921", "a number in this is too long"),
        ("3", "RS922", "the text is not an object"),
        ("{}", "RS922", "semantics is missing"),
        (broken("trace", 3), "RS922", "trace is not a list"),
        (broken("trace", []), "RS923", "the run has no steps"),
        (broken("trace.2", []), "RS922", "trace[2] is not an object"),
        (broken("trace.2.action", ...), "RS922", "trace[2].action is missing"),
        (
            broken("trace.2.action.actor", "0"),
            "RS922",
            "trace[2].action.actor is not a whole number",
        ),
        (
            broken("trace.2.action.slot", True),
            "RS922",
            "trace[2].action.slot is not a whole number",
        ),
        (broken("trace.2.action.slot", -2), "RS922", "trace[2].action.slot is not a whole number"),
        (broken("trace.2.action.choices", [1.5]), "RS922", "trace[2].action.choices[0] is not"),
        (broken("semantics", "exact"), "RS922", "semantics is not one of tts, ftts, core"),
        (broken("semantics", []), "RS922", "semantics is not a text"),
        (broken("model", None), "RS922", "model is not a text"),
        (broken("loop", "1"), "RS922", "loop is not a whole number from 0 on"),
        (result_json(RESULTS["satisfied"]), "RS923", "there is no run in this"),
        ('{"violations": {}}', "RS922", "violations is not a list"),
        ('{"violations": [3]}', "RS922", "violations[0] is not an object"),
    ],
)
def test_what_is_no_run(text: str, code: str, message: str) -> None:
    with pytest.raises(RebsyncError) as caught:
        read(text)
    (findings,) = caught.value.findings
    (found,) = findings.diagnostics
    assert (findings.source.path, found.code) == ("run.json", code)
    assert found.message.startswith(message)


def test_a_violation_that_is_not_there() -> None:
    with pytest.raises(RebsyncError) as caught:
        read(result_json(RESULTS["violated"]), "End")
    (found,) = caught.value.findings[0].diagnostics
    assert (found.code, found.hint) == ("RS923", 'did you mean "Ends"?')
