"""TCTL on state spaces, against the same ones unrolled into single units of time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import pytest

from rebsync.checker.formulas import And, Atom, Bound, Formula, Not, Or, Temporal, Timed
from rebsync.checker.graph import Graph
from rebsync.checker.look import Stopped
from rebsync.checker.temporal import Lasso, check_tctl, compiled_figures
from rebsync.checker.temporal.evaluation import Evaluation
from rebsync.checker.temporal.figures import Figures, in_python
from tests.checker.temporal_graphs import (
    Edge,
    draw_bound,
    draw_graph,
    draw_timed,
    draw_universal,
    graph_of,
    in_c,
    random_cases,
)

P, Q = Atom(0), Atom(1)


# --- the meaning, unit by unit -----------------------------------------------------------------


@dataclass
class Unrolled:
    """Points with their labels; a step to a next point takes no time or one unit."""

    labels: list[int]
    after: list[list[tuple[int, int]]]


def unrolled(graph: Graph) -> Unrolled:
    """The states of the graph first, then the points on the way along its edges."""
    labels = list(graph.labels)
    after: list[list[tuple[int, int]]] = [[] for _ in labels]
    for state in range(len(graph)):
        for edge in range(graph.first[state], graph.first[state + 1]):
            target, time = graph.target[edge], graph.time[edge]
            if target < 0:
                continue
            here = state
            for _ in range(time - 1):
                after[here].append((len(labels), 1))
                here = len(labels)
                labels.append(graph.labels[state])
                after.append([])
            after[here].append((target, min(time, 1)))
        if not after[state]:
            after[state].append((state, 1))
    return Unrolled(labels, after)


def truth(points: Unrolled, formula: Formula) -> list[bool]:
    match formula:
        case Atom(predicate):
            return [bool(label >> predicate & 1) for label in points.labels]
        case Not(operand):
            return [not v for v in truth(points, operand)]
        case And(left, right):
            return [a and b for a, b in zip(truth(points, left), truth(points, right), strict=True)]
        case Or(left, right):
            return [a or b for a, b in zip(truth(points, left), truth(points, right), strict=True)]
        case Timed("AG", bound, (operand,)):
            return [not v for v in truth(points, Timed("EF", bound, (Not(operand),)))]
        case Timed("EG", bound, (operand,)):
            return [not v for v in truth(points, Timed("AF", bound, (Not(operand),)))]
        case Timed(operator, bound, operands):
            *first, right_side = (truth(points, operand) for operand in operands)
            left_side = first[0] if first else [True] * len(right_side)
            return until(points, left_side, right_side, bound, operator in ("AF", "AU"))
        case _:
            raise AssertionError(formula)


def until(
    points: Unrolled, left: list[bool], right: list[bool], bound: Bound | None, on_all: bool
) -> list[bool]:
    """The least solution, over points and the time that has passed."""
    most = bound[1] + 1 if bound else 0
    count = len(points.labels)
    solved = {(n, k): right[n] and allowed(bound, k) for n in range(count) for k in range(most + 1)}
    changed = True
    while changed:
        changed = False
        for n, k in solved:
            if not solved[n, k] and left[n]:
                ways = [solved[after, min(k + time, most)] for after, time in points.after[n]]
                if all(ways) if on_all else any(ways):
                    solved[n, k] = changed = True
    return [solved[n, 0] for n in range(count)]


def allowed(bound: Bound | None, elapsed: int) -> bool:
    match bound:
        case None:
            return True
        case ("<", limit):
            return elapsed < limit
        case ("<=", limit):
            return elapsed <= limit
        case (">", limit):
            return elapsed > limit
        case (">=", limit):
            return elapsed >= limit
        case (_, limit):
            return elapsed == limit


# --- drawn at random ---------------------------------------------------------------------------


def test_truth_is_that_of_single_units_of_time() -> None:
    for random in random_cases(60):
        graph, formula = draw_graph(random), draw_timed(random, random.randint(1, 4))
        expected = truth(unrolled(graph), formula)[: len(graph)]
        answer = check_tctl(graph, formula)
        assert [bool(v) for v in answer.states] == expected, formula
        assert answer.holds is all(expected[state] for state in graph.initial)
        if answer.run is not None:
            assert not answer.holds
            only(graph, answer.run)


@pytest.mark.parametrize("shortest", [50_000, 0])
def test_a_run_that_is_shown_violates_the_formula_alone(
    shortest: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rebsync.checker.temporal.explanation._SHORTEST", shortest)
    for random in random_cases(40):
        graph, formula = draw_graph(random), draw_universal(random, random.randint(1, 3))
        answer = check_tctl(graph, formula)
        assert answer.holds is (answer.run is None)
        if answer.run is not None:
            assert not truth(unrolled(only(graph, answer.run)), formula)[0], formula


def only(graph: Graph, run: Lasso) -> Graph:
    """The state space of one run, and of all that can follow it; it must be a run of the graph."""
    state = graph.initial[run.prefix[0]]
    edges: list[list[Edge]] = []
    labels = [graph.labels[state]]
    for ordinal in (*run.prefix[1:], *(run.cycle or ())):
        edge = graph.first[state] + ordinal
        assert edge < graph.first[state + 1]
        state = graph.target[edge]
        assert state >= 0
        edges.append([(len(labels), 0, graph.time[edge])])
        labels.append(graph.labels[state])
    if run.cycle:
        ((_, actor, time),) = edges[-1]
        edges[-1] = [(len(run.prefix) - 1, actor, time)]
        labels.pop()
    elif run.cycle is None:
        copy = [successors(graph, each, len(labels)) for each in range(len(graph))]
        return graph_of([*edges, copy[state], *copy], [*labels, *graph.labels])
    else:
        assert not successors(graph, state, 0)
        edges.append([])
    return graph_of(edges, labels)


def successors(graph: Graph, state: int, shift: int) -> list[Edge]:
    """The edges of a state that do not fail, their targets moved."""
    return [
        (graph.target[edge] + shift, graph.actor[edge], graph.time[edge])
        for edge in range(graph.first[state], graph.first[state + 1])
        if graph.target[edge] >= 0
    ]


# --- in C --------------------------------------------------------------------------------------


@pytest.mark.parametrize(("most", "longest"), [(4, 5), (60, 40), (30, 2**33)])
def test_c_and_python_agree(most: int, longest: int) -> None:
    """Truth in all states, and the run that is shown."""
    find = in_c()
    for random in random_cases(20):
        graph, formula = draw_graph(random, most, longest), draw_timed(random, random.randint(1, 4))
        assert isinstance(find(graph, 8), compiled_figures.CompiledFigures)
        assert check_tctl(graph, formula, find=find) == check_tctl(graph, formula), formula


@pytest.mark.parametrize("operator", ["EF", "AF", "EU", "AU"])
def test_timelines_are_split_alike(operator: Literal["EF", "AF", "EU", "AU"]) -> None:
    """All that is known of an until: its figures and timeline, its truth along edges."""
    find, operands = in_c(), (P, Q) if operator in ("EU", "AU") else (Q,)
    for random in random_cases(20):
        graph, bound = draw_graph(random, 20, 30), draw_bound(random)
        known = []
        for figures in (in_python, find):
            evaluation = Evaluation.of(graph, 8, find=figures)
            truth = evaluation.truth(Timed(operator, bound, operands))
            line, outcome = evaluation.line, evaluation.outcome(Timed(operator, bound, operands))
            arrays = (line.first, line.source, line.target, line.time, line.step, line.origin)
            known.append((*map(list, arrays), list(outcome.times), truth))
        assert known[0] == known[1], (operator, bound)


def test_what_is_too_long_for_c_is_done_in_python() -> None:
    find = in_c()
    graph = graph_of([[(1, -1, 2**60)], [(0, -1, 2**60)]], [1, 2])
    assert type(find(graph, 8)) is Figures
    assert type(find(SWITCH, 2**61)) is Figures
    assert check_tctl(graph, AG(AF(Q, ("<=", 2**60))), find=find).holds


# --- written down ------------------------------------------------------------------------------


def AG(f: Formula, bound: Bound | None = None) -> Formula:
    return Timed("AG", bound, (f,))


def AF(f: Formula, bound: Bound | None = None) -> Formula:
    return Timed("AF", bound, (f,))


def EF(f: Formula, bound: Bound | None = None) -> Formula:
    return Timed("EF", bound, (f,))


def EG(f: Formula, bound: Bound | None = None) -> Formula:
    return Timed("EG", bound, (f,))


# p waits 3, then q for 2
SWITCH = graph_of([[(1, -1, 3)], [(0, -1, 2)]], [1, 2])


@pytest.mark.parametrize(
    ("formula", "holds"),
    [
        (AF(Q, ("<=", 3)), True),
        (AF(Q, ("<", 3)), False),
        (EF(Q, ("==", 4)), True),
        (EF(Q, ("==", 5)), False),
        (AG(P, ("<", 3)), True),
        (AG(P, ("<=", 3)), False),
        (AF(P, (">", 2)), True),
        (AG(AF(Q, ("<=", 3))), True),
        (AG(AF(P, ("<=", 1))), False),
        (AF(AG(Q, ("<=", 1))), True),
        (AF(AG(Q, ("<=", 2))), False),
        (EF(And(P, AF(Q, ("==", 1)))), True),
        (Timed("AU", ("==", 3), (P, Q)), True),
        (Timed("AU", ("==", 4), (P, Q)), False),
        (Timed("AU", (">", 3), (Or(P, Q), P)), True),
        (AG(P, ("<", 0)), True),
        (EF(P, ("<", 0)), False),
        (EF(P, ("==", 0)), True),
    ],
)
def test_bounds_count_from_where_the_operator_begins(formula: Formula, holds: bool) -> None:
    assert check_tctl(SWITCH, formula).holds is holds


def test_a_state_on_the_way_counts_though_it_is_none_of_the_graph() -> None:
    # only after 3 units of waiting is q 2 units away
    graph = graph_of([[(1, -1, 5)], []], [1, 2])
    soon = AF(Q, ("<=", 2))
    assert not check_tctl(graph, soon).holds
    assert check_tctl(graph, EF(And(P, soon))).holds
    assert check_tctl(graph, AG(Not(And(P, soon)))).run == Lasso((0, 0), None)


def test_time_goes_on_in_a_final_state() -> None:
    graph = graph_of([[(1, 0, 0)], [(-1, 0, 0)]], [0, 1])
    assert check_tctl(graph, AF(P, (">=", 1000))).holds
    assert check_tctl(graph, AF(Q, ("<=", 1000))).run == Lasso((0, 0), ())
    assert check_tctl(graph, AF(Q)).run == Lasso((0, 0), ())


def test_in_a_cycle_without_time_no_time_passes() -> None:
    graph = graph_of([[(0, 0, 0), (1, 0, 4)], []], [1, 1])
    assert check_tctl(graph, AF(P, (">", 1))).run == Lasso((0,), (0,))
    assert check_tctl(graph, EF(P, (">", 1))).holds
    assert check_tctl(graph, EG(P, ("<=", 1))).holds


def test_a_run_shows_the_inner_operator_too() -> None:
    graph = graph_of([[(1, 0, 1)], [(2, 0, 2), (0, 0, 0)], [(2, 0, 3)]], [0, 1, 0])
    answer = check_tctl(graph, AG(Or(Not(P), AF(Q, ("<=", 4)))))
    assert answer.run == Lasso((0, 0, 0, 0), None)
    assert check_tctl(graph, AG(Or(Not(P), AF(Q)))).run == Lasso((0,), (0, 1))


def test_a_violated_possibility_has_no_run() -> None:
    answer = check_tctl(SWITCH, EF(And(P, Q)))
    assert (answer.holds, answer.run) == (False, None)
    assert check_tctl(SWITCH, Or(AG(P), AG(Q))).run is None
    assert check_tctl(SWITCH, And(EF(Q), AG(P))).run == Lasso((0, 0), None)


def test_every_initial_state_counts() -> None:
    graph = graph_of([[], []], [1, 0], (0, 1))
    answer = check_tctl(graph, P)
    assert answer.run == Lasso((1,), None)
    assert list(answer.states) == [1, 0]
    assert check_tctl(graph_of([], [], ()), P).holds


def test_long_times_cost_no_more_than_short_ones() -> None:
    year = 365 * 24 * 3600 * 1000 // 20
    graph = graph_of([[(1, -1, year)], [(0, -1, year)]], [1, 2])
    assert check_tctl(graph, AG(AF(Q, ("<=", year)))).holds
    assert not check_tctl(graph, AG(AF(Q, ("<", year)))).holds
    assert check_tctl(graph, AG(EF(P, (">=", year)))).holds
    assert check_tctl(graph, EF(And(P, AF(Q, ("==", 7))))).holds


def test_a_run_that_takes_too_much_effort_is_not_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    graph = graph_of([[(0, 0, 1), (1, 0, 0)], [(0, 0, 0)]], [0, 1])
    never = Not(EF(P, ("==", 400)))
    assert check_tctl(graph, never).run == Lasso((0, *[0] * 400, 1), None)
    monkeypatch.setattr("rebsync.checker.temporal.explanation._SHORTEST", 0)
    monkeypatch.setattr("rebsync.checker.temporal.explanation._EFFORT", 100)
    answer = check_tctl(graph, never)
    assert (answer.holds, answer.run) == (False, None)


def test_too_many_times_stop_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rebsync.checker.temporal.elapsed._MOST_BITS", 1000)
    assert check_tctl(SWITCH, EF(Q, ("==", 93))).holds
    with pytest.raises(Stopped, match="too many times up to 90000"):
        check_tctl(SWITCH, EF(Q, ("==", 90_000)))


BOUNDS: tuple[Bound | None, ...] = (None, ("<=", 3), (">", 3), ("==", 3))


def test_long_work_looks_at_the_bounds() -> None:
    def look() -> None:
        raise Stopped("now")

    for bound in BOUNDS:
        for operator in (AF, EF):
            with pytest.raises(Stopped, match="now"):
                check_tctl(SWITCH, operator(Q, bound), look)


def test_every_loop_in_c_looks_at_the_bounds(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whichever look it is that stops the work, it is stopped."""
    find = in_c()
    monkeypatch.setattr(compiled_figures, "_STRETCH", 2)
    graph = graph_of([[(1, -1, 5), (2, 0, 0)], [(0, 0, 0)], [(2, 0, 3)]], [1, 2, 1])
    for formula in (AG(operator(Q, bound)) for operator in (AF, EF) for bound in BOUNDS):
        counted = Looks(0)
        check_tctl(graph, formula, counted, find)
        for number in range(1, counted.done + 1):
            with pytest.raises(Stopped, match="now"):
                check_tctl(graph, formula, Looks(number), find)


@dataclass
class Looks:
    """Stops the work at a look of this number, or at none."""

    stopping: int
    done: int = 0

    def __call__(self) -> None:
        self.done += 1
        if self.done == self.stopping:
            raise Stopped("now")


def test_an_operator_of_ltl_is_refused() -> None:
    with pytest.raises(ValueError, match="G is an operator of LTL"):
        check_tctl(SWITCH, AG(Temporal("G", (P,))))
