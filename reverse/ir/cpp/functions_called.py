"""Calls of functions of the program ([expr.call]): arguments, defaults, virtual functions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.classes import (
    implicit_constructor,
    is_aggregate,
    is_copy,
    methods_named,
    needs_constructor,
)
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value, World, lower_value
from rebsync.reverse.ir.cpp.initialisation import initialised
from rebsync.reverse.ir.cpp.objects import (
    address,
    as_value,
    assigned_memberwise,
    class_of,
    copies_trivially,
    dereferenced,
    ended_later,
    implicitly,
    is_base,
    passed,
)
from rebsync.reverse.ir.cpp.overloads import (
    ArgumentValue,
    Braces,
    ParameterSignature,
    conversion_function,
    resolve,
    signature,
)
from rebsync.reverse.ir.cpp.sequencing import has_effects, in_any_order
from rebsync.reverse.ir.cpp.symbols import ClassSymbol, FunctionSymbol
from rebsync.reverse.ir.cpp.types import Declared, ReferenceKind
from rebsync.reverse.ir.dump_expressions import dump_type
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
    arguments += _defaults(context, function, len(nodes), place)
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


def _defaults(
    context: Context, function: FunctionSymbol, given: int, place: Span
) -> list[e.Expression]:
    """Default arguments, evaluated at the call ([dcl.fct.default])."""
    found: list[e.Expression] = []
    for parameter in signature(context.world, function).parameters[given:]:
        if parameter.default is None:
            raise Unlowered("a call with too few arguments")
        cpp, node = parameter.default
        with context.reading(cpp, function.scope):
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
    taken = tuple(s.Argument(a) for a in arguments)
    result = signature(context.world, function).result
    callee: s.Callee = s.FunctionCallee(function.name)
    if function.code.body is None:  # it is declared here, and defined in a library
        callee = s.LibraryCallee(function.name)
    if function.owner is not None and not function.is_static:
        if receiver is None:
            raise Unlowered("a call of a member function without an object")
        if not is_qualified and is_virtual(context.world, function):
            if not _has_known_class(context, receiver.expression):
                key = method_key(context.world, function)
                callee = s.MethodCallee(
                    receiver.expression, key, function.owner, None, dynamic=False
                )
        if isinstance(callee, s.LibraryCallee):
            callee = s.LibraryCallee(function.name, receiver.expression)
        elif isinstance(callee, s.FunctionCallee):
            taken = (s.Argument(receiver.expression), *taken)
    return stored_result(context, callee, taken, result, place)


def stored_result(
    context: Context,
    callee: s.Callee,
    arguments: tuple[s.Argument, ...],
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


# --- what `World` offers ---------------------------------------------------------------------------


def construct(
    context: Context, target: e.Lvalue, owner: ClassSymbol, values: list[Value], place: Span
) -> None:
    """An object of a class in a variable, of values as arguments."""
    constructors = [f for f in owner.constructors if not _is_implicit(owner, f)]
    type_ = t.Record(owner.name)
    is_copy_of = len(values) == 1 and (
        values[0].type == type_ or is_base(context, type_, values[0].type)
    )
    if is_copy_of and not any(is_copy(owner, f) for f in constructors):
        _copy_constructed(context, target, owner, values[0], place)
        return
    if not constructors:
        if values:
            raise Unlowered("a construction that no constructor is declared for")
        constructor = None
        if needs_constructor(context.world, owner):
            constructor = implicit_constructor(owner)
        context.emit(s.Construct(target, owner.name, (), constructor, place))
        return
    function = resolve(context, constructors, list(values))
    if function.is_default and not values:
        name = implicit_constructor(owner)
        context.emit(s.Construct(target, owner.name, (), name, place))
        return
    parameters = signature(context.world, function).parameters
    passed_values = [
        passed(context, v, p.declared, place) for v, p in zip(values, parameters, strict=False)
    ]
    passed_values += _defaults(context, function, len(values), place)
    arguments = tuple(s.Argument(a) for a in passed_values)
    context.emit(s.Construct(target, owner.name, arguments, function.name, place))


def _is_implicit(owner: ClassSymbol, function: FunctionSymbol) -> bool:
    """Whether the language makes the function's body: a defaulted copy or move constructor."""
    return function.is_default and is_copy(owner, function)


def _copy_constructed(
    context: Context, target: e.Lvalue, owner: ClassSymbol, value: Value, place: Span
) -> None:
    """The implicit copy constructor ([class.copy.ctor])."""
    if any(is_copy(owner, f) and f.is_deleted for f in owner.constructors):
        raise Unlowered("a copy of what cannot be copied")
    if copies_trivially(context.world, t.Record(owner.name)):
        if value.type == t.Record(owner.name):
            context.emit(s.Assign(target, as_value(context, value, place), place))
            return
        context.emit(s.Construct(target, owner.name, (), None, place))
        assigned_memberwise(context, owner, target, value.expression, place)
        return
    raise Unlowered("a copy that a class makes by itself of parts that do more")


