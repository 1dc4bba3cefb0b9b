"""How loops of Python end: their `else`, and what their variable is behind them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.rewriting import before_breaks
from rebsync.reverse.python.expressions.elements import known_range
from rebsync.reverse.python.generated.arrays import array_elements
from rebsync.reverse.python.generated.failing import may_fail
from rebsync.reverse.python.generated.py_types import call_parts
from rebsync.reverse.python.generated.statement_reader import ModelStatementReader
from rebsync.reverse.syntax.ancestors import ancestors, climb
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import SCOPES, field, named, text_of

_LOOPS = frozenset({"for_statement", "while_statement"})
_BINDING = frozenset({"assignment", "augmented_assignment", "named_expression"})


def with_else(
    reader: ModelStatementReader, node: Node, read: Callable[[], list[m.Statement]]
) -> list[m.Statement]:
    """A loop, and what its `else` does if no `break` ends it: a variable tells that one did."""
    alternative = node.child_by_field_name("alternative")
    if alternative is not None and _is_silent(reader, field(alternative, "body")):
        alternative = None
    if alternative is None or not leaves(field(node, "body")):
        return [*read(), *_behind(reader, alternative)]
    own = reader.expressions
    taken = {*own.locals, *own.types, *reader.types}
    flag = reader.free("broke", pattern="broke{}", first=2, taken=taken)
    reader.expressions.locals[f"else of {node.start_byte}"] = flag
    reader.expressions.types[flag] = m.Type("boolean")
    ended = m.ExpressionStatement(m.Assign("=", m.Name(flag), m.BoolLiteral(True)))
    loop = [_before_breaks(each, ended) for each in read()]
    otherwise = reader.branch(field(alternative, "body"))
    told = m.Declarator(flag, m.BoolLiteral(False))
    declared = m.Local(m.Declaration(m.Type("boolean"), (told,)))
    return [declared, *loop, m.If(m.Unary("!", m.Name(flag)), otherwise)]


def _before_breaks(loop: m.Statement, first: m.Statement) -> m.Statement:
    if not isinstance(loop, m.For | m.While):
        return loop
    return replace(loop, body=before_breaks(loop.body, first))


def with_last(
    reader: ModelStatementReader, node: Node, read: Callable[[], m.Statement]
) -> list[m.Statement]:
    """A loop, and before it its variable, if that is read behind it: there it has its last value.

    Of a loop that may do no round the variable is not known behind it, unless it was before.
    """
    name, first = text_of(field(node, "left")), _first(reader, node)
    known = reader.expressions.locals
    is_known = name in known
    if not is_known and (first is None or not _is_read_behind(node, name)):
        return [read()]
    reader.lasting = name
    try:
        loop = read()
    finally:
        reader.lasting = ""
    if is_known or first is None or name not in known:
        return [loop]
    reader.implied.add(name)
    told = m.Declarator(known[name], first)
    declared = m.Declaration(reader.expressions.types[known[name]], (told,))
    return [m.Local(declared), loop]


def _behind(reader: ModelStatementReader, alternative: Node | None) -> tuple[m.Statement, ...]:
    """What an `else` does that always runs."""
    if alternative is None:
        return ()
    block = reader.branch(field(alternative, "body"))
    has_locals = any(isinstance(s, m.Local) for s in block.statements)
    return (block,) if has_locals else block.statements


def _is_silent(reader: ModelStatementReader, block: Node) -> bool:
    """Whether a block only tells people something."""
    silent = reader.expressions.names.silent
    return all(silent.holds(n) and not may_fail(reader.expressions, n) for n in named(block))


def leaves(node: Node, jump: str = "break_statement") -> bool:
    """Whether a `break`, or a `continue`, in a body is one of the loop that the body is of."""
    return any(
        child.type == jump
        or (child.type in _LOOPS and _leaves_behind(child, jump))
        or (child.type not in _LOOPS | SCOPES and leaves(child, jump))
        for child in named(node)
    )


def _leaves_behind(loop: Node, jump: str) -> bool:
    alternative = loop.child_by_field_name("alternative")
    return alternative is not None and leaves(alternative, jump)


def _first(reader: ModelStatementReader, node: Node) -> m.Expression | None:
    """The first value of a loop's variable; None: there may be no round."""
    right = field(node, "right")
    called, arguments = call_parts(right) or ("", [])
    if called == "range":
        first = next(iter(known_range(arguments) or ()), None)
        return m.IntLiteral(first) if first is not None and first >= 0 else None
    if right.type in ("identifier", "attribute"):
        elements = array_elements(reader.expressions, right)
        return elements[0] if elements else None
    return None


def _is_read_behind(node: Node, name: str) -> bool:
    """Whether a loop's variable is read where the loop has ended, and nothing else is stored in it.

    There may be other loops and comprehensions that give their own one this name.
    """
    around = climb(node, lambda n: n.type == "function_definition")
    if around is None or not name.isidentifier():
        return False
    alternative = node.child_by_field_name("alternative")
    end = alternative.start_byte if alternative is not None else node.end_byte
    behind = (n for n in nodes_in(around) if n.start_byte >= end and text_of(n) == name)
    found = [n for n in behind if n.type == "identifier" and not _is_given(n, name, node)]
    return bool(found) and all(map(_is_read, found))


def _is_read(node: Node) -> bool:
    """Whether a name is that of a variable whose value is asked."""
    above = node.parent
    return above is not None and (
        above.type not in _BINDING or node not in map(above.child_by_field_name, ("left", "name"))
    )


def _is_given(node: Node, name: str, loop: Node) -> bool:
    """Whether a name is no variable, or one that another loop, comprehension or function has."""
    above = node.parent
    if above is not None and above.type in ("attribute", "keyword_argument"):
        return node in map(above.child_by_field_name, ("attribute", "name"))
    return any(
        name in map(text_of, _bound_by(each))
        for each in ancestors(node, lambda n: n.type == "module")
        if each != loop
    )


def _bound_by(node: Node) -> Iterator[Node]:
    """The names that a loop, a comprehension or a function within binds."""
    match node.type:
        case "for_statement":
            yield from nodes_in(field(node, "left"))
        case "lambda":
            parameters = node.child_by_field_name("parameters")
            yield from nodes_in(parameters) if parameters is not None else ()
        case kind if kind.endswith("comprehension") or kind == "generator_expression":
            clauses = (c for c in named(node) if c.type == "for_in_clause")
            yield from (n for c in clauses for n in nodes_in(field(c, "left")))
        case _:
            return
