"""Assignments ([expr.ass]) and increments: what is stored, converted to the type of the place."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.context import (
    Context,
    Unlowered,
    Value,
    lower_value,
    lowers_expression,
)
from rebsync.reverse.ir.cpp.initialisation import initialised
from rebsync.reverse.ir.cpp.objects import (
    address,
    as_value,
    assigned_memberwise,
    class_of,
    dereferenced,
    implicitly,
)
from rebsync.reverse.ir.cpp.operators import ARITHMETIC, binary, is_built_in
from rebsync.reverse.ir.cpp.sequencing import in_any_order
from rebsync.reverse.ir.cpp.types import INT
from rebsync.reverse.syntax.cpp_tree import part, text_of
from rebsync.source import Span


@lowers_expression("assignment_expression")
def assignment(context: Context, node: Node) -> Value:
    """`a = b` and `a += b`; gives the place that was assigned."""
    sign, place = text_of(part(node, "operator")), context.place(node)
    left, right = part(node, "left"), part(node, "right")
    target: list[Value] = []
    source: list[Value] = []

    def assigned() -> Value:
        target.append(lower_value(context, left))
        if not target[0].is_lvalue:
            target[0] = _given(target[0], place)
        return Value(address(context, target[0], place), t.Reference(target[0].type))

    def value() -> Value:
        if right.type == "initializer_list":
            made = context.temporary(target[0].type, place)
            initialised(context, made, target[0].type, right)
            source.append(Value(made, target[0].type))
        else:
            source.append(lower_value(context, right))
        if sign == "=" and is_built_in(target[0].type) and is_built_in(source[0].type):
            source[0] = implicitly(context, source[0], target[0].type, place)
        return Value(source[0].expression, source[0].type)

    found = in_any_order(context, [assigned, value], place)
    to = dereferenced(found[0], target[0].type, place)
    from_ = source[0]
    if found[1] is not from_.expression:
        from_ = Value(found[1], from_.type)
    if sign == "=":
        return assign(context, to, from_, place)
    return compound(context, sign.removesuffix("="), to, from_, place)


def _given(value: Value, place: Span) -> Value:
    """The object that a call of a library gives a reference to, as `m(0)` of a matrix."""
    if value.type != t.UNKNOWN:
        raise Unlowered("an assignment to no object that is known")
    return dereferenced(value.expression, t.UNKNOWN, place)


def assign(context: Context, to: Value, value: Value, place: Span) -> Value:
    """Stores a value in an object, as its class does that."""
    owner = class_of(context, to.type)
    if owner is not None:
        called = context.world.operator(context, "operator=", [to, value], place)
        if called is not None:
            return called
        value = implicitly(context, value, to.type, place)
        assigned_memberwise(context, owner, to.expression, value, place)
        return to
    target = to.expression
    if not isinstance(target, e.Lvalue):
        raise Unlowered("an assignment to no object that is known")
    found = as_value(context, implicitly(context, value, to.type, place), place)
    context.emit(s.Assign(target, found, place))
    return to


def compound(context: Context, sign: str, to: Value, value: Value, place: Span) -> Value:
    """`a += b`: the operation in the common type, its result in the type of the place."""
    called = context.world.operator(context, f"operator{sign}=", [to, value], place)
    if called is not None:
        return called
    target = to.expression
    if not isinstance(target, e.Lvalue):
        raise Unlowered("an assignment to no object that is known")
    if not (is_built_in(to.type) and is_built_in(value.type)):
        operator = ARITHMETIC[sign]
        context.emit(s.CompoundAssign(target, operator, value.expression, True, place))
        return to
    result = binary(sign, Value(to.expression, to.type), value, place)
    same = isinstance(result.expression, e.Binary) and result.type == to.type
    if same and isinstance(result.expression, e.Binary) and result.expression.left == target:
        operator, right = result.expression.operator, result.expression.right
        context.emit(s.CompoundAssign(target, operator, right, False, place))
    else:
        stored = implicitly(context, result, to.type, place).expression
        context.emit(s.Assign(target, stored, place))
    return to


@lowers_expression("update_expression")
def update(context: Context, node: Node) -> Value:
    """`++a` gives the place, `a++` the value before."""
    place, argument = context.place(node), part(node, "argument")
    sign = text_of(part(node, "operator"))
    is_prefix = node.children[0].type == sign
    to = lower_value(context, argument)
    arguments = [to] if is_prefix else [to, Value(e.Literal(0, INT, place=place), INT)]
    called = context.world.operator(context, f"operator{sign}", arguments, place)
    if called is not None:
        return called
    if not to.is_lvalue:
        to = _given(to, place)
    if not isinstance(to.type, t.Integer | t.Float | t.Reference):
        return _of_library(context, sign, to, is_prefix, place)
    before = None
    if not is_prefix and not _is_discarded(node):
        before = context.temporary(to.type, place)
        context.emit(s.Assign(before, to.expression, place))
    one = Value(e.Literal(1, INT, place=place), INT)
    changed = compound(context, sign[0], to, one, place)
    return changed if before is None else Value(before, to.type)


def _is_discarded(node: Node) -> bool:
    """Whether nothing looks at the value."""
    parent = node.parent
    if parent is None:
        return False
    if parent.type == "for_statement":
        return parent.child_by_field_name("condition") != node
    return parent.type == "expression_statement"


def _of_library(context: Context, sign: str, to: Value, is_prefix: bool, place: Span) -> Value:
    """An iterator, or what is not known."""
    target = context.temporary(t.UNKNOWN, place)
    argument = s.CallArgument(address(context, to, place))
    callee = s.LibraryCallee(f"operator{sign}")
    context.emit(s.Call(target, callee, (argument,), place))
    return to if is_prefix else Value(target, t.UNKNOWN)
