"""Temporal properties on the state space of a search: what refutes them, and how that is said."""

from __future__ import annotations

from rebsync.checker.formulas import And, Atom, Formula, Not, Or, Temporal, Timed
from rebsync.checker.graph import Graph
from rebsync.checker.look import Look
from rebsync.checker.problem import Fairness
from rebsync.checker.temporal import Lasso, check_ltl, check_tctl
from rebsync.checker.temporal.emptiness import Find, search
from rebsync.checker.temporal.figures import FindFigures, in_python
from rebsync.records import dataclass
from rebsync.unions import assert_never

FAIRNESS_CAVEATS = {
    "weak": "LTL is about weakly fair runs: who can always act from some moment on acts in the end",
    "progress": "LTL is about runs on which time goes on for ever, or which end",
}
HOLDS_FAIRLY = (
    "{} is violated by unfair runs only: with --fairness weak it is satisfied, and the official "
    "checker may say so too"
)
EXACT_ONLY = "bounds of time in TCTL have a meaning in the exact view (tts) only"


@dataclass(frozen=True, slots=True)
class Refutation:
    """A run on which a formula does not hold, or as much of it as a run can show."""

    run: Lasso
    message: str


def refutation(
    graph: Graph,
    formula: Formula,
    branching: bool,
    fairness: Fairness,
    look: Look,
    compiled: bool = False,
) -> Refutation | None:
    """Why a formula does not hold; None when it does. `branching` says that it is one of TCTL.

    With `compiled` the work is done in C where that can be had.

    Raises Stopped when `look` does, or when deciding takes too much memory.
    """
    if not branching:
        run = check_ltl(graph, formula, fairness, look, _find(compiled))
        return Refutation(run, _said(run)) if run else None
    answer = check_tctl(graph, formula, look, find_figures(compiled))
    if answer.holds:
        return None
    if answer.run is None:
        start = next(n for n, state in enumerate(graph.initial) if not answer.states[state])
        message = "it does not hold in this state, which no single run shows"
        return Refutation(Lasso((start,), None), message)
    return Refutation(answer.run, _said(answer.run))


def _find(compiled: bool) -> Find:
    if not compiled:
        return search
    from rebsync.checker.temporal.compiled_product import search_compiled

    return search_compiled


def find_figures(compiled: bool) -> FindFigures:
    """What decides untils, for `compiled` in C where that can be had."""
    if not compiled:
        return in_python
    from rebsync.checker.temporal.compiled_figures import figures_for

    return figures_for


def _said(run: Lasso) -> str:
    return "it does not hold on this run" + (", which ends here" if run.cycle == () else "")


def has_bound(formula: Formula) -> bool:
    """Whether an operator of a formula counts time."""
    match formula:
        case Atom():
            return False
        case Timed(_, bound, operands):
            return bound is not None or any(has_bound(o) for o in operands)
        case Not(operand):
            return has_bound(operand)
        case And(left, right) | Or(left, right):
            return has_bound(left) or has_bound(right)
        case Temporal(_, operands):
            return any(has_bound(o) for o in operands)
        case _:
            assert_never(formula)
