"""The truth of formulas of TCTL at every node of a timeline."""

from __future__ import annotations

import operator
from collections.abc import Callable
from dataclasses import field

from rebsync.checker.formulas import And, Atom, Formula, Not, Or, Temporal, Timed
from rebsync.checker.graph import Graph
from rebsync.checker.look import Look, unwatched
from rebsync.checker.temporal.figures import Figures, FindFigures, in_python
from rebsync.checker.temporal.outcome import Outcome, Window
from rebsync.checker.temporal.timeline import Timeline
from rebsync.records import dataclass
from rebsync.unions import assert_never

_FLIPPED = bytes((1, 0)) + bytes(254)


def reduced(formula: Formula) -> Formula:
    """The same formula with no other operators of time than `EF AF EU AU`.

    ValueError: it has an operator of LTL.
    """
    match formula:
        case Atom():
            return formula
        case Not(operand):
            inner = reduced(operand)
            return inner.operand if isinstance(inner, Not) else Not(inner)
        case And(left, right):
            return And(reduced(left), reduced(right))
        case Or(left, right):
            return Or(reduced(left), reduced(right))
        case Timed("AG", bound, (operand,)):
            return Not(Timed("EF", bound, (reduced(Not(operand)),)))
        case Timed("EG", bound, (operand,)):
            return Not(Timed("AF", bound, (reduced(Not(operand)),)))
        case Timed(kind, bound, operands):
            return Timed(kind, bound, tuple(reduced(o) for o in operands))
        case Temporal():
            raise ValueError(f"{formula.operator} is an operator of LTL, not of TCTL")
        case _:
            assert_never(formula)


@dataclass(slots=True)
class Evaluation:
    """A state space as a timeline, and what is known of it already."""

    graph: Graph
    line: Timeline
    figures: Figures
    _known: dict[Formula, bytearray] = field(default_factory=dict)
    _outcomes: dict[Timed, Outcome] = field(default_factory=dict)

    @staticmethod
    def of(
        graph: Graph, patience: int, look: Look = unwatched, find: FindFigures = in_python
    ) -> Evaluation:
        """Nothing is known yet; `patience` is more than every bound."""
        figures = find(graph, patience)
        return Evaluation(graph, figures.timeline(graph, patience, look), figures)

    def truth(self, formula: Formula, splits: bool = True) -> bytearray:
        """Where a reduced formula holds.

        With `splits`, edges are split where it changes, so that it stays as it is along edges;
        without, that is so only of the operands of its operators of time.
        """
        match formula:
            case Not(operand):
                return self.truth(operand, splits).translate(_FLIPPED)
            case And(left, right):
                one, other = self._pair(left, right, splits)
                return _combined(operator.and_, one, other)
            case Or(left, right):
                one, other = self._pair(left, right, splits)
                return _combined(operator.or_, one, other)
            case Timed() if not splits:
                return self.figures.holding(self.outcome(formula))
            case _:
                if formula not in self._known:
                    self._known[formula] = self._first_truth(formula)
                return self.line.extend(self._known[formula])

    def outcome(self, formula: Timed) -> Outcome:
        """All about one of `EF AF EU AU`."""
        if len(formula.operands) == 2:
            left, right = self._pair(*formula.operands, splits=True)
        else:
            right = self.truth(formula.operands[0])
            left = bytearray(b"\1") * len(self.line)
        found = self._outcomes.get(formula)
        if found is None or len(found.times) != len(self.line):
            on_all = formula.operator in ("AF", "AU")
            window = Window.of(formula.bound)
            found = self.figures.outcome(self.line, window, left, right, on_all)
            self._outcomes[formula] = found
        return found

    def _pair(self, left: Formula, right: Formula, splits: bool) -> tuple[bytearray, bytearray]:
        one = self.truth(left, splits)
        other = self.truth(right, splits)
        return self.line.extend(one), other

    def _first_truth(self, formula: Formula) -> bytearray:
        if isinstance(formula, Timed):
            return self.figures.everywhere(self.outcome(formula))
        assert isinstance(formula, Atom)
        return self.line.extend(self.figures.truth(self.graph, formula.predicate))


def _combined(operation: Callable[[int, int], int], one: bytearray, other: bytearray) -> bytearray:
    """All truths at once, as two large numbers."""
    numbers = int.from_bytes(one, "little"), int.from_bytes(other, "little")
    return bytearray(operation(*numbers).to_bytes(len(one), "little"))
