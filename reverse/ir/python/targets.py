"""What is assigned to in Python: names, attributes, elements, and patterns of these."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.python.context import Lowering, NoLowering
from rebsync.reverse.ir.python.references import name_target, unsupported_value
from rebsync.reverse.ir.python.results import result_of, type_of
from rebsync.reverse.syntax.py_tree import field, named, text_of

_PATTERNS = frozenset({"pattern_list", "tuple_pattern", "list_pattern", "tuple", "list"})
_GROUPS = frozenset({"parenthesized_expression", "as_pattern_target", "expression_list"})
_DISPLAYS = frozenset({"tuple", "list", "expression_list"})
_STARRED = frozenset({"list_splat_pattern", "list_splat"})


def lvalue(ctx: Lowering, node: Node) -> e.Lvalue:
    """A target that is one place; its parts are evaluated where it stands."""
    match node.type:
        case "identifier":
            return name_target(ctx, node)
        case "attribute" | "subscript":
            value = ctx.value(node)
            if isinstance(value, e.LibraryReference):
                holder, _, name = value.name.rpartition(".")
                return e.Attribute(e.LibraryReference(holder), name, place=ctx.place(node))
            assert isinstance(value, e.Attribute | e.Index | e.Global | e.Temporary)
            return value
        case kind if kind in _GROUPS and len(named(node)) == 1:
            return lvalue(ctx, named(node)[0])
        case _:
            raise NoLowering("this is no target of an assignment", node)


def assign(ctx: Lowering, target: Node, value: e.Expression, node: Node) -> None:
    """Stores a value in a target, which may be a pattern."""
    inner = _pattern(target)
    if inner is None:
        mark = len(ctx.out)
        place = lvalue(ctx, target)
        if len(ctx.out) > mark:
            later = ctx.out[mark:]
            del ctx.out[mark:]
            value = ctx.saved(value)
            ctx.out += later
        ctx.emit(s.Assign(place, value, ctx.place(node)))
        return
    stars = [n for n, each in enumerate(inner) if each.type in _STARRED]
    temporaries = tuple(ctx.temporary(each) for each in inner)
    rest = stars[0] if stars else None
    ctx.emit(s.Unpack(temporaries, value, rest, ctx.place(node)))
    for each, temporary in zip(inner, temporaries, strict=True):
        assign(ctx, named(each)[0] if each.type in _STARRED else each, temporary, node)


def _pattern(target: Node) -> list[Node] | None:
    """The targets within a pattern."""
    if target.type in _PATTERNS:
        return named(target)
    if target.type in _GROUPS:
        inner = named(target)
        is_tuple = target.type == "expression_list" and any(c.type == "," for c in target.children)
        return inner if is_tuple else _pattern(inner[0])
    return None


def assign_all(ctx: Lowering, targets: Sequence[Node], value: Node, node: Node) -> None:
    """`a = b, c = value`: the value once, then the targets from left to right."""
    patterns = [_pattern(t) for t in targets]
    if len(targets) == 1 and patterns[0] is not None and _pairs(patterns[0], value):
        _assign_each(ctx, patterns[0], named(value), node)
        return
    lowered = ctx.value(value)
    if len(targets) > 1:
        lowered = ctx.saved(lowered)
    for target in targets:
        assign(ctx, target, lowered, node)


def _pairs(targets: list[Node], value: Node) -> bool:
    """Whether each target gets one element of what is written out as a tuple."""
    values = named(value)
    return (
        value.type in _DISPLAYS
        and len(values) == len(targets)
        and not any(n.type in _STARRED for n in (*targets, *values))
    )


def _assign_each(ctx: Lowering, targets: list[Node], values: list[Node], node: Node) -> None:
    """`a, b = b, a`: all values, then all targets."""
    lowered = ctx.values(values)
    # Locals too may be assigned to before they are read.
    fixed = [ctx.stored(v) if isinstance(v, e.Local) else ctx.saved(v) for v in lowered]
    for target, value in zip(targets, fixed, strict=True):
        assign(ctx, target, value, node)


def augment(ctx: Lowering, node: Node) -> None:
    """`target += value`; the target is read before the value has effects."""
    operator = ctx.operator(text_of(field(node, "operator"))[:-1], node)
    target = lvalue(ctx, field(node, "left"))
    place = ctx.place(node)
    values: list[e.Expression] = []
    effects = ctx.body(lambda: values.append(ctx.value(field(node, "right"))))
    (value,) = values
    _, dynamic = result_of(operator, type_of(target), type_of(value))
    if not effects:
        ctx.emit(s.CompoundAssign(target, operator, value, dynamic, place))
        return
    fixed = _fixed(ctx, target)
    old = ctx.stored(fixed)
    ctx.out += effects
    ctx.emit(s.CompoundAssign(old, operator, value, dynamic, place))
    ctx.emit(s.Assign(fixed, old, place))


def _fixed(ctx: Lowering, target: e.Lvalue) -> e.Lvalue:
    """A target whose parts are evaluated already."""
    match target:
        case e.Attribute(holder, name):
            saved = ctx.saved(holder)
            return e.Attribute(saved, name, target.type, target.dynamic, target.place)
        case e.Index(holder, index):
            return e.Index(ctx.saved(holder), ctx.saved(index), place=target.place)
        case _:
            return target


def delete(ctx: Lowering, node: Node) -> None:
    """`del a, b[0]`: one after the other."""
    for target in named(node):
        for each in _pattern(target) or [target]:
            inner = _pattern(each)
            if inner is not None:
                unsupported_value(ctx, each, "several targets of `del` in parentheses")
            else:
                ctx.emit(s.Delete(lvalue(ctx, each), ctx.place(node)))
