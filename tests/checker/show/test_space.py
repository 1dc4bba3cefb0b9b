"""State spaces as DOT, JSON, SVG and RMC's XML."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import replace
from functools import cache
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import pytest

from rebsync.checker.exploration import Limits
from rebsync.checker.lowering import lower
from rebsync.checker.program import Program
from rebsync.checker.search import Interpreted
from rebsync.checker.show.rmc_xml import rmc_xml
from rebsync.checker.show.space import StateSpace, levels, space_dot, space_json
from rebsync.checker.show.space_layout import drawing_of
from rebsync.checker.show.space_svg import space_svg
from rebsync.checker.spaces import space_of
from rebsync.checker.steps import Semantics
from rebsync.checker.telling import Teller
from rebsync.diagnostics import RebsyncError
from rebsync.files import read_source
from rebsync.grammars.parser import parse_model
from rebsync.properties import Properties
from rebsync.source import Source
from rebsync.static import analyse
from tests.checker.show.test_chart import SVG, Box
from tests.consoles import ROOT

GAME = """\
reactiveclass A(4) {
  knownrebecs { B b; }
  statevars { int n; boolean f; }
  A() { self.go(); }
  msgsrv go() {
    n = (n + ?(1, 2)) % 4;
    if (n == 3) { b.ball(n); } else { self.go() after(2) deadline(9); }
    if (n == 2) { assertion(f, "never < two"); }
    f = true;
  }
}
reactiveclass B(2) {
  knownrebecs { A a; }
  statevars { int[2] seen; }
  msgsrv ball(int k) { seen[0] = (seen[0] + k) % 3; a.go() after(1); }
}
main { A a(b):(); B b(a):(); }
"""
ROBOTS = ROOT / "examples" / "running_example" / "running_example.rebeca"


def explored(
    source: Source, semantics: Semantics, most: int | None = None
) -> tuple[Program, StateSpace]:
    """The state space of a model, or its first states."""
    program, _ = lower(analyse(parse_model(source).model), Properties())
    search = Interpreted(program, semantics)
    search.run(Limits(states=most))
    return program, space_of(search, Teller(search.view, source), {})


@cache
def game(semantics: Semantics = "ftts") -> tuple[Program, StateSpace]:
    """A model with a choice, a failure, cycles, and a message after some time."""
    return explored(Source("game.rebeca", GAME), semantics)


@cache
def robots() -> StateSpace:
    """Forty states and more of a model with many ways."""
    return explored(read_source(str(ROBOTS)), "tts", 40)[1]


def test_the_space_of_a_model() -> None:
    _, space = game()
    assert (len(space.states), space.initial) == (6, (0,))
    told = [(e.source, e.target, e.label, e.time, e.failure) for e in [*space.edges][:3]]
    failure = 'an assertion fails in A.go: "never < two"'
    assert told == [
        (0, 1, "a.go() ?(1)", 2, None),
        (0, None, "a.go() ?(2)", 0, failure),
        (1, 2, "a.go() ?(1)", 2, None),
    ]


def test_levels_are_distances() -> None:
    depth, before = levels(game()[1])
    assert depth == [0, 1, 2, 2, 3, 3]
    assert before == [None, 0, 1, 1, 2, 3]


def test_a_deadlock_is_marked() -> None:
    text = "reactiveclass A(2) { A() { self.m(); } msgsrv m() {} } main { A a():(); }"
    _, space = explored(Source("a.rebeca", text), "tts")
    assert space.marks == ((1, "deadlock"),)


# --- SVG ---------------------------------------------------------------------------------------

SPACES = {"game": game()[1], "exact": game("tts")[1], "robots": robots()}
every_space = pytest.mark.parametrize("space", SPACES.values(), ids=SPACES)


@every_space
def test_states_and_labels_do_not_cover_each_other(space: StateSpace) -> None:
    drawing = drawing_of(space)
    nodes = [
        Box(n.x - n.width / 2, n.top, n.x + n.width / 2, n.bottom, n.lines[0])
        for n in drawing.nodes
    ]
    labels = [
        Box(line.at[0], line.at[1] - 9, line.at[0] + len(line.label) * 6.75, line.at[1] + 2)
        for line in drawing.lines
    ]
    for one, other in combinations([*nodes, *labels], 2):
        assert not one.meets(other), (one, other)


@every_space
def test_lines_do_not_run_through_states(space: StateSpace) -> None:
    drawing = drawing_of(space)
    for line in drawing.lines:
        for (x1, y1), (x2, y2) in zip(line.points, line.points[1:], strict=False):
            if x1 != x2 and y1 != y2:
                continue
            part = Box(min(x1, x2), min(y1, y2), max(x1, x2), max(y1, y2))
            for n in drawing.nodes:
                inner = Box(n.x - n.width / 2 + 1, n.top + 1, n.x + n.width / 2 - 1, n.bottom - 1)
                assert not part.meets(inner)


@every_space
def test_every_state_and_edge_is_drawn(space: StateSpace) -> None:
    svg = ElementTree.fromstring(space_svg(space))
    states = [g for g in svg.iter(f"{SVG}g") if (g.get("class") or "").startswith("state")]
    failures = {(e.source, e.failure) for e in space.edges if e.target is None}
    assert len(states) == len(space.states) + len(failures)
    drawn = [p for p in svg.iter(f"{SVG}path") if (p.get("class") or "").startswith("way")]
    different = {(e.source, e.target, e.label, e.time, e.failure) for e in space.edges}
    assert len(drawn) == len(different) + len(space.initial)
    assert space_svg(space) == space_svg(space)


def test_texts_stay_inside_the_drawing() -> None:
    svg = ElementTree.fromstring(space_svg(game()[1]))
    left, _, width, height = map(float, svg.get("viewBox", "").split())
    for text in svg.iter(f"{SVG}text"):
        x, y = float(text.get("x", "")), float(text.get("y", ""))
        assert left <= x <= x + len(text.text or "") * 6.75 <= left + width
        assert 0 <= y <= height


def test_equal_steps_are_one_line() -> None:
    space = game()[1]
    edges = tuple(space.edges)
    twice = replace(space, edges=(*edges, edges[0]))
    assert "a.go() ?(1) +2 (x2)" in space_svg(twice)


def test_too_many_states_are_refused() -> None:
    space = game()[1]
    with pytest.raises(RebsyncError) as caught:
        space_svg(replace(space, states=[*space.states] * 100))
    (found,) = caught.value.findings[0].diagnostics
    assert (found.code, found.message) == (
        "RS925",
        "600 states are too many to draw: at most 500 are",
    )


# --- DOT and JSON ------------------------------------------------------------------------------


def test_dot() -> None:
    dot = space_dot(game()[1])
    assert '  s0 [label="0\\la: n = 0, f = false\\l  go() from a at 0\\lb: seen[0] = 0, ' in dot
    assert '  s0 -> s1 [label="a.go() ?(1) +2"];' in dot
    assert (
        '[shape=octagon, color=red, label="an assertion fails in A.go: \\"never < two\\""];' in dot
    )
    assert dot.count("->") == len([*game()[1].edges]) + 1


def test_graphviz_reads_it(tmp_path: Path) -> None:
    dot = shutil.which("dot")
    if dot is None:
        pytest.skip("Graphviz is not installed")
    hard = replace(robots(), model='a "b" \\ <c>\n')
    done = subprocess.run(
        [dot, "-Tplain"], input=space_dot(hard), capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert len(re.findall(r"^node ", done.stdout, re.MULTILINE)) == len(hard.states) + 1


def test_json() -> None:
    data = json.loads(space_json(game()[1]))
    assert data["initial"] == [0]
    assert data["states"][1]["rebecs"][0] == {
        "name": "a",
        "variables": {"n": 1, "f": True},
        "bag": [{"server": "go", "arguments": {}, "sender": "a", "arrival": 0, "deadline": 7}],
        "busy_until": None,
        "suspended_at": None,
    }
    assert data["edges"][0] == {
        "source": 0,
        "target": 1,
        "label": "a.go() ?(1)",
        "time": 2,
        "failure": None,
    }


# --- RMC ---------------------------------------------------------------------------------------


def test_rmc_xml() -> None:
    program, space = game()
    root = ElementTree.fromstring(rmc_xml(space, program))
    assert root.tag == "transitionsystem"
    state = root.findall("state")[1]
    assert state.attrib == {"id": "2_0", "atomicpropositions": ""}
    (first, second) = state.findall("rebec")
    assert [(v.get("name"), v.get("type"), v.text) for v in first.iter("variable")] == [
        ("A.n", "int", "1"),
        ("A.f", "boolean", "true"),
    ]
    assert [v.get("name") for v in second.iter("variable")] == ["B.seen[0]", "B.seen[1]"]
    (message,) = first.iter("message")
    assert (message.attrib, message.text) == (
        {"arrival": "2", "deadline": "9", "sender": "a"},
        "go()",
    )


def test_rmc_edges_say_when_they_lead_back() -> None:
    program, space = game()
    edges = ElementTree.fromstring(rmc_xml(space, program)).findall("transition")
    assert len(edges) == sum(edge.target is not None for edge in space.edges)
    times = [int(e.get("shift", "")) for e in edges]
    assert min(times) == 0 < max(times)
    assert edges[0].attrib == {
        "source": "1_0",
        "destination": "2_0",
        "executionTime": "0",
        "shift": "0",
    }
    assert edges[0][0].attrib == {"sender": "a", "owner": "a", "title": "GO"}


def test_rmc_tells_steps_of_time_and_suspended_rebecs() -> None:
    text = "reactiveclass A(2) { A() { self.m(); } msgsrv m() { delay(3); } } main { A a():(); }"
    program, space = explored(Source("a.rebeca", text), "tts")
    root = ElementTree.fromstring(rmc_xml(space, program))
    assert [e[0].attrib for e in root.findall("transition")] == [
        {"sender": "a", "owner": "a", "title": "M"},
        {"value": "3"},
        {"sender": "a", "owner": "a", "title": "tau=>M"},
    ]
    assert [r.text for r in root.iter("res")] == [None, "3", "3", None]
    assert [r.text for r in root.iter("now")] == ["0", "3", "3", "3"]


def test_rmc_propositions() -> None:
    program, space = game()
    named = replace(space, holds=tuple(("p", "q<") for _ in space.states))
    root = ElementTree.fromstring(rmc_xml(named, program))
    assert root[0].get("atomicpropositions") == "p,q<,"
