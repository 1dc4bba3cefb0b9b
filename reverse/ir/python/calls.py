"""Calls of Python: who is called, and with what."""

from __future__ import annotations

from collections.abc import Callable

from tree_sitter import Node

from rebsync.reverse.ir import calls as c
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir.python.context import MAPPING, Lowering, NoLowering, Operand
from rebsync.reverse.ir.python.references import attribute, element
from rebsync.reverse.ir.python.symbols import ScopeKind, Symbols
from rebsync.reverse.syntax.py_tree import field, named, text_of

_SUPER = "builtins.super"


def call(ctx: Lowering, node: Node) -> e.Expression:
    """A call; the value is a temporary that holds the result."""
    callee = _callee(ctx, field(node, "function"))
    nodes = _arguments(node)
    values: list[Operand] = []
    effects = ctx.body(lambda: values.extend(ctx.operands([_operand(ctx, n) for n in nodes])))
    if effects:
        callee = _fixed(ctx, callee)
        ctx.out += effects
    arguments = tuple(_argument(n, v) for n, v in zip(nodes, values, strict=True))
    target = ctx.temporary(node)
    ctx.emit(c.Call(target, callee, arguments, ctx.place(node)))
    return target


def _callee(ctx: Lowering, node: Node) -> c.Callee:
    """What is called, seen before its arguments."""

    if node.type != "attribute":
        return _of_value(ctx.value(node), node)
    name = text_of(field(node, "attribute"))
    if (receiver := _super_receiver(ctx, field(node, "object"))) is not None:
        return c.MethodCallee(receiver[0], name, after=receiver[1], dynamic=False)
    value = ctx.value(field(node, "object"))
    if isinstance(value, e.LibraryReference | e.ModuleReference):
        return _of_value(attribute(ctx, value, name, node), node)
    return c.MethodCallee(value, ctx.scope.mangled(name))


def _of_value(value: e.Expression, node: Node) -> c.Callee:
    if isinstance(value, e.LibraryReference):
        if value.name == _SUPER and not _has_arguments(node):
            raise NoLowering("`super` that is no object of a call", node)
        return c.LibraryCallee(value.name)
    return c.ValueCallee(value)


def _has_arguments(function: Node) -> bool:
    return function.parent is not None and bool(named(field(function.parent, "arguments")))


def _fixed(ctx: Lowering, callee: c.Callee) -> c.Callee:
    """What is called whatever the arguments do."""
    match callee:
        case c.ValueCallee(value):
            return c.ValueCallee(ctx.saved(value))
        case c.MethodCallee(receiver, name, declared, after, dynamic):
            if after is None and not ctx.names.is_method(name):
                method = e.Attribute(receiver, name, place=receiver.place)
                return c.ValueCallee(ctx.stored(method))
            return c.MethodCallee(ctx.saved(receiver), name, declared, after, dynamic)
        case _:
            return callee


def _arguments(node: Node) -> list[Node]:
    """The arguments as Python evaluates them: those by name behind those by place."""
    arguments = field(node, "arguments")
    if arguments.type == "generator_expression":
        return [arguments]
    found = named(arguments)
    return sorted(found, key=lambda n: n.type in ("keyword_argument", "dictionary_splat"))


def _operand(ctx: Lowering, node: Node) -> Callable[[], Operand]:

    match node.type:
        case "keyword_argument":
            return lambda: ctx.value(field(node, "value"))
        case "dictionary_splat":
            return lambda: _named_rest(ctx, node)
        case _:
            return lambda: element(ctx, node)


def _named_rest(ctx: Lowering, node: Node) -> e.Expression:
    """The mapping whose entries are arguments: what it has at this moment, if more come."""

    value = ctx.value(named(node)[0])
    if node.next_named_sibling is None:
        return value
    return ctx.saved(e.BuildMapping(MAPPING, (e.Spread(value),), ctx.place(node)))


def _argument(node: Node, value: Operand) -> c.CallArgument:
    if isinstance(value, e.Spread):
        return c.CallArgument(value.operand, stars=1)
    assert not isinstance(value, e.FormatPiece)
    match node.type:
        case "keyword_argument":
            return c.CallArgument(value, text_of(field(node, "name")))
        case "dictionary_splat":
            return c.CallArgument(value, stars=2)
        case _:
            return c.CallArgument(value)


def _super_receiver(ctx: Lowering, node: Node) -> tuple[e.Expression, str] | None:
    """The object and the class of `super()` or `super(Class, self)` in a method."""
    if node.type != "call" or text_of(field(node, "function")) != "super":
        return None
    function = ctx.name(field(node, "function"))
    if not isinstance(function, e.LibraryReference) or function.name != _SUPER:
        return None
    method = _method(ctx.scope)
    arguments = named(field(node, "arguments"))
    owner = method.parent if method is not None else None
    first = _first_parameter(method) if method is not None else None
    if arguments and not (owner and first and _says_the_same(arguments, owner, first)):
        return None  # a call like others, of a class and an object
    if owner is None or first is None or (method is not ctx.function and not arguments):
        raise NoLowering("`super` outside of a method", node)
    receiver = ctx.names.resolve(first, ctx.scope, ctx.place(node))
    return receiver, owner.name


def _says_the_same(arguments: list[Node], owner: Symbols, first: str) -> bool:
    if len(arguments) != 2 or text_of(arguments[1]) != first:
        return False
    said = text_of(arguments[0])
    return said in (text_of(field(owner.node, "name")), "__class__")


def _method(scope: Symbols) -> Symbols | None:
    """The method that a scope is or stands in."""
    at: Symbols | None = scope
    while at is not None:
        if at.kind is ScopeKind.FUNCTION and at.parent and at.parent.kind is ScopeKind.CLASS:
            return at
        at = at.parent
    return None


def _first_parameter(method: Symbols) -> str | None:
    parameters = named(field(method.node, "parameters"))
    if parameters and parameters[0].type == "identifier":
        return text_of(parameters[0])
    return None
