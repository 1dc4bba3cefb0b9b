"""Calls of functions of the program ([expr.call]): arguments, defaults, virtual functions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value, World, lower_value
from rebsync.reverse.ir.cpp.initialisation import initialised
from rebsync.reverse.ir.cpp.objects import (
    address,
    dereferenced,
    ended_later,
    passed,
)
from rebsync.reverse.ir.cpp.overloads import (
    ArgumentValue,
    Braces,
    ParameterSignature,
    signature,
)
from rebsync.reverse.ir.cpp.sequencing import has_effects, in_any_order
from rebsync.reverse.ir.cpp.symbols import FunctionSymbol
from rebsync.reverse.ir.cpp.types import Declared, ReferenceKind
from rebsync.reverse.ir.dump_types import dump_type
from rebsync.source import Span


def argument_values(context: Context, nodes: Sequence[Node]) -> list[ArgumentValue]:
    """What arguments are, by which an overload is chosen; nothing of them is emitted."""
    found: list[ArgumentValue] = []
    with context.body(), context.trial():
        for node in nodes:
            if node.type == "initializer_list":
                found.append(Braces(node))
            else:
                found.append(lower_value(context, node))
    return found


def call_function(
    context: Context,
    function: FunctionSymbol,
    nodes: Sequence[Node],
    place: Span,
    receiver: Value | None = None,
    is_qualified: bool = False,
) -> Value:
    """A call with arguments as they stand in the source."""
    found = signature(context.world, function)
    operands = [
        _operand(context, parameter, node, place)
        for parameter, node in zip(found.parameters, nodes, strict=False)
    ]
    # Those of a pack, which nothing in the function names one by one.
    operands += [partial(lower_value, context, node) for node in nodes[len(operands) :]]
    if receiver is not None and not function.is_static:
        mark = len(context.out)
        arguments = in_any_order(context, operands, place)
        if has_effects(context.out[mark:]) and not _is_fixed(receiver.expression):
            before = address(context, receiver, place)
            target = context.temporary(t.Reference(receiver.type), place)
            context.out.insert(mark, s.Assign(target, before, place))
            receiver = dereferenced(target, receiver.type, place)
    else:
        arguments = in_any_order(context, operands, place)
    arguments = arguments[: len(found.parameters)]
    arguments += default_arguments(context, function, len(nodes), place)
    return call(context, function, arguments, place, receiver, is_qualified)


def _operand(
    context: Context, parameter: ParameterSignature, node: Node, place: Span
) -> Callable[[], Value]:
    declared = parameter.declared

    def operand() -> Value:
        if node.type == "initializer_list":
            made = context.temporary(declared.type, place)
            initialised(context, made, declared.type, node)
            value = Value(made, declared.type)
        else:
            value = lower_value(context, node)
        return Value(passed(context, value, declared, place), declared.form)

    return operand


def default_arguments(
    context: Context, function: FunctionSymbol, given: int, place: Span
) -> list[e.Expression]:
    """Default arguments, evaluated at the call ([dcl.fct.default])."""
    found: list[e.Expression] = []
    for parameter in signature(context.world, function).parameters[given:]:
        if parameter.default is None:
            raise Unlowered("a call with too few arguments")
        cpp, node = parameter.default
        with context.reading(cpp, function.scope, place):
            found.append(_operand(context, parameter, node, place)().expression)
    return found


def _is_fixed(receiver: e.Expression) -> bool:
    match receiver:
        case e.Local() | e.Captured() | e.Temporary() | e.Global():
            return True
        case e.Attribute(of):
            return _is_fixed(of)
        case e.Dereference(e.Local() | e.Captured()):
            return False
        case _:
            return False


def call(
    context: Context,
    function: FunctionSymbol,
    arguments: Sequence[e.Expression],
    place: Span,
    receiver: Value | None = None,
    is_qualified: bool = False,
) -> Value:
    """A call with arguments that are passed as they are."""
    if function.is_deleted:
        raise Unlowered("a call of a deleted function")
    taken = tuple(s.CallArgument(a) for a in arguments)
    result = signature(context.world, function).result
    callee: s.Callee = callee_of(function)
    if function.owner is not None and not function.is_static:
        if receiver is None:
            raise Unlowered("a call of a member function without an object")
        may_override = not is_qualified and is_virtual(context.world, function)
        if may_override and not _has_known_class(context, receiver.expression):
            key = method_key(context.world, function)
            callee = s.MethodCallee(receiver.expression, key, function.owner, None, dynamic=False)
        if isinstance(callee, s.LibraryCallee):
            callee = s.LibraryCallee(function.name, receiver.expression)
        elif isinstance(callee, s.FunctionCallee):
            taken = (s.CallArgument(receiver.expression), *taken)
    return stored_result(context, callee, taken, result, place)


def callee_of(function: FunctionSymbol) -> s.FunctionCallee | s.LibraryCallee:
    """A function that is called without an object; one without a body is of a library."""
    is_here = function.code.body is not None
    return s.FunctionCallee(function.name) if is_here else s.LibraryCallee(function.name)


def stored_result(
    context: Context,
    callee: s.Callee,
    arguments: tuple[s.CallArgument, ...],
    result: Declared,
    place: Span,
) -> Value:
    """The call, and what it gives."""
    if result.type == t.NOTHING:
        context.emit(s.Call(None, callee, arguments, place))
        return Value(e.Literal(None, t.NOTHING, place=place), t.NOTHING)
    target = context.temporary(result.form, place)
    context.emit(s.Call(target, callee, arguments, place))
    if result.reference is not ReferenceKind.NONE:
        return dereferenced(target, result.type, place)
    if result.type != t.UNKNOWN:
        ended_later(context, target, result.type, place)
    return Value(target, result.type)


def _has_known_class(context: Context, receiver: e.Expression) -> bool:
    """Whether an object is known to be of no derived class: a variable or field of its own.

    The object of a constructor or destructor is of its class while that runs ([class.cdtor]).
    """
    if receiver == context.this:
        return context.in_constructor
    return isinstance(receiver, e.Local | e.Temporary | e.Global | e.Attribute) or (
        isinstance(receiver, e.Captured) and receiver.name != "this"
    )


def is_virtual(world: World, function: FunctionSymbol) -> bool:
    """Whether a function is virtual, itself or as it overrides one ([class.virtual])."""
    if function.is_virtual:
        return True
    if function.owner is None or function.is_static or function.simple.startswith("~"):
        return False
    types = parameter_types(world, function)
    return any(
        f.is_virtual and f.simple == function.simple and parameter_types(world, f) == types
        for base in world.symbols.lineage(function.owner)[1:]
        for f in base.functions
    )


def parameter_types(world: World, function: FunctionSymbol) -> tuple[Declared, ...]:
    """What tells a function apart from others of its name."""
    return tuple(
        replace(p.declared, is_constant=False) for p in signature(world, function).parameters
    )


def method_key(world: World, function: FunctionSymbol) -> str:
    """The name by which a class's method is looked up: with its types where a name has several."""
    cached: dict[str, bool] = world.symbols.__dict__.setdefault("method keys", {})
    name = function.simple
    if name not in cached:
        signatures = set()
        is_overloaded = False
        for class_ in world.symbols.classes.values():
            found = [f for f in class_.functions if f.simple == name]
            is_overloaded |= len(found) > 1
            signatures |= {parameter_types(world, f) for f in found}
        cached[name] = is_overloaded or len(signatures) > 1
    if not cached[name]:
        return name
    types = ", ".join(dump_type(p.form) for p in parameter_types(world, function))
    return f"{name}({types}){' const' * function.is_const}"


def library_arguments(
    context: Context, nodes: Sequence[Node], place: Span, is_pure: bool
) -> tuple[s.CallArgument, ...]:
    """Arguments of a function of a library: variables themselves, as it may change them."""

    def operand(node: Node) -> Callable[[], Value]:
        def lowered() -> Value:
            value = lower_value(context, node)
            if is_pure or not value.is_lvalue or isinstance(value.expression, e.LibraryReference):
                return Value(value.expression, value.type)
            return Value(address(context, value, place), t.Reference(value.type))

        return lowered

    found = in_any_order(context, [operand(node) for node in nodes], place)
    return tuple(s.CallArgument(x) for x in found)
