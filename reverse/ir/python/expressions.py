"""Expressions of Python: effects are emitted, and what is left is a tree."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.python import calls, comprehensions, functions, literals
from rebsync.reverse.ir.python.context import (
    MAPPING,
    SEQUENCE,
    SET,
    TUPLE,
    Lowering,
    NoLowering,
    Operand,
)
from rebsync.reverse.ir.python.references import attribute, element, name_target, unsupported_value
from rebsync.reverse.ir.python.results import has_truth, result_of, type_of
from rebsync.reverse.ir.types import (
    TRUTH,
    UNKNOWN,
    Float,
    Integer,
    is_plain,
)
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.syntax.py_tree import field, named, text_of

_COMPARED = {
    "==": Operator.EQUAL,
    "!=": Operator.UNEQUAL,
    "<>": Operator.UNEQUAL,
    "<": Operator.LESS,
    "<=": Operator.LESS_EQUAL,
    ">": Operator.GREATER,
    ">=": Operator.GREATER_EQUAL,
    "is": Operator.SAME,
    "is not": Operator.NOT_SAME,
    "in": Operator.IN,
    "not in": Operator.NOT_IN,
}
_SIGNS = {"-": Operator.NEGATE, "+": Operator.PLUS, "~": Operator.INVERT}
_BY_IDENTITY = (Operator.SAME, Operator.NOT_SAME)


def lower_value(ctx: Lowering, node: Node) -> e.Expression:
    """An expression; what has no lowering is emitted as `Unsupported`."""
    mark = len(ctx.out)
    try:
        rule = _RULES.get(node.type)
        if rule is None or node.type == "ERROR" or node.is_missing:
            raise NoLowering(f"no meaning is known of a `{node.type}`", node)
        return rule(ctx, node)
    except NoLowering as failure:
        del ctx.out[mark:]
        return unsupported_value(ctx, node, failure.reason)


# --- operators -----------------------------------------------------------------------------------


def _binary(ctx: Lowering, node: Node) -> e.Expression:
    left, right = ctx.ordered([lambda: ctx.part(node, "left"), lambda: ctx.part(node, "right")])
    operator = ctx.operator(text_of(field(node, "operator")), node)
    type_, dynamic = result_of(operator, type_of(left), type_of(right))
    return e.Binary(operator, left, right, type_, dynamic, ctx.place(node))


def _unary(ctx: Lowering, node: Node) -> e.Expression:
    operator = _SIGNS[text_of(field(node, "operator"))]
    operand = ctx.part(node, "argument")
    type_ = type_of(operand)
    known = isinstance(type_, Integer | Float)
    result = type_ if known else UNKNOWN
    return e.Unary(operator, operand, result, not is_plain(type_), ctx.place(node))


def _not(ctx: Lowering, node: Node) -> e.Expression:
    operand = ctx.part(node, "argument")
    return e.Unary(Operator.NOT, operand, TRUTH, has_truth(operand), ctx.place(node))


def _boolean(ctx: Lowering, node: Node) -> e.Expression:
    """`and` and `or`."""
    is_and = text_of(field(node, "operator")) == "and"
    left = ctx.part(node, "left")
    return _short_circuit(ctx, left, lambda: ctx.part(node, "right"), is_and, node)


def _short_circuit(
    ctx: Lowering,
    left: e.Expression,
    right: Callable[[], e.Expression],
    is_and: bool,
    node: Node,
) -> e.Expression:
    """A tree where the right side emits nothing, else a branch."""
    values: list[e.Expression] = []
    body = ctx.body(lambda: values.append(right()))
    (value,), place = values, ctx.place(node)
    if not body:
        type_ = type_of(left) if type_of(left) == type_of(value) else UNKNOWN
        kind = e.And if is_and else e.Or
        return kind(left, value, type_, has_truth(left), place)
    target = ctx.temporary(node)
    ctx.emit(s.Assign(target, left, place))
    body = (*body, s.Assign(target, value, place))
    then, otherwise = (body, ()) if is_and else ((), body)
    ctx.emit(s.If(target, then, otherwise, has_truth(left), place))
    return target


def _append(ctx: Lowering, values: list[e.Expression], node: Node) -> None:
    values.append(ctx.value(node))


def _conditional(ctx: Lowering, node: Node) -> e.Expression:
    then, test, otherwise = named(node)
    condition = ctx.value(test)
    values: list[e.Expression] = []
    bodies = [ctx.body(partial(_append, ctx, values, branch)) for branch in (then, otherwise)]
    place, dynamic = ctx.place(node), has_truth(condition)
    if not any(bodies):
        type_ = type_of(values[0]) if type_of(values[0]) == type_of(values[1]) else UNKNOWN
        return e.Conditional(condition, values[0], values[1], type_, dynamic, place)
    target = ctx.temporary(node)
    first, second = ((*b, s.Assign(target, v, place)) for b, v in zip(bodies, values, strict=True))
    ctx.emit(s.If(condition, first, second, dynamic, place))
    return target


def _comparison(ctx: Lowering, node: Node) -> e.Expression:
    """`a < b < c` is `a < b and b < c`, where `b` is evaluated once."""
    operators = [_COMPARED[text_of(c)] for c in node.children_by_field_name("operators")]
    if node.has_error or len(named(node)) != len(operators) + 1:
        raise NoLowering("no comparison of Python", node)
    first, second, *rest = named(node)
    left, right = ctx.values((first, second))
    return _chain(ctx, left, right, rest, operators, node)


def _chain(
    ctx: Lowering,
    left: e.Expression,
    right: e.Expression,
    nodes: list[Node],
    operators: list[Operator],
    node: Node,
) -> e.Expression:
    """A comparison of two values, and if it holds that of the second with the next node."""
    if not nodes:
        return _compared(ctx, operators[0], left, right, node)
    if not ctx.is_stable(right):
        left, right = ctx.saved(left), ctx.saved(right)
    start = _compared(ctx, operators[0], left, right, node)
    first, *rest = nodes

    def go_on() -> e.Expression:
        return _chain(ctx, right, ctx.value(first), rest, operators[1:], node)

    return _short_circuit(ctx, start, go_on, True, node)


def _compared(
    ctx: Lowering, operator: Operator, left: e.Expression, right: e.Expression, node: Node
) -> e.Binary:
    if operator in _BY_IDENTITY:
        return e.Binary(operator, left, right, TRUTH, False, ctx.place(node))
    type_, dynamic = result_of(operator, type_of(left), type_of(right))
    return e.Binary(operator, left, right, type_, dynamic, ctx.place(node))


# --- parts and new values ------------------------------------------------------------------------


def _attribute(ctx: Lowering, node: Node) -> e.Expression:
    target = ctx.part(node, "object")
    return attribute(ctx, target, text_of(field(node, "attribute")), node)


def _subscript(ctx: Lowering, node: Node) -> e.Expression:
    nodes = node.children_by_field_name("subscript")
    target, *indices = ctx.values([field(node, "value"), *nodes])
    is_tuple = len(indices) > 1 or any(c.type == "," for c in node.children)
    index = e.Build(TUPLE, tuple(indices), ctx.place(node)) if is_tuple else indices[0]
    return e.Index(target, index, place=ctx.place(node))


def _slice(ctx: Lowering, node: Node) -> e.Expression:
    parts: list[Node | None] = [None]
    for child in node.children:
        if child.type == ":":
            parts.append(None)
        elif child.type != "comment":
            parts[-1] = child
    values = iter(ctx.values(p for p in parts if p is not None))
    low, high, step = ([None if p is None else next(values) for p in parts] + [None] * 2)[:3]
    return e.Slice(low, high, step, ctx.place(node))


def _display(ctx: Lowering, node: Node) -> e.Expression:
    """A list, tuple or set of elements."""
    type_ = {"list": SEQUENCE, "set": SET}.get(node.type, TUPLE)
    elements = ctx.operands([partial(element, ctx, n) for n in named(node)])
    found = tuple(x for x in elements if not isinstance(x, e.FormatPiece))
    return e.Build(type_, found, ctx.place(node))


def _dictionary(ctx: Lowering, node: Node) -> e.Expression:
    parts: list[Callable[[], Operand]] = []
    for entry in named(node):
        if entry.type == "pair":
            parts += [
                partial(ctx.part, entry, "key"),
                partial(ctx.part, entry, "value"),
            ]
        elif entry.type == "dictionary_splat":
            parts.append(partial(_mapping, ctx, entry))
        else:
            raise NoLowering("this is no entry of a dictionary", entry)
    values = iter(ctx.operands(parts))
    entries: list[tuple[e.Expression, e.Expression] | e.Spread] = []
    for value in values:
        if isinstance(value, e.Spread):
            entries.append(value)
        elif not isinstance(value, e.FormatPiece):
            paired = next(values)
            assert not isinstance(paired, e.Spread | e.FormatPiece)
            entries.append((value, paired))
    return e.BuildMapping(MAPPING, tuple(entries), ctx.place(node))


def _mapping(ctx: Lowering, node: Node) -> Operand:
    """What is spread into a dictionary: what it has at this moment."""
    value = ctx.value(named(node)[0])
    copied = e.BuildMapping(MAPPING, (e.Spread(value),), ctx.place(node))
    target = ctx.temporary(node, MAPPING)
    ctx.emit(s.Assign(target, copied, ctx.place(node)))
    return e.Spread(target, ctx.place(node))


def _parenthesized(ctx: Lowering, node: Node) -> e.Expression:
    inner = named(node)
    if len(inner) != 1:
        raise NoLowering("nothing or more than one value in parentheses", node)
    return ctx.value(inner[0])


def _walrus(ctx: Lowering, node: Node) -> e.Expression:
    """Assigns a name; the value is what it then holds."""

    value = ctx.part(node, "value")
    target = name_target(ctx, field(node, "name"), at=ctx.function)
    if not isinstance(target, e.Local) or any(target == n for n in walk(value)):
        value = ctx.saved(value)
    ctx.emit(s.Assign(target, value, ctx.place(node)))
    return target if isinstance(target, e.Local) else value


def _name(ctx: Lowering, node: Node) -> e.Expression:
    return ctx.name(node)


def _starred(ctx: Lowering, node: Node) -> e.Expression:
    """The grammar reads `*f(x)` as `(*f)(x)` behind a `return`: see `element`."""
    above = node.parent
    if above is None or above.type not in ("call", "attribute", "subscript"):
        raise NoLowering("a star has no meaning here", node)
    if above.type == "subscript" and node != field(above, "value"):
        raise NoLowering("elements of an index", node)
    return ctx.value(named(node)[0])


def _await(ctx: Lowering, node: Node) -> e.Expression:
    value = ctx.value(named(node)[0])
    target = ctx.temporary(node)
    ctx.emit(s.Await(target, value, ctx.place(node)))
    return target


def _yield(ctx: Lowering, node: Node) -> e.Expression:
    inner = named(node)
    none = e.Literal(None, place=ctx.place(node))
    value = ctx.value(inner[0]) if inner else none
    delegates = any(c.type == "from" for c in node.children)
    target = ctx.temporary(node)
    ctx.emit(s.Yield(target, value, delegates, ctx.place(node)))
    return target


_RULES: Mapping[str, Callable[[Lowering, Node], e.Expression]] = {
    "identifier": _name,
    "integer": literals.number,
    "float": literals.number,
    "string": literals.string,
    "concatenated_string": literals.string,
    "true": literals.constant,
    "false": literals.constant,
    "none": literals.constant,
    "ellipsis": literals.constant,
    "binary_operator": _binary,
    "unary_operator": _unary,
    "not_operator": _not,
    "boolean_operator": _boolean,
    "comparison_operator": _comparison,
    "conditional_expression": _conditional,
    "parenthesized_expression": _parenthesized,
    "named_expression": _walrus,
    "attribute": _attribute,
    "subscript": _subscript,
    "slice": _slice,
    "list": _display,
    "tuple": _display,
    "set": _display,
    "expression_list": _display,
    "dictionary": _dictionary,
    "call": calls.call,
    "lambda": functions.closure_of,
    "list_comprehension": comprehensions.comprehension,
    "set_comprehension": comprehensions.comprehension,
    "dictionary_comprehension": comprehensions.comprehension,
    "generator_expression": comprehensions.generator,
    "list_splat": _starred,
    "await": _await,
    "yield": _yield,
}
