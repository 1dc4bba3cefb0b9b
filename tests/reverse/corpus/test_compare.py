"""The comparison, tried on facts and answers that are made up."""

from __future__ import annotations

import pytest

from tests.reverse.corpus.compare import Comparison, answers_of, compare
from tests.reverse.corpus.values import OPEN, RIGHT, WRONG, Json, Verdict, judge, judge_null

UNKNOWN = {"unknown": "nobody calls this", "file": "a.cpp", "line": 1}


def fact(kind: str = "publisher", line: int = 3, **keys: Json) -> Json:
    usual: Json = {"file": "a.cpp", "line": line, "node_class": "Talker", "kind": kind}
    match kind:
        case "publisher":
            usual |= {"name": "chatter", "type": "std_msgs/String", "depth": 10, "latched": False}
        case "subscription":
            usual |= {"name": "chatter", "type": "std_msgs/String", "depth": 10}
            usual |= {"callback": "Talker::heard"}
        case "parameter":
            usual |= {"name": "~rate", "type": None, "access": "get", "default": 5}
        case "timer":
            usual |= {"name": None, "type": None, "period": 0.5, "one_shot": False}
            usual |= {"callback": "Talker::tick"}
        case "node":
            usual |= {"name": "talker", "type": None}
    return {**usual, **keys}


def answer(kind: str = "publisher", line: int = 3, **keys: Json) -> Json:
    """What says the same as the fact."""
    said = fact(kind, line)
    if "callback" in said:
        said["callback"] = {"function": said["callback"], "file": "a.cpp", "line": 20}
    return {**said, **keys}


def figures(found: Comparison) -> tuple[int, int, int, int]:
    """Found, and answers that are right, open and wrong."""
    return found.found, found.count(RIGHT), found.count(OPEN), found.count(WRONG)


# --- counting -----------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["publisher", "subscription", "parameter", "timer", "node"])
def test_an_answer_that_agrees(kind: str) -> None:
    found = compare([fact(kind)], [answer(kind)])
    assert figures(found) == (1, 1, 0, 0)
    assert (found.recall, found.precision, found.unresolved) == (1.0, 1.0, 0.0)
    assert all(set(counts) == {RIGHT} for counts in found.details().values())


def test_what_is_missed() -> None:
    found = compare([fact(), fact(line=4)], [answer()])
    assert (found.facts, found.reported, found.recall, found.precision) == (2, 1, 0.5, 1.0)
    assert [m["line"] for m in found.missed] == [4]


def test_no_answers_are_not_wrong() -> None:
    found = compare([fact()], [])
    assert (found.recall, found.precision, found.unresolved, found.unknown) == (0.0, 1.0, 0.0, 0.0)


def test_what_no_fact_says() -> None:
    found = compare([fact()], [answer(), answer(line=4), answer("parameter")])
    assert (found.recall, found.precision, found.count(WRONG)) == (1.0, 1 / 3, 2)
    assert [e["line"] for e in found.extra] == [3, 4] or [e["line"] for e in found.extra] == [4, 3]


@pytest.mark.parametrize(
    "wrong", [{"name": "chat"}, {"type": "std_msgs/Int32"}, {"type": None}, {"name": None}]
)
def test_what_is_wrong(wrong: Json) -> None:
    assert figures(compare([fact()], [answer(**wrong)])) == (0, 0, 0, 1)


def test_another_access_is_wrong() -> None:
    found = compare([fact("parameter")], [answer("parameter", access="set")])
    assert figures(found) == (0, 0, 0, 1)


def test_another_kind_or_place_is_no_answer() -> None:
    for other in (answer("subscription"), answer(line=4), answer(file="b.cpp")):
        found = compare([fact()], [other])
        assert (found.recall, found.precision, len(found.missed)) == (0.0, 0.0, 1)


@pytest.mark.parametrize("key", ["name", "type"])
def test_what_is_unresolved(key: str) -> None:
    found = compare([fact(), fact(line=4)], [answer() | {key: UNKNOWN}, answer(line=4)])
    assert figures(found) == (1, 1, 1, 0)
    assert (found.recall, found.precision) == (0.5, 1.0)
    assert (found.unresolved, found.unknown) == (0.5, 0.5)


