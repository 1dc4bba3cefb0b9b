"""Texts of C++: objects of `std::string`, which are values, and literals, which are pointers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.bodies.scope import Record, Scope, Variable
from rebsync.reverse.bodies.types.cpp_conversions import type_in
from rebsync.reverse.models.building import bare, is_calm, negated
from rebsync.reverse.models.texts import TEXT, is_constant, is_plain, same, text_literal
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_tree import part, text_of


def is_text(reader: CppExpressionReader, expression: m.Expression) -> bool:
    """Whether an expression is a text."""
    return type_in(reader.scope, expression) == TEXT


def check_no_text(reader: CppExpressionReader, node: Node, *operands: m.Expression) -> None:
    """Raises where what is done with a text is nothing that the model can."""
    if any(is_text(reader, operand) for operand in operands):
        raise reader.unknown(node, "the model only copies and compares texts")


def check_stored(
    reader: CppExpressionReader, node: Node, value: m.Expression, place: Variable
) -> None:
    """Raises where a variable of texts gets something else, or one of something else a text."""
    if place.type is not None and is_text(reader, value) != (place.type == TEXT):
        raise reader.unknown(node, "the model only copies and compares texts")


def check_alike(
    reader: CppExpressionReader, node: Node, one: m.Expression, other: m.Expression
) -> None:
    """Raises where only one of two values is a text."""
    if is_text(reader, one) != is_text(reader, other):
        raise reader.unknown(node, "the model only copies and compares texts")


def texts_among(scope: Scope, names: Iterable[str]) -> set[str]:
    """Those of some locals, and fields of local messages, that hold texts."""
    found: set[str] = set()
    for each in names:
        name, _, path = each.partition(".")
        match scope.locals.get(name):
            case Variable(_, type_) if type_ == TEXT:
                found.add(each)
            case Record(fields) if path in fields and fields[path].type == TEXT:
                found.add(each)
            case _:
                pass
    return found


def operation(
    reader: CppExpressionReader, node: Node, operator: str, left: m.Expression, right: m.Expression
) -> m.Expression | None:
    """The comparison of two texts, or the concatenation of constants; None for other operands."""
    texts = [is_text(reader, side) for side in (left, right)]
    if not any(texts):
        return None
    match bare(left), bare(right):
        case (m.StringLiteral(one), m.StringLiteral(other)) if operator == "+":
            if is_plain(one) and is_plain(other):
                return text_literal(one[1:-1] + other[1:-1], reader.cpp.span(node))
    pointers = is_constant(left) and is_constant(right)
    if not all(texts) or operator not in ("==", "!=") or pointers:
        raise reader.unknown(node, "the model only copies and compares texts")
    return _equal(reader, node, left, right, holds=operator == "==")


def call(
    reader: CppExpressionReader, node: Node, target: Node, name: str, arguments: Sequence[Node]
) -> m.Expression | None:
    """`text.empty()`; None for what else is called of a text, or of something else."""
    if name != "empty" or arguments:
        return None
    try:
        text = reader.read(target)
    except Unknown:
        return None
    if not is_text(reader, text) or is_constant(text):
        return None
    return _equal(reader, node, text, text_literal(""))


def emptied(reader: CppExpressionReader, node: Node) -> m.Expression | None:
    """`text.clear()`; None for other calls."""
    called = call_of(node)
    if called is None or called.name != "clear" or called.target is None or called.arguments:
        return None
    variable = resolve(reader.scope, called.target)
    if not isinstance(variable, Variable) or variable.type != TEXT:
        return None
    return m.Assign("=", m.Name(variable.name), text_literal(""), reader.cpp.span(node))


def of_compare(reader: CppExpressionReader, node: Node, operator: str) -> m.Expression | None:
    """`text.compare(other) == 0`; None for other operations."""
    call, zero = call_of(part(node, "left")), text_of(part(node, "right"))
    if operator not in ("==", "!=") or zero != "0" or call is None or call.target is None:
        return None
    if call.name != "compare" or len(call.arguments) != 1:
        return None
    left, right = reader.read(call.target), reader.read(call.arguments[0])
    if not (is_text(reader, left) and is_text(reader, right)):
        return None
    return _equal(reader, node, left, right, holds=operator == "==")


def _equal(
    reader: CppExpressionReader,
    node: Node,
    left: m.Expression,
    right: m.Expression,
    holds: bool = True,
) -> m.Expression:
    span = reader.cpp.span(node)
    found = same(left, right, span)
    if not (is_constant(left) or is_constant(right)):
        if not (is_calm(left) and is_calm(right)):
            raise reader.unknown(node, "the model would do this more than once")
        why = "texts that occur nowhere in the code may be equal or not"
        reader.approximate(node, Unknown(span, why, ""))
    return found if holds else negated(found)
