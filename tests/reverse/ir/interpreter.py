"""A concrete interpreter of the intermediate form, on the values of Python itself.

Bodies run as generators, so that a `Yield` can stand anywhere. A statement gives how it ended:
None, or the jump that leaves it.
"""

from __future__ import annotations

import operator as op
import types
from collections.abc import Callable, Generator

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.program import Function, FunctionKind, ParameterKind, Program
from tests.reverse.ir.control import Carried, Control, Jump, Run
from tests.reverse.ir.evaluation import BINARY, Frame, Value, library, wrapped

_IN_PLACE: dict[Operator, Callable[[Value, Value], Value]] = {
    Operator.ADD: op.iadd,
    Operator.SUBTRACT: op.isub,
    Operator.MULTIPLY: op.imul,
    Operator.MATRIX_MULTIPLY: op.imatmul,
    Operator.TRUE_DIVIDE: op.itruediv,
    Operator.FLOOR_DIVIDE: op.ifloordiv,
    Operator.FLOOR_MODULO: op.imod,
    Operator.POWER: op.ipow,
    Operator.SHIFT_LEFT: op.ilshift,
    Operator.SHIFT_RIGHT: op.irshift,
    Operator.BIT_AND: op.iand,
    Operator.BIT_OR: op.ior,
    Operator.BIT_XOR: op.ixor,
}


