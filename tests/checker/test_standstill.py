"""Time that stands still, found in graphs: the interpreter's way and the compiled one agree."""

from __future__ import annotations

from array import array
from functools import cache
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.graph import Graph
from rebsync.checker.lowering import lower
from rebsync.checker.standstill import ENDLESS, LEAVES, cycle_from, marks_of, may_stand_still
from rebsync.cli.problem import read_problem
from tests.cli.run import ROOT

Edges = list[list[tuple[int, int]]]  # for each state: target (-1: a failure), time


def graph_of(edges: Edges) -> Graph:
    first, target, time = array("Q", [0]), array("q"), array("q")
    for each in edges:
        for to, passed in each:
            target.append(to)
            time.append(passed)
        first.append(len(target))
    return Graph(first, target, array("i", [0] * len(target)), time, array("Q"), 1, (0,))


@st.composite
def graphs(draw: st.DrawFn) -> Edges:
    count = draw(st.integers(1, 8))
    edge = st.tuples(st.integers(-1, count - 1), st.sampled_from((0, 0, 0, 2)))
    return [draw(st.lists(edge, max_size=3)) for _ in range(count)]


def by_paths(edges: Edges) -> list[int]:
    """The marks, found by following all paths without time."""
    count = len(edges)
    reach = [{s} for s in range(count)]
    for _ in range(count):
        for s, each in enumerate(edges):
            for to, time in each:
                if to >= 0 and time == 0:
                    reach[s] |= reach[to]
    cyclic = {
        s
        for s, each in enumerate(edges)
        if any(t >= 0 and d == 0 and s in reach[t] for t, d in each)
    }
    marks = []
    for s in range(count):
        endless = bool(cyclic & reach[s])
        leaves = any(not edges[r] or any(d > 0 for _, d in edges[r]) for r in reach[s])
        marks.append(ENDLESS * endless | LEAVES * leaves)
    return marks


@cache
def compiled() -> CompiledSearch:
    problem = read_problem(str(ROOT / "examples" / "hello" / "hello.rebeca"), None)
    return CompiledSearch(lower(problem.analysis)[0], "tts")


@given(graphs())
def test_marks_are_those_of_the_paths(edges: Edges) -> None:
    graph = graph_of([[(t, 0 if t < 0 else d) for t, d in each] for each in edges])
    plain = [[(t, 0 if t < 0 else d) for t, d in each] for each in edges]
    expected = by_paths(plain)
    assert list(marks_of(graph)) == expected
    assert list(compiled().marks(graph)) == expected
    if ENDLESS in expected:
        state, prefix, cycle = cycle_from(graph, marks_of(graph))
        assert expected[state] == ENDLESS
        for ordinal in prefix:
            state = plain[state][ordinal][0]
        start = state
        for ordinal in cycle:
            state = plain[state][ordinal][0]
        assert cycle
        assert state == start


@pytest.mark.parametrize(
    ("body", "may"),
    [
        ("self.go();", True),
        ("self.go() after(1);", False),
        ("self.go() after(?(1, 2));", False),
        ("self.go() after(?(0, 2));", True),
        ("delay(1); self.go();", False),
        ("if (n > 0) { delay(1); } self.go();", True),
        ("f(); self.go();", True),  # it cannot, but calls are not looked into for delays
        ("delay(n); self.go();", True),
        ("while (n > 0) { delay(n); } self.go() after(1);", True),
        ("other();", False),
    ],
)
def test_what_cannot_stand_still_is_seen_in_the_code(tmp_path: Path, body: str, may: bool) -> None:
    text = """
reactiveclass A(3) {
  statevars { int n; }
  A() { self.go(); }
  msgsrv go() { BODY }
  msgsrv other() { }
  void f() { delay(2); }
}
main { A a():(); }
"""
    (tmp_path / "m.rebeca").write_text(text.replace("BODY", body))
    problem = read_problem(str(tmp_path / "m.rebeca"), None)
    assert may_stand_still(lower(problem.analysis)[0]) is may
