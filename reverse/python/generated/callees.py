"""Which function a call of generated Python runs, where the code chooses one of several."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import partial, reduce

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import binary, is_calm, negated
from rebsync.reverse.python.expressions.conditions import signs_of
from rebsync.reverse.python.expressions.values import TRUTH
from rebsync.reverse.python.generated import tuples
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.names import Callee, ChosenCallee
from rebsync.reverse.python.generated.py_types import call_parts, without_parentheses
from rebsync.reverse.syntax.py_tree import calls_in, field, named, text_of
from rebsync.source import Span

NOBODY = ""  # what is called where a table lacks the key: None is no function
_BRANCHING = frozenset({"conditional_expression", "boolean_operator"})


def callee(reader: ModelExpressionReader, node: Node) -> Callee:
    """What is called, by its name; of `f if x else g` and `{1: f}.get(x, g)` both."""
    node = without_parentheses(node)
    if node.type == "conditional_expression":
        then, condition, otherwise = named(node)
        asked = reader.condition(condition)
        return ChosenCallee(asked, callee(reader, then), callee(reader, otherwise))
    if (found := tuples.table_asked(reader, node)) is not None:
        return _looked_up(reader, node, *found)
    kept = reader.kept_sends.get(text_of(node))
    return kept if kept is not None else reader.of_run_time(text_of(node))


def _looked_up(reader: ModelExpressionReader, node: Node, written: Node, key: Node) -> Callee:
    """One of the functions in a table of numbers or truth values. Unread: it may lack the key."""
    asked, entries = reader.read(key), [n for n in named(written) if n.type == "pair"]
    _, arguments = call_parts(node) or ("", [])
    found = callee(reader, arguments[1]) if len(arguments) == 2 else NOBODY if arguments else None
    keys = [reader.read(field(entry, "key")) for entry in entries]
    literals = {
        k.expression for k in keys if isinstance(k.expression, m.IntLiteral | m.BoolLiteral)
    }
    is_known = len(literals) == len(named(written)) > 0 and {k.kind for k in keys} == {asked.kind}
    is_whole = asked.kind == TRUTH and len(keys) == 2
    if not (is_known and is_calm(asked.expression)) or (found is None and not is_whole):
        raise reader.unread(node, "say what is called for each value by `if`")
    for known, entry in [*zip(keys, entries, strict=True)][::-1]:
        function = callee(reader, field(entry, "value"))
        is_it: m.Expression = binary("==", asked.expression, known.expression)
        if asked.kind == TRUTH:
            is_true = known.expression == m.BoolLiteral(True)
            is_it = asked.expression if is_true else negated(asked.expression)
        found = function if found is None else ChosenCallee(is_it, function, found)
    return found or NOBODY


def is_method(reader: ModelExpressionReader, node: Node) -> bool:
    """Whether something names a method of the object, and does not call it."""
    holder, _, name = text_of(node).rpartition(".")
    names = reader.names
    is_method = name in names.sends or (name in names.functions and name not in names.properties)
    return node.type == "attribute" and holder == reader.own and is_method


def known_there(reader: ModelExpressionReader, node: Node) -> tuple[str, m.Expression] | None:
    """The local of `f`, or `f is not None`, that may be no function, and when it is one."""
    operands = named(node) if node.type == "comparison_operator" else [node]
    is_none = len(operands) == 2 and signs_of(node) == ["is not"] and operands[1].type == "none"
    found = reader.kept_sends.get(text_of(operands[0])) if len(operands) == 1 or is_none else None
    there, asked = list[m.Expression](), found
    while isinstance(asked, ChosenCallee):
        there.append(asked.asked)
        asked = asked.otherwise
    is_it = asked == NOBODY and bool(there)
    return (text_of(operands[0]), reduce(partial(binary, "||"), there)) if is_it else None


def there(found: Callee) -> Callee:
    """A function of several that is known to be one: the last is, if none before it is."""
    if not isinstance(found, ChosenCallee):
        return found
    rest = there(found.otherwise)
    return found.then if rest == NOBODY else replace(found, otherwise=rest)


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
