"""Lambdas ([expr.prim.lambda]): closures with what they capture by value and by reference."""

from __future__ import annotations

import dataclasses
from dataclasses import field, replace
from typing import Any

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.context import (
    Context,
    LambdaCaptures,
    Unlowered,
    Value,
    lower_value,
    lowers_expression,
)
from rebsync.reverse.ir.cpp.functions import body_of, bound_parameters
from rebsync.reverse.ir.cpp.objects import as_value
from rebsync.reverse.ir.cpp.types import Declared, ReferenceKind
from rebsync.reverse.ir.program import Function, Parameter
from rebsync.reverse.syntax.cpp_declarations import parameters_in
from rebsync.reverse.syntax.cpp_exceptions import is_noexcept
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.source import Span


@dataclass(slots=True)
class _Capturing:
    """What a lambda captures: how by default, and what it was said or found to take."""

    enclosing: Context
    place: Span
    default: str
    explicit: dict[str, bool]
    initial: dict[str, Value]
    taken: dict[str, e.Capture] = field(default_factory=dict)
    values: dict[str, Value] = field(default_factory=dict)

    def value_of(self, context: Context, name: str) -> Value | None:
        """What a name of the function around means within the lambda."""
        if name not in self.values:
            found = self.initial.get(name)
            by_reference = False
            if found is None:
                found = self.enclosing.local(name)
                by_reference = self.explicit.get(name, self.default == "&")
            if found is None:
                return None
            is_listed = bool(self.default) or name in self.initial or name in self.explicit
            if not is_listed and not isinstance(found.expression, e.Literal | e.Global):
                raise Unlowered("a variable that a lambda does not capture")
            self.values[name] = self._captured(found, name, by_reference or name == "this")
        return self.values[name]

    def _captured(self, found: Value, name: str, by_reference: bool) -> Value:
        """A variable as the lambda sees it; by value what a reference leads to is copied."""
        expression = found.expression
        is_shared = isinstance(expression, e.Local | e.Captured | e.Global | e.Literal)
        if name not in self.initial and not by_reference and not is_shared:
            found = copied(self.enclosing, name, found, self.place)
        local = found.expression
        is_alias = isinstance(local, e.Local) and local.name in self.enclosing.aliases
        if is_alias and not by_reference:
            found = copied(self.enclosing, name, found, self.place)
        return Value(self._within(found.expression, by_reference), found.type, found.is_lvalue)

    def _within(self, expression: e.Expression, by_reference: bool) -> e.Expression:
        match expression:
            case e.Local(name, type_, place):
                self._take(name, expression, by_reference)
                return e.Captured(self.enclosing.name, name, type_, place)
            case e.Captured(function, name):
                self._take(f"{function}^{name}", expression, by_reference)
                return expression
            case e.Temporary():
                raise Unlowered("a lambda that captures a temporary")
            case e.Dereference() | e.Attribute() | e.Index() | e.AddressOf():
                return self._parts(expression)
            case _:
                return expression

    def _parts(self, expression: e.Expression) -> e.Expression:
        changed: Any = {
            f.name: self._within(inner, by_reference=False)
            for f in dataclasses.fields(expression)
            if f.name in ("object", "reference", "index", "target")
            and (inner := getattr(expression, f.name)) is not None
        }
        return replace(expression, **changed)

    def _take(self, key: str, variable: e.Local | e.Captured, by_reference: bool) -> None:
        known = self.taken.get(key)
        if known is None or by_reference:
            self.taken[key] = e.Capture(variable, by_reference)
        if by_reference and isinstance(variable, e.Local):
            self.enclosing.shared.add(variable.name)


def copied(context: Context, name: str, value: Value, place: Span) -> Value:
    """A new variable with a copy of a value, for a lambda to take."""
    local = e.Local(context.unique(name), value.type, place)
    copy = as_value(context, value, place)
    context.emit(s.Declare(local, value.type, copy, place))
    return Value(local, value.type, is_lvalue=True)


