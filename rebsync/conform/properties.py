"""The properties of a property file, evaluated on the run that was matched."""

from __future__ import annotations

from typing import Literal, TypeAlias

from rebsync.checker.formulas import (
    And,
    Formula,
    NamedFormula,
    Temporal,
    Timed,
    atoms,
    parts,
)
from rebsync.checker.machine import Failed
from rebsync.checker.program import Program
from rebsync.checker.search import Interpreted
from rebsync.conform.finite import (
    Conjunction,
    Disjunction,
    Negation,
    Next,
    Owed,
    Progression,
    Rest,
)
from rebsync.conform.graph import Node
from rebsync.records import dataclass

RunVerdict: TypeAlias = Literal["satisfied", "violated", "open", "undetermined"]
"""Whatever follows it holds; it does not; that depends on what follows; not known."""


@dataclass(frozen=True, slots=True)
class Evaluated:
    """A property on a run: `time` is when that was decided, `margin` by how much bounds were met.

    Of an open one `is_fulfilled` says whether it holds if nothing follows (LTLf: De Giacomo and
    Vardi, Linear temporal logic and linear dynamic logic on finite traces, 2013).
    """

    name: str
    kind: Literal["assertion", "formula"]
    verdict: RunVerdict
    time: int | None = None
    margin: int | None = None
    is_fulfilled: bool = True
    reason: str = ""


class Evaluation:
    """Sees the states of a run, and evaluates properties in them."""

    def __init__(
        self, program: Program, formulas: tuple[NamedFormula, ...], assertions: int
    ) -> None:
        self._search = Interpreted(program, "tts", ())
        self._open = [
            _Property(formula, number < assertions) for number, formula in enumerate(formulas)
        ]
        self._predicates = tuple(
            dict.fromkeys(p for formula in formulas for p in atoms(formula.formula))
        )
        self._last: tuple[int, Node] | None = None

    def see(self, time: int, node: Node) -> None:
        """The next state of the run."""
        if not self._open:
            return
        truth = self._truth(node)
        before = self._last
        for each in self._open:
            elapsed = 0 if before is None else time - before[0]
            each.see(time, truth, before[1].truth if before else truth, elapsed)
        self._last = (time, node)

    def _truth(self, node: Node) -> dict[int, bool | None]:
        truth: dict[int, bool | None] = node.truth
        if len(truth) < len(self._predicates):
            for predicate in self._predicates:
                try:
                    truth[predicate] = self._search.holds(node.state, predicate)
                except Failed:
                    truth[predicate] = None
        return truth

    def result(self, is_middle: bool, is_lost: bool, is_known: bool) -> tuple[Evaluated, ...]:
        """What is known at the end. Of the middle of a run only what holds of all states is.

        `is_known`: all rebecs were recorded.
        """
        why = ""
        if is_lost:
            why = "too many runs of the model fit the recording"
        elif not is_known:
            why = "not all nodes were recorded"
        return tuple(each.result(is_middle, why) for each in self._open)


class _Property:
    def __init__(self, formula: NamedFormula, is_assertion: bool) -> None:
        self.name = formula.name
        self.is_assertion = is_assertion
        self.formula = formula.formula
        if is_assertion:
            self.formula = Temporal("G", (formula.formula,))
        self.progression = Progression(self.formula)
        self.decided: tuple[RunVerdict, int] | None = None
        self.bound = greatest_bound(self.formula)
        self.needed = tuple(dict.fromkeys(atoms(self.formula)))
        # Without bounds what is left depends on few things, and is made once for each.
        self._rests: dict[Rest, Rest] = {}
        self._number = 0
        self._table: dict[tuple[int, tuple[bool | None, ...]], Rest] = {}

    def see(
        self,
        time: int,
        truth: dict[int, bool | None],
        before: dict[int, bool | None],
        elapsed: int,
    ) -> None:
        """A state, how long after the one before it is reached, and what was true in that."""
        if self.decided is not None:
            return
        if self.bound is None:
            # The usual case, and the only one that repeats: nothing that was not seen before.
            rest = self._table.get((self._number, tuple([truth[p] for p in self.needed])))
            if rest is not None and not isinstance(rest, bool):
                self._go_on(rest)
                return
        if None in truth.values() and any(truth[p] is None for p in self.needed):
            self.decided = ("undetermined", time)
            return
        if elapsed > 1 and self.bound is not None:
            # As in docs/semantics.md, the state before holds at each whole time in between.
            count = min(elapsed - 1, self.bound + 1)
            for _ in range(count):
                self._step(time, before, 1)
            elapsed -= count
        self._step(time, truth, elapsed)

    def _step(self, time: int, truth: dict[int, bool | None], elapsed: int) -> None:
        if self.decided is not None:
            return
        rest = self._progressed(truth, elapsed)
        if isinstance(rest, bool):
            self.decided = ("satisfied" if rest else "violated", time)

    def _progressed(self, truth: dict[int, bool | None], elapsed: int) -> Rest:
        if self.bound is not None:
            return self.progression.see({p: bool(truth[p]) for p in self.needed}, elapsed)
        values = tuple([truth[p] for p in self.needed])
        rest = self._table.get((self._number, values))
        if rest is None:
            rest = self.progression.see({p: bool(truth[p]) for p in self.needed}, elapsed)
            rest = self._rests.setdefault(rest, rest)
            self._table[self._number, values] = rest
        self._go_on(rest)
        return rest

    def _go_on(self, rest: Rest) -> None:
        self.progression.rest = rest
        self._number = id(rest)

    def result(self, is_middle: bool, why: str) -> Evaluated:
        kind: Literal["assertion", "formula"] = "assertion" if self.is_assertion else "formula"
        margin = self.progression.margin
        if why:
            return Evaluated(self.name, kind, "undetermined", None, margin, reason=why)
        if is_middle and not _is_invariant(self.formula):
            why = "the recording begins in the middle of the run"
            return Evaluated(self.name, kind, "undetermined", None, margin, reason=why)
        if self.decided is not None:
            verdict, time = self.decided
            why = "it has no value in a state" if verdict == "undetermined" else ""
            return Evaluated(self.name, kind, verdict, time, margin, reason=why)
        return Evaluated(
            self.name, kind, "open", None, margin, holds_at_the_end(self.progression.rest)
        )


def _is_invariant(formula: Formula) -> bool:
    """Whether it says something of all states, so that a run may begin in any of them."""
    match formula:
        case Temporal("G", _) | Timed("AG", None, _):
            return True
        case And(left, right):
            return _is_invariant(left) and _is_invariant(right)
        case _:
            return False


def greatest_bound(formula: Formula) -> int | None:
    """The greatest number that bounds a time in it; None without any."""
    timed = (f for f in parts(formula) if isinstance(f, Timed))
    return max((f.bound[1] for f in timed if f.bound is not None), default=None)


def holds_at_the_end(rest: Rest) -> bool:
    """Whether what is left of a formula holds when there is no further state."""
    match rest:
        case bool():
            return rest
        case Conjunction(parts):
            return all(map(holds_at_the_end, parts))
        case Disjunction(parts):
            return any(map(holds_at_the_end, parts))
        case Negation(part):
            return not holds_at_the_end(part)
        case Next():
            return False
        case Owed(operator, _, _, _):
            return operator in "GW"
