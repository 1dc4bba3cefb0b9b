"""What the lowering of one function knows and has emitted so far.

Lowerings of node types are registered in `EXPRESSIONS` and `STATEMENTS`; what has none raises
`Unlowered`, which becomes an `Unsupported` for the full-expression or statement around.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import field
from typing import TypeAlias

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.symbol_table import SymbolTable
from rebsync.reverse.ir.cpp.symbols import ClassSymbol
from rebsync.reverse.ir.cpp.types import Declared, TypeReader
from rebsync.reverse.ir.program import Function
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, text_of
from rebsync.source import Span


class Unlowered(Exception):
    """A construct that has no lowering, with the reason."""


@dataclass(frozen=True, slots=True)
class Value:
    """An expression with its type; an lvalue names an object that stays ([basic.lval])."""

    expression: e.Expression
    type: t.Type
    is_lvalue: bool = False


# Constructs an object of a class in a variable, of arguments.
Constructing: TypeAlias = "Callable[[Context, e.Lvalue, ClassSymbol, list[Value], Span], None]"
# An object of a class made a value of another type by a function of its class; None without one.
Converting: TypeAlias = "Callable[[Context, Value, ClassSymbol, t.Type, Span], Value | None]"
# Constructs an object of a class of a library.
LibraryCalling: TypeAlias = "Callable[[Context, e.Lvalue, t.Type, Sequence[Node], Span], None]"
# Calls an operator function of the program; None where there is none for these operands.
OperatorCalling: TypeAlias = "Callable[[Context, str, list[Value], Span], Value | None]"


@dataclass(frozen=True)
class World:
    """What the lowerings of all functions of a program share.

    `construct` and `conversion` choose among functions of classes: overload resolution.
    """

    symbols: SymbolTable
    types: TypeReader
    construct: Constructing
    conversion: Converting
    call_library: LibraryCalling
    operator: OperatorCalling


@dataclass(slots=True)
class PendingEnd:
    """The end of a temporary that the statement `anchor` made; `flag` is true once it is made."""

    anchor: s.Statement | None
    ending: s.Statement
    flag: e.Temporary | None = None


@dataclass(slots=True)
class Context:
    """The state of the lowering of one function or lambda.

    `scope` is where names are looked up from; `owner` the class of `this`; `result` what is
    returned, None where a lambda leaves it out. `objects` are the destructions that end the current
    scope, `pending` those of temporaries that end the full-expression.
    """

    world: World
    cpp: Cpp
    name: str
    scope: str
    owner: ClassSymbol | None = None
    this: e.Expression | None = None
    result: Declared | None = None
    enclosing: Context | None = None
    captures: LambdaCaptures | None = None
    exposed: frozenset[str] | None = None
    in_constructor: bool = False
    locals: list[dict[str, Value]] = field(default_factory=lambda: [{}])
    out: list[s.Statement] = field(default_factory=list)
    objects: list[s.Statement] = field(default_factory=list)
    pending: list[PendingEnd] = field(default_factory=list)
    full: list[s.Statement] | None = None
    names: set[str] = field(default_factory=set)
    shared: set[str] = field(default_factory=set)
    lambdas: dict[int, str] = field(default_factory=dict)
    closures: list[Function] = field(default_factory=list)
    aliases: set[str] = field(default_factory=set)
    returned: list[t.Type] = field(default_factory=list)
    temporaries: int = 0
    expanding: set[str] = field(default_factory=set)  # macros whose text is being lowered
    used_at: Span | None = None  # where what stands elsewhere is used

    # --- places and emission --------------------------------------------------------------------

    def place(self, node: Node) -> Span:
        """The place of a node; of what stands elsewhere the place that uses it."""
        return self.cpp.span(node) if self.used_at is None else self.used_at

    def emit(self, *statements: s.Statement) -> None:
        """Statements that run next."""
        self.out += statements

    @contextmanager
    def body(self) -> Iterator[list[s.Statement]]:
        """Statements are collected in a list of their own."""
        before, self.out = self.out, []
        try:
            yield self.out
        finally:
            self.out = before

    @contextmanager
    def trial(self) -> Iterator[None]:
        """What is lowered is only looked at for its types: nothing of it stays."""
        before = self.temporaries, self.full, self.pending, len(self.closures), set(self.names)
        self.full, self.pending = self.out, []
        try:
            yield
        finally:
            self.temporaries, self.full, self.pending, count, self.names = before
            del self.closures[count:]

    @contextmanager
    def within(self, body: list[s.Statement]) -> Iterator[None]:
        """Statements are added to a list that was collected before."""
        before, self.out = self.out, body
        try:
            yield
        finally:
            self.out = before

    def temporary(self, type_: t.Type, place: Span) -> e.Temporary:
        """A new variable of the lowering."""
        self.temporaries += 1
        return e.Temporary(self.temporaries, type_, place)

    def stored(self, value: e.Expression, type_: t.Type, place: Span) -> e.Temporary:
        """A value, computed now."""
        if isinstance(value, e.Temporary):
            return value
        target = self.temporary(type_, place)
        self.emit(s.Assign(target, value, place))
        return target

    @contextmanager
    def reading(self, cpp: Cpp, scope: str, place: Span | None = None) -> Iterator[None]:
        """What is lowered stands elsewhere: locals are not seen from there."""
        before = self.cpp, self.scope, self.locals, self.captures, self.used_at
        self.cpp, self.scope, self.locals, self.captures = cpp, scope, [{}], None
        self.used_at = self.used_at or place
        try:
            yield
        finally:
            self.cpp, self.scope, self.locals, self.captures, self.used_at = before

    # --- full-expressions -----------------------------------------------------------------------

    @contextmanager
    def full_expression(self) -> Iterator[None]:
        """Temporaries with destructors end at its end, the last one first ([class.temporary])."""
        full, pending = self.full, self.pending
        self.full, self.pending = self.out, []
        start = len(self.out)
        try:
            yield
            if any(t.flag is not None for t in self.pending):
                for each in self.pending:
                    self.flag(each, self.out)
            for each in reversed(self.pending):
                self._end(each, start)
        finally:
            self.full, self.pending = full, pending

    def end_later(self, ending: s.Statement) -> None:
        """A temporary made just now ends with the full-expression."""
        made = PendingEnd(self.out[-1] if self.out else None, ending)
        self.pending.append(made)
        if self.out is not self.full:
            self.flag(made, self.out)

    def flag(self, pending: PendingEnd, body: list[s.Statement]) -> None:
        """Notes at run time that a temporary was made, as it need not be where it is to end."""
        at = next((n + 1 for n, each in enumerate(body) if each is pending.anchor), None)
        if pending.flag is None and at is not None:
            place = pending.ending.place
            pending.flag = self.temporary(t.TRUTH, place)
            body.insert(at, s.Assign(pending.flag, e.Literal(True, t.TRUTH), place))

    def _end(self, pending: PendingEnd, start: int) -> None:
        """All that comes behind the statement that made a temporary, and then its end."""
        place, final = pending.ending.place, pending.ending
        if pending.flag is not None:
            self.out.insert(start, s.Assign(pending.flag, e.Literal(False, t.TRUTH), place))
            final = s.If(pending.flag, (pending.ending,), (), False, place)
            at: int | None = start + 1
        else:
            at = next((n + 1 for n, x in enumerate(self.out) if x is pending.anchor), None)
        if at is None:
            return  # it was taken back, as what is around it has no lowering
        within = tuple(self.out[at:])
        del self.out[at:]
        self.emit(s.Try(within, final=(final,), place=place))

    # --- names ----------------------------------------------------------------------------------

    @contextmanager
    def scoped(self) -> Iterator[None]:
        """Names that are declared are seen until its end."""
        self.locals.append({})
        try:
            yield
        finally:
            self.locals.pop()

    def unique(self, name: str) -> str:
        """A name for a variable that no other of the function has."""
        found, number = name, 1
        while found in self.names:
            number += 1
            found = f"{name}~{number}"
        self.names.add(found)
        return found

    def bind(self, name: str, value: Value) -> None:
        """What a name means in the current scope."""
        self.locals[-1][name] = value

    def local(self, name: str) -> Value | None:
        """The variable of the function, or captured by it, that a name means."""
        for scope in reversed(self.locals):
            if name in scope:
                return scope[name]
        return self.captures.value_of(self, name) if self.captures is not None else None


@dataclass(slots=True)
class LambdaCaptures:
    """How a lambda takes what it names of the function around it."""

    value_of: Callable[[Context, str], Value | None]


ExpressionLowering: TypeAlias = Callable[[Context, Node], Value]
StatementLowering: TypeAlias = Callable[[Context, Node], None]
EXPRESSIONS: dict[str, ExpressionLowering] = {}
STATEMENTS: dict[str, StatementLowering] = {}


def lowers_expression(*types: str) -> Callable[[ExpressionLowering], ExpressionLowering]:
    """Registers the lowering of types of nodes that are expressions."""

    def register(lowering: ExpressionLowering) -> ExpressionLowering:
        EXPRESSIONS.update(dict.fromkeys(types, lowering))
        return lowering

    return register


def lowers_statement(*types: str) -> Callable[[StatementLowering], StatementLowering]:
    """Registers the lowering of types of nodes that are statements."""

    def register(lowering: StatementLowering) -> StatementLowering:
        STATEMENTS.update(dict.fromkeys(types, lowering))
        return lowering

    return register


def lower_value(context: Context, node: Node) -> Value:
    """An expression as a value; what has effects is emitted before."""
    lowering = EXPRESSIONS.get(node.type)
    if lowering is None or node.is_missing:
        raise Unlowered(f"no lowering of {node.type.replace('_', ' ')}")
    return lowering(context, node)


def lower_statement(context: Context, node: Node) -> None:
    """A statement, emitted; one that has no lowering as `Unsupported`."""
    lowering = STATEMENTS.get(node.type)
    mark = len(context.out)
    try:
        if lowering is None:
            raise Unlowered(f"no lowering of {node.type.replace('_', ' ')}")
        lowering(context, node)
    except Unlowered as error:
        del context.out[mark:]
        context.emit(unsupported(context, node, str(error)))


def unsupported(
    context: Context, node: Node, reason: str, target: e.Lvalue | None = None
) -> s.Unsupported:
    """What a node names, as read and written: anything may be done to it."""
    found: dict[e.Expression, None] = {}
    if context.this is not None:
        found[context.this] = None
    for name in inside(node, "identifier"):
        value = context.local(text_of(name))
        if value is not None:
            found[value.expression] = None
    names = tuple(found)
    written = tuple(n for n in names if isinstance(n, e.Lvalue))
    return s.Unsupported(reason, names, written, target, context.place(node))


def full_value(context: Context, node: Node) -> Value:
    """The value of an expression of which another statement uses the value; never `Unlowered`."""
    mark = len(context.out)
    try:
        return lower_value(context, node)
    except Unlowered as error:
        del context.out[mark:]
        target = context.temporary(t.UNKNOWN, context.place(node))
        context.emit(unsupported(context, node, str(error), target))
        return Value(target, t.UNKNOWN)
