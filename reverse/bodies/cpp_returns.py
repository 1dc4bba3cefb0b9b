"""Bodies without `return`: what follows one stands in the other branch."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync import model as m

if TYPE_CHECKING:
    from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader


def without_returns(
    reader: CppStatementReader,
    node: Node,
    statements: Sequence[m.Statement],
    result: m.Expression | None,
) -> tuple[m.Statement, ...]:
    """The same without leaving: what follows a return stands in the other branch."""
    done: list[m.Statement] = []
    for index, statement in enumerate(statements):
        rest = statements[index + 1 :]
        if not _leaves(statement):
            done.append(statement)
            continue
        match statement:
            case m.Return(value):
                if value is not None and result is not None:
                    done.append(m.ExpressionStatement(m.Assign("=", result, value)))
            case m.Block(inner):
                done += without_returns(reader, node, (*inner, *rest), result)
            case m.If(condition, then, otherwise, annotations, span):
                ways = [
                    m.Block(without_returns(reader, node, (*_inner(way), *rest), result))
                    for way in (then, otherwise)
                ]
                last = ways[1] if ways[1].statements else None
                done.append(m.If(condition, ways[0], last, annotations, span))
            case _:
                raise reader.unread(node, "a return in a loop has no place in another body")
        break
    return tuple(done)


def _inner(statement: m.Statement | None) -> tuple[m.Statement, ...]:
    match statement:
        case None:
            return ()
        case m.Block(statements):
            return statements
        case _:
            return (statement,)


def _leaves(statement: m.Statement) -> bool:
    waiting = [statement]
    while waiting:
        match waiting.pop():
            case m.Return():
                return True
            case m.Block(statements):
                waiting += statements
            case m.If(_, then, otherwise):
                waiting += [then] if otherwise is None else [then, otherwise]
            case m.While(body=body) | m.For(body=body):
                waiting.append(body)
            case m.Switch(_, cases):
                waiting += [s for c in cases for s in c.statements]
    return False
