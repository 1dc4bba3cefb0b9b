"""`match` of Python as branches, for patterns of constants, names and alternatives.

Patterns that take a subject apart have no lowering yet: such a `match` is `Unsupported`.
"""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.python.context import Lowering, NoLowering
from rebsync.reverse.ir.python.references import attribute, name_target
from rebsync.reverse.ir.python.results import has_truth, result_of, type_of
from rebsync.reverse.ir.types import TRUTH
from rebsync.reverse.syntax.py_tree import field, named, text_of

_BY_IDENTITY = frozenset({"true", "false", "none"})
_VALUES = frozenset({"integer", "float", "string", "concatenated_string"})


def match(ctx: Lowering, node: Node) -> None:
    """The first case whose pattern fits and whose guard holds."""
    subjects = node.children_by_field_name("subject")
    if len(subjects) != 1:
        raise NoLowering("a match of several subjects", node)
    clauses = [c for c in named(field(node, "body")) if c.type == "case_clause"]
    subject = ctx.stored(ctx.value(subjects[0]))
    done = ctx.temporary(node, TRUTH)
    guarded = any(c.child_by_field_name("guard") is not None for c in clauses)
    if guarded:
        ctx.emit(s.Assign(done, e.Literal(False, TRUTH), ctx.place(node)))
    _cases(ctx, clauses, subject, done if guarded else None)


def _cases(
    ctx: Lowering, clauses: list[Node], subject: e.Temporary, done: e.Temporary | None
) -> None:
    """One case after the other; with guards, whether one was entered is kept in `done`."""

    if not clauses:
        return
    clause, *rest = clauses
    place = ctx.place(clause)
    (pattern,) = [c for c in named(clause) if c.type == "case_pattern"]
    names: list[Node] = []
    test = _test(ctx, pattern, subject, names)
    guard = clause.child_by_field_name("guard")

    def enter() -> None:
        for name in names:
            ctx.emit(s.Assign(name_target(ctx, name), subject, place))
        if guard is None:
            run()
            return
        holds = ctx.value(named(guard)[0])
        ctx.emit(s.If(holds, ctx.body(run), (), has_truth(holds), place))

    def run() -> None:
        if done is not None:
            ctx.emit(s.Assign(done, e.Literal(True, TRUTH), place))
        ctx.out += ctx.block(field(clause, "consequence"))

    then = ctx.body(enter)
    otherwise = ctx.body(lambda: _cases(ctx, rest, subject, done))
    if done is None:
        ctx.emit(s.If(test, then, otherwise, has_truth(test), place))
        return
    ctx.emit(s.If(test, then, (), has_truth(test), place))
    if otherwise:
        ctx.emit(
            s.If(e.Unary(Operator.NOT, done, TRUTH, False, place), otherwise, (), False, place)
        )


def _test(ctx: Lowering, pattern: Node, subject: e.Temporary, names: list[Node]) -> e.Expression:
    """Whether a pattern fits; adds the names that it binds."""
    inner = named(pattern)
    place = ctx.place(pattern)
    match pattern.type:
        case "case_pattern" if not inner:  # `_`
            return e.Literal(True, TRUTH, place=place)
        case "case_pattern" if pattern.children[0].type == "-":
            return _equal(ctx, subject, _negative(ctx, inner[0]), pattern)
        case "case_pattern":
            return _test(ctx, inner[0], subject, names)
        case "union_pattern":
            return _either(ctx, inner, subject, names, pattern)
        case "as_pattern":
            test = _test(ctx, inner[0], subject, names)
            names.append(inner[-1])
            return test
        case "dotted_name" if len(inner) == 1:
            names.append(inner[0])
            return e.Literal(True, TRUTH, place=place)
        case "dotted_name":
            return _equal(ctx, subject, _dotted(ctx, inner), pattern)
        case kind if kind in _BY_IDENTITY:
            value = ctx.value(pattern)
            return e.Binary(Operator.SAME, subject, value, TRUTH, False, place)
        case kind if kind in _VALUES:
            return _equal(ctx, subject, ctx.value(pattern), pattern)
        case _:
            raise NoLowering(f"a `{pattern.type}` takes a value apart", pattern)


def _negative(ctx: Lowering, node: Node) -> e.Expression:
    value = ctx.value(node)
    if isinstance(value, e.Literal) and isinstance(value.value, int | float):
        return e.Literal(-value.value, value.type, f"-{value.text}", value.place)
    raise NoLowering("this is no number of a pattern", node)


def _either(
    ctx: Lowering, patterns: list[Node], subject: e.Temporary, names: list[Node], node: Node
) -> e.Expression:
    before = dict(zip(node.children[1:], node.children, strict=False))
    tests = [
        _equal(ctx, subject, _negative(ctx, p), p)
        if p in before and before[p].type == "-"
        else _test(ctx, p, subject, names)
        for p in patterns
    ]
    if any(c.type == "_" for c in node.children):
        tests.append(e.Literal(True, TRUTH))
    if names:
        raise NoLowering("alternatives that bind names", node)
    found = tests[0]
    for test in tests[1:]:
        found = e.Or(found, test, TRUTH, has_truth(found), ctx.place(node))
    return found


def _equal(ctx: Lowering, subject: e.Temporary, value: e.Expression, node: Node) -> e.Expression:
    type_, dynamic = result_of(Operator.EQUAL, type_of(subject), type_of(value))
    return e.Binary(Operator.EQUAL, subject, value, type_, dynamic, ctx.place(node))


def _dotted(ctx: Lowering, names: list[Node]) -> e.Expression:
    """`Kind.ON` in a pattern: what it is, not a name that is bound."""

    value = ctx.name(names[0])
    for name in names[1:]:
        value = attribute(ctx, value, text_of(name), name)
    return value
