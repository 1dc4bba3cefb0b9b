"""Control of the intermediate form: branches, loops, exceptions, contexts.

Bodies run as generators, so that a `Yield` can stand anywhere. A statement gives how it ended:
None, or the jump that leaves it.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from tests.reverse.ir.evaluation import Evaluator, Frame, Value


class Carried(BaseException):
    """A `StopIteration` of the program, which must not end the generators of the interpreter."""

    def __init__(self, inner: StopIteration) -> None:
        super().__init__(inner)
        self.inner = inner


@dataclass(frozen=True, slots=True)
class Jump:
    """How a statement was left; the value of a return."""

    kind: type[s.Break] | type[s.Continue] | type[s.Return]
    value: Value = None


Run: TypeAlias = Generator[Value, Value, Jump | None]


class Control(Evaluator):
    """Statements with statements in them."""

    def body(self, body: s.Body, frame: Frame) -> Run:
        for statement in body:
            jump = yield from self.statement(statement, frame)
            if jump is not None:
                return jump
        return None

    def statement(self, statement: s.Statement, frame: Frame) -> Run:
        raise NotImplementedError

    def store(self, target: e.Lvalue | None, value: Value, frame: Frame) -> None:
        raise NotImplementedError

    def delete(self, target: e.Lvalue, frame: Frame) -> None:
        raise NotImplementedError

    def value(self, expression: e.Expression, frame: Frame) -> Value:
        """An expression, from a statement."""
        return self.carry(self.eval, expression, frame)

    def carry(self, call: Callable[..., Value], *arguments: Value, **named: Value) -> Value:
        """Calls something; a `StopIteration` of it is carried."""
        try:
            return call(*arguments, **named)
        except StopIteration as stop:
            raise Carried(stop) from stop

    def structured(self, statement: s.Statement, frame: Frame) -> Run:
        match statement:
            case s.Block(body):
                return (yield from self.body(body, frame))
            case s.If(test, then, otherwise, dynamic):
                holds = self._holds(test, dynamic, frame)
                return (yield from self.body(then if holds else otherwise, frame))
            case s.Assert(test, message, text, dynamic):
                if not self._holds(test, dynamic, frame):
                    yield from self.body(message, frame)
                    raise AssertionError(*(() if text is None else (self.value(text, frame),)))
                return None
            case s.Loop():
                return (yield from self._loop(statement, frame))
            case s.ForEach():
                return (yield from self._for_each(statement, frame))
            case s.Try():
                return (yield from self._try(statement, frame))
            case s.With():
                return (yield from self._with(statement, frame))
            case _:
                raise NotImplementedError(statement)

    def _holds(self, test: e.Expression, dynamic: bool, frame: Frame) -> bool:
        return bool(self.carry(self.truth, self.value(test, frame), dynamic))

    def _loop(self, loop: s.Loop, frame: Frame) -> Run:
        tested = not loop.body_first
        while True:
            if tested:
                yield from self.body(loop.prelude, frame)
                if not self._holds(loop.test, loop.dynamic, frame):
                    return (yield from self.body(loop.otherwise, frame))
            tested = True
            jump = yield from self.body(loop.body, frame)
            if jump is not None and jump.kind is not s.Continue:
                return None if jump.kind is s.Break else jump
            yield from self.body(loop.step, frame)

    def _for_each(self, loop: s.ForEach, frame: Frame) -> Run:
        elements: Iterator[Value] = self.carry(iter, self.value(loop.iterable, frame))
        while True:
            try:
                element = next(elements)
            except StopIteration:
                return (yield from self.body(loop.otherwise, frame))
            self.store(loop.target, element, frame)
            jump = yield from self.body(loop.body, frame)
            if jump is not None and jump.kind is not s.Continue:
                return None if jump.kind is s.Break else jump

    def _try(self, statement: s.Try, frame: Frame) -> Run:
        leaving: Jump | None = None
        failure: BaseException | None = None
        try:
            leaving = yield from self._handled(statement, frame)
        except BaseException as raised:
            failure = raised
            # What is raised or returned at the end goes before what was raised.
            jump = yield from self.body(statement.final, frame)
            if jump is not None:
                return jump
            raise
        if failure is None:
            jump = yield from self.body(statement.final, frame)
            leaving = jump if jump is not None else leaving
        return leaving

    def _handled(self, statement: s.Try, frame: Frame) -> Run:
        try:
            jump = yield from self.body(statement.body, frame)
        except BaseException as raised:
            inner = raised.inner if isinstance(raised, Carried) else raised
            for handler in statement.handlers:
                yield from self.body(handler.prelude, frame)
                if self._fits(handler, inner, frame):
                    return (yield from self._handler(handler, inner, frame))
            raise
        if jump is None:
            jump = yield from self.body(statement.otherwise, frame)
        return jump

    def _fits(self, handler: s.Handler, raised: BaseException, frame: Frame) -> bool:
        if handler.types is None:
            return True
        kinds = tuple(self.value(kind, frame) for kind in handler.types)
        return isinstance(raised, kinds)

    def _handler(self, handler: s.Handler, raised: BaseException, frame: Frame) -> Run:
        if handler.target is None:
            return (yield from self.body(handler.body, frame))
        self.store(handler.target, raised, frame)
        try:
            return (yield from self.body(handler.body, frame))
        finally:
            self.store(handler.target, None, frame)
            self.delete(handler.target, frame)

    def _with(self, statement: s.With, frame: Frame) -> Run:
        context = self.value(statement.context, frame)
        kind = type(context)
        leave = kind.__exit__
        self.store(statement.target, self.carry(kind.__enter__, context), frame)
        try:
            jump = yield from self.body(statement.body, frame)
        except BaseException as raised:
            inner = raised.inner if isinstance(raised, Carried) else raised
            if not self.carry(leave, context, type(inner), inner, inner.__traceback__):
                raise
            return None
        self.carry(leave, context, None, None, None)
        return jump
