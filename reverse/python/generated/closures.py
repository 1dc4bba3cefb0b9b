"""What functions within bodies of Python give: their only value, where they are called."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.python.generated import idioms
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.names import Closure


def value_of_call(
    reader: ModelExpressionReader, node: Node, called: str, arguments: list[Node]
) -> m.Expression:
    """What a function of the body gives, which does nothing."""
    closure = reader.closures[called]
    values = [reader.expression(a) for a in arguments_of(reader, node, closure, arguments)]
    if not all(map(is_calm, values)):
        raise reader.unread(node, "this is evaluated once there, and not so often here")
    plain = [v if isinstance(v, m.Name | m.IntLiteral | m.Index) else m.Paren(v) for v in values]
    with reader.standing_for([name for name, _ in closure.parameters], [*map(reader.value, plain)]):
        return idioms.grouped(node, reader.expression(closure.body))


def arguments_of(
    reader: ModelExpressionReader, node: Node, closure: Closure, arguments: list[Node]
) -> list[Node]:
    """The arguments in the order of the parameters, which they are given in."""
    plain = not any(
        a.type in ("keyword_argument", "list_splat", "dictionary_splat") for a in arguments
    )
    if not plain or len(arguments) != len(closure.parameters):
        raise reader.unread(node, "this function is called with other arguments")
    return arguments
