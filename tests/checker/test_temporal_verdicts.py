"""LTL and TCTL from a property file to verdicts, runs and bounds, as `rebsync verify` has them."""

from __future__ import annotations

from random import Random
from typing import Literal, get_args

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rebsync.checker import conclusion
from rebsync.checker.exploration import Limits, Progress, Unavailable
from rebsync.checker.formulas import And, Atom, Formula, Not, Or, Temporal, Timed
from rebsync.checker.problem import EngineChoice, Fairness, Options, Problem
from rebsync.checker.result import Result, Violation
from rebsync.checker.search import Interpreted
from rebsync.checker.show.data import trace_json
from rebsync.checker.show.replay import trace_from_json
from rebsync.checker.simulate import replay
from rebsync.checker.steps import Semantics
from rebsync.checker.telling import Teller
from rebsync.checker.temporal import check_ltl, check_tctl
from rebsync.checker.trace import Trace
from rebsync.checker.verify import verify
from rebsync.checker.views import view_of
from rebsync.cli.progress import told
from rebsync.source import Source
from tests.checker.comparing import System
from tests.checker.draw_systems import TIMED, WITHOUT_DELAY, Drawn, systems
from tests.checker.temporal_graphs import draw_linear, draw_timed, in_c

FAIRNESS: tuple[Fairness, ...] = get_args(Fairness)
TIMED_VIEWS: tuple[Semantics, ...] = ("tts", "ftts")
ENGINES: tuple[EngineChoice, ...] = ("interpreted", "compiled")
# goes on as long as it chooses 1
ENDS = """
reactiveclass C(3) {
  statevars { int x; }
  C() { x = 0; self.go(); }
  msgsrv go() { x = ?(1, 2); if (x == 1) { self.go() after(2); } }
}
main { C c():(); }
"""
TURNS = """
reactiveclass C(3) {
  statevars { int x; int[2] a; }
  C() { x = 0; self.go(); }
  msgsrv go() { x = (x + 1) % 3; self.go() after(2); }
}
main { C c():(); }
"""
# without a delay nobody must ever wait for the other
SIDE_BY_SIDE = """
reactiveclass A(2) {
  statevars { boolean on; }
  A() { on = false; self.go(); }
  msgsrv go() { on = !on; self.go(); }
}
main { A a():(); A b():(); }
"""
MANY = """
reactiveclass C(3) {
  statevars { int x; }
  C() { x = 0; self.go(); }
  msgsrv go() { x = (x + ?(1, 2)) % 300; self.go() after(1); }
}
main { C c():(); }
"""


def read(model: str, properties: str) -> Problem:
    text = f"property {{ {properties} }}"
    system = System.of(model, text)
    source = Source("model.property", text)
    return Problem(system.source, system.analysis, system.properties, source)


def answer(
    model: str,
    properties: str,
    semantics: Semantics | None = None,
    engine: EngineChoice = "interpreted",
    fairness: Fairness = "none",
) -> Result:
    """The answer about a model; it may end."""
    options = Options(semantics, engine, fairness=fairness, allowed=frozenset(["deadlock"]))
    try:
        return verify(read(model, properties), options)
    except Unavailable as unavailable:
        pytest.skip(f"no compiled engine: {unavailable}")


def told_of(result: Result, name: str) -> Violation:
    (found,) = (v for v in result.violations if v.name == name)
    return found


def values(trace: Trace, variable: str) -> list[str]:
    """The values of a variable of the first rebec along a run."""
    return [dict(step.rebecs[0].variables)[variable] for step in trace.steps]


# --- verdicts and runs -------------------------------------------------------------------------


@pytest.mark.parametrize("engine", ENGINES)
def test_runs_show_why_ltl_does_not_hold(engine: EngineChoice) -> None:
    properties = """LTL {
      ends: F(c.x == 2);
      loops: G(F(c.x == 1));
      stays: G(c.x == 2 -> G(c.x == 2));
      one: G(c.x < 2);
    }"""
    result = answer(ENDS, properties, engine=engine)
    verdicts = {"ends": "violated", "loops": "violated", "stays": "satisfied", "one": "violated"}
    assert dict(result.properties) == verdicts
    assert (result.verdict, result.semantics, result.reason) == ("violated", "ftts", None)
    lasso, end, prefix = (told_of(result, name) for name in ("ends", "loops", "one"))
    assert (lasso.message, lasso.trace.loop) == ("it does not hold on this run", 1)
    assert values(lasso.trace, "x") == ["0", "1", "1"]
    assert (lasso.path, lasso.line) == ("model.property", 2)
    assert (end.message, end.trace.loop) == ("it does not hold on this run, which ends here", None)
    assert (prefix.message, prefix.trace.loop) == ("it does not hold on this run", None)
    assert values(end.trace, "x") == values(prefix.trace, "x") == ["0", "2"]


