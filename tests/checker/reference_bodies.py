"""The bodies of the reference: statements."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from rebsync import model as m
from tests.checker.reference_expressions import Expressions
from tests.checker.reference_frames import Endless, Frame
from tests.checker.reference_values import Value, convert, tag, zero

_ENDLESS = 100_000  # statements


@dataclass
class Body(Expressions):
    """One run of one body. Each statement says how it ends, None for going on."""

    def run(
        self, parameters: tuple[m.Parameter, ...], arguments: Value, body: m.Block | None
    ) -> Value:
        """Runs a server, method or constructor to its end; its result if it has one."""
        assert isinstance(arguments, tuple)
        symbols = [self.symbol(p) for p in parameters]
        self.frames.append(Frame([dict(zip(symbols, arguments, strict=True))]))
        if body is not None:
            self._block(body.statements)
        return self.frames.pop().result

    def _block(self, statements: tuple[m.Statement, ...]) -> str | None:
        with self._scope():
            return self._sequence(statements)

    def _sequence(self, statements: tuple[m.Statement, ...]) -> str | None:
        for statement in statements:
            if end := self._execute(statement):
                return end
        return None

    @contextmanager
    def _scope(self) -> Iterator[None]:
        self.frame.scopes.append({})
        yield
        self.frame.scopes.pop()

    def _execute(self, statement: m.Statement) -> str | None:
        self.steps += 1
        if self.steps > _ENDLESS:
            raise Endless
        match statement:
            case m.Block(statements):
                return self._block(statements)
            case m.ExpressionStatement(expression):
                self.evaluate(expression)
            case m.Local(declaration):
                self._declare(declaration)
            case m.If(condition, then, otherwise):
                chosen = then if self.truth(condition) else otherwise
                return self._block((chosen,)) if chosen is not None else None
            case m.While(condition, body):
                return self._loop(condition, body, ())
            case m.For(initial, condition, updates, body):
                with self._scope():
                    if isinstance(initial, m.Declaration):
                        self._declare(initial)
                    else:
                        for expression in initial:
                            self.evaluate(expression)
                    return self._loop(condition, body, updates)
            case m.Switch():
                return self._switch(statement)
            case m.Return(value):
                if value is not None:
                    self.frame.result = self.evaluate(value)[1]
                return "return"
            case m.Break():
                return "break"
            case m.Continue():
                return "continue"
            case m.Empty():
                pass
        return None

    def _loop(
        self,
        condition: m.Expression | None,
        body: m.Statement,
        updates: tuple[m.Expression, ...],
    ) -> str | None:
        while condition is None or self.truth(condition):
            end = self._block((body,))
            if end == "break":
                return None
            if end == "return":
                return end
            for update in updates:
                self.evaluate(update)
        return None

    def _switch(self, switch: m.Switch) -> str | None:
        subject = self.evaluate(switch.subject)[1]
        entries = [
            position
            for position, case in enumerate(switch.cases)
            if case.value is None or self.analysis.value_of(case.value) == subject
        ]
        if not entries:
            return None
        with self._scope():
            for skipped in switch.cases[: entries[0]]:
                self._skip(skipped.statements)
            for entered in switch.cases[entries[0] :]:
                if end := self._sequence(entered.statements):
                    return None if end == "break" else end
        return None

    def _skip(self, statements: tuple[m.Statement, ...]) -> None:
        """Locals of the cases above are in scope, as if nothing had been stored."""
        for statement in statements:
            if isinstance(statement, m.Local):
                for declarator in statement.declaration.declarators:
                    value = zero(statement.declaration.type)
                    self.frame.scopes[-1][self.symbol(declarator)] = value

    def _declare(self, declaration: m.Declaration) -> None:
        for declarator in declaration.declarators:
            if declarator.initial is None:
                value = zero(declaration.type)
            else:
                value = self.initial(declarator.initial, tag(declaration.type))
            self.frame.scopes[-1][self.symbol(declarator)] = value

    def initial(self, initial: m.Initializer, kind: str) -> Value:
        """The value with which a variable starts."""
        if not isinstance(initial, m.ArrayInitializer):
            return convert(self.evaluate(initial)[1], kind)
        values: list[Value] = []
        for inner in initial.values:
            with self.held(*values):
                values.append(self.initial(inner, kind))
        return tuple(values)
