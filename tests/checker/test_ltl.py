"""LTL on state spaces, against formulas evaluated run by run."""

from __future__ import annotations

import itertools
from array import array
from collections.abc import Iterator
from dataclasses import replace

import pytest

from rebsync.checker.exploration import Unavailable
from rebsync.checker.formulas import And, Atom, Formula, Not, Or, Temporal, Timed
from rebsync.checker.graph import Graph
from rebsync.checker.look import Stopped
from rebsync.checker.temporal import Fairness, Lasso, check_ltl, compiled_product
from rebsync.checker.temporal.buchi import translate
from rebsync.checker.temporal.emptiness import Find, search
from tests.checker.temporal_graphs import Edge, draw_graph, draw_linear, graph_of, random_cases

P, Q = Atom(0), Atom(1)
FAIRNESS: tuple[Fairness, ...] = ("none", "weak", "progress")

# A run as edge numbers: prefix and cycle; an empty cycle stays in the last state.
Run = tuple[int, tuple[int, ...], tuple[int, ...]]


def G(f: Formula) -> Formula:
    return Temporal("G", (f,))


def F(f: Formula) -> Formula:
    return Temporal("F", (f,))


def X(f: Formula) -> Formula:
    return Temporal("X", (f,))


# --- the meaning, run by run -------------------------------------------------------------------


def values(formula: Formula, word: list[int], loop: int) -> list[bool]:
    """Whether the formula holds at each position of word[:loop] (word[loop:])^omega."""
    after = [*range(1, len(word)), loop]
    match formula:
        case Atom(predicate):
            return [bool(letter >> predicate & 1) for letter in word]
        case Not(operand):
            return [not v for v in values(operand, word, loop)]
        case And(left, right):
            sides = zip(values(left, word, loop), values(right, word, loop), strict=True)
            return [a and b for a, b in sides]
        case Or(left, right):
            sides = zip(values(left, word, loop), values(right, word, loop), strict=True)
            return [a or b for a, b in sides]
        case Temporal(operator, operands):
            *first, last = (values(operand, word, loop) for operand in operands)
            if operator == "X":
                return [last[n] for n in after]
            left_side = first[0] if first else [operator == "F"] * len(word)
            if operator == "G":
                return [all(last[n] for n in _ahead(i, after)) for i in range(len(word))]
            found = []
            for i in range(len(word)):
                reached = next((n for n in _until(i, after, left_side, last)), None)
                forever = operator == "W" and all(left_side[n] for n in _ahead(i, after))
                found.append(reached is not None or forever)
            return found
        case _:
            raise AssertionError(formula)


def _ahead(position: int, after: list[int]) -> Iterator[int]:
    for _ in range(2 * len(after)):
        yield position
        position = after[position]


def _until(position: int, after: list[int], left: list[bool], right: list[bool]) -> Iterator[int]:
    for n in _ahead(position, after):
        if right[n]:
            yield n
        if not left[n]:
            return


def holds(graph: Graph, formula: Formula, run: Run) -> bool:
    start, prefix, cycle = run
    states = [start, *(graph.target[e] for e in (*prefix, *cycle[:-1]))]
    word = [graph.labels[s] for s in states]
    return values(formula, word, len(prefix))[0]


def live(graph: Graph, state: int) -> list[int]:
    return [e for e in range(graph.first[state], graph.first[state + 1]) if graph.target[e] >= 0]


def fair(graph: Graph, run: Run, fairness: Fairness) -> bool:
    _, _, cycle = run
    if not cycle or fairness == "none":
        return True
    if fairness == "progress":
        return any(graph.time[e] > 0 for e in cycle)
    states = [graph.target[e] for e in cycle]
    return all(
        any(graph.actor[e] == rebec for e in cycle)
        or any(all(graph.actor[e] != rebec for e in live(graph, s)) for s in states)
        for rebec in (0, 1)
    )