def test_what_nobody_can_know() -> None:
    unknowable = fact(name=None, why="read from a file", partial="*/pose")
    found = compare([unknowable], [answer(name=UNKNOWN)])
    assert figures(found) == (1, 1, 0, 0)
    assert (found.unresolved, found.unknown) == (0.0, 1.0)
    assert found.details()["partial"] == {WRONG: 1}
    partly = compare([unknowable], [answer(name={**UNKNOWN, "partial": "*pose"})])
    assert partly.details()["partial"] == {RIGHT: 1}
    assert figures(compare([unknowable], [answer(name="turtle1/pose")])) == (0, 0, 0, 1)
    other = answer(name={**UNKNOWN, "partial": "*/color"})
    assert figures(compare([unknowable], [other])) == (0, 0, 0, 1)


def test_two_calls_on_one_line() -> None:
    facts = [fact(name="left"), fact(name="right")]
    found = compare(facts, [answer(name="right"), answer(name="left")])
    assert figures(found) == (2, 2, 0, 0)
    half = compare(facts, [answer(name="right")])
    assert [m["name"] for m in half.missed] == ["left"]


def test_nodelets_have_no_name() -> None:
    nodelet = fact("node", name=None, nodelet="Relay")
    right = answer("node", name=None, nodelet="relay_package::Relay")
    assert figures(compare([nodelet], [right])) == (1, 1, 0, 0)
    assert compare([nodelet], [right]).unknown == 0.0
    wrong = answer("node", name=None, nodelet="Other")
    assert figures(compare([nodelet], [wrong])) == (0, 0, 0, 1)


def test_callers_stand_for_a_helper() -> None:
    sites = [
        {"file": "b.cpp", "line": 1, "name": "~x"},
        {"file": "b.cpp", "line": 2, "name": "~y"},
    ]
    helper = fact("parameter", name={"one_of": ["~x", "~y"]}, default=None, sites=sites)
    at_x = answer("parameter", file="b.cpp", line=1, name="~x")
    at_y = answer("parameter", file="b.cpp", line=2, name="~y")
    assert figures(compare([helper], [at_x, at_y])) == (1, 2, 0, 0)
    assert figures(compare([helper], [at_x])) == (0, 1, 0, 0)
    assert figures(compare([helper], [at_x, {**at_y, "name": "~z"}])) == (0, 1, 0, 1)
    inside = answer("parameter", name=UNKNOWN, default=None)
    assert figures(compare([helper], [inside, at_x, at_y])) == (1, 2, 1, 0)
    both = answer("parameter", name={"one_of": ["~y", "~x"]}, default=None)
    assert figures(compare([helper], [both, at_x])) == (1, 2, 0, 0)


# --- details ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "key", "wanted", "given", "verdict"),
    [
        ("publisher", "depth", 10, 5, WRONG),
        ("publisher", "depth", 10, UNKNOWN, OPEN),
        ("publisher", "latched", True, False, WRONG),
        ("publisher", "transport", "image_transport", None, WRONG),
        ("publisher", "transport", "image_transport", "image_transport", RIGHT),
        ("publisher", "node_class", None, "Talker", WRONG),
        ("publisher", "node_class", "Talker", "ns::Talker", RIGHT),
        ("subscription", "callback", "Talker::heard", {"function": "Talker::tick"}, WRONG),
        ("subscription", "callback", "Talker::heard", {"function": None}, WRONG),
        ("subscription", "callback", "Talker::heard", UNKNOWN, OPEN),
        ("subscription", "callback", "Talker::heard", None, WRONG),
        ("subscription", "callback", None, {"function": "Talker::heard"}, WRONG),
        ("subscription", "callback", None, None, RIGHT),
        ("subscription", "single", True, False, WRONG),
        ("subscription", "single", True, True, RIGHT),
        ("timer", "period", 0.5, 0.50000000001, RIGHT),
        ("timer", "period", 0.5, 0.6, WRONG),
        ("timer", "period", None, UNKNOWN, RIGHT),
        ("timer", "period", None, 0.5, WRONG),
        ("timer", "one_shot", True, False, WRONG),
        ("timer", "autostart", False, True, WRONG),
        ("timer", "callback", "Talker::tick", {"function": "tick"}, WRONG),
        ("parameter", "default", 5, 5.0, RIGHT),
        ("parameter", "default", 5, None, WRONG),
        ("parameter", "default", 5, UNKNOWN, OPEN),
        ("parameter", "default", None, None, RIGHT),
        ("parameter", "default", None, [], RIGHT),
        ("parameter", "default", None, 5, WRONG),
        ("parameter", "default", None, UNKNOWN, OPEN),
        ("parameter", "default", True, 1, WRONG),
        ("parameter", "value", "on", "on", RIGHT),
        ("parameter", "value", "on", "off", WRONG),
        ("node", "anonymous", True, False, WRONG),
        ("node", "anonymous", True, True, RIGHT),
    ],
)
def test_a_detail(kind: str, key: str, wanted: Json, given: Json, verdict: Verdict) -> None:
    found = compare([fact(kind, **{key: wanted})], [answer(kind, **{key: given})])
    assert found.details()[key] == {verdict: 1}
    assert found.found == 1


