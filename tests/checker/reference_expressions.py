"""The expressions of the reference: an interpreter that walks the syntax tree.

A body asks the world for everything that is not its own: which option to choose, what time it is,
to send, to wait. The answers are kept in a log. A suspended body goes on by being run again from
its beginning: the log answers what has been asked before, the world the rest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from rebsync import model as m
from rebsync.static import Analysis, ClassInfo
from rebsync.static.constants import float_value
from rebsync.static.symbols import (
    BuiltinFunctionSymbol,
    BuiltinSymbol,
    EnvSymbol,
    KnownRebecSymbol,
    MethodSymbol,
    RebecSymbol,
    ServerSymbol,
    StateSymbol,
    Symbol,
)
from tests.checker.reference_frames import Fails, Frame, Place, Variables, World, key_of, replaced
from tests.checker.reference_values import (
    Tagged,
    Value,
    convert,
    negative,
    operate,
    raised,
    root,
    tag,
    zero,
)


@dataclass
class Expressions:
    """One run of one body of the rebec `index`, an instance of `info`: its expressions."""

    analysis: Analysis
    info: ClassInfo
    index: int
    known: Variables
    env: Variables
    variables: Variables
    sender: int
    world: World
    log: list[object]
    asked: int = 0
    steps: int = 0
    frames: list[Frame] = field(default_factory=list)

    def run(
        self, parameters: tuple[m.Parameter, ...], arguments: Value, body: m.Block | None
    ) -> Value:
        """Runs a server, method or constructor to its end; its result if it has one."""
        raise NotImplementedError

    def ask(self, live: Callable[[], Value]) -> Value:
        """The next answer: from the log, or a new one."""
        if self.asked == len(self.log):
            self.log.append(live())
        self.asked += 1
        return self.log[self.asked - 1]  # type: ignore[return-value]

    @property
    def frame(self) -> Frame:
        return self.frames[-1]

    def symbol(self, node: object) -> Symbol:
        symbol = self.analysis.symbol_of(node)
        assert symbol is not None, node
        return symbol

    # --- expressions -----------------------------------------------------------------------------

    @contextmanager
    def held(self, *operands: Value) -> Iterator[None]:
        """Keeps what is computed while more is evaluated."""
        self.frame.operands += operands
        yield
        del self.frame.operands[len(self.frame.operands) - len(operands) :]

    def truth(self, node: m.Expression) -> bool:
        return bool(self.evaluate(node)[1])

    def evaluate(self, node: m.Expression) -> Tagged:
        """The kind and the value of an expression."""
        match node:
            case m.IntLiteral(value):
                return "int", value
            case m.FloatLiteral(text):
                kind = "double" if node.is_double else "float"
                return kind, convert(float_value(text), kind)
            case m.BoolLiteral(truth):
                return "boolean", truth
            case m.NullLiteral():
                return "rebec", None
            case m.Self() | m.Super():
                return "rebec", self.index
            case m.Paren(inner):
                return self.evaluate(inner)
            case m.Cast(type_, operand):
                return tag(type_), convert(self.evaluate(operand)[1], tag(type_))
            case m.Name() | m.Member() | m.Index():
                return self._read(node)
            case m.Call():
                return self._call(node)
            case m.Choice(options):
                taken = self.ask(lambda: self.world.choose(len(options)))
                assert isinstance(taken, int)
                kind = tag(self.analysis.types[id(node)])
                return kind, convert(self.analysis.value_of(options[taken]), kind)
            case m.Conditional(condition, then, otherwise):
                chosen = then if self.truth(condition) else otherwise
                return self._as_typed(node, self.evaluate(chosen))
            case m.InstanceOf(operand, type_):
                return "boolean", self._descends(self.evaluate(operand)[1], type_.name)
            case _:
                return self._operator(node)

    def _as_typed(self, node: m.Expression, tagged: Tagged) -> Tagged:
        """A value of two that may differ in type: a whole one becomes floating if either is."""
        type_ = self.analysis.type_of(node)
        if type_ is not None and type_.name in ("float", "double"):
            return type_.name, convert(tagged[1], type_.name)
        return tagged

    def _descends(self, rebec: Value, name: str) -> bool:
        return isinstance(rebec, int) and (
            name == "ReactiveClass" or name in self._class(rebec).lineage
        )

    def _class(self, rebec: int) -> ClassInfo:
        main = self.analysis.model.main
        assert main is not None
        return self.analysis.classes[main.rebecs[rebec].type.name]

    def _operator(self, node: m.Expression) -> Tagged:
        match node:
            case m.Unary("++" | "--" as operator, operand):
                return self._step(operator, operand, after=True)
            case m.Postfix(operator, operand):
                return self._step(operator, operand, after=False)
            case m.Unary("-", m.IntLiteral(value)):
                return "int", -value
            case m.Unary(operator, operand):
                return negative(operator, self.evaluate(operand))
            case m.Binary("&&", left, right):
                return "boolean", self.truth(left) and self.truth(right)
            case m.Binary("||", left, right):
                return "boolean", self.truth(left) or self.truth(right)
            case m.Binary(operator, left, right):
                first = self.evaluate(left)
                with self.held(first[1]):
                    second = self.evaluate(right)
                return self._computed(node, operator, first, second)
            case m.Assign(operator, target, assigned):
                return self._assign(node, operator, target, assigned)
            case _:
                raise NotImplementedError(node)

    def _computed(self, node: m.Node, operator: str, left: Tagged, right: Tagged) -> Tagged:
        try:
            return operate(operator, left, right)
        except ZeroDivisionError:
            raise Fails("division", node) from None

    def _assign(
        self, node: m.Node, operator: str, target: m.Expression, assigned: m.Expression
    ) -> Tagged:
        place = self._place(target)
        with self.held(*place.path):
            if operator == "=":
                value = self.evaluate(assigned)
            else:
                before = place.kind, self._load(place)
                with self.held(before[1]):
                    value = self.evaluate(assigned)
                value = self._computed(node, operator[:-1], before, value)
        return self._store(place, value[1])

    def _step(self, operator: str, operand: m.Expression, *, after: bool) -> Tagged:
        place = self._place(operand)
        before = place.kind, self._load(place)
        stored = self._store(place, operate(operator[0], before, ("int", 1))[1])
        return stored if after else before

    # --- variables -------------------------------------------------------------------------------

    def _read(self, node: m.Name | m.Member | m.Index) -> Tagged:
        inner: m.Expression = node
        while isinstance(inner, m.Index | m.Paren):
            inner = inner.target if isinstance(inner, m.Index) else inner.inner
        if not isinstance(inner, m.Name | m.Member):
            return self._element(node)
        symbol = self.symbol(inner)
        if isinstance(symbol, BuiltinSymbol):
            if symbol.name == "sender":
                return "rebec", self.sender
            return "int", self.ask(lambda: self.world.read(symbol.name))
        if isinstance(symbol, RebecSymbol):
            return "rebec", self.env[symbol]
        place = self._place(node)
        return place.kind, self._load(place)

    def _element(self, node: m.Expression) -> Tagged:
        """An element of an array that no variable holds, such as a result."""
        match node:
            case m.Paren(inner):
                return self._element(inner)
            case m.Index(target, index):
                kind, values = self._element(target)
                assert isinstance(values, tuple)
                with self.held(values):
                    position = self.evaluate(index)[1]
                assert isinstance(position, int)
                if not 0 <= position < len(values):
                    raise Fails("index", node)
                return kind, values[position]
            case _:
                return self.evaluate(node)

    def _place(self, node: m.Expression) -> Place:
        match node:
            case m.Paren(inner):
                return self._place(inner)
            case m.Name() | m.Member():
                symbol = self.symbol(node)
                type_ = getattr(symbol, "type", None)
                assert isinstance(type_, m.Type)
                return Place(symbol, type_)
            case m.Index(target, index):
                outer = self._place(target)
                with self.held(*outer.path):
                    position = self.evaluate(index)[1]
                assert isinstance(position, int)
                if not 0 <= position < outer.type.dimensions[0]:
                    raise Fails("index", node)
                inner_type = m.Type(outer.type.name, outer.type.dimensions[1:])
                return Place(outer.symbol, inner_type, (*outer.path, position))
            case _:
                raise NotImplementedError(node)

    def _holder(self, symbol: Symbol) -> Variables:
        match symbol:
            case StateSymbol():
                return self.variables
            case KnownRebecSymbol():
                return self.known
            case EnvSymbol():
                return self.env
            case _:
                return next(s for s in reversed(self.frame.scopes) if symbol in s)

    def _load(self, place: Place) -> Value:
        value = self._holder(place.symbol)[place.symbol]
        for position in place.path:
            assert isinstance(value, tuple)
            value = value[position]
        return value

    def _store(self, place: Place, value: Value) -> Tagged:
        narrowed = convert(value, place.kind)
        holder = self._holder(place.symbol)
        holder[place.symbol] = replaced(holder[place.symbol], place.path, narrowed)
        return place.kind, narrowed

    # --- calls -----------------------------------------------------------------------------------

    def _call(self, node: m.Call) -> Tagged:
        symbol = self.symbol(node)
        match symbol:
            case BuiltinFunctionSymbol(name):
                return self._builtin(name, node)
            case MethodSymbol():
                return self._invoke(node, symbol)
            case ServerSymbol():
                self._send(node, symbol)
                return "void", None
            case _:
                raise NotImplementedError(node)

    def _builtin(self, name: str, node: m.Call) -> Tagged:
        if name == "delay":
            time = convert(self.evaluate(node.arguments[0])[1], "int")
            assert isinstance(time, int)
            if time < 0:
                raise Fails("time", node)
            self.frame.point = node
            self.ask(lambda: self.world.wait(time))
            return "void", None
        if name == "assertion":
            if not self.truth(node.arguments[0]):
                raise Fails("assertion", node)
            return "void", None
        numbers = self._arguments(node.arguments, ("double",) * len(node.arguments))
        floats = [float(n) for n in numbers if isinstance(n, float)]
        return "double", raised(*floats) if name == "pow" else root(*floats)

    def _arguments(
        self, nodes: tuple[m.Expression, ...], kinds: tuple[str, ...], *held: Value
    ) -> tuple[Value, ...]:
        values: list[Value] = []
        for node, kind in zip(nodes, kinds, strict=True):
            with self.held(*held, *values):
                values.append(convert(self.evaluate(node)[1], kind))
        return tuple(values)

    def _invoke(self, node: m.Call, symbol: MethodSymbol) -> Tagged:
        target = node.target
        while isinstance(target, m.Paren):
            target = target.inner
        if not isinstance(target, m.Super):
            # an heir runs its own version, whoever calls
            symbol = next(s for s in self.info.methods if key_of(s) == key_of(symbol))
        method = symbol.declaration
        kinds = tuple(tag(p.type) for p in method.parameters)
        arguments = self._arguments(node.arguments, kinds)
        self.frame.point = node
        result = self.run(method.parameters, arguments, method.body)
        if method.type.name == "void":
            return "void", None
        if result is None:
            result = zero(method.type)
        return tag(method.type), convert(result, tag(method.type))

    def _send(self, node: m.Call, symbol: ServerSymbol) -> None:
        receiver = self.index if node.target is None else self.evaluate(node.target)[1]
        kinds = tuple(tag(p.type) for p in symbol.declaration.parameters)
        arguments = self._arguments(node.arguments, kinds, receiver)
        with self.held(receiver, *arguments):
            after = self._time(node.after)
            with self.held(after):
                deadline = self._time(node.deadline)
        if not isinstance(receiver, int) or not self._serves(receiver, symbol):
            raise Fails("null", node)
        if after is not None and after < 0:
            raise Fails("time", node)
        times = after or 0, deadline
        key = key_of(symbol)
        self.ask(lambda: self.world.send(node, receiver, key, arguments, times))

    def _serves(self, receiver: int, symbol: ServerSymbol) -> bool:
        return any(key_of(s) == key_of(symbol) for s in self._class(receiver).servers)

    def _time(self, node: m.Expression | None) -> int | None:
        if node is None:
            return None
        time = convert(self.evaluate(node)[1], "int")
        assert isinstance(time, int)
        return time