def runs(graph: Graph, longest: int) -> Iterator[Run]:
    """All runs with so many edges at most in prefix and cycle."""
    waiting: list[tuple[int, tuple[int, ...]]] = [(s, ()) for s in dict.fromkeys(graph.initial)]
    while waiting:
        start, edges = waiting.pop()
        states = [start, *(graph.target[e] for e in edges)]
        after = live(graph, states[-1])
        if not after:
            yield start, edges, ()
        for position, state in enumerate(states[:-1]):
            if state == states[-1]:
                yield start, edges[:position], edges[position:]
        if len(edges) < longest:
            waiting += [(start, (*edges, e)) for e in after]


def run_of(graph: Graph, lasso: Lasso) -> Run:
    """The edges of an answer; it must be a run of the graph."""
    state = start = graph.initial[lasso.prefix[0]]
    edges = []
    for ordinal in (*lasso.prefix[1:], *(lasso.cycle or ())):
        edge = graph.first[state] + ordinal
        assert edge < graph.first[state + 1]
        edges.append(edge)
        state = graph.target[edge]
        assert state >= 0
    split = len(lasso.prefix) - 1
    prefix, cycle = tuple(edges[:split]), tuple(edges[split:])
    if lasso.cycle is not None:
        entered = graph.target[prefix[-1]] if prefix else start
        assert state == entered
        assert cycle or not live(graph, state)
    return start, prefix, cycle


def continuations(graph: Graph, run: Run, longest: int) -> Iterator[Run]:
    start, prefix, _ = run
    state = graph.target[prefix[-1]] if prefix else start
    for _, more, cycle in runs(replace(graph, initial=(state,)), longest):
        yield start, (*prefix, *more), cycle


# --- drawn at random ---------------------------------------------------------------------------


def test_an_answer_is_a_violating_run_and_no_answer_means_there_is_none() -> None:
    for random in random_cases(12):
        graph, formula = draw_graph(random), draw_linear(random, random.randint(1, 3))
        fairness = random.choice(FAIRNESS)
        answer = check_ltl(graph, formula, fairness)
        if answer is None:
            for run in itertools.islice(runs(graph, 7), 300):
                assert holds(graph, formula, run) or not fair(graph, run, fairness), run
            continue
        run = run_of(graph, answer)
        if answer.cycle is None:
            for longer in itertools.islice(continuations(graph, run, 5), 50):
                assert not holds(graph, formula, longer)
        else:
            assert not holds(graph, formula, run)
            assert fair(graph, run, fairness)


def test_on_a_single_run_the_answer_is_the_value_of_the_formula() -> None:
    for random in random_cases(16):
        word = [random.randrange(4) for _ in range(random.randint(1, 7))]
        loop = random.randrange(len(word))
        formula = draw_linear(random, random.randint(1, 4))
        after = [*range(1, len(word)), loop]
        graph = graph_of([[(n, 0, 1)] for n in after], word)
        value = values(formula, word, loop)[0]
        fairness = random.choice(FAIRNESS)
        assert (check_ltl(graph, formula, fairness) is None) is value
        assert (check_ltl(graph, Not(formula), fairness) is None) is not value


@pytest.mark.parametrize(
    "formula",
    [
        F(F(P)),
        F(Temporal("U", (P, Q))),
        F(Temporal("W", (P, Q))),
        F(Temporal("W", (F(P), Q))),
        F(Temporal("W", (F(P), And(F(P), Q)))),
        G(G(P)),
        G(Temporal("U", (P, Q))),
        G(Temporal("W", (P, Q))),
        F(G(F(P))),
        F(G(F(And(P, X(Q))))),
        G(F(G(P))),
        Temporal("U", (P, F(Q))),
        Temporal("U", (P, Temporal("U", (P, Q)))),
        Temporal("U", (P, Temporal("U", (Q, P)))),
        Temporal("W", (P, Temporal("W", (P, Q)))),
        Temporal("W", (G(P), Q)),
        Temporal("W", (Q, And(Q, F(P)))),
        Not(Temporal("W", (F(P), G(Q)))),
        F(Not(Temporal("U", (Not(P), Not(F(Q)))))),
        G(Not(Not(Temporal("U", (P, G(Q)))))),
    ],
)
def test_formulas_that_can_be_simplified_keep_their_meaning(formula: Formula) -> None:
    for size, loop in ((1, 0), (2, 1), (3, 0), (3, 2), (4, 1), (4, 3)):
        for word in itertools.product(range(4), repeat=size):
            graph = graph_of([[(n, 0, 1)] for n in [*range(1, size), loop]], word)
            value = values(formula, list(word), loop)[0]
            assert (check_ltl(graph, formula) is None) is value


