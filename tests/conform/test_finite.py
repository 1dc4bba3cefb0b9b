"""Formulas on finite runs: what is decided early is what holds of every continuation."""

from __future__ import annotations

from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from rebsync.checker.formulas import And, Atom, Bound, Formula, Not, Or, Temporal, Timed
from rebsync.conform.finite import Progression
from rebsync.conform.properties import holds_at_the_end

State = tuple[bool, bool]
STATES: list[State] = [(a, b) for a in (False, True) for b in (False, True)]


def formulas(timed: bool) -> st.SearchStrategy[Formula]:
    """Small formulas over two atoms: of LTL, or with bounds."""
    atoms: st.SearchStrategy[Formula] = st.sampled_from([Atom(0), Atom(1)])
    bounds: st.SearchStrategy[Bound | None] = st.one_of(
        st.none(), st.tuples(st.sampled_from(["<", "<=", ">", ">=", "=="]), st.integers(0, 3))
    )

    def larger(inner: st.SearchStrategy[Formula]) -> st.SearchStrategy[Formula]:
        pairs = st.tuples(inner, inner)
        found: list[st.SearchStrategy[Formula]] = [
            inner.map(Not),
            pairs.map(lambda p: And(*p)),
            pairs.map(lambda p: Or(*p)),
        ]
        if timed:
            found += [
                st.builds(lambda b, f: Timed("AG", b, (f,)), bounds, inner),
                st.builds(lambda b, f: Timed("EF", b, (f,)), bounds, inner),
                st.builds(lambda b, p: Timed("AU", b, p), bounds, pairs),
            ]
        else:
            found += [
                st.builds(lambda o, f: Temporal(o, (f,)), st.sampled_from("GFX"), inner),
                st.builds(lambda o, p: Temporal(o, p), st.sampled_from("UW"), pairs),
            ]
        return st.one_of(found)

    return st.recursive(atoms, larger, max_leaves=4)


def holds(formula: Formula, run: list[State], at: int) -> bool:
    """The textbook meaning on a finite run, of which each state lasts one unit of time (LTLf)."""
    rest = range(at, len(run))
    match formula:
        case Atom(number):
            return run[at][number]
        case Not(operand):
            return not holds(operand, run, at)
        case And(left, right):
            return holds(left, run, at) and holds(right, run, at)
        case Or(left, right):
            return holds(left, run, at) or holds(right, run, at)
        case Temporal("X", (operand,)):
            return at + 1 < len(run) and holds(operand, run, at + 1)
        case Temporal("G", (operand,)):
            return all(holds(operand, run, i) for i in rest)
        case Temporal("F", (operand,)):
            return any(holds(operand, run, i) for i in rest)
        case Temporal("W", operands):
            always = all(holds(operands[0], run, i) for i in rest)
            return always or holds(Temporal("U", operands), run, at)
        case Temporal("U", (left, right)):
            return any(
                holds(right, run, i) and all(holds(left, run, j) for j in range(at, i))
                for i in rest
            )
        case Timed(operator, bound, operands):
            inside = [i for i in rest if bound is None or _is_in(i - at, bound)]
            last = operands[-1]
            if operator[1] == "G":
                return all(holds(last, run, i) for i in inside)
            first = operands[0] if operator[1] == "U" else None
            return any(
                holds(last, run, i)
                and (first is None or all(holds(first, run, j) for j in range(at, i)))
                for i in inside
            )
        case _:
            raise ValueError(formula)


def _is_in(time: int, bound: Bound) -> bool:
    operator, limit = bound
    return {
        "<": time < limit,
        "<=": time <= limit,
        ">": time > limit,
        ">=": time >= limit,
        "==": time == limit,
    }[operator]


def progressed(formula: Formula, run: list[State]) -> Progression:
    """A formula after all states of a run."""
    progression = Progression(formula)
    for number, state in enumerate(run):
        progression.see({0: state[0], 1: state[1]}, 0 if number == 0 else 1)
    return progression


def _check(formula: Formula, run: list[State]) -> None:
    rest = progressed(formula, run).rest
    assert holds_at_the_end(rest) is holds(formula, run, 0)
    if isinstance(rest, bool):
        for more in product(STATES, repeat=2):
            assert holds(formula, [*run, *more], 0) is rest


@given(formulas(timed=False), st.lists(st.sampled_from(STATES), min_size=1, max_size=6))
def test_ltl_means_what_the_textbook_says(formula: Formula, run: list[State]) -> None:
    _check(formula, run)


@given(formulas(timed=True), st.lists(st.sampled_from(STATES), min_size=1, max_size=6))
def test_bounds_mean_what_the_textbook_says(formula: Formula, run: list[State]) -> None:
    _check(formula, run)


def test_the_margin_is_the_least() -> None:
    within = Timed("AF", ("<=", 3), (Atom(1),))
    formula = Timed("AG", None, (Or(Not(Atom(0)), within),))
    a, b, none = (True, False), (False, True), (False, False)
    progression = progressed(formula, [a, b, none, a, none, none, b])
    assert progression.margin == 0
    assert progressed(formula, [a, b, none]).margin == 2
    assert progressed(formula, [a, none, none, none, b]).rest is False
