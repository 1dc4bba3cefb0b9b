"""Functions and classes of Python as values: closures, defaults, decorators, class bodies."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Parameter, ParameterKind
from rebsync.reverse.ir.python.context import Lowering, NoLowering
from rebsync.reverse.ir.python.names import free_variables
from rebsync.reverse.ir.python.references import name_target
from rebsync.reverse.ir.python.symbols import Symbols
from rebsync.reverse.ir.types import UNKNOWN, Container, ContainerKind, Type
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.py_tree import field, named, text_of


def closure_of(ctx: Lowering, node: Node) -> e.Expression:
    """A new function: its defaults are evaluated, what it captures is shared."""

    defaults = [(p.name, value) for p, value in parameters_of(ctx, node) if value is not None]
    values = ctx.values(v for _, v in defaults)
    names = [name for name, _ in defaults]
    scope = ctx.binder.scopes[node.id]
    pairs = tuple(zip(names, values, strict=True))
    return e.Closure(scope.name, captures_of(ctx, scope), pairs, place=ctx.place(node))


def captures_of(ctx: Lowering, scope: Symbols) -> tuple[e.Capture, ...]:
    """What a function within this one takes from here and from further out."""
    found = []
    for variable in free_variables(scope).values():
        is_own = variable.function == ctx.function.name
        found.append(e.Capture(e.Local(variable.name) if is_own else variable))
    return tuple(found)


def parameters_of(ctx: Lowering, node: Node) -> list[tuple[Parameter, Node | None]]:
    """The parameters of a function, each with its default."""
    parameters = node.child_by_field_name("parameters")
    found: list[tuple[Parameter, Node | None]] = []
    kind = ParameterKind.PLAIN
    for child in named(parameters) if parameters is not None else ():
        if child.type == "positional_separator":
            found = [(_by_place(p), default) for p, default in found]
        elif child.type == "keyword_separator":
            kind = ParameterKind.BY_NAME
        else:
            parameter, default = _parameter(ctx, child, kind)
            found.append((parameter, default))
            if parameter.kind is ParameterKind.REST:
                kind = ParameterKind.BY_NAME
    return found


def _by_place(parameter: Parameter) -> Parameter:
    return Parameter(
        parameter.name,
        parameter.type,
        ParameterKind.BY_PLACE,
        parameter.has_default,
        parameter.place,
    )


def _parameter(ctx: Lowering, node: Node, kind: ParameterKind) -> tuple[Parameter, Node | None]:
    place, default = ctx.place(node), None
    name, type_ = node, _REST_TYPES.get(node.type, UNKNOWN)
    if node.type in ("default_parameter", "typed_default_parameter"):
        name, default = field(node, "name"), field(node, "value")
    elif node.type == "typed_parameter":
        name = node.named_children[0]
        type_ = _REST_TYPES.get(name.type, UNKNOWN)
    kind = _REST.get(name.type, kind)
    if name.type in ("tuple_pattern", "ERROR"):
        raise NoLowering("a parameter that is a pattern", node)
    text = ctx.binder.scopes[_function_of(node).id].mangled(text_of(name).lstrip("* "))
    return Parameter(text, type_, kind, default is not None, place), default


def _function_of(node: Node) -> Node:
    """The function whose parameter a node is."""
    above = climb(node, lambda n: n.type in ("function_definition", "lambda"))
    assert above is not None
    return above


_REST = {
    "list_splat_pattern": ParameterKind.REST,
    "dictionary_splat_pattern": ParameterKind.NAMED_REST,
}
_REST_TYPES: dict[str, Type] = {
    "list_splat_pattern": Container(ContainerKind.TUPLE),
    "dictionary_splat_pattern": Container(ContainerKind.MAPPING),
}


# --- definitions ---------------------------------------------------------------------------------


def define(ctx: Lowering, node: Node) -> None:
    """A function or class with its decorators: these first, applied from the last to the first."""

    definition, decorators = node, []
    if node.type == "decorated_definition":
        definition = field(node, "definition")
        decorators = [c.named_children[0] for c in node.children if c.type == "decorator"]
    values = [ctx.saved(v) for v in ctx.values(d for d in decorators)]
    target = name_target(ctx, field(definition, "name"))
    if definition.type == "class_definition":
        value = _class(ctx, definition, target if not decorators else None)
        if value is None:
            return
    else:
        value = closure_of(ctx, definition)
    for decorator in reversed(values):
        result = ctx.temporary(node)
        callee = _callee(decorator)
        ctx.emit(s.Call(result, callee, (s.CallArgument(value),), ctx.place(node)))
        value = result
    ctx.emit(s.Assign(target, value, ctx.place(definition)))


def _callee(value: e.Expression) -> s.Callee:
    if isinstance(value, e.LibraryReference):
        return s.LibraryCallee(value.name)
    return s.ValueCallee(value)


def _class(ctx: Lowering, node: Node, target: e.Lvalue | None) -> e.Expression | None:
    """Defines a class, in its variable or (to be decorated) in a temporary, which is given."""

    arguments = node.child_by_field_name("superclasses")
    parts = named(arguments) if arguments is not None else []
    nodes = [field(p, "value") if p.type == "keyword_argument" else p for p in parts]
    if any(p.type in ("list_splat", "dictionary_splat") for p in parts):
        raise NoLowering("bases that are computed", node)
    values = ctx.values(nodes)
    bases = tuple(
        s.CallArgument(v, text_of(field(p, "name")) if p.type == "keyword_argument" else None)
        for p, v in zip(parts, values, strict=True)
    )
    name = ctx.binder.scopes[node.id].name
    result = target if target is not None else ctx.temporary(node)
    ctx.emit(s.DefineClass(result, name, bases, ctx.place(node)))
    return None if target is not None else result