def test_a_cycle_in_pieces_is_one_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rebsync.checker.temporal.ltl._EFFORT", 0)
    for random in random_cases(6):
        graph, formula = draw_graph(random), draw_linear(random, 3)
        fairness = random.choice(FAIRNESS)
        answer = check_ltl(graph, formula, fairness)
        if answer is not None and answer.cycle is not None:
            run = run_of(graph, answer)
            assert not holds(graph, formula, run)
            assert fair(graph, run, fairness)


def test_a_cycle_is_entered_as_soon_as_the_automaton_can() -> None:
    for random in random_cases(6):
        graph, formula = draw_graph(random, most=3), draw_linear(random, 2)
        answer = check_ltl(graph, formula)
        if answer is not None and answer.cycle is not None:
            rounds = len(translate(formula, wanted=False).moves)
            for start, prefix, cycle in itertools.islice(runs(graph, 6), 300):
                if len(prefix) + rounds * max(len(cycle), 1) < len(answer.prefix) - 1:
                    assert holds(graph, formula, (start, prefix, cycle))


# --- the search in C ---------------------------------------------------------------------------


def test_the_search_in_c_finds_the_same() -> None:
    in_c = needs_c()
    for random in random_cases(20):
        graph, formula = draw_graph(random, most=7), draw_linear(random, random.randint(1, 4))
        fairness = random.choice(FAIRNESS)
        expected = check_ltl(graph, formula, fairness)
        assert check_ltl(graph, formula, fairness, find=in_c) == expected, formula


def test_the_search_in_c_leaves_large_tables_alone() -> None:
    in_c = needs_c()
    edges = [[(n, 63 + n, 1) for n in range(3)]] * 3
    graph = graph_of(edges, [1, 3, 1 << 15])
    many = G(F(And(P, Not(Or(Q, Atom(15))))))
    for fairness in FAIRNESS:
        expected = check_ltl(graph, many, fairness)
        assert (expected is None) is (fairness == "weak")
        assert check_ltl(graph, many, fairness, find=in_c) == expected
    every = F(Atom(0))
    for predicate in range(1, 16):
        every = And(every, F(Atom(predicate)))
    assert check_ltl(graph_of(edges, [2**16 - 1] * 3), Or(every, G(P)), find=in_c) is None


def test_the_search_in_c_looks_at_the_bounds() -> None:
    in_c = needs_c()

    def look() -> None:
        raise Stopped("now")

    for find in (search, in_c):
        with pytest.raises(Stopped, match="now"):
            check_ltl(graph_of([[(0, 0, 1)]], [0]), G(F(P)), look=look, find=find)


def needs_c() -> Find:
    """The search in C; without a compiler the test is skipped."""
    try:
        compiled_product._library()
    except Unavailable as unavailable:
        pytest.skip(f"no C: {unavailable}")
    return compiled_product.search_compiled


# --- written down ------------------------------------------------------------------------------


def test_next_moves_over_steps_of_time_too() -> None:
    graph = graph_of([[(1, -1, 5)], [(0, 0, 0)]], [0, 1])
    assert check_ltl(graph, X(P)) is None
    assert check_ltl(graph, X(X(P))) == Lasso((0, 0, 0), None)


def test_a_finite_run_stays_in_its_last_state() -> None:
    graph = graph_of([[(1, 0, 0)], []], [0, 1])
    assert check_ltl(graph, F(G(P))) is None
    assert check_ltl(graph, F(G(Not(P)))) == Lasso((0, 0), ())
    for fairness in FAIRNESS:
        assert check_ltl(graph, G(F(Not(P))), fairness) == Lasso((0, 0), ())


def test_a_failed_step_belongs_to_no_run() -> None:
    graph = graph_of([[(-1, 0, 0), (1, 0, 0)], [(-1, 1, 0)]], [1, 1])
    assert check_ltl(graph, G(P)) is None
    assert check_ltl(graph, F(Not(P))) == Lasso((0, 1), ())


