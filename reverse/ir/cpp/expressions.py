"""Expressions of C++ ([expr]): literals, operators, subscripts, conditions, commas."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp import literals
from rebsync.reverse.ir.cpp.context import (
    Context,
    Unlowered,
    Value,
    lower_value,
    lowers_expression,
)
from rebsync.reverse.ir.cpp.conversions import common_type, is_arithmetic
from rebsync.reverse.ir.cpp.functions_called import call_function
from rebsync.reverse.ir.cpp.library import of_element
from rebsync.reverse.ir.cpp.names import function_value, pointed
from rebsync.reverse.ir.cpp.objects import (
    address,
    as_value,
    class_of,
    default_constructed,
    default_value,
    dereferenced,
    implicitly,
)
from rebsync.reverse.ir.cpp.operators import binary, unary
from rebsync.reverse.ir.cpp.sequencing import in_any_order, in_order
from rebsync.reverse.ir.cpp.symbols import ClassSymbol
from rebsync.reverse.ir.cpp.types import SIZE, STRING
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.source import Span

_DURATIONS = {
    **{"h": "hours", "min": "minutes", "s": "seconds", "ms": "milliseconds"},
    **{"us": "microseconds", "ns": "nanoseconds"},
}


def truth(context: Context, node: Node) -> e.Expression:
    """A condition ([stmt.select]): contextually converted to `bool`."""
    place = context.place(node)
    return implicitly(context, lower_value(context, node), t.TRUTH, place).expression


# --- literals -------------------------------------------------------------------------------------


@lowers_expression("number_literal")
def number(context: Context, node: Node) -> Value:
    """A number."""
    return _literal(literals.number(text_of(node), context.place(node)))


@lowers_expression("char_literal")
def character(context: Context, node: Node) -> Value:
    """A character."""
    return _literal(literals.character(text_of(node), context.place(node)))


@lowers_expression("string_literal", "raw_string_literal")
def string(context: Context, node: Node) -> Value:
    """A text."""
    return _literal(literals.string(text_of(node), context.place(node)))


@lowers_expression("user_defined_literal")
def user_defined(context: Context, node: Node) -> Value:
    """`500ms`: a call of the literal operator of that suffix."""
    place, inner = context.place(node), named(node)
    suffix = text_of(node)[len(text_of(inner[0])) :] if inner else ""
    if suffix not in _DURATIONS:
        return _literal_operator(context, suffix, inner, place)
    value = lower_value(context, inner[0])
    type_ = t.Record(f"std::chrono::{_DURATIONS[suffix]}")
    target = context.temporary(type_, place)
    callee = s.LibraryCallee(f'std::literals::operator""{suffix}')
    context.emit(s.Call(target, callee, (s.CallArgument(value.expression),), place))
    return Value(target, type_)


def _literal_operator(context: Context, suffix: str, inner: Sequence[Node], place: Span) -> Value:
    """A call of a literal operator of the program ([over.literal])."""
    path = context.cpp.source.path
    names = (f'operator""{suffix}', f'operator"" {suffix}')
    named_so = (context.world.symbols.functions_named(n, context.scope, path) for n in names)
    found = next(filter(None, named_so), [])
    if len(found) != 1 or len(inner) != 2 or len(found[0].code.parameters) != 1:
        raise Unlowered("a literal with a suffix that is not known")
    return call_function(context, found[0], inner[:1], place)


@lowers_expression("concatenated_string")
def concatenated(context: Context, node: Node) -> Value:
    """Texts that follow each other."""
    pieces = [literals.string(text_of(child), context.place(child)) for child in named(node)]
    if None in pieces:
        raise Unlowered("a text made by a macro")
    joined = "".join(str(p.value) for p in pieces if p is not None)
    return Value(e.Literal(joined, STRING, text_of(node), context.place(node)), STRING)


def _literal(found: e.Literal | None) -> Value:
    if found is None:
        raise Unlowered("a literal of a type that the form does not have")
    return Value(found, found.type)


@lowers_expression("true", "false")
def boolean(context: Context, node: Node) -> Value:
    """A truth."""
    return Value(e.Literal(node.type == "true", t.TRUTH, node.type, context.place(node)), t.TRUTH)


@lowers_expression("null", "nullptr")
def null(context: Context, node: Node) -> Value:
    """The null pointer."""
    return Value(e.Literal(None, t.NOTHING, text_of(node), context.place(node)), t.NOTHING)


@lowers_expression("parenthesized_expression")
def parenthesized(context: Context, node: Node) -> Value:
    """What is between parentheses."""
    inner = named(node)
    if len(inner) != 1:
        raise Unlowered("parentheses around other than one expression")
    return lower_value(context, inner[0])


# --- operators ------------------------------------------------------------------------------------


@lowers_expression("binary_expression")
def binary_expression(context: Context, node: Node) -> Value:
    """Two operands and a sign."""
    sign, place = context.cpp.operator(node), context.place(node)
    left, right = part(node, "left"), part(node, "right")
    if sign in ("&&", "||", "and", "or"):
        return _short_circuit(context, sign in ("&&", "and"), left, right, place)
    kinds: list[Value] = []

    def operand(side: Node) -> Callable[[], Value]:
        def lowered() -> Value:
            value = lower_value(context, side)
            kinds.append(value)
            if class_of(context, value.type) is not None and value.is_lvalue:
                return Value(address(context, value, place), value.type)
            return Value(value.expression, value.type)

        return lowered

    order = in_order if sign in ("<<", ">>", "<=>") else in_any_order
    found = order(context, [operand(left), operand(right)], place)
    values = [_again(v, x, place) for v, x in zip(kinds, found, strict=True)]
    called = context.world.operator(context, f"operator{sign}", values, place)
    if called is not None:
        return called
    return binary(sign, values[0], values[1], place)


def _again(value: Value, found: e.Expression, place: Span) -> Value:
    """An operand as it is after its order was settled: of an object the address was taken."""
    if isinstance(found, e.AddressOf) and value.is_lvalue:
        return value
    if value.is_lvalue and found is not value.expression:
        is_address = isinstance(value.type, t.Record)
        return dereferenced(found, value.type, place) if is_address else Value(found, value.type)
    return Value(found, value.type, value.is_lvalue)


def _short_circuit(context: Context, is_and: bool, left: Node, right: Node, place: Span) -> Value:
    """`&&` and `||`: the right operand is evaluated only where it counts ([expr.log.and])."""
    first = truth(context, left)
    with context.body() as body:
        second = truth(context, right)
    if not body:
        kind = e.And if is_and else e.Or
        return Value(kind(first, second, t.TRUTH, False, place), t.TRUTH)
    target = context.temporary(t.TRUTH, place)
    body.append(s.Assign(target, second, place))
    test = target if is_and else e.Unary(Operator.NOT, target, t.TRUTH, False, place)
    context.emit(s.Assign(target, first, place), s.If(test, tuple(body), (), False, place))
    return Value(target, t.TRUTH)


@lowers_expression("unary_expression")
def unary_expression(context: Context, node: Node) -> Value:
    """A sign before an operand."""
    sign, place = context.cpp.operator(node), context.place(node)
    value = lower_value(context, part(node, "argument"))
    name = f"operator{'!' if sign == 'not' else sign}"
    called = context.world.operator(context, name, [value], place)
    return unary(context, sign, value, place) if called is None else called


@lowers_expression("pointer_expression")
def pointer_expression(context: Context, node: Node) -> Value:
    """`*p` and `&x`; `&C::f` is a function."""
    argument, place = part(node, "argument"), context.place(node)
    if context.cpp.operator(node) == "&":
        return address_of(context, argument, place)
    value = lower_value(context, argument)
    if class_of(context, value.type) is not None:
        called = context.world.operator(context, "operator*", [value], place)
        if called is None:
            raise Unlowered("an object that leads nowhere")
        return called
    return pointed(context, value, place)


def address_of(context: Context, argument: Node, place: Span) -> Value:
    """`&x`."""
    if argument.type == "qualified_identifier":
        text = "".join(text_of(argument).split())
        outer, _, last = text.rpartition("::")
        owner = context.world.symbols.type_named(outer, context.scope, context.cpp.source.path)
        if isinstance(owner, ClassSymbol):
            return _method_value(context, owner, last, place)
    value = lower_value(context, argument)
    if isinstance(value.type, t.FunctionType) and not value.is_lvalue:
        return value
    if not value.is_lvalue:
        raise Unlowered("the address of a value")
    type_ = t.Reference(value.type, may_be_null=True)
    return Value(address(context, value, place), type_)


def _method_value(context: Context, owner: ClassSymbol, name: str, place: Span) -> Value:
    for class_ in context.world.symbols.lineage(owner.name):
        found = [f for f in class_.functions if f.simple == name]
        if len(found) == 1:
            return function_value(context, found[0].name, place)
        if found:
            raise Unlowered("the address of an overloaded member function")
        if any(f.name == name and f.is_static for f in class_.fields):
            attribute = e.Attribute(e.ClassReference(class_.name), name, t.UNKNOWN, False, place)
            return Value(e.AddressOf(attribute, t.UNKNOWN, place), t.UNKNOWN)
    raise Unlowered("the address of a member that is not known")


@lowers_expression("comma_expression")
def comma(context: Context, node: Node) -> Value:
    """The left operand for what it does, then the right one; or the operator of a class."""
    left = discarded(context, part(node, "left"))
    right = lower_value(context, part(node, "right"))
    return context.world.operator(context, "operator,", [left, right], context.place(node)) or right


def discarded(context: Context, node: Node) -> Value:
    """An expression for what it does ([expr.context])."""
    value = lower_value(context, node)
    found = value.expression
    is_silent = isinstance(found, e.Literal | e.Lvalue) and not _may_run(found)
    if not is_silent:
        context.emit(s.Evaluate(found, context.place(node)))
    return value


def _may_run(expression: e.Expression) -> bool:
    for inner in walk(expression):
        match inner:
            case e.Binary() | e.Index(checked=True):
                return True
            case e.Dereference(of) if isinstance(getattr(of, "type", None), t.Optional):
                return True  # `x.value();` throws where there is none
            case _:
                pass
    return isinstance(expression, e.Attribute | e.Index | e.Dereference) and expression.dynamic


@lowers_expression("conditional_expression")
def conditional(context: Context, node: Node) -> Value:
    """`a ? b : c`: only one of `b` and `c` is evaluated, both become one type ([expr.cond])."""
    place = context.place(node)
    test = truth(context, part(node, "condition"))
    sides = part(node, "consequence"), part(node, "alternative")
    with context.body() as then:
        first = lower_value(context, sides[0])
    with context.body() as otherwise:
        second = lower_value(context, sides[1])
    both = first.is_lvalue and second.is_lvalue and first.type == second.type
    is_object = isinstance(first.type, t.Record | t.Container | t.Array | t.RosMessage)
    if both and is_object:
        type_: t.Type = t.Reference(first.type)
        with context.within(then):
            one = address(context, first, place)
        with context.within(otherwise):
            other = address(context, second, place)
        found = _chosen(context, test, (then, one), (otherwise, other), type_, place)
        return dereferenced(found, first.type, place)
    type_ = _common(first.type, second.type)
    with context.within(then):
        one = as_value(context, implicitly(context, first, type_, place), place)
    with context.within(otherwise):
        other = as_value(context, implicitly(context, second, type_, place), place)
    return Value(_chosen(context, test, (then, one), (otherwise, other), type_, place), type_)


def _common(first: t.Type, second: t.Type) -> t.Type:
    if first == second:
        return first
    if all(is_arithmetic(x) or isinstance(x, t.Enumeration) for x in (first, second)):
        return common_type(first, second)
    if t.UNKNOWN in (first, second):
        return t.UNKNOWN
    return second if first == t.NOTHING else first


def _chosen(
    context: Context,
    test: e.Expression,
    then: tuple[list[s.Statement], e.Expression],
    otherwise: tuple[list[s.Statement], e.Expression],
    type_: t.Type,
    place: Span,
) -> e.Expression:
    if not then[0] and not otherwise[0] and type_ != t.NOTHING:
        return e.Conditional(test, then[1], otherwise[1], type_, False, place)
    target = context.temporary(type_, place)
    bodies = [
        (*body, *(() if type_ == t.NOTHING else (s.Assign(target, value, place),)))
        for body, value in (then, otherwise)
    ]
    context.emit(s.If(test, bodies[0], bodies[1], False, place))
    return e.Literal(None, t.NOTHING, place=place) if type_ == t.NOTHING else target


# --- elements -------------------------------------------------------------------------------------


@lowers_expression("subscript_expression")
def subscript(context: Context, node: Node) -> Value:
    """`a[i]`; in a map it makes the element if there is none."""
    place = context.place(node)
    indices = named(part(node, "indices"))
    if len(indices) != 1 or indices[0].type == "initializer_list":
        raise Unlowered("a subscript with other than one index")
    of = lower_value(context, part(node, "argument"))
    index = lower_value(context, indices[0])
    return element(context, of, index, place)


def element(context: Context, of: Value, index: Value, place: Span) -> Value:
    """An element of a container, text, array or object with an operator for that."""
    match of.type:
        case t.Container(t.ContainerKind.MAPPING, (key, type_)):
            return _entry(context, of, implicitly(context, index, key, place), type_, place)
        case t.Container(t.ContainerKind.SEQUENCE, (type_,)) | t.Array(type_, _):
            return _element(context, of, index, type_, place)
        case t.Text():
            return _element(context, of, index, t.Integer(8), place)
        case t.Record(name) if name in context.world.symbols.classes:
            called = context.world.operator(context, "operator[]", [of, index], place)
            if called is None:
                raise Unlowered("an element of an object without an operator for that")
            return called
        case t.Reference():
            # What the pointer leads into is not known: any element of it.
            found = e.Index(of.expression, index.expression, of.type.to, True, False, False, place)
            return Value(found, of.type.to, is_lvalue=True)
        case _:
            type_ = of_element(of.type)
            found = e.Index(of.expression, index.expression, type_, True, False, False, place)
            return Value(found, type_, is_lvalue=True)


def _element(context: Context, of: Value, index: Value, type_: t.Type, place: Span) -> Value:
    if isinstance(index.type, t.Integer):
        at = index.expression
    else:
        at = implicitly(context, index, SIZE, place).expression
    is_dynamic = not isinstance(index.type, t.Integer | t.Enumeration | t.Truth)
    found = e.Index(of.expression, at, type_, is_dynamic, False, False, place)
    return Value(found, type_, of.is_lvalue)


def _entry(context: Context, of: Value, key: Value, type_: t.Type, place: Span) -> Value:
    at = key.expression
    if not isinstance(at, e.Literal | e.Temporary):
        at = context.stored(as_value(context, key, place), key.type, place)
    found = e.Index(of.expression, at, type_, False, False, False, place)
    lacks = e.Binary(Operator.NOT_IN, at, of.expression, t.TRUTH, False, place)
    with context.body() as body:
        value = default_value(context, type_, place)
        if value is not None:
            context.emit(s.Assign(found, value, place))
        else:
            made = context.temporary(type_, place)
            default_constructed(context, made, type_, place)
            context.emit(s.Assign(found, made, place))
    context.emit(s.If(lacks, tuple(body), (), False, place))
    return Value(found, type_, is_lvalue=True)
