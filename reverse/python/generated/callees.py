"""Which function a call of generated Python runs, where the code chooses one of several."""

from __future__ import annotations

from contextlib import suppress

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import negated
from rebsync.reverse.python.expressions.values import TRUTH
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.names import Callee, ChosenCallee
from rebsync.reverse.python.generated.py_types import without_parentheses
from rebsync.reverse.syntax.py_tree import calls_in, field, named, text_of
from rebsync.source import Span

_BRANCHING = frozenset({"conditional_expression", "boolean_operator"})


def callee(reader: ModelExpressionReader, node: Node) -> Callee:
    """What is called, by its name; of `f if x else g` and `{True: f, False: g}[x]` both."""
    node = without_parentheses(node)
    if node.type == "conditional_expression":
        then, condition, otherwise = named(node)
        asked = reader.condition(condition)
        return ChosenCallee(asked, callee(reader, then), callee(reader, otherwise))
    if node.type == "subscript" and field(node, "value").type == "dictionary":
        return _looked_up(reader, node)
    kept = reader.kept_sends.get(text_of(node))
    return kept if kept is not None else reader.of_run_time(text_of(node))


def _looked_up(reader: ModelExpressionReader, node: Node) -> Callee:
    """One of two functions in a table of truth values. Unread: the table may lack the key."""
    functions = {}
    for pair in named(field(node, "value")):
        if pair.type != "pair" or field(pair, "value").type != "attribute":
            raise reader.unread(node, "the model has no such function")
        functions[text_of(field(pair, "key"))] = callee(reader, field(pair, "value"))
    asked = reader.read(field(node, "subscript"))
    if asked.kind != TRUTH or functions.keys() != {"True", "False"}:
        raise reader.unread(node, "say what is called for each value by `if`")
    return ChosenCallee(asked.expression, functions["True"], functions["False"])


def evaluated(reader: ModelExpressionReader, node: Node) -> m.Statement:
    """What is evaluated only for what it does: `f() if x else g()`, `x and f()`."""
    node, ways = without_parentheses(node), list[Node | None]()
    if node.type in _BRANCHING and (found := _as_value(reader, node)) is not None:
        return m.ExpressionStatement(found, span=reader.span(node))
    match node.type, named(node):
        case "conditional_expression", [then, condition, otherwise]:
            ways = [None if n.type == "none" else n for n in (then, otherwise)]
        case "boolean_operator", [condition, then]:
            is_or = text_of(field(node, "operator")) == "or"
            ways = [None, then] if is_or else [then]
        case _:
            return _branching(reader.expression(node), reader.span(node))
    asked, span = reader.condition(condition), reader.span(node)
    if reader.kind(asked) is None:
        raise reader.unread(condition, "nobody knows whether this holds")
    blocks = [m.Block((evaluated(reader, n),)) if n is not None else None for n in ways]
    if blocks[0] is None:
        asked, blocks = negated(asked), blocks[1:]
    return m.If(asked, blocks[0] or m.Block(()), blocks[1] if len(blocks) > 1 else None, span=span)


def _as_value(reader: ModelExpressionReader, node: Node) -> m.Expression | None:
    """An expression that is one in the model too: one that sends, or gives nothing, is none."""
    called = (text_of(field(c, "function")) for c in calls_in(node))
    sends = reader.names.sends
    if any(c.removeprefix("self.") in sends or c in reader.kept_sends for c in called):
        return None
    with suppress(Unread):
        return reader.expression(node)
    return None


def _branching(found: m.Expression, span: Span) -> m.Statement:
    """An expression as a statement, of which the branches do something."""
    if not isinstance(found, m.Conditional):
        return m.ExpressionStatement(found, span=span)
    then, otherwise = (m.Block((_branching(e, span),)) for e in (found.then, found.otherwise))
    return m.If(found.condition, then, otherwise, span=span)