@pytest.mark.parametrize("engine", ENGINES)
def test_runs_show_why_tctl_does_not_hold(engine: EngineChoice) -> None:
    properties = """TCTL {
      ends: AF(c.x == 2);
      late: EF(time >= 10, c.x == 2);
      three: EF(c.x == 3);
      soon: AG(c.x != 1 || AF(time <= 2, c.x == 2));
    }"""
    result = answer(ENDS, properties, engine=engine)
    verdicts = {"ends": "violated", "late": "satisfied", "three": "violated", "soon": "violated"}
    assert dict(result.properties) == verdicts
    assert result.semantics == "tts"
    ends, three, soon = (told_of(result, name) for name in ("ends", "three", "soon"))
    assert values(ends.trace, "x") == ["0", "1", "1", "1"]
    assert ends.trace.loop == 1
    assert three.message == "it does not hold in this state, which no single run shows"
    assert len(three.trace.steps) == 1
    assert soon.trace.steps[-1].until == 4  # 1 from 0 on, and then more than 2 units


@pytest.mark.parametrize("semantics", get_args(Semantics))
def test_every_run_can_be_made_again(semantics: Semantics) -> None:
    properties = """
      LTL { never: G(c.x < 2); two: F(G(c.x == 2)); next: X(X(c.x == 0)); }
      TCTL { must: AG(AF(c.x == 3)); may: AG(EF(c.x == 0)); }
    """
    result = answer(TURNS, properties, semantics)
    teller = Teller(view_of(System.of(TURNS).program, semantics), Source("model.rebeca", TURNS))
    assert {v.name for v in result.violations} == {"never", "two", "next", "must"}
    for violation in result.violations:
        recorded = trace_from_json(Source("run.json", trace_json(violation.trace)))
        assert replay(teller, recorded.actions, recorded.loop) == violation.trace


# --- what a run is -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("semantics", "fairness", "verdict"),
    [
        ("core", "none", "violated"),
        ("core", "weak", "satisfied"),
        ("tts", "none", "violated"),
        ("tts", "weak", "satisfied"),
        ("tts", "progress", "satisfied"),
        ("ftts", "none", "violated"),
        ("ftts", "weak", "satisfied"),
    ],
)
def test_fairness_says_which_runs_count(
    semantics: Semantics, fairness: Fairness, verdict: str
) -> None:
    result = answer(SIDE_BY_SIDE, "LTL { on: G(F(b.on)); }", semantics, fairness=fairness)
    assert dict(result.properties) == {"on": verdict}
    assert any("LTL is about" in caveat for caveat in result.caveats) is (fairness != "none")


def test_next_counts_steps_of_time() -> None:
    formula = "LTL { second: X(c.x == 1 && X(c.x == 1 && X(c.x == 2))); }"
    assert answer(TURNS, formula).verdict == "satisfied"
    assert answer(TURNS, formula, "ftts").verdict == "violated"


@pytest.mark.parametrize("semantics", ["ftts", "core"])
def test_bounds_of_time_need_the_exact_view(semantics: Semantics) -> None:
    properties = "TCTL { may: AG(EF(c.x == 0)); soon: AG(AF(time <= 6, c.x == 0)); }"
    result = answer(TURNS, properties, semantics)
    assert dict(result.properties) == {"may": "satisfied", "soon": "undetermined"}
    assert result.verdict == "undetermined"
    assert result.reason == "bounds of time in TCTL have a meaning in the exact view (tts) only"
    assert answer(TURNS, properties, "tts").verdict == "satisfied"


@pytest.mark.parametrize("engine", ENGINES)
def test_a_formula_without_a_value_is_violated_where_it_has_none(engine: EngineChoice) -> None:
    properties = """
      LTL { part: G(F(10 / c.x > 1)); place: F(c.a[c.x] == 5); safe: G(10 / 3 > 1 || c.x < 3); }
      TCTL { rest: EF(c.x % c.a[0] == 1); }
    """
    result = answer(TURNS, properties, engine=engine)
    found = [(v.kind, v.name, len(v.trace.steps)) for v in result.violations]
    assert sorted(found) == [
        ("division", "part", 1),
        ("division", "rest", 1),
        ("index", "place", 4),
    ]
    assert dict(result.properties)["safe"] == "satisfied"


# --- bounds ------------------------------------------------------------------------------------

SLOW = (
    "LTL { live: G(F(c.x == 0)); one: G(c.x != 1 || F(c.x == 2)); } TCTL { may: AG(EF(c.x == 0)); }"
)


def test_a_search_that_is_cut_decides_no_temporal_property() -> None:
    result = verify(read(MANY, SLOW), Options(engine="interpreted", limits=Limits(states=50)))
    assert {verdict for _, verdict in result.properties} == {"undetermined"}
    assert (result.verdict, result.reason) == ("undetermined", "the bound of 50 states was reached")


