"""Whether a variable holds a message or timer, and not None; whether a value is True or False."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import binary, is_calm
from rebsync.reverse.python.bodies import body_texts
from rebsync.reverse.python.bodies.body_expression_reader import BodyExpressionReader
from rebsync.reverse.python.bodies.body_scope import Key, Message, Var
from rebsync.reverse.python.bodies.body_timers import is_timer
from rebsync.reverse.python.expressions.values import STRING, TRUTH, Value
from rebsync.reverse.syntax.py_tree import text_of


def presence_key(key: Key) -> Key:
    """The variable that says whether a variable holds a message, and not None."""
    where, number, name = key
    return where, number, f"{name} is there"


def is_there(reader: BodyExpressionReader, node: Node) -> m.Expression | None:
    """Whether a variable holds a message or timer, and not None; None for other expressions."""
    if node.type not in ("identifier", "attribute"):
        return None
    meaning, path = reader.meaning(node)
    if path or not isinstance(meaning, Message | Var):
        return None
    if isinstance(meaning, Var) and not (
        meaning.is_state and is_timer(reader.reading, node, reader.frame)
    ):
        return None
    key = presence_key(meaning.key)
    reader.reading.learnt.want(key)
    is_server = isinstance(meaning, Message) and bool(meaning.server)
    if is_server or reader.reading.learnt.kind(key) is None:
        return m.BoolLiteral(True)
    owner = reader.frame.owner_of(key) or reader.frame
    if not meaning.is_state and key[2] not in owner.assigned:
        raise Unread(reader.frame.span(node), f'"{text_of(node)}" may have no value yet')
    return m.Name(presence_name(reader, meaning, node), reader.frame.span(node))


def presence_name(reader: BodyExpressionReader, variable: Message | Var, node: Node) -> str:
    """The variable of the model that says whether one holds a message or timer."""
    key, wish = presence_key(variable.key), f"{variable.name}_is_there"
    if isinstance(variable, Var):
        return reader.reading.state_name(key, wish)
    return reader.reading.part_name(variable, key, wish, node, reader.frame)


def compared_with_none(
    reader: BodyExpressionReader, operands: list[Node], signs: list[str]
) -> Value | None:
    """`message is None`, `message is not None`; None for other comparisons."""
    if len(operands) != 2 or operands[1].type != "none":
        return None
    if signs[0] not in ("is", "==", "is not", "!="):
        return None
    found = body_texts.is_text(reader, operands[0]) or is_there(reader, operands[0])
    if found is None:
        return None
    return Value(found if "n" in signs[0] or signs[0] == "!=" else m.Unary("!", found), TRUTH)


def identical(
    reader: BodyExpressionReader, operands: list[Node], signs: list[str], node: Node
) -> m.Expression | None:
    """`x is True`, `x == None`: of truth values and None there is one object of each.

    None for other comparisons: whether two equal numbers or texts are one object is open.
    """
    literals = [o.type for o in operands if o.type in ("true", "false", "none")]
    known = ("is", "is not", "==", "!=") if "none" in literals else ("is", "is not")
    if len(operands) != 2 or not literals or signs[0] not in known:
        return None
    is_same = signs[0] in ("is", "==")
    if literals == ["none", "none"]:
        return m.BoolLiteral(is_same)
    values = [reader.read(o) for o in operands if o.type != "none"]
    if len(values) == 2 and values[0].kind == values[1].kind:
        sides = values[0].expression, values[1].expression
        return binary("==" if is_same else "!=", *sides, reader.frame.span(node))
    if any(v.kind == STRING or not is_calm(v.expression) for v in values):
        return None
    return m.BoolLiteral(not is_same)  # a number is none of these
