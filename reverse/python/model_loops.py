"""Loops over numbers and arrays, and `match`, as people write them, in the model's words."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain, count
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.building import binary
from rebsync.reverse.python import model_idioms as idioms
from rebsync.reverse.python.py_tree import field, named

if TYPE_CHECKING:
    from rebsync.reverse.python.model_statements import Statements


def counted(reader: Statements, node: Node, name: str) -> m.For:
    """`for i in range(...)`."""
    start, end, step = idioms.rounds(reader.expressions, node)
    body = _body(reader, node, name, m.Type("int"), ())
    return _for(reader, node, reader.local(name), start, end, step, body)


def each(reader: Statements, node: Node, name: str) -> m.For:
    """`for x in self._values` goes through an array of one dimension."""
    values = reader.expressions.read(field(node, "right"))
    variable = values.name if isinstance(values, m.Name | m.Member) else ""
    type_ = reader.expressions.types.get(variable, reader.expressions.names.types.get(variable))
    if type_ is None or len(type_.dimensions) != 1:
        raise reader.expressions.unread(node, "the model has no such loop")
    index = _free(reader, node, name)
    read = m.Index(values, m.Name(index))
    element = reader.expressions.kind(read) or m.Type(type_.name)
    first = m.Local(m.Declaration(element, (m.Declarator(reader.local(name), read),)))
    reader.expressions.locals[f"index of {name}"] = index
    body = _body(reader, node, name, element, (first,))
    del reader.expressions.locals[f"index of {name}"]
    zero, end, one = m.IntLiteral(0), m.IntLiteral(type_.dimensions[0]), m.IntLiteral(1)
    return _for(reader, node, index, zero, end, one, body)


def _free(reader: Statements, node: Node, name: str) -> str:
    """A name for the index of a loop, which nothing in it has."""
    taken = {*reader.expressions.locals.values(), *reader.expressions.names.types}
    taken |= {name, *idioms.stored_in(field(node, "body"))}
    numbered = (f"i{number}" for number in count(1))
    return next(n for n in chain(("i", "j", "k"), numbered) if n not in taken)


def _body(
    reader: Statements, node: Node, name: str, type_: m.Type, first: tuple[m.Statement, ...]
) -> m.Block:
    """The body of a loop over something, whose variable is known in it only."""
    body, known = field(node, "body"), reader.expressions.locals
    is_one = field(node, "left").type == "identifier"
    if not is_one or name in known or name in idioms.stored_in(body):
        raise reader.expressions.unread(node, "the variable of this loop is used elsewhere")
    known[name] = reader.local(name)
    reader.expressions.types[known[name]] = type_
    found = reader.suite(body)
    del known[name]
    return replace(found, statements=(*first, *found.statements))


def _for(
    reader: Statements,
    node: Node,
    index: str,
    start: m.Expression,
    end: m.Expression,
    step: m.Expression,
    body: m.Block,
) -> m.For:
    place = m.Name(index)
    declared = m.Declaration(m.Type("int"), (m.Declarator(index, start),))
    is_down = isinstance(step, m.Unary)
    by = step.operand if isinstance(step, m.Unary) else step
    if not isinstance(by, m.IntLiteral) or by.value == 0:
        raise reader.expressions.unread(node, "the step of this loop is to be a number")
    operator = "-" if is_down else "+"
    update: m.Expression = m.Postfix(operator * 2, place)
    if by.value != 1:
        update = m.Assign(f"{operator}=", place, by)
    condition = binary(">" if is_down else "<", place, end)
    span = reader.expressions.py.span(node)
    return m.For(declared, condition, (update,), body, span=span)


def match(reader: Statements, node: Node) -> list[m.Statement]:
    """`match` as the chain of conditions that it is."""
    subject = next(c for c in named(node) if c.type not in ("block", "case_clause"))
    branches: list[tuple[m.Expression | None, m.Block]] = []
    for values, block in idioms.cases(reader.expressions, node):
        asked: m.Expression | None = None
        for value in values:
            each = binary("==", reader.expressions.read(subject), reader.expressions.read(value))
            asked = each if asked is None else m.Binary("||", asked, each)
        branches.append((asked, reader.branch(block)))
    found: m.Statement | None = None
    for asked, body in reversed(branches):
        if asked is None and found is None:
            found = body
        elif asked is None:
            raise reader.expressions.unread(node, "no case behind this one is ever taken")
        else:
            found = m.If(asked, body, found, span=reader.expressions.py.span(node))
    return [found] if found is not None else []
