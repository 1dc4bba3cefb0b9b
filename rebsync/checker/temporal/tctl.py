"""Branching time: does a formula of TCTL hold in the initial states?

Time is whole numbers. What holds in a state holds until the next one is reached; what runs are,
and what bounds mean on them, is said in decision 11.
"""

from __future__ import annotations

from dataclasses import field

from rebsync.checker.formulas import And, Atom, Formula, Not, Or, Temporal, Timed
from rebsync.checker.graph import Graph
from rebsync.checker.look import Look, unwatched
from rebsync.checker.temporal.evaluation import Evaluation, reduced
from rebsync.checker.temporal.explanation import explain
from rebsync.checker.temporal.figures import FindFigures, in_python
from rebsync.checker.temporal.lasso import Lasso, lasso
from rebsync.records import dataclass
from rebsync.unions import assert_never


@dataclass(frozen=True, slots=True)
class Branching:
    """Whether a formula holds in all initial states, and in which of all states it does.

    `run` shows why it does not hold, as far as one run can show that: not for E that is violated.
    """

    holds: bool
    states: bytearray = field(repr=False)
    run: Lasso | None


def check_tctl(
    graph: Graph, formula: Formula, look: Look = unwatched, find: FindFigures = in_python
) -> Branching:
    """Decides a formula by the figures that are found; `look` is called now and then.

    ValueError: it has an operator of LTL.
    """
    simple = reduced(formula)
    evaluation = Evaluation.of(graph, _largest_limit(simple) + 2, look, find)
    truth = evaluation.truth(simple, splits=False)[: len(graph)]
    for position, state in enumerate(graph.initial):
        if not truth[state]:
            found = explain(evaluation, simple, state, False)
            run = lasso(graph, position, found.prefix, found.cycle) if found else None
            return Branching(False, truth, run)
    return Branching(True, truth, None)


def _largest_limit(formula: Formula) -> int:
    match formula:
        case Atom():
            return 0
        case Not(operand):
            return _largest_limit(operand)
        case And(left, right) | Or(left, right):
            return max(_largest_limit(left), _largest_limit(right))
        case Timed(_, bound, operands):
            return max(bound[1] if bound else 0, *(_largest_limit(o) for o in operands), 0)
        case Temporal():
            raise AssertionError(f"not of TCTL: {formula.operator}")
        case _:
            assert_never(formula)