@pytest.mark.parametrize(
    ("stop", "reason"),
    [
        ("seconds", "the bound of 1000 seconds was reached"),
        ("interrupt", "it was interrupted"),
        ("memory", "there was no more memory"),
    ],
)
def test_what_ends_the_deciding_leaves_the_rest_undetermined(
    stop: Literal["seconds", "interrupt", "memory"], reason: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[str] = []

    def report(now: Progress) -> None:
        seen.append(now.task)
        if now.task == "deciding one":
            if stop == "interrupt":
                raise KeyboardInterrupt
            if stop == "memory":
                raise MemoryError
            monkeypatch.setattr("rebsync.checker.watch.time.perf_counter", lambda: 1e9)

    options = Options(engine="interpreted", limits=Limits(seconds=1000))
    monkeypatch.setattr("rebsync.checker.watch._SLICE", 0)
    result = verify(read(MANY, SLOW), options, report)
    verdicts = {"live": "violated", "one": "undetermined", "may": "undetermined"}
    assert dict(result.properties) == verdicts
    assert (result.verdict, result.reason) == ("violated", reason)
    assert [task for task in dict.fromkeys(seen) if task] == [
        "storing all steps",
        "deciding live",
        "deciding one",
    ]


def test_the_state_space_must_fit_into_the_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(conclusion, "_EDGE", 2**40)
    limits = Limits(memory=2**40)
    result = verify(read(TURNS, "LTL { on: G(F(c.x == 0)); }"), Options(limits=limits))
    assert (result.verdict, result.reason) == (
        "undetermined",
        f"the bound of {2**40} bytes of memory was reached",
    )


def test_progress_says_what_is_done_after_the_search() -> None:
    now = Progress(1200, 3000, 7, 0, 12.4, 52 * 2**20, "deciding live")
    assert told(now) == "1,200 states, deciding live, 12 s, 52 MiB"


# --- views -------------------------------------------------------------------------------------


@given(systems(WITHOUT_DELAY), st.randoms(use_true_random=False))
def test_without_delay_the_views_agree_where_steps_are_not_counted(
    drawn: Drawn, random: Random
) -> None:
    program = System.of(drawn.model, drawn.properties).program
    assume(program.predicates)
    graphs = []
    for view in TIMED_VIEWS:
        search = Interpreted(program, view)
        assume(search.run(Limits(states=300)).reason is None)
        graphs.append(search.graph())

    def asked(formula: Formula) -> Formula:
        return uncounted(over_predicates(formula, len(program.predicates)))

    for fairness in FAIRNESS:
        linear = asked(draw_linear(random, random.randint(1, 4)))
        exact, floating = (check_ltl(graph, linear, fairness) is None for graph in graphs)
        assert exact is floating, (linear, fairness)
        timed = asked(draw_timed(random, random.randint(1, 3)))
        exact, floating = (check_tctl(graph, timed).holds for graph in graphs)
        assert exact is floating, timed


@given(systems(TIMED), st.randoms(use_true_random=False))
def test_c_decides_tctl_as_python_does(drawn: Drawn, random: Random) -> None:
    """On the state spaces of drawn models: truth in all states, and the run that is shown."""
    program = System.of(drawn.model, drawn.properties).program
    assume(program.predicates)
    search, find = Interpreted(program, "tts"), in_c()
    assume(search.run(Limits(states=300)).reason is None)
    graph = search.graph()
    for _ in range(5):
        drawn_formula = draw_timed(random, random.randint(1, 4))
        formula = over_predicates(drawn_formula, len(program.predicates))
        assert check_tctl(graph, formula, find=find) == check_tctl(graph, formula), formula


def over_predicates(formula: Formula, predicates: int) -> Formula:
    """The formula over so many predicates."""
    match formula:
        case Atom(predicate):
            return Atom(predicate % predicates)
        case Not(operand):
            return Not(over_predicates(operand, predicates))
        case And(left, right):
            return And(over_predicates(left, predicates), over_predicates(right, predicates))
        case Or(left, right):
            return Or(over_predicates(left, predicates), over_predicates(right, predicates))
        case Temporal(linear, operands):
            return Temporal(linear, tuple(over_predicates(o, predicates) for o in operands))
        case Timed(timed, bound, operands):
            return Timed(timed, bound, tuple(over_predicates(o, predicates) for o in operands))
        case _:
            raise AssertionError(formula)


def uncounted(formula: Formula) -> Formula:
    """The formula without X and without bounds."""
    match formula:
        case Atom():
            return formula
        case Not(operand):
            return Not(uncounted(operand))
        case And(left, right):
            return And(uncounted(left), uncounted(right))
        case Or(left, right):
            return Or(uncounted(left), uncounted(right))
        case Temporal("X", (operand,)):
            return uncounted(operand)
        case Temporal(linear, operands):
            return Temporal(linear, tuple(uncounted(o) for o in operands))
        case Timed(timed, _, operands):
            return Timed(timed, None, tuple(uncounted(o) for o in operands))
        case _:
            raise AssertionError(formula)
