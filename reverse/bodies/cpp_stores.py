"""Values as variables hold them, and what of them the model does not have."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.bodies.types.cpp_conversions import converted_to, is_truth
from rebsync.reverse.findings import Unread
from rebsync.static.types import BOOLEAN


def kept(
    reader: CppExpressionReader, node: Node, value: m.Expression, place: Variable
) -> m.Expression:
    """A value as a variable holds it.

    A truth value of a message is a byte in the code: other numbers than 0 and 1 in it are listed.
    """
    if place.bits and place.type == BOOLEAN and not is_truth(reader.scope, value):
        why = "this truth value of a message gets a number, which need not be 0 or 1"
        unread = Unread(reader.cpp.span(node), why, "compare it with 0: != 0")
        if reader.findings is None:
            raise unread
        reader.findings.unreadable(reader.cpp.source, unread, reader.within)
    return converted_to(reader.scope, value, place)