def test_details_that_are_not_spoken_of() -> None:
    counts = compare([fact("timer")], [answer("timer")]).details()
    assert set(counts) == {"callback", "period", "one_shot", "node_class"}
    stopped = compare([fact("timer")], [answer("timer", autostart=False)])
    assert stopped.details()["autostart"] == {WRONG: 1}


def test_callbacks_that_have_two_names() -> None:
    either = fact("subscription", through="Talker::Functor")
    for name in ("Talker::heard", "Talker::Functor"):
        found = compare([either], [answer("subscription", callback={"function": name})])
        assert found.details()["callback"] == {RIGHT: 1}
    given = {"function": "Talker::other", "through": "Talker::Functor"}
    found = compare([either], [answer("subscription", callback=given)])
    assert found.details()["callback"] == {RIGHT: 1}


def test_callbacks_of_which_one_is_chosen() -> None:
    chosen = fact("subscription", callback={"one_of": ["C::a", "C::b"]})
    unsaid = ["C::a", None]
    for names, verdict in (
        (["C::b", "C::a"], RIGHT),
        (["C::a"], WRONG),
        (["C::a", "C::c"], WRONG),
        (unsaid, OPEN),
    ):
        given = {"one_of": [{"function": name} for name in names]}
        found = compare([chosen], [answer("subscription", callback=given)])
        assert found.details()["callback"] == {verdict: 1}


def test_what_a_variable_holds_before_is_a_default() -> None:
    held = fact("parameter", default=None, fallback=2.0)
    for given, verdict in ((2.0, RIGHT), (None, RIGHT), (3.0, WRONG)):
        found = compare([held], [answer("parameter", default=given)])
        assert found.details()["default"] == {verdict: 1}


def test_defaults_that_nobody_can_know() -> None:
    unknowable = fact("parameter", default=None, why="read from the device")
    for given, verdict in ((UNKNOWN, RIGHT), (None, RIGHT), (3.0, WRONG)):
        found = compare([unknowable], [answer("parameter", default=given)])
        assert found.details()["default"] == {verdict: 1}


# --- values -------------------------------------------------------------------------------------

TOPIC = {"parameter": "~topic", "in": "~", "default": "~scan"}
HANDLE = {"relative": "speed", "handle": ["", "~", "~*"]}
PERIOD = {"parameter": "~rate", "default": 0.2, "expression": "1/value"}


