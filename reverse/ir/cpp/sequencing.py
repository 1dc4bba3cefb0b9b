"""The order in which operands are evaluated ([intro.execution]).

Operands give expressions; what they do before that has been emitted. Where C++ leaves the order
open and it can matter, each operand becomes a part of an `Unsequenced`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value
from rebsync.reverse.ir.cpp.library import is_pure
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.syntax.cpp_tree import named, text_of
from rebsync.source import Span

Operand: TypeAlias = Callable[[], Value]
# Where a name stands without that its address can be taken.
_READING = frozenset(
    {
        *("binary_expression", "assignment_expression", "update_expression", "unary_expression"),
        *("condition_clause", "parenthesized_expression", "subscript_argument_list"),
        *("conditional_expression", "return_statement", "expression_statement", "cast_expression"),
        *("comma_expression", "case_statement", "parameter_declaration", "declaration"),
    }
)


def in_order(context: Context, operands: Sequence[Operand], place: Span) -> list[e.Expression]:
    """Operands from the first to the last: a later one does not change earlier ones."""
    return _operands(context, operands, place, is_open=False)


def in_any_order(context: Context, operands: Sequence[Operand], place: Span) -> list[e.Expression]:
    """Operands whose order is unspecified: those of operators, arguments."""
    return _operands(context, operands, place, is_open=True)


def _operands(
    context: Context, operands: Sequence[Operand], place: Span, is_open: bool
) -> list[e.Expression]:
    start = len(context.out)
    parts: list[list[s.Statement]] = []
    values: list[Value] = []
    for operand in operands:
        mark = len(context.out)
        values.append(operand())
        parts.append(context.out[mark:])
    if not _conflict(context, parts, values, is_open):
        return [v.expression for v in values]
    if is_open:
        _flag_temporaries(context, parts)
    del context.out[start:]
    found = [_spilled(context, p, v, place) for p, v in zip(parts, values, strict=True)]
    if is_open:
        bodies = tuple(tuple(body) for body, _ in found if body)
        context.emit(s.Unsequenced(bodies, place))
    else:
        context.emit(*(each for body, _ in found for each in body))
    return [expression for _, expression in found]


def _flag_temporaries(context: Context, parts: list[list[s.Statement]]) -> None:
    """Temporaries that end later, and are made in parts whose order is not known."""
    making = [p for p in parts if any(t.anchor is each for t in context.pending for each in p)]
    if len(making) > 1:
        raise Unlowered("temporaries with destructors in several operands without an order")
    for part in making:
        for temporary in context.pending:
            context.flag(temporary, part)


def _conflict(
    context: Context, parts: list[list[s.Statement]], values: list[Value], is_open: bool
) -> bool:
    """Whether an operand can see what another does."""
    doing = [n for n, part in enumerate(parts) if has_effects(part)]
    running = [n for n, v in enumerate(values) if is_dynamic(v.expression)]
    if not doing:
        return is_open and len(running) > 1
    for number, (part, value) in enumerate(zip(parts, values, strict=True)):
        others = [n for n in doing if n != number and (is_open or n > number)]
        if others and (part or number in running or not _is_stable(context, value, parts)):
            return True
    return False


def _spilled(
    context: Context, part: list[s.Statement], value: Value, place: Span
) -> tuple[list[s.Statement], e.Expression]:
    expression = value.expression
    if isinstance(expression, e.Literal | e.Temporary):
        return part, expression
    target = context.temporary(value.type, place)
    return [*part, s.Assign(target, expression, place)], target


def has_effects(body: Sequence[s.Statement]) -> bool:
    """Whether statements do anything that others could see, but for temporaries."""
    return any(isinstance(node, s.Statement) and _does(node) for node in walk(tuple(body))) or any(
        is_dynamic(node) for node in walk(tuple(body)) if isinstance(node, e.Expression)
    )


def _does(statement: s.Statement) -> bool:
    match statement:
        case s.Assign(e.Temporary(), _) | s.Declare(e.Temporary()) | s.Evaluate():
            return False
        case s.Call(e.Temporary(), s.LibraryCallee(name), _):
            return not is_pure(name)
        case s.If() | s.Block():
            return False
        case _:
            return True


def is_dynamic(expression: e.Expression) -> bool:
    """Whether what it does may be up to a class: an operator of a library or of an unknown type."""
    return any(getattr(node, "dynamic", False) for node in walk((expression,)))  # type: ignore[arg-type]


def _is_stable(context: Context, value: Value, parts: list[list[s.Statement]]) -> bool:
    """Whether no other operand can change a value."""
    changed = {
        node.target
        for part in parts
        for node in walk(tuple(part))
        if isinstance(node, s.Assign | s.CompoundAssign | s.Call | s.Construct)
    }
    return _holds(context, value.expression, changed)


def _holds(context: Context, expression: e.Expression, changed: set[e.Lvalue | None]) -> bool:
    match expression:
        case e.Literal() | e.Temporary() | e.FunctionReference() | e.LibraryReference():
            return True
        case e.Local(name):
            is_private = name not in exposed(context) and expression not in changed
            return name == "this" or is_private
        case e.AddressOf(e.Attribute(of)):
            return isinstance(of, e.Lvalue) and _holds(context, e.AddressOf(of), changed)
        case e.AddressOf(target):
            return isinstance(target, e.Local | e.Temporary | e.Global | e.Captured)
        case e.Unary(_, operand) | e.Convert(_, operand):
            return _holds(context, operand, changed)
        case e.Binary(_, left, right) | e.And(left, right) | e.Or(left, right):
            return _holds(context, left, changed) and _holds(context, right, changed)
        case _:
            return False


def exposed(context: Context) -> frozenset[str]:
    """The names of the function whose variables others may reach: by address or capture."""
    return context.exposed if context.exposed is not None else frozenset()


def exposed_in(body: Node) -> frozenset[str]:
    """The names in a body that stand where a reference may be made to what they name."""
    found: set[str] = set()
    waiting: list[tuple[Node, bool]] = [(body, False)]
    while waiting:
        node, within = waiting.pop()
        for child in named(node):
            inner = within or child.type == "lambda_expression"
            if child.type == "identifier":
                if within or node.type not in _READING:
                    found.add(text_of(child))
            else:
                waiting.append((child, inner))
    return frozenset(found)