@lowers_expression("lambda_expression")
def lambda_expression(context: Context, node: Node) -> Value:
    """`[captures](parameters) { body }`: a new closure."""
    place = context.place(node)
    if any(c.type in ("template_parameter_list", "ERROR") for c in node.children):
        raise Unlowered("a lambda that is a template")
    capturing = _captures(context, part(node, "captures"), place)
    inner = Context(
        context.world,
        context.cpp,
        _name(context, node),
        context.scope,
        owner=context.owner,
        enclosing=context,
        captures=LambdaCaptures(capturing.value_of),
        exposed=context.exposed,
        lambdas=context.lambdas,
    )
    inner.result = _result(context, node)
    parameters = _parameters(inner, node)
    if context.local("this") is not None and (capturing.default or "this" in capturing.explicit):
        this = capturing.value_of(inner, "this")
        inner.this = None if this is None else this.expression
    body = body_of(inner, part(node, "body"))
    result = _deduced(inner)
    types = tuple(p.type for p in parameters)
    form = t.FunctionType(types, result.form)
    function = Function(
        inner.name,
        parameters,
        body,
        result.form,
        captured=frozenset(inner.shared),
        place=place,
        noexcept=is_noexcept(node),
    )
    context.closures += [*inner.closures, function]
    return Value(e.Closure(inner.name, tuple(capturing.taken.values()), (), form, place), form)


def _name(context: Context, node: Node) -> str:
    name = context.lambdas.get(node.id)
    if name is None:
        raise Unlowered("a lambda in a place of its own")
    return name


def _deduced(context: Context) -> Declared:
    """The type of what a lambda without a result type returns."""
    if context.result is not None:
        return context.result
    kinds = set(context.returned)
    if not kinds:
        return Declared(t.NOTHING)
    return Declared(kinds.pop() if len(kinds) == 1 else t.UNKNOWN)


def _result(context: Context, node: Node) -> Declared | None:
    declarator = node.child_by_field_name("declarator")
    for child in declarator.children if declarator is not None else ():
        if child.type == "trailing_return_type" and child.named_children:
            return context.world.types.descriptor(
                context.cpp, context.scope, child.named_children[0]
            )
    return None


def _parameters(context: Context, node: Node) -> tuple[Parameter, ...]:
    declarator = node.child_by_field_name("declarator")
    list_ = declarator.child_by_field_name("parameters") if declarator is not None else None
    found: list[tuple[str, Declared]] = []
    for parameter in parameters_in(list_) if list_ is not None else ():
        declared = context.world.types.declared(
            context.cpp,
            context.scope,
            parameter.type,
            parameter.node.child_by_field_name("declarator"),
        )
        if "auto" in text_of(parameter.type).split() and declared.type == t.UNKNOWN:
            is_value = declared.reference is ReferenceKind.NONE
            declared = Declared(t.UNKNOWN) if is_value else declared
        found.append((parameter.name, declared))
    return bound_parameters(context, found, context.place(node))


def _captures(context: Context, node: Node, place: Span) -> _Capturing:
    """`[&, x, y = 3, this]`."""
    found = _Capturing(context, place, "", {}, {})
    by_reference = False
    for child in node.children:
        match child.type:
            case "lambda_default_capture":
                found.default = text_of(child)
            case "&":
                by_reference = True
                continue
            case "identifier":
                found.explicit[text_of(child)] = by_reference
            case "this":
                found.explicit["this"] = True
            case "*" | "ERROR" | "...":
                raise Unlowered("a capture of the object by value")
            case "lambda_capture_initializer":
                _initial(context, found, child, by_reference)
        by_reference = False
    return found


def _initial(context: Context, found: _Capturing, node: Node, by_reference: bool) -> None:
    """`[x = value]`: a variable of the closure's own."""
    names = named(node)
    name = text_of(part(node, "left"))
    if by_reference or text_of(node).startswith("&") or len(names) != 2:
        raise Unlowered("a reference that a capture makes")
    value = lower_value(context, part(node, "right"))
    found.initial[name] = copied(context, name, value, context.place(node))
