"""Arrays of the model in functions of Python: they are of fixed length, and have none there."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.idioms import type_of
from rebsync.reverse.syntax.py_tree import text_of

NO_LENGTH = 'an array of the model has no "{}" in Python: say its length as a number'


def is_length(reader: ModelExpressionReader, called: str, arguments: list[Node]) -> bool:
    """Whether a function of Python asks how long an array is."""
    if called not in ("len", "reversed") or len(arguments) != 1:
        return False
    return _array(reader, arguments[0]) is not None


def array_elements(reader: ModelExpressionReader, node: Node) -> list[m.Expression] | None:
    """The elements of a variable of the model that is an array of one dimension; else None."""
    found = _array(reader, node)
    if found is None:
        return None
    read, length = found
    return [m.Index(read, m.IntLiteral(i)) for i in range(length)]


def _array(reader: ModelExpressionReader, node: Node) -> tuple[m.Expression, int] | None:
    if node.type not in ("identifier", "attribute"):
        return None
    if not {reader.variable(text_of(node))} & (reader.types.keys() | reader.names.types.keys()):
        return None
    read = reader.expression(node)
    type_ = type_of(reader, read)
    return None if type_ is None or len(type_.dimensions) != 1 else (read, type_.dimensions[0])