def conversion(
    context: Context, value: Value, owner: ClassSymbol, to: t.Type, place: Span
) -> Value | None:
    """A conversion function of an object's class ([class.conv.fct])."""
    function = conversion_function(owner, context.world, to)
    if function is None:
        return None
    return implicitly(context, call(context, function, [], place, value), to, place)


def call_operator(context: Context, name: str, values: list[Value], place: Span) -> Value | None:
    """An operator function for operands of which one is an object of the program ([over.oper])."""
    owners = [class_of(context, v.type) for v in values]
    enums = any(isinstance(v.type, t.Enumeration) for v in values)
    if not any(owners) and not enums:
        return None
    owner = owners[0]
    members = methods_named(context.world, owner.name, name) if owner is not None else []
    members = [f for f in members if not f.is_default]
    free = context.world.symbols.functions_named(name, context.scope, context.cpp.source.path)
    for value in values:
        if isinstance(value.type, t.Record | t.Enumeration):
            space = value.type.name.rpartition("::")[0]
            path = context.cpp.source.path
            found = context.world.symbols.functions_named(name, space, path)
            free = [*free, *(f for f in found if f not in free)]
    if name == "operator=" and not _fits(context, members, values):
        members = []
    if not members and not free:
        return None
    if members and (not free or _fits(context, members, values)):
        function = resolve(context, members, values[1:])
        return call_with_values(context, function, values[1:], place, values[0])
    if not any(_fits_free(context, f, values) for f in free):
        return None
    return call_with_values(context, resolve(context, free, values), values, place)


def _fits(context: Context, members: Sequence[FunctionSymbol], values: list[Value]) -> bool:
    """Whether a member operator takes the operands, as far as their number and classes tell."""
    if not members:
        return False
    try:
        resolve(context, members, values[1:])
    except Unlowered:
        return False
    only = [signature(context.world, f).parameters for f in members]
    return any(
        len(p) == len(values) - 1
        and all(_may_be(context, v, q) for v, q in zip(values[1:], p, strict=True))
        for p in only
    )


def _fits_free(context: Context, function: FunctionSymbol, values: list[Value]) -> bool:
    parameters = signature(context.world, function).parameters
    return len(parameters) == len(values) and all(
        _may_be(context, v, p) for v, p in zip(values, parameters, strict=True)
    )


def _may_be(context: Context, value: Value, parameter: ParameterSignature) -> bool:
    type_ = parameter.declared.type
    if value.type == type_ or is_base(context, type_, value.type):
        return True
    is_number = isinstance(value.type, t.Integer | t.Float | t.Truth | t.Enumeration)
    return is_number and isinstance(type_, t.Integer | t.Float | t.Truth | t.Record)


def call_with_values(
    context: Context,
    function: FunctionSymbol,
    values: Sequence[Value],
    place: Span,
    receiver: Value | None = None,
) -> Value:
    """A call whose arguments are values that are there."""
    parameters = signature(context.world, function).parameters
    arguments = [
        passed(context, v, p.declared, place) for v, p in zip(values, parameters, strict=False)
    ]
    arguments += _defaults(context, function, len(values), place)
    return call(context, function, arguments, place, receiver)


def call_library(
    context: Context, target: e.Lvalue, type_: t.Type, nodes: Sequence[Node], place: Span
) -> None:
    """An object of a library, constructed of arguments that it may look at and change."""
    arguments = library_arguments(context, nodes, place, is_pure=False)
    if isinstance(type_, t.Record | t.Message):
        context.emit(s.Call(target, s.LibraryCallee(type_.name), arguments, place))
        return
    if type_ != t.UNKNOWN:
        raise Unlowered("a construction by arguments that is not known")
    callee = s.LibraryCallee("constructor of a type that is not known")
    context.emit(s.Call(target, callee, arguments, place))


def library_arguments(
    context: Context, nodes: Sequence[Node], place: Span, is_pure: bool
) -> tuple[s.Argument, ...]:
    """Arguments of a function of a library: variables themselves, as it may change them."""

    def operand(node: Node) -> Callable[[], Value]:
        def lowered() -> Value:
            value = lower_value(context, node)
            if is_pure or not value.is_lvalue or isinstance(value.expression, e.LibraryReference):
                return Value(value.expression, value.type)
            return Value(address(context, value, place), t.Reference(value.type))

        return lowered

    found = in_any_order(context, [operand(node) for node in nodes], place)
    return tuple(s.Argument(x) for x in found)
