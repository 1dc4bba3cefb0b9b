"""Texts of Python as values of the model: they are only copied and compared."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import bare, binary, is_calm, negated
from rebsync.reverse.models.texts import MEMBER, is_constant, is_plain, no_text, same, text_literal
from rebsync.reverse.python.bodies.body_expression_reader import BodyExpressionReader
from rebsync.reverse.python.bodies.body_scope import Var, unknown
from rebsync.reverse.python.expressions.values import STRING, Value
from rebsync.reverse.syntax.py_tree import field, is_literal_text, named, text_of


def compared(
    reader: BodyExpressionReader, sign: str, left: Value, right: Value, node: Node
) -> m.Expression:
    """`left == right`, `left != right`; Unknown for other comparisons of texts."""
    calm = is_calm(left.expression) and is_calm(right.expression)
    if left.kind != right.kind and sign in ("==", "!=", "<>") and calm:
        return m.BoolLiteral(sign != "==")
    if left.kind != right.kind or sign not in ("==", "!=", "<>"):
        raise unknown(reader.frame, node, f'"{text_of(node)}"')
    if not (is_constant(left.expression) or is_constant(right.expression)):
        if not calm:
            raise unknown(reader.frame, node, f'"{text_of(node)}"')
        reader.note(node, "texts that occur nowhere in the code may be equal or not")
    found = same(left.expression, right.expression, reader.frame.span(node))
    return found if sign == "==" else negated(found)


def is_operation(node: Node) -> bool:
    """Whether a binary operation may be one on values: `"%d" % x` and its like make texts."""
    sides = named(node)
    if not any(is_literal_text(n) for n in sides):
        return True
    plain = all(is_literal_text(n) or n.type in ("identifier", "attribute") for n in sides)
    return plain and text_of(field(node, "operator")) == "+"


def joined(
    reader: BodyExpressionReader, operator: str, left: Value, right: Value, node: Node
) -> Value:
    """The concatenation of two texts that the code names; Unknown for other operations on texts."""
    match bare(left.expression), bare(right.expression):
        case (m.StringLiteral(one), m.StringLiteral(other)) if operator == "+":
            if is_plain(one) and is_plain(other):
                return Value(text_literal(one[1:-1] + other[1:-1], reader.frame.span(node)), STRING)
    raise unknown(reader.frame, node, f'"{text_of(node)}"')


def identical(
    reader: BodyExpressionReader, operands: list[Node], signs: list[str], node: Node
) -> m.Expression | None:
    """`mode is Mode.RUN`: a member of an enumeration is one object; None for other comparisons."""
    if len(operands) != 2 or signs not in (["is"], ["is not"]) or operands[1].type == "none":
        return None
    left, right = (reader.read(operand) for operand in operands)
    match right.expression:
        case m.StringLiteral(text) if text[1:2] == MEMBER:
            return compared(reader, "==" if signs == ["is"] else "!=", left, right, node)
        case _:
            return None


def is_filled(reader: BodyExpressionReader, value: Value, node: Node) -> m.Expression:
    """What Python takes for true: a text that is not empty, and not None."""
    if not is_calm(value.expression):
        raise unknown(reader.frame, node, f'"{text_of(node)}"')
    filled = binary("!=", value.expression, text_literal(""))
    if not value.mixed:
        return filled
    return binary("&&", filled, binary("!=", value.expression, no_text()))


def is_text(reader: BodyExpressionReader, node: Node) -> m.Expression | None:
    """Whether a variable of texts holds one, and not None; None for other expressions."""
    if node.type not in ("identifier", "attribute"):
        return None
    meaning, path = reader.meaning(node)
    if path or not isinstance(meaning, Var) or reader.reading.learnt.kind(meaning.key) != STRING:
        return None
    return binary("!=", reader.read(node).expression, no_text(), reader.frame.span(node))