@pytest.mark.parametrize(
    ("wanted", "given", "verdict"),
    [
        ("a/b", "a//b/", RIGHT),
        ("~x", "~/x", RIGHT),
        ("x", "/x", WRONG),
        ("x", "~x", WRONG),
        ("x", {"relative": "x", "handle": [""]}, OPEN),
        ("x", {"one_of": ["x", "y"]}, WRONG),
        ("x", {"one_of": ["x", UNKNOWN]}, OPEN),
        ("x", {"parameter": "~x"}, WRONG),
        ("x", {"parameter": UNKNOWN}, OPEN),
        ([1, 2], [1, 2], RIGHT),
        (TOPIC, TOPIC, RIGHT),
        (TOPIC, {**TOPIC, "default": "scan"}, RIGHT),
        (TOPIC, {**TOPIC, "default": "/scan"}, WRONG),
        (TOPIC, {**TOPIC, "default": UNKNOWN}, OPEN),
        (TOPIC, {"parameter": "~topic", "in": "~"}, WRONG),
        (TOPIC, {**TOPIC, "parameter": "topic"}, WRONG),
        (TOPIC, {**TOPIC, "in": ""}, WRONG),
        (TOPIC, {**TOPIC, "in": ["~", ""]}, WRONG),
        (TOPIC, {**TOPIC, "in": "*"}, OPEN),
        (TOPIC, {**TOPIC, "search": True}, WRONG),
        (TOPIC, {**TOPIC, "expression": "value + '/x'"}, WRONG),
        (TOPIC, UNKNOWN, OPEN),
        (TOPIC, "scan", WRONG),
        ({"parameter": "~t"}, {"parameter": "~t", "default": ""}, RIGHT),
        ({"parameter": "~t"}, {"parameter": "~t", "default": "x"}, WRONG),
        ({"parameter": "~t"}, {"parameter": "~t", "default": UNKNOWN}, OPEN),
        (PERIOD, {**PERIOD, "default": 5.0, "expression": "1.0 / value"}, RIGHT),
        (PERIOD, {**PERIOD, "expression": "1.f/value"}, RIGHT),
        (PERIOD, {**PERIOD, "default": 4.0}, WRONG),
        (PERIOD, {**PERIOD, "expression": "2 / value"}, WRONG),
        (PERIOD, {"parameter": "~rate", "default": 0.2}, WRONG),
        ({"one_of": ["x", "y"]}, {"one_of": ["y", "x"]}, RIGHT),
        ({"one_of": ["x", "y"]}, {"one_of": ["x"]}, WRONG),
        ({"one_of": ["x", "y", "z"]}, {"one_of": ["x"]}, WRONG),
        ({"one_of": ["x", "y"]}, {"one_of": ["x", "y", "z"]}, WRONG),
        ({"one_of": ["x", "y"]}, {"one_of": ["x", UNKNOWN]}, OPEN),
        (
            {"one_of": [{"parameter": "~x"}, {"parameter": "~y"}]},
            {"parameter": {"one_of": ["~x", "~y"]}},
            RIGHT,
        ),
        (HANDLE, {"relative": "speed", "handle": []}, RIGHT),
        (HANDLE, {"relative": "pace", "handle": []}, WRONG),
        (HANDLE, "speed", RIGHT),
        (HANDLE, "~speed", RIGHT),
        (HANDLE, "/speed", WRONG),
        (HANDLE, {"one_of": ["speed", "~speed"]}, RIGHT),
        (HANDLE, {**UNKNOWN, "partial": "*/speed"}, RIGHT),
        (HANDLE, {**UNKNOWN, "partial": "*/pace"}, WRONG),
        (HANDLE, UNKNOWN, OPEN),
        (HANDLE, {"parameter": "~speed"}, WRONG),
    ],
)
def test_a_value(wanted: Json, given: Json, verdict: Verdict) -> None:
    assert judge(wanted, given) is verdict


def test_an_unknown_value() -> None:
    assert judge_null(UNKNOWN) is RIGHT
    assert judge_null({"one_of": ["x", UNKNOWN]}) is RIGHT
    assert judge_null({"relative": "pose", "handle": []}, "*/pose") is RIGHT
    assert judge_null({"relative": "color", "handle": []}, "*/pose") is WRONG
    assert judge_null("x") is WRONG
    assert judge_null(None) is WRONG


def test_items_are_named_as_facts_name_things() -> None:
    item = {"file": "a.cpp", "line": 3, "within": "Talker", "topic": "x"}
    lists = ("nodes", "subscriptions", "timers", "rates", "parameters", "services", "clients")
    (named,) = answers_of({"publishers": [item], **{key: [] for key in lists}})
    assert named["kind"] == "publisher"
    assert (named["name"], named["node_class"]) == ("x", "Talker")
