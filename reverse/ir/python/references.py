"""What names and members of Python stand for, where code has a lowering and where not."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.python.context import Lowering, Operand
from rebsync.reverse.ir.python.names import lookup, module_scope, variable
from rebsync.reverse.ir.python.symbols import ScopeKind, Symbols
from rebsync.reverse.syntax.py_tree import field, named, text_of


def attribute(ctx: Lowering, target: e.Expression, name: str, node: Node) -> e.Expression:
    """A member of something: of a module or library, what it has under that name."""
    name, place = ctx.scope.mangled(name), ctx.place(node)
    match target:
        case e.LibraryReference(whole):
            return e.LibraryReference(f"{whole}.{name}", place=place)
        case e.ModuleReference():
            found = ctx.names.module_member(target, name)
            return found if found is not None else e.Attribute(target, name, place=place)
        case _:
            return e.Attribute(target, name, place=place)


def name_target(ctx: Lowering, node: Node, at: Symbols | None = None) -> e.Lvalue:
    """The variable that an assignment to a name stores in."""
    scope = at or ctx.scope
    name, place = scope.mangled(text_of(node)), ctx.place(node)
    binding = lookup(name, scope)
    if binding is None:
        return e.Global(module_scope(scope).name, name, place=place)
    if binding.kind is ScopeKind.CLASS:
        return e.Attribute(e.ClassReference(binding.name), name, dynamic=False, place=place)
    return variable(name, binding, scope, place)


def element(ctx: Lowering, node: Node) -> Operand:
    """An element of a display, or an argument by its place; either may be spread."""
    if node.type == "parenthesized_list_splat":
        node = named(node)[0]
    if node.type == "list_splat":
        return e.Spread(ctx.value(named(node)[0]), ctx.place(node))
    value = ctx.value(node)
    return e.Spread(value, ctx.place(node)) if _starts_with_star(node) else value


def _starts_with_star(node: Node) -> bool:
    """Whether the grammar reads `*f(x)` as a call of `*f`."""
    inner: Node | None = node
    while inner is not None and inner.type in _PARTS:
        inner = inner.child_by_field_name(_PARTS[inner.type])
    return inner is not None and inner.type == "list_splat"


_PARTS = {"call": "function", "attribute": "object", "subscript": "value"}


def unsupported_value(ctx: Lowering, node: Node, reason: str) -> e.Temporary:
    """Emits that an expression has no lowering; the value that nobody knows."""
    target = ctx.temporary(node)
    reads = names_in(ctx, node)
    writes = tuple(name for name in reads if isinstance(name, e.Local | e.Captured | e.Global))
    ctx.emit(s.Unsupported(reason, reads, writes, target, ctx.place(node)))
    return target


def names_in(ctx: Lowering, node: Node) -> tuple[e.Expression, ...]:
    """What the names in a piece of code stand for."""
    found: dict[e.Expression, None] = {}
    waiting = [node]
    while waiting:
        inner = waiting.pop()
        if inner.type == "identifier":
            found[ctx.name(inner)] = None
        elif inner.type == "attribute":
            waiting.append(field(inner, "object"))
        else:
            waiting += reversed(inner.named_children)
    return tuple(found)


def unsupported(ctx: Lowering, node: Node, reason: str) -> None:
    """Emits that a statement has no lowering."""
    reads = names_in(ctx, node)
    writes = tuple(name for name in reads if isinstance(name, e.Local | e.Captured | e.Global))
    ctx.emit(s.Unsupported(reason, reads, writes, None, ctx.place(node)))
