"""`any` and `all` over a container of constants: a disjunction or conjunction of its elements."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import binary, is_calm
from rebsync.reverse.python.bodies import body_tables
from rebsync.reverse.python.bodies.body_expression_reader import BodyExpressionReader
from rebsync.reverse.python.bodies.body_scope import TRUTH, Value
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import arguments_of
from rebsync.reverse.syntax.py_tree import field, named, text_of

_SIGNS = {"builtins.any": "||", "builtins.all": "&&"}
_ELEMENTS = ("generator_expression", "list_comprehension")
_COMPUTES = frozenset({"comparison_operator", "boolean_operator", "not_operator"})


def quantified(reader: BodyExpressionReader, call: Node) -> Value | None:
    """`any(x == y for x in (1, 2))` as `1 == y || 2 == y`; None for what is no such call."""
    sign = _SIGNS.get(reader.reading.external(field(call, "function"), reader.frame))
    arguments = field(call, "arguments")
    made = [arguments] if arguments.type in _ELEMENTS else arguments_of(call)[0]
    if sign is None or len(made) != 1 or made[0].type not in _ELEMENTS:
        return None
    parts = named(made[0])
    if len(parts) != 2 or parts[1].type != "for_in_clause" or parts[0].type not in _COMPUTES:
        return None
    variable, iterable = field(parts[1], "left"), field(parts[1], "right")
    listed = body_tables.elements(reader, iterable) if variable.type == "identifier" else None
    if not listed or _runs(parts[0]):
        return None
    return _joined(reader, sign, text_of(variable), listed, parts[0])


def _joined(
    reader: BodyExpressionReader, sign: str, name: str, listed: Sequence[Value], test: Node
) -> Value | None:
    """The test of each element, as what the variable stands for."""
    bound, before = reader.frame.bound, reader.frame.bound.get(name)
    found: m.Expression | None = None
    try:
        for element in listed:
            bound[name] = element
            one = reader.condition(test)
            if not is_calm(one):
                return None
            found = one if found is None else binary(sign, found, one, reader.frame.span(test))
    finally:
        del bound[name]
        if before is not None:
            bound[name] = before
    return Value(found, TRUTH) if found is not None else None


def _runs(test: Node) -> bool:
    """Whether a test does more than to compare values: what it does more than once is asked."""
    return any(n.type in ("call", "lambda", "subscript", "await") for n in nodes_in(test))
