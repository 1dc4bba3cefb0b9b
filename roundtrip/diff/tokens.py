"""Trees in which a name stands for the element it refers to, so that two models compare by `==`.

What a depth leaves out is not in the trees: parentheses, blocks and empty statements without
meaning, casts to the type that a value has, `self.` before what is one's own.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field, fields, replace
from typing import TypeVar, cast

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import Depth
from rebsync.roundtrip.diff.operands import Operand, is_unreadable
from rebsync.static.constants import constant
from rebsync.static.symbols import (
    BuiltinFunctionSymbol,
    BuiltinSymbol,
    KnownRebecSymbol,
    MethodSymbol,
    ServerSymbol,
    StateSymbol,
)

_Node = TypeVar("_Node")
_OWN = (StateSymbol, KnownRebecSymbol)


@dataclass(frozen=True, slots=True, eq=False)
class ElementNames:
    """What elements are called in the comparison.

    `declared` goes by the `id` of declarations, `classes` by name; what is in neither keeps its
    name.
    """

    declared: Mapping[int, str] = field(default_factory=dict)
    classes: Mapping[str, str] = field(default_factory=dict)


@dataclass(slots=True, eq=False)
class Tokens:
    """Makes the trees of one side; `origin` leads from them back to what is written."""

    side: Operand
    names: ElementNames
    bare: bool = False  # whether parentheses are left out that the order of operators makes plain
    locals: Mapping[int, str] = field(default_factory=dict)
    origin: dict[int, object] = field(default_factory=dict)
    kept: list[object] = field(default_factory=list)  # so that no `id` is used again

    def of(self, node: _Node) -> _Node:
        """The tree of a node."""
        made = self._made(node)
        self.origin[id(made)] = node
        self.kept.append(made)
        return cast("_Node", made)

    def written(self, made: _Node) -> _Node:
        """What a tree was made from."""
        return cast("_Node", self.origin.get(id(made), made))

    def list_of(self, statement: m.Statement | None) -> tuple[m.Statement, ...]:
        """The statements of a body or branch."""
        if statement is None:
            return ()
        if isinstance(statement, m.Block) and not statement.annotations:
            return self._statements(statement.statements)
        return self._statements((statement,))

    def class_name(self, name: str) -> str:
        """What a class is called."""
        return self.names.classes.get(name, name)

    @property
    def _folds(self) -> bool:
        return self.side.depth is Depth.EQUAL

    def _made(self, node: object) -> object:
        match node:
            case m.Paren(inner) if self._folds or self.bare:
                return self._copy(self.of(inner))
            case m.Cast(type_, inner) if self._folds and self._is_of(inner, type_):
                return self._copy(self.of(inner))
            case m.Name():
                return replace(node, name=self._referred(node, node.name))
            case m.Member(m.Self()) if self._folds and isinstance(self._symbol(node), _OWN):
                return m.Name(self._referred(node, node.name))
            case m.Member():
                return replace(self._parts(node), name=self._referred(node, node.name))
            case m.Call():
                return self._call(node)
            case m.Type():
                return replace(node, name=self.class_name(node.name))
            case m.Declarator() | m.Parameter():
                made = self._parts(node)
                return replace(made, name=self.locals.get(id(node), node.name))
            case m.FloatLiteral(text) if self._folds:
                return m.FloatLiteral(_number(text))
            case m.If(otherwise=m.Block(inner, annotations=())) if self._folds and not inner:
                return self._made(replace(node, otherwise=None))
            case m.If(otherwise=m.Block((m.If() as inner,), annotations=())) if self._folds:
                return self._made(replace(node, otherwise=inner))
            case m.ExpressionStatement(value) if self._folds:
                return self._parts(replace(node, expression=_step(value)))
            case m.Block() | m.Case():
                return replace(self._parts(node), statements=self._statements(node.statements))
            case m.For() if self._folds:
                return self._parts(replace(node, updates=tuple(map(_step, node.updates))))
            case m.Empty() if is_unreadable(node):
                return m.Empty((m.Annotation(f"{id(self)} {id(node)}"),))  # equal to nothing
            case _:
                return self._parts(node)

    def _is_of(self, expression: m.Expression, type_: m.Type) -> bool:
        """Whether a cast to a type leaves an expression as it is."""
        if isinstance(expression, m.IntLiteral) and type_ == m.Type("int"):
            return constant(expression) == constant(m.Cast(type_, expression))
        known = self.side.analysis.type_of(expression)
        return known is not None and str(known) == str(type_)

    def _symbol(self, node: object) -> object:
        return self.side.analysis.symbol_of(node)

    def _referred(self, node: object, name: str) -> str:
        symbol = self._symbol(node)
        if symbol is None or isinstance(symbol, BuiltinSymbol | BuiltinFunctionSymbol):
            return name
        declaration = id(getattr(symbol, "declaration", None))
        return self.locals.get(declaration) or self.names.declared.get(declaration, name)

    def _call(self, node: m.Call) -> m.Call:
        made = replace(self._parts(node), name=self._referred(node, node.name))
        symbol = self._symbol(node)
        own = isinstance(symbol, ServerSymbol | MethodSymbol) and isinstance(made.target, m.Self)
        return replace(made, target=None) if own and self._folds else made

    def _parts(self, node: _Node) -> _Node:
        changed: dict[str, object] = {}
        for each in fields(node):  # type: ignore[arg-type]
            value = getattr(node, each.name)
            if not each.compare or (each.name == "statements"):
                continue
            if isinstance(value, tuple):
                changed[each.name] = tuple(
                    self.of(v) if hasattr(v, "__dataclass_fields__") else v for v in value
                )
            elif hasattr(value, "__dataclass_fields__"):
                changed[each.name] = self.of(value)
        return replace(node, **changed)  # type: ignore[type-var]

    def _copy(self, node: _Node) -> _Node:
        return replace(node)  # type: ignore[type-var]

    # --- statements -----------------------------------------------------------------------------

    def _statements(self, statements: tuple[m.Statement, ...]) -> tuple[m.Statement, ...]:
        if not self._folds:
            return tuple(self.of(s) for s in statements)
        return tuple(self.of(s) for s in _flat(statements))


def _step(expression: m.Expression) -> m.Expression:
    """A step up or down whose value nobody takes, told in one way."""
    match expression:
        case m.Paren(inner):
            return _step(inner)
        case m.Unary("++" | "--" as sign, inner):
            return m.Postfix(sign, inner, expression.span)
        case _:
            return expression


def _flat(statements: tuple[m.Statement, ...]) -> Iterator[m.Statement]:
    """Without blocks that declare nothing, and a declaration for each local."""
    for statement in statements:
        match statement:
            case m.Empty(annotations=()):
                continue
            case m.Block(inner, annotations=()) if not any(isinstance(s, m.Local) for s in inner):
                yield from _flat(inner)
            case m.Local(declaration) if len(declaration.declarators) > 1:
                for one in declaration.declarators:
                    yield replace(statement, declaration=replace(declaration, declarators=(one,)))
            case _:
                yield statement


def _number(text: str) -> str:
    """One spelling for a number, and the letter that says its type."""
    digits = text.replace("_", "").lower()
    suffix = digits[-1] if digits[-1] in "fd" else ""
    return repr(float(digits.rstrip("fd"))) + suffix
