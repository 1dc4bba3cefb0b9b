"""The package value as JSON: every form of value, every kind of fact, the published schema."""

from __future__ import annotations

import json
from typing import Any

import jsonschema  # type: ignore[import-untyped]
import pytest

from rebsync.reverse.graph import (
    Callback,
    ClientFact,
    Fact,
    FromParameter,
    Graph,
    NodeFact,
    OneOf,
    ParameterFact,
    Place,
    PublisherFact,
    RateFact,
    Resolved,
    ServiceFact,
    Site,
    SubscriptionFact,
    TimerFact,
    Under,
    Unmodelled,
    UnmodelledFact,
    Unresolved,
)
from rebsync.reverse.graph_json import fact_data, graph_data, value_data
from rebsync.reverse.libraries.routines import Access
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.source import Source, Span
from tests.consoles import ROOT

SCHEMA = json.loads((ROOT / "docs" / "extract.schema.json").read_text(encoding="utf-8"))
SOURCE = Source("src/talker.cpp", "\n\nvoid f();\nvoid g();\n")
HERE, BELOW = Place(SOURCE, Span(2, 4)), Place(SOURCE, Span(12, 14))
CPP = parse(SOURCE)
SITE = Site("Talker", None, CPP, CPP.root, HERE, "pub_")
UNKNOWN = Unresolved("nobody calls this", BELOW, "*/pose")
AT_SITE = {"file": "src/talker.cpp", "line": 3, "within": "Talker", "kept": "pub_"}
UNKNOWN_DATA = {
    "unknown": "nobody calls this",
    "partial": "*/pose",
    "file": "src/talker.cpp",
    "line": 4,
}
CALLBACK = Callback("Talker::heard", BELOW)
CALLED = {"function": "Talker::heard", "file": "src/talker.cpp", "line": 4}

# What has no place in a model: the fact, its list, and what the list says.
BESIDES: list[tuple[UnmodelledFact, str, dict[str, Any]]] = [
    (
        UnmodelledFact(SITE, Unmodelled.ACTION_SERVER, "go", "demo/Go"),
        "action_servers",
        {"name": "go", "type": "demo/Go"},
    ),
    (
        UnmodelledFact(SITE, Unmodelled.ACTION_CLIENT, UNKNOWN, "demo/Go"),
        "action_clients",
        {"name": UNKNOWN_DATA, "type": "demo/Go"},
    ),
    (
        UnmodelledFact(SITE, Unmodelled.STATIC_BROADCASTER),
        "transforms",
        {"role": "static broadcaster"},
    ),
    (
        UnmodelledFact(SITE, Unmodelled.CONFIGURED, None, "demo::DemoConfig"),
        "reconfigurations",
        {"role": "server", "name": None, "config": "demo::DemoConfig"},
    ),
    (
        UnmodelledFact(SITE, Unmodelled.CONFIGURING, "other"),
        "reconfigurations",
        {"role": "client", "name": "other", "config": None},
    ),
]
FACTS: list[tuple[Fact, dict[str, Any]]] = [
    (NodeFact(SITE, "talker"), {"name": "talker", "anonymous": False, "nodelet": None}),
    (
        NodeFact(SITE, None, nodelet="a::Relay"),
        {"name": None, "anonymous": False, "nodelet": "a::Relay"},
    ),
    (
        PublisherFact(SITE, "chatter", "std_msgs/String", 10, transport="image_transport"),
        {
            "topic": "chatter",
            "type": "std_msgs/String",
            "depth": 10,
            "latched": False,
            "transport": "image_transport",
        },
    ),
    (
        SubscriptionFact(SITE, UNKNOWN, "std_msgs/String", 5, (CALLBACK,)),
        {
            "topic": UNKNOWN_DATA,
            "type": "std_msgs/String",
            "depth": 5,
            "callback": CALLED,
            "single": False,
        },
    ),
    (
        SubscriptionFact(SITE, "map", "nav_msgs/OccupancyGrid", 1, (), single=True),
        {
            "topic": "map",
            "type": "nav_msgs/OccupancyGrid",
            "depth": 1,
            "callback": None,
            "single": True,
        },
    ),
    (
        TimerFact(SITE, 0.5, False, (Callback("", HERE, through="Talker::Functor"), UNKNOWN)),
        {
            "period": 0.5,
            "one_shot": False,
            "callback": {
                "one_of": [
                    {
                        "function": None,
                        "file": "src/talker.cpp",
                        "line": 3,
                        "through": "Talker::Functor",
                    },
                    UNKNOWN_DATA,
                ]
            },
            "autostart": True,
            "wall": False,
        },
    ),
    (RateFact(SITE, 10, wall=True), {"hz": 10, "wall": True}),
    (ParameterFact(SITE, "~x", Access.HAS), {"name": "~x", "access": "has", "default": None}),
    (
        ParameterFact(SITE, "~x", Access.SET, value=(1, 2)),
        {"name": "~x", "access": "set", "default": None, "value": [1, 2]},
    ),
    (
        ParameterFact(SITE, "x", Access.GET, default=OneOf((1, 2)), search=True),
        {"name": "x", "access": "get", "default": {"one_of": [1, 2]}, "search": True},
    ),
    (
        ServiceFact(SITE, "add", "a/Add", (CALLBACK,)),
        {"name": "add", "type": "a/Add", "callback": CALLED},
    ),
    (ClientFact(SITE, "add", "a/Add"), {"name": "add", "type": "a/Add"}),
]