def test_only_progress_refuses_a_cycle_without_time() -> None:
    graph = graph_of([[(0, 0, 0), (1, 0, 2)], [(0, 0, 1)]], [0, 1])
    assert check_ltl(graph, F(P)) == Lasso((0,), (0,))
    assert check_ltl(graph, F(P), "weak") == Lasso((0,), (0,))
    assert check_ltl(graph, F(P), "progress") is None


def test_weak_fairness_lets_everybody_act_who_could_always_act() -> None:
    graph = graph_of([[(0, 0, 1), (1, 1, 0)], [(1, 0, 1)]], [0, 1])
    assert check_ltl(graph, F(P)) == Lasso((0,), (0,))
    assert check_ltl(graph, F(P), "weak") is None
    assert check_ltl(graph, F(P), "progress") == Lasso((0,), (0,))


def test_weak_fairness_asks_nothing_of_who_could_only_fail() -> None:
    graph = graph_of([[(0, 0, 1), (-1, 1, 0)]], [0])
    assert check_ltl(graph, F(P), "weak") == Lasso((0,), (0,))


def test_a_cycle_is_the_shortest_that_violates() -> None:
    # p soon on the way by 1 and 2, q soon by 3 and 4; both sooner by 5
    ways: list[list[Edge]] = [
        [(1, 0, 0), (3, 0, 0), (5, 0, 0)],
        [(2, 0, 0)],
        [(0, 0, 0)],
        [(4, 0, 0)],
        [(0, 0, 0)],
        [(6, 0, 0)],
        [(7, 0, 0)],
        [(0, 0, 0)],
    ]
    graph = graph_of(ways, [0, 1, 0, 2, 0, 0, 1, 2])
    answer = check_ltl(graph, Not(And(G(F(P)), G(F(Q)))))
    assert answer == Lasso((0,), (2, 0, 0, 0))


def test_who_is_interrupted_may_be_passed_over() -> None:
    graph = graph_of([[(1, 0, 0), (2, 1, 0)], [(0, 0, 0)], [(2, 0, 0)]], [0, 0, 1])
    assert check_ltl(graph, F(P), "weak") == Lasso((0,), (0, 0))


def test_a_violation_that_nothing_can_undo_is_shown_by_its_prefix() -> None:
    graph = graph_of([[(1, 0, 0)], [(2, 0, 0)], [(0, 0, 1)]], [1, 1, 0])
    assert check_ltl(graph, G(P)) == Lasso((0, 0, 0), None)
    assert check_ltl(graph, G(P), "progress") == Lasso((0,), (0, 0, 0))


def test_every_initial_state_counts() -> None:
    graph = graph_of([[(0, 0, 1)], [(1, 0, 1)]], [1, 0], (0, 1))
    assert check_ltl(graph, P) == Lasso((1,), None)
    assert check_ltl(graph, F(P)) == Lasso((1,), (0,))
    assert check_ltl(graph_of([], [], ()), P) is None


def test_predicates_beyond_the_first_word_are_read() -> None:
    graph = graph_of([[(1, 0, 0)], [(0, 0, 0)]], [0, 0])
    labels = array("Q", [1, 1 << 5, 1, 0])
    wide = replace(graph, labels=labels, words=2)
    assert check_ltl(wide, And(P, Atom(69))) is None
    assert check_ltl(wide, G(Or(Atom(69), X(Atom(69))))) is None
    assert check_ltl(wide, G(Atom(69))) == Lasso((0, 0), None)


def test_an_operator_of_tctl_is_refused() -> None:
    with pytest.raises(ValueError, match="AF is an operator of TCTL"):
        check_ltl(graph_of([[]], [0]), G(Timed("AF", None, (P,))))


@pytest.mark.parametrize(
    ("formula", "states"),
    [
        (G(P), 2),
        (F(P), 1),
        (G(F(P)), 2),
        (F(G(P)), 1),
        (G(Or(Not(P), F(Q))), 2),
        (Or(Not(And(G(F(P)), G(F(Q)))), G(F(Atom(2)))), 2),
    ],
)
def test_automata_of_everyday_formulas_are_small(formula: Formula, states: int) -> None:
    assert len(translate(formula, wanted=False).moves) <= states
