"""Expressions of Python that do nothing: functions that are named, and iterators nobody asks."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.models.building import is_calm
from rebsync.reverse.python.expressions.elements import known_range
from rebsync.reverse.python.generated.callees import is_method
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.failing import may_fail
from rebsync.reverse.python.generated.idioms import ahead
from rebsync.reverse.syntax.py_tree import field, is_constant_text, named, text_of

DISPLAYS = frozenset({"tuple", "list"})


def does_nothing(reader: ModelExpressionReader, node: Node) -> bool:
    """Whether a statement only names something, or makes an iterator that nobody goes through."""
    return is_constant_text(node) or is_method(reader, node) or _is_lazy(reader, node)


def is_iterator(reader: ModelExpressionReader, call: Node | None) -> bool:
    """Whether a call makes an iterator, which runs nothing until it is asked."""
    function = call.child_by_field_name("function") if call is not None else None
    named_ = reader.library(function) if function is not None else ""
    return named_ in ("builtins.map", "builtins.filter", "builtins.zip", "builtins.enumerate")


def _is_lazy(reader: ModelExpressionReader, node: Node) -> bool:
    if node.type == "generator_expression":
        first = next(each for each in named(node) if each.type == "for_in_clause")
        return _is_iterable(reader, field(first, "right"))
    if not is_iterator(reader, node):
        return False
    name, given = text_of(field(node, "function")), named(field(node, "arguments"))
    is_applied = name in ("map", "filter")
    through = given[1:] if is_applied else given
    if not through or (name not in ("map", "zip") and len(through) > 1):
        return False
    is_called = not is_applied or _is_function(reader, given[0])
    return is_called and all(_is_iterable(reader, each) for each in through)


def _is_function(reader: ModelExpressionReader, given: Node) -> bool:
    """Whether an argument is a function, which is made or named and not called."""
    if given.type != "lambda":
        return is_method(reader, given)
    parameters = given.child_by_field_name("parameters")
    return parameters is None or all(each.type == "identifier" for each in named(parameters))


def _is_iterable(reader: ModelExpressionReader, node: Node) -> bool:
    """Whether it can be gone through, and to make it does nothing and does not fail."""
    if node.type in DISPLAYS:
        return all(_is_still(reader, each) for each in named(node))
    if node.type == "identifier":
        kept = reader.kept_tables.get(text_of(node))
        return kept is not None and kept.type in DISPLAYS
    if node.type == "call" and reader.library(field(node, "function")) == "builtins.range":
        return known_range(named(field(node, "arguments"))) is not None
    return _is_lazy(reader, node)


def _is_still(reader: ModelExpressionReader, element: Node) -> bool:
    if is_method(reader, element):
        return True
    with ahead(reader):
        return not may_fail(reader, element) and is_calm(reader.expression(element))
