"""Call expressions of C++: which function, method, class, value or library a call means."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from tree_sitter import Node

from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.alternatives import call_chosen
from rebsync.reverse.ir.cpp.casts import NAMED_CASTS, cast, named_cast
from rebsync.reverse.ir.cpp.classes import find_member, methods_named
from rebsync.reverse.ir.cpp.context import (
    Context,
    Unlowered,
    Value,
    lower_value,
    lowers_expression,
)
from rebsync.reverse.ir.cpp.functions_called import (
    argument_values,
    call_function,
    library_arguments,
    stored_result,
)
from rebsync.reverse.ir.cpp.initialisation import by_arguments, initialised
from rebsync.reverse.ir.cpp.library import function_result, is_pure
from rebsync.reverse.ir.cpp.macros import expanded
from rebsync.reverse.ir.cpp.methods import library_method
from rebsync.reverse.ir.cpp.names import field_of, object_of, this_object
from rebsync.reverse.ir.cpp.objects import as_value, class_of, ended_later, locked, passed
from rebsync.reverse.ir.cpp.sequencing import in_any_order
from rebsync.reverse.ir.cpp.standard_functions import STANDARD
from rebsync.reverse.ir.cpp.symbols import ClassSymbol, FunctionSymbol
from rebsync.reverse.ir.cpp.types import AUTO, Declared, ReferenceKind
from rebsync.reverse.ir.dump_types import dump_type
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.reverse.syntax.macros import hides
from rebsync.source import Span


@lowers_expression("call_expression")
def call_expression(context: Context, node: Node) -> Value:
    """A call of whatever stands before the parentheses."""
    function, place = part(node, "function"), context.place(node)
    arguments = part(node, "arguments")
    nodes = named(arguments)
    if arguments.type == "initializer_list":
        return _functional_cast(context, function, nodes, place)
    match function.type:
        case "identifier":
            return _named(context, function, nodes, place)
        case "qualified_identifier" | "template_function":
            return _qualified(context, function, nodes, place)
        case "field_expression":
            return _method(context, function, nodes, place)
        case "primitive_type" | "sized_type_specifier" | "template_type":
            return _functional_cast(context, function, nodes, place)
        case _:
            return call_value(context, lower_value(context, function), nodes, place)


@lowers_expression("compound_literal_expression")
def compound_literal(context: Context, node: Node) -> Value:
    """`T{a, b}`."""
    type_ = context.world.types.of(context.cpp, context.scope, part(node, "type"))
    return _made(context, type_, [part(node, "value")], context.place(node), in_braces=True)


def _functional_cast(
    context: Context, type_node: Node, nodes: Sequence[Node], place: Span
) -> Value:
    """`T(a, b)` ([expr.type.conv])."""
    type_ = context.world.types.of(context.cpp, context.scope, type_node)
    return _construction(context, type_, nodes, place)


def _construction(context: Context, type_: t.Type, nodes: Sequence[Node], place: Span) -> Value:
    is_object = isinstance(type_, t.Container | t.Record | t.RosMessage | t.Unknown)
    if len(nodes) == 1 and not is_object:
        return cast(context, lower_value(context, nodes[0]), Declared(type_), place)
    return _made(context, type_, nodes, place, in_braces=False)


def _made(
    context: Context, type_: t.Type, nodes: Sequence[Node], place: Span, in_braces: bool
) -> Value:
    target = context.temporary(type_, place)
    if in_braces:
        initialised(context, target, type_, nodes[0])
    else:
        by_arguments(context, target, type_, nodes, place)
    ended_later(context, target, type_, place)
    return Value(target, type_)


# --- names ----------------------------------------------------------------------------------------


def _named(context: Context, function: Node, nodes: Sequence[Node], place: Span) -> Value:
    """`f(a)`: a variable, a member function, a class or a free function, in this order."""
    name = text_of(function)
    local = context.local(name)
    if local is not None:
        return call_value(context, local, nodes, place)
    if context.owner is not None:
        if methods_named(context.world, context.owner.name, name):
            return _own_method(context, context.owner, name, nodes, place, False)
        if find_member(context.world, context.owner.name, name) is not None:
            return call_value(context, lower_value(context, function), nodes, place)
    return _free(context, function, name, nodes, place)


def _qualified(context: Context, function: Node, nodes: Sequence[Node], place: Span) -> Value:
    """`a::f(x)`, `C::f(x)`, `f<T>(x)`."""
    inner, types = _without_template(function)
    if types and _is_variable(context, inner):
        raise Unlowered("a comparison that looks like a template")
    if inner in NAMED_CASTS:
        return named_cast(context, inner, types, nodes, place)
    outer, _, last = inner.rpartition("::")
    path = context.cpp.source.path
    owner = context.world.symbols.type_named(outer, context.scope, path) if outer else None
    if isinstance(owner, ClassSymbol) and methods_named(context.world, owner.name, last):
        return _own_method(context, owner, last, nodes, place, True)
    return _free(context, function, inner, nodes, place, types)


def _is_variable(context: Context, name: str) -> bool:
    """Whether `a < b > (c)` is no call of a template: `a` is a variable."""
    symbols, path = context.world.symbols, context.cpp.source.path
    is_member = context.owner is not None and find_member(context.world, context.owner.name, name)
    known = context.local(name) is not None or bool(is_member)
    return known or symbols.variable_named(name, context.scope, path) is not None


def _without_template(function: Node) -> tuple[str, list[Node]]:
    """The name of what is called, and the last arguments of templates in it."""
    types: list[Node] = []
    current: Node | None = function
    while current is not None:
        if current.type in ("template_function", "template_method", "template_type"):
            types = named(part(current, "arguments"))
        current = (
            current.child_by_field_name("name") if current.type == "qualified_identifier" else None
        )
    text = "".join(text_of(function).split())
    return (text.partition("<")[0] if types else text), types


def _own_method(
    context: Context,
    owner: ClassSymbol,
    name: str,
    nodes: Sequence[Node],
    place: Span,
    is_qualified: bool,
) -> Value:
    """A member function without an object before it: of `this`, or a static one."""
    candidates = methods_named(context.world, owner.name, name)

    def call(function: FunctionSymbol) -> Value:
        receiver = None if function.is_static else this_object(context)
        return call_function(context, function, nodes, place, receiver, is_qualified)

    return call_chosen(context, candidates, argument_values(context, nodes), call, place)


def _free(
    context: Context,
    function: Node,
    name: str,
    nodes: Sequence[Node],
    place: Span,
    types: Sequence[Node] = (),
) -> Value:
    symbols, path = context.world.symbols, context.cpp.source.path
    found = symbols.functions_named(name, context.scope, path)
    if found:
        values = argument_values(context, nodes)
        return call_chosen(
            context, found, values, lambda f: call_function(context, f, nodes, place), place
        )
    if name in symbols.code.macros:
        return expanded(context, name, nodes, place)
    if hides(name):
        raise Unlowered(f"a macro, {name}")
    symbol = symbols.type_named(name, context.scope, path)
    type_ = context.world.types.of(context.cpp, context.scope, function) if types else t.UNKNOWN
    if symbol is not None or isinstance(type_, t.Container | t.Array | t.Reference):
        type_ = type_ if types else context.world.types.named(context.cpp, context.scope, name)
        return _construction(context, type_, nodes, place)
    if symbols.variable_named(name, context.scope, path) is not None:
        return call_value(context, lower_value(context, function), nodes, place)
    return _library(context, name, nodes, types, place)


def _library(
    context: Context, name: str, nodes: Sequence[Node], types: Sequence[Node], place: Span
) -> Value:
    """A function or class of a library."""
    full = context.world.types.without_alias(context.cpp, context.scope, name)
    full = context.world.types.imported(context.cpp, full)
    known = STANDARD.get(full.removeprefix("boost::").removeprefix("std::"))
    if known is not None and full.startswith(("std::", "boost::")):
        result = known(context, nodes, types, place)
        if result is not None:
            return result
    named_type = context.world.types.named(context.cpp, context.scope, full)
    if not types and not isinstance(named_type, t.Record | t.Unknown):
        return _construction(context, named_type, nodes, place)
    inner = [context.world.types.descriptor(context.cpp, context.scope, x).type for x in types]
    if inner:
        full = f"{full}<{', '.join(map(dump_type, inner))}>"
    arguments = library_arguments(context, nodes, place, is_pure(full))
    kinds = [getattr(a.value, "type", t.UNKNOWN) for a in arguments]
    if full.partition("<")[0].endswith("::shared_ptr") and len(arguments) == 1:
        of = kinds[0].to if isinstance(kinds[0], t.Reference) else kinds[0]
        locked(context, Value(arguments[0].value, of), place, is_explicit=True)
    result_type = function_result(full, kinds)
    return stored_result(context, s.LibraryCallee(full), arguments, Declared(result_type), place)


# --- methods and values ---------------------------------------------------------------------------


def _method(context: Context, function: Node, nodes: Sequence[Node], place: Span) -> Value:
    """`a.f(x)` and `p->f(x)`."""
    field = part(function, "field")
    types = named(part(field, "arguments")) if field.type == "template_method" else []
    name_node = part(field, "name") if types else field
    qualified = "".join(text_of(name_node).split())
    name = qualified.rpartition("::")[2]
    receiver = object_of(context, function)
    owner = class_of(context, receiver.type)
    if owner is None:
        return library_method(context, receiver, name, nodes, place)
    candidates = methods_named(context.world, owner.name, name)
    if candidates:
        values = argument_values(context, nodes)
        is_qualified = "::" in qualified
        return call_chosen(
            context,
            candidates,
            values,
            lambda f: call_function(context, f, nodes, place, receiver, is_qualified),
            place,
        )
    if find_member(context.world, owner.name, name) is not None:
        return call_value(context, field_of(context, receiver, name, place), nodes, place)
    return library_method(context, receiver, name, nodes, place)


def call_value(context: Context, value: Value, nodes: Sequence[Node], place: Span) -> Value:
    """A call of a function value, a lambda, or an object with a call operator."""
    owner = class_of(context, value.type)
    if owner is not None:
        candidates = methods_named(context.world, owner.name, "operator()")
        if not candidates:
            raise Unlowered("a call of an object without a call operator")
        values = argument_values(context, nodes)
        return call_chosen(
            context,
            candidates,
            values,
            lambda f: call_function(context, f, nodes, place, value),
            place,
        )
    callee = s.ValueCallee(value.expression)
    if not isinstance(value.type, t.FunctionType) or value.type.parameters is None:
        arguments = library_arguments(context, nodes, place, is_pure=False)
        return stored_result(context, callee, arguments, AUTO, place)
    declared = [_declared(p) for p in value.type.parameters]
    if len(declared) != len(nodes):
        raise Unlowered("a call of a function value with other arguments than it takes")

    def operand(node: Node, to: Declared) -> Callable[[], Value]:
        def lowered() -> Value:
            if to.type == t.UNKNOWN and to.reference is ReferenceKind.NONE:
                found = lower_value(context, node)
                return Value(as_value(context, found, place), found.type)
            return Value(passed(context, lower_value(context, node), to, place), to.form)

        return lowered

    operands = [operand(n, d) for n, d in zip(nodes, declared, strict=True)]
    found = in_any_order(context, operands, place)
    arguments = tuple(s.CallArgument(x) for x in found)
    return stored_result(context, callee, arguments, _declared(value.type.result), place)


def _declared(type_: t.Type) -> Declared:
    """A parameter or result of a function type, in which references are types."""
    is_reference = isinstance(type_, t.Reference) and not type_.may_be_null
    if is_reference and type_.ownership is t.Ownership.NONE:  # type: ignore[union-attr]
        return Declared(type_.to, ReferenceKind.CONSTANT)  # type: ignore[union-attr]
    return Declared(type_)