class Interpreter(Control):
    """Runs the functions of a program; `calls` are the functions that run now."""

    def __init__(self, program: Program) -> None:
        super().__init__()
        self.program = program
        self.modules: dict[str, types.ModuleType] = {}
        self.calls: list[str] = []

    # --- functions and modules -------------------------------------------------------------------

    def module(self, name: str) -> types.ModuleType:
        """A module, run when it is first asked for."""
        if name not in self.modules:
            module = self.modules[name] = types.ModuleType(name)
            self.globals[name] = vars(module)
            self._finish(self._function(Frame(self.program.function(name), {})))
        return self.modules[name]

    def closure(self, expression: e.Closure, frame: Frame) -> Value:
        """A function of Python that runs a body."""
        function = self.program.function(expression.function)
        around = {**frame.around, frame.function.name: frame}
        defaults = {name: self.eval(value, frame) for name, value in expression.defaults}

        def call(*arguments: Value, **named: Value) -> Value:
            inner = Frame(function, around, _bound(function, defaults, arguments, named))
            run = self._function(inner)
            if function.kind is FunctionKind.GENERATOR:
                return run
            if function.kind is FunctionKind.COROUTINE:
                return types.coroutine(lambda: run)()
            return self._finish(run)

        call.__name__ = function.name.rpartition(".")[2]
        return call

    def _function(self, frame: Frame) -> Generator[Value, Value, Value]:
        """Runs a body to its end; gives what it returns."""
        name = frame.function.name
        self.calls.append(name)
        try:
            jump = yield from self._noted(self.body(frame.function.body, frame), name)
        except Carried as carried:
            if frame.function.kind is FunctionKind.GENERATOR:
                raise carried.inner from None  # which becomes another error, as in Python
            raise
        finally:
            if self.calls and self.calls[-1] == name:
                self.calls.pop()
        return jump.value if jump is not None else None

    def _noted(self, run: Run, name: str) -> Run:
        """Takes a generator off the running calls while it waits."""
        sent, failure = None, None
        while True:
            try:
                given = run.throw(failure) if failure is not None else run.send(sent)
            except StopIteration as stop:
                found: Jump | None = stop.value
                return found
            self.calls.pop()
            sent, failure = None, None
            try:
                sent = yield given
            except BaseException as raised:
                failure = raised
            self.calls.append(name)

    def _finish(self, run: Generator[Value, Value, Value]) -> Value:
        name = self.calls[:]
        try:
            run.send(None)
        except StopIteration as stop:
            return stop.value
        except Carried as carried:
            raise carried.inner from None
        finally:
            self.calls[:] = name
        raise AssertionError("a function that is no generator yields")

    # --- statements ------------------------------------------------------------------------------

    def statement(self, statement: s.Statement, frame: Frame) -> Run:
        match statement:
            case s.Return(value):
                return Jump(s.Return, None if value is None else self.value(value, frame))
            case s.Break():
                return Jump(s.Break)
            case s.Continue():
                return Jump(s.Continue)
            case s.Yield(target, value, delegates):
                given = self.value(value, frame)
                sent = (yield from given) if delegates else (yield given)
                self.store(target, sent, frame)
            case s.Await(target, value):
                result = yield from self.value(value, frame).__await__()
                self.store(target, result, frame)
            case s.Call() | s.Import() | s.DefineClass() | s.Raise() | s.Delete():
                self._effect(statement, frame)
            case (
                s.Evaluate()
                | s.Assign()
                | s.CompoundAssign()
                | s.Unpack()
                | s.Insert()
                | s.Declare()
            ):
                self._assignment(statement, frame)
            case s.Unsupported(reason):
                raise NotImplementedError(reason)
            case _:
                return (yield from self.structured(statement, frame))
        return None

    def _assignment(self, statement: s.Statement, frame: Frame) -> None:
        match statement:
            case s.Evaluate(value):
                self.value(value, frame)
            case s.Assign(target, value):
                self.store(target, self.value(value, frame), frame)
            case s.Declare(e.Attribute(e.ClassReference(name), member)):
                self.defining[name].setdefault("__annotations__", {})[member] = object
            case s.CompoundAssign(target, operator, value, dynamic):
                self._compound(target, operator, value, dynamic, frame)
            case s.Unpack(targets, value, rest):
                self._unpack(targets, self.value(value, frame), rest, frame)
            case s.Insert(container, value, key):
                holder = frame.temporaries[container.number]
                at = None if key is None else self.value(key, frame)
                element = self.value(value, frame)
                if key is not None:
                    self.carry(op.setitem, holder, at, element)
                else:
                    self.carry(holder.add if isinstance(holder, set) else holder.append, element)

    def _compound(
        self,
        target: e.Lvalue,
        operator: Operator,
        value: e.Expression,
        dynamic: bool,
        frame: Frame,
    ) -> None:
        fixed = self._fixed(target, frame)
        old = self.value(fixed, frame)
        by = self.value(value, frame)
        apply = _IN_PLACE.get(operator, BINARY[operator]) if dynamic else BINARY[operator]
        self.store(fixed, wrapped(self.carry(apply, old, by), target.type), frame)

    def _fixed(self, target: e.Lvalue, frame: Frame) -> e.Lvalue:
        """A target whose parts are evaluated: they are in temporaries."""
        match target:
            case e.Attribute(e.ClassReference(), _):
                return target
            case e.Attribute(holder, name):
                return e.Attribute(self._kept(-1, holder, frame), name)
            case e.Index(holder, index):
                first = self._kept(-1, holder, frame)
                return e.Index(first, self._kept(-2, index, frame))
            case _:
                return target

    def _kept(self, number: int, part: e.Expression, frame: Frame) -> e.Temporary:
        frame.temporaries[number] = self.value(part, frame)
        return e.Temporary(number)

    def _unpack(
        self, targets: tuple[e.Temporary, ...], value: Value, rest: int | None, frame: Frame
    ) -> None:
        elements = self.carry(list, value)
        if (rest is None and len(elements) != len(targets)) or len(elements) < len(targets) - 1:
            raise ValueError("too many or too few values to unpack")
        if rest is not None:
            end = len(elements) - (len(targets) - rest - 1)
            elements[rest:end] = [elements[rest:end]]
        for target, element in zip(targets, elements, strict=True):
            self.store(target, element, frame)

    def store(self, target: e.Lvalue | None, value: Value, frame: Frame) -> None:
        match target:
            case None:
                pass
            case e.Local(name):
                frame.locals[name] = value
            case e.Temporary(number):
                frame.temporaries[number] = value
            case e.Captured(function, name):
                self.note("write captured", function, name)
                frame.around[function].locals[name] = value
            case e.Global(module, name):
                self.note("write global", module, name)
                self.globals[module][name] = value
            case e.Attribute(holder, name):
                found = self.value(holder, frame)
                if any(found is space for space in self.defining.values()):
                    found[name] = value
                else:
                    self.note("write attribute", found, name)
                    self.carry(setattr, found, name, value)
            case e.Index(holder, index):
                container = self.value(holder, frame)
                key = self.value(index, frame)
                self.note("write element", container, key)
                self.carry(op.setitem, container, key, value)
            case _:
                raise NotImplementedError(target)

    # --- effects ---------------------------------------------------------------------------------

    def _effect(self, statement: s.Statement, frame: Frame) -> None:
        match statement:
            case s.Call(target, callee, arguments):
                function = self._callee(callee, frame)
                by_place: list[Value] = []
                named: dict[str, Value] = {}
                for argument in arguments:
                    value = self.value(argument.value, frame)
                    if argument.stars == 1:
                        by_place += self.carry(list, value)
                    elif argument.stars == 2:
                        named.update(value)
                    elif argument.name is not None:
                        named[argument.name] = value
                    else:
                        by_place.append(value)
                self.store(target, self.carry(function, *by_place, **named), frame)
            case s.Raise(None, _):
                raise
            case s.Raise(value, cause):
                self._raise(None if value is None else self.value(value, frame), cause, frame)
            case s.Import(target, module, name, is_program):
                found = self.module(module) if is_program else library(module)
                if name is not None:
                    found = getattr(found, name)
                self.store(target, found, frame)
            case s.DefineClass():
                self._define(statement, frame)
            case s.Delete(target):
                self.delete(target, frame)

    def _raise(self, raised: Value, cause: e.Expression | None, frame: Frame) -> None:
        if isinstance(raised, type) and issubclass(raised, StopIteration):
            raised = raised()
        if isinstance(raised, StopIteration):
            raise Carried(raised)
        if cause is None:
            raise raised
        raise raised from self.value(cause, frame)

    def _callee(self, callee: s.Callee, frame: Frame) -> Value:
        match callee:
            case s.ValueCallee(value):
                return self.value(value, frame)
            case s.LibraryCallee(name):
                return library(name)
            case s.MethodCallee(receiver, name, _, after):
                found = self.value(receiver, frame)
                if after is not None:
                    found = super(self.classes[after], found)
                return self.carry(self.attribute, found, name)
            case _:
                raise NotImplementedError(callee)

    def _define(self, statement: s.DefineClass, frame: Frame) -> None:
        bases = [self.value(a.value, frame) for a in statement.bases if a.name is None]
        named = {a.name: self.value(a.value, frame) for a in statement.bases if a.name}
        name = statement.class_name
        body = self.program.function(name)
        around = {**frame.around, frame.function.name: frame}

        def fill(space: dict[str, Value]) -> None:
            before = self.defining.get(name)
            self.defining[name] = space
            try:
                self._finish(self._function(Frame(body, around)))
            finally:
                del self.defining[name]
                if before is not None:
                    self.defining[name] = before

        short = name.replace(":", ".").rpartition(".")[2].partition("#")[0]
        made = self.carry(types.new_class, short, tuple(bases), named, fill)
        self.classes[name] = made
        self.store(statement.target, made, frame)

    def delete(self, target: e.Lvalue, frame: Frame) -> None:
        match target:
            case e.Local(name):
                if name not in frame.locals:
                    raise UnboundLocalError(name)
                del frame.locals[name]
            case e.Global(module, name):
                self.note("write global", module, name)
                del self.globals[module][name]
            case e.Captured(function, name):
                self.note("write captured", function, name)
                del frame.around[function].locals[name]
            case e.Attribute(holder, name):
                found = self.value(holder, frame)
                if any(found is space for space in self.defining.values()):
                    del found[name]
                else:
                    self.note("write attribute", found, name)
                    self.carry(delattr, found, name)
            case e.Index(holder, index):
                container, key = self.value(holder, frame), self.value(index, frame)
                self.note("write element", container, key)
                self.carry(op.delitem, container, key)
            case _:
                raise NotImplementedError(target)


def _bound(
    function: Function,
    defaults: dict[str, Value],
    arguments: tuple[Value, ...],
    named: dict[str, Value],
) -> dict[str, Value]:
    """The parameters of a call; what does not fit is a `TypeError`."""
    found: dict[str, Value] = {}
    rest, left = list(arguments), dict(named)
    for parameter in function.parameters:
        name, kind = parameter.name, parameter.kind
        if kind is ParameterKind.REST:
            found[name], rest = tuple(rest), []
        elif kind is ParameterKind.NAMED_REST:
            found[name], left = left, {}
        elif rest and kind is not ParameterKind.BY_NAME:
            found[name] = rest.pop(0)
            if name in left and kind is ParameterKind.PLAIN:
                raise TypeError(f"{function.name} has {name} twice")
        elif name in left and kind is not ParameterKind.BY_PLACE:
            found[name] = left.pop(name)
        elif name in defaults:
            found[name] = defaults[name]
        else:
            raise TypeError(f"{function.name} lacks {name}")
    if rest or left:
        raise TypeError(f"{function.name} takes no {rest or left}")
    return found
