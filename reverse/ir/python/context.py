"""The state of one lowering: statements emitted so far, temporaries, and the order of operands."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import TypeAlias

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.python.names import NameLookup
from rebsync.reverse.ir.python.results import OPERATORS, type_of
from rebsync.reverse.ir.python.symbols import Binder, Symbols
from rebsync.reverse.ir.types import TEXT, UNKNOWN, Container, ContainerKind, Type
from rebsync.reverse.syntax.py_tree import Py, field, named, text_of
from rebsync.source import Span

_STABLE = (
    *(e.Literal, e.Temporary, e.ClassReference, e.ModuleReference, e.LibraryReference),
    e.FunctionReference,
)
SEQUENCE = Container(ContainerKind.SEQUENCE)
TUPLE = Container(ContainerKind.TUPLE)
SET = Container(ContainerKind.SET)
MAPPING = Container(ContainerKind.MAPPING)


class NoLowering(Exception):
    """A construct without a lowering; caught where it stands, which becomes `Unsupported`."""

    def __init__(self, reason: str, node: Node) -> None:
        super().__init__(reason)
        self.reason = reason
        self.node = node


@dataclass(frozen=True, slots=True)
class Rules:
    """How expressions and statements are lowered; they need each other."""

    value: Callable[[Lowering, Node], e.Expression]
    statement: Callable[[Lowering, Node], None]


class Lowering:
    """Lowers one function: effects are emitted as statements, what is left of an expression is a
    tree that is evaluated after them.
    """

    def __init__(self, names: NameLookup, binder: Binder, scope: Symbols, rules: Rules) -> None:
        self._rules = rules
        self.names = names
        self.binder = binder
        self.scope = scope
        self.function = scope.function
        self.captured: frozenset[str] = frozenset()
        self.out: list[s.Statement] = []
        self._count = 0

    @property
    def py(self) -> Py:
        return self.binder.py

    def place(self, node: Node) -> Span:
        return self.py.span(node)

    def emit(self, statement: s.Statement) -> None:
        self.out.append(statement)

    def temporary(self, node: Node, type_: Type = UNKNOWN) -> e.Temporary:
        """A new temporary."""
        self._count += 1
        return e.Temporary(self._count, type_, self.place(node))

    def is_stable(self, value: e.Expression) -> bool:
        """Whether evaluating an expression later gives the same."""
        if isinstance(value, e.Local):
            return value.name not in self.captured and value.name not in self.function.walrus
        return isinstance(value, _STABLE)

    def name(self, node: Node) -> e.Expression:
        """What an identifier stands for."""
        name = self.scope.mangled(text_of(node))
        return self.names.resolve(name, self.scope, self.place(node))

    def operator(self, text: str, node: Node) -> Operator:
        """An arithmetic operator; `/` of Python 2 is another."""
        found = OPERATORS.get(text)
        if found is None:
            raise NoLowering(f"no meaning is known of `{text}`", node)
        is_old = self.binder.is_python_2 and not self.binder.has_future_division
        is_classic = found is Operator.TRUE_DIVIDE and is_old
        return Operator.CLASSIC_DIVIDE if is_classic else found

    def value(self, node: Node) -> e.Expression:
        """An expression, whose effects are emitted."""
        return self._rules.value(self, node)

    def part(self, node: Node, name: str) -> e.Expression:
        """The expression that is a part of a node."""
        return self._rules.value(self, field(node, name))

    def values(self, nodes: Iterable[Node]) -> list[e.Expression]:
        """Some expressions in their order."""
        return self.ordered([partial(self.value, node) for node in nodes])

    def lower_all(self, nodes: Iterable[Node]) -> None:
        """Emits some statements one after the other."""
        for node in nodes:
            self._rules.statement(self, node)

    def block(self, node: Node | None) -> s.Body:
        """The statements of a block."""
        return self.body(lambda: self.lower_all(named(node) if node is not None else ()))

    def else_of(self, node: Node) -> s.Body:
        """The statements of the `else` of a loop or `try`."""
        clause = next((c for c in node.children if c.type == "else_clause"), None)
        return self.block(field(clause, "body")) if clause is not None else ()

    def body(self, fill: Callable[[], None]) -> s.Body:
        """The statements that are emitted meanwhile, as a body of their own."""
        outer, self.out = self.out, []
        try:
            fill()
            return tuple(self.out)
        finally:
            self.out = outer

    def within(self, scope: Symbols, fill: Callable[[], None]) -> None:
        """Does something in a scope within this function."""
        outer, self.scope = self.scope, scope
        try:
            fill()
        finally:
            self.scope = outer

    def ordered(self, parts: Sequence[Callable[[], e.Expression]]) -> list[e.Expression]:
        """Operands in their order: those before one that has effects are saved before these."""
        found = self.operands(parts)
        return [v for v in found if not isinstance(v, e.Spread | e.FormatPiece)]

    def operands(self, parts: Sequence[Callable[[], Operand]]) -> list[Operand]:
        """As `ordered`, of operands that are iterated or made text when it is their turn."""
        values: list[Operand] = []
        for part in parts:
            mark = len(self.out)
            value = part()
            if len(self.out) > mark:
                later = self.out[mark:]
                del self.out[mark:]
                values = [self.saved_operand(v) for v in values]
                self.out += later
            values.append(value)
        return values

    def saved_operand(self, value: Operand) -> Operand:
        """As `saved`; what is iterated or made text is so now."""
        match value:
            case e.Spread(operand):
                copied = e.Build(SEQUENCE, (value,), operand.place)
                return e.Spread(self.stored(copied), value.place)
            case e.FormatPiece(e.Literal(str())):
                return value
            case e.FormatPiece(inner):
                return e.FormatPiece(self.stored(e.Format((value,), TEXT, place=inner.place)))
            case _:
                return self.saved(value)

    def saved(self, value: e.Expression) -> e.Expression:
        """A value that what comes later does not change: itself, or a temporary that has it."""
        if isinstance(value, e.Slice):
            parts = (value.low, value.high, value.step)
            low, high, step = (None if p is None else self.saved(p) for p in parts)
            return e.Slice(low, high, step, value.place)
        return value if self.is_stable(value) else self.stored(value)

    def stored(self, value: e.Expression) -> e.Temporary:
        """A temporary that has a value."""
        self._count += 1
        target = e.Temporary(self._count, type_of(value), value.place)
        self.emit(s.Assign(target, value, value.place))
        return target


Operand: TypeAlias = e.Expression | e.Spread | e.FormatPiece
