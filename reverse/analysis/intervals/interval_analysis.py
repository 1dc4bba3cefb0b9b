"""Which values the variables of bodies can have: interval analysis over statements of the model.

The abstract interpretation of Cousot and Cousot (1977): each variable has an interval, what
conditions say of one counts until it is written, and a loop is entered with nothing known of what
it writes. Numbers that hold more than the model's `int` in the code (`widths`) are taken to hold
one of it before a body starts; whatever a body gives them must be one again, or they are `broken`.
"""

from __future__ import annotations

from collections.abc import Sequence

from rebsync import model as m
from rebsync.intervals import exactly
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals import writes
from rebsync.reverse.analysis.intervals.interval_values import IntervalValues, note
from rebsync.reverse.analysis.intervals.writes import written


@dataclass(slots=True)
class IntervalAnalysis(IntervalValues):
    """Follows bodies, one after the other; what it is told and notes is that of its base."""

    def body(self, statements: Sequence[m.Statement]) -> None:
        """Looks at what a body gives the numbers, and at what it leaves in state variables."""
        self._now, self._locals = {}, {}
        if self._each(statements):
            self._leave()

    def _leave(self) -> None:
        for name in self.state:
            if name in self.widths:
                note(self.left, name, self._of(name))

    def _each(self, statements: Sequence[m.Statement]) -> bool:
        """Whether what follows may run."""
        return all(self._statement(s) for s in statements)

    def _statement(self, statement: m.Statement) -> bool:
        for annotation in statement.annotations:
            self._all(annotation.arguments or ())
        match statement:
            case m.Block(statements):
                return self._block(statements)
            case m.ExpressionStatement(expression):
                self._value(expression)
            case m.Local(declaration):
                self._declared(declaration)
            case m.If(condition, then, otherwise):
                return self._branches(condition, then, otherwise)
            case m.While(condition, body):
                self._loop(condition, body, ())
            case m.For():
                self._for(statement)
            case m.Switch():
                self._switch(statement)
            case m.Return(value):
                if value is not None:
                    self._value(value)
                self._leave()
                return False
            case m.Break() | m.Continue():
                return False
            case _:
                pass
        return True

    # --- locals ---------------------------------------------------------------------------------

    def _block(self, statements: Sequence[m.Statement]) -> bool:
        around = dict(self._locals)
        goes_on = self._each(statements)
        for statement in statements:
            if isinstance(statement, m.Local):
                self._close(statement.declaration, around)
        return goes_on

    def _close(self, declaration: m.Declaration, around: dict[str, m.Type]) -> None:
        """Locals end: their names are again those of what is around."""
        self._locals = dict(around)
        for declarator in declaration.declarators:
            self._forget_name(declarator.name)

    def _declared(self, declaration: m.Declaration) -> None:
        for declarator in declaration.declarators:
            name, initial = declarator.name, declarator.initial
            self._locals[name] = declaration.type
            self._forget_name(name)
            waiting = [initial] if initial is not None else []
            while waiting:
                value = waiting.pop()
                if isinstance(value, m.ArrayInitializer):
                    waiting += value.values
                else:
                    self._store(name, self._value(value))
            if declaration.type.dimensions:
                self._forget_name(name)

    # --- branches -------------------------------------------------------------------------------

    def _branches(
        self, condition: m.Expression, then: m.Statement, otherwise: m.Statement | None
    ) -> bool:
        self._value(condition)
        before = dict(self._now)
        self._assume(condition, True)
        goes_on = self._statement(then)
        after, self._now = self._now, before
        self._assume(condition, False)
        others = self._statement(otherwise) if otherwise is not None else True
        if goes_on and others:
            self._now = {n: self._joined(n, after) for n in after.keys() | self._now.keys()}
        elif goes_on:
            self._now = after
        return goes_on or others

    def _switch(self, switch: m.Switch) -> None:
        """Each case may be entered from that above it: nothing is known of what cases write."""
        self._value(switch.subject)
        self._forget(switch)
        before = dict(self._now)
        for case in switch.cases:
            self._now = dict(before)
            self._block(case.statements)
        self._now = before

    # --- loops ----------------------------------------------------------------------------------

    def _for(self, loop: m.For) -> None:
        around = dict(self._locals)
        if (rounds := writes.rounds_of(loop)) is not None:
            name, numbers = rounds
            turns = [loop.condition] if loop.condition is not None else []
            for number in numbers:
                self._now[name] = exactly(number)
                self._all(turns)
                self._statement(loop.body)
                self._all(loop.updates)
            self._now[name] = exactly(max(numbers.start, numbers.stop))
            self._all(turns)
        else:
            if isinstance(loop.initial, m.Declaration):
                self._declared(loop.initial)
            else:
                self._all(loop.initial)
            self._loop(loop.condition, loop.body, loop.updates)
        if isinstance(loop.initial, m.Declaration):
            self._close(loop.initial, around)

    def _loop(
        self, condition: m.Expression | None, body: m.Statement, updates: Sequence[m.Expression]
    ) -> None:
        """One round stands for all: of what it writes nothing is known when it starts."""
        for node in (condition, body, *updates):
            if node is not None:
                self._forget(node)
        before = dict(self._now)
        if condition is not None:
            self._value(condition)
            self._assume(condition, True)
        self._statement(body)
        if updates:
            # A `continue` leads here as well: only what the condition says of others still holds.
            self._now = dict(before)
            if condition is not None and self._is_steady(condition, body):
                self._assume(condition, True)
            self._all(updates)
        self._now = before
        if condition is not None:
            self._value(condition)
            if not any(isinstance(n, m.Break) for n in m.walk(body)):
                self._assume(condition, False)

    def _is_steady(self, condition: m.Expression, body: m.Statement) -> bool:
        """Whether a body changes nothing of what a condition names."""
        names = {n.name for n in m.walk(condition) if isinstance(n, m.Name | m.Member)}
        changed = written(body) | (set(self.called) if writes.calls_own(body) else set())
        return not names & changed