@pytest.mark.parametrize(("fact", "data"), FACTS)
def test_a_fact(fact: Fact, data: dict[str, Any]) -> None:
    assert fact_data(fact) == AT_SITE | data


@pytest.mark.parametrize(
    ("value", "data"),
    [
        (True, True),
        (2, 2),
        (float("inf"), "inf"),
        ("~x", "~x"),
        ((1.5, ("a",)), [1.5, ["a"]]),
        (FromParameter("~x"), {"parameter": "~x"}),
        (
            FromParameter("x", "y", "value + '/z'", True, ("~",)),
            {
                "parameter": "x",
                "default": "y",
                "in": "~",
                "expression": "value + '/z'",
                "search": True,
            },
        ),
        (FromParameter("x", within=("", "~")), {"parameter": "x", "in": ["", "~"]}),
        (
            FromParameter(OneOf(("x", "y")), FromParameter("z")),
            {"parameter": {"one_of": ["x", "y"]}, "default": {"parameter": "z"}},
        ),
        (OneOf(("x", UNKNOWN)), {"one_of": ["x", UNKNOWN_DATA]}),
        (Under("x", ("~", "")), {"relative": "x", "handle": ["~", ""]}),
        (UNKNOWN, UNKNOWN_DATA),
        (Unresolved("why", HERE), {"unknown": "why", "file": "src/talker.cpp", "line": 3}),
    ],
)
def test_a_value(value: Resolved, data: object) -> None:
    assert value_data(value) == data


def test_all_facts_are_as_the_schema_says() -> None:
    besides = tuple(fact for fact, _, _ in BESIDES)
    lists = graph_data(Graph(tuple(fact for fact, _ in FACTS), besides))
    assert sum(map(len, lists.values())) == len(FACTS) + len(BESIDES) + len(lists["unknowns"])
    report = {"grade": "exact", "bodies": [], "findings": []}
    whole: dict[str, object] = {"package": "a", "path": ".", "file": None, "model": None}
    whole |= {"texts": [], "report": report}
    validator = jsonschema.Draft202012Validator(SCHEMA)
    validator.check_schema(SCHEMA)
    validator.validate(whole | lists)
    listed = ("action_servers", "transforms", "reconfigurations")
    for name in ("publishers", "timers", "unknowns", *listed):
        broken = [*lists[name], {**lists[name][0], "oddity": 1}]
        assert not validator.is_valid(whole | lists | {name: broken})


@pytest.mark.parametrize(("fact", "name", "data"), BESIDES, ids=lambda x: str(x)[:40])
def test_what_has_no_place_in_a_model(
    fact: UnmodelledFact, name: str, data: dict[str, Any]
) -> None:
    lists = graph_data(Graph(unmodelled=(fact,)))
    assert lists[name] == [{**AT_SITE, **data}]


def test_unknowns_say_of_what_they_are() -> None:
    nested = ParameterFact(SITE, "~x", Access.GET, default=OneOf((1, UNKNOWN)))
    unknowns = graph_data(Graph((FACTS[3][0], nested)))["unknowns"]
    call = {"file": "src/talker.cpp", "line": 3}
    assert unknowns == [
        {"of": "subscriptions", "key": "topic", "call": call, **UNKNOWN_DATA},
        {"of": "parameters", "key": "default", "call": call, **UNKNOWN_DATA},
    ]
