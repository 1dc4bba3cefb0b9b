"""Elements of arrays that expressions of generated Python store in: `put_item` and `before`.

An array and an index that are needed twice are kept in names: `(values := self._a)`. These stand
for what they keep as long as the store is read, and for nothing behind it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.py_types import call_parts, without_parentheses
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import field, named, text_of

_STEP = re.compile(r"(\w+)\.(add|subtract)")
_NO_EXPRESSION = "the model has no such expression"


def is_kept(walrus: Node) -> bool:
    """Whether a `:=` keeps the array or the index of a store, by where it stands."""
    node, above = _outermost(walrus)
    if above is None:
        return False
    if above.type == "subscript":
        node, above = _outermost(above)
        return _is_argument(node, above, "before", 1)
    return _is_argument(node, above, "put_item", 2)


def put_item(reader: ModelExpressionReader, node: Node, arguments: Sequence[Node]) -> m.Expression:
    """`put_item(array, index, value)`: an assignment to an element."""
    place, index, value = arguments
    with _kept(reader, place, index) as names:
        target = _element(reader, node, place, index, names)
        stored = reader.stored(target, index, value, node)
        used = [text_of(n) for n in nodes_in(value) if text_of(n) in names]
        is_update = isinstance(stored, m.Unary) or getattr(stored, "operator", "=") != "="
        if sorted(used) != (sorted(filter(None, names)) if is_update and used else []):
            raise reader.unread(value, "what this stores in is asked once more")
    return stored


def before(reader: ModelExpressionReader, node: Node, arguments: Sequence[Node]) -> m.Expression:
    """`before(x, put(...))`: `x++`, whose value is the one before the store."""
    first, second = arguments
    place = without_parentheses(first)
    if place.type == "subscript" and any(map(_walrus, map(without_parentheses, named(place)))):
        array, index = field(place, "value"), field(place, "subscript")
        with _kept(reader, array, index) as names:
            target: m.Expression = _element(reader, node, array, index, names)
            step = _step_of_kept(second, names)
    else:
        target, step = reader.expression(first), _STEP.search(text_of(second))
        stored = reader.expression(second)
        if not isinstance(stored, m.Unary | m.Postfix) or stored.operand != target:
            step = None
    if step is None:
        raise reader.unread(node, _NO_EXPRESSION)
    operator = "++" if step[2] == "add" else "--"
    return reader.cuts.converted(step[1], m.Postfix(operator, target, reader.py.span(node)))


def _step_of_kept(node: Node, names: tuple[str, str]) -> re.Match[str] | None:
    """`put_item(values, index, int32.add(values[index], 1))`, and nothing else."""
    called, arguments = call_parts(node) or ("", [])
    if called.rpartition(".")[2] != "put_item" or len(arguments) != 3:
        return None
    update, operands = call_parts(arguments[2]) or ("", [])
    read = "".join(text_of(operands[0]).split()) if operands else ""
    is_own = tuple(map(text_of, arguments[:2])) == names and read == f"{names[0]}[{names[1]}]"
    is_one = len(operands) == 2 and text_of(operands[1]) == "1"
    return _STEP.fullmatch(update) if is_own and is_one else None


def _element(
    reader: ModelExpressionReader, node: Node, place: Node, index: Node, names: tuple[str, str]
) -> m.Index:
    """The element that is stored in; only the array itself says which indices it has."""
    walrus = _walrus(without_parentheses(index))
    at = without_parentheses(index) if walrus is None else walrus[1]
    called, _ = call_parts(at) or ("", [])
    if called.endswith(".at") and called.removesuffix(".at") != names[0]:
        raise reader.unread(at, _NO_EXPRESSION)
    kept = _walrus(without_parentheses(place))
    array = reader.expression(place if kept is None else kept[1])
    return m.Index(array, reader.index(at), reader.py.span(node))


@contextmanager
def _kept(reader: ModelExpressionReader, *places: Node) -> Iterator[tuple[str, str]]:
    """The names that keep an array and an index, which stand for these meanwhile."""
    found = [_walrus(without_parentheses(p)) for p in places]
    kept = dict(f for f in found if f is not None)
    if len(kept) != len(found) - found.count(None) or kept.keys() & {*reader.locals, *reader.kept}:
        raise reader.unread(places[0], _NO_EXPRESSION)
    reader.kept |= kept
    array, index = ("" if f is None else f[0] for f in found)
    try:
        yield array, index
    finally:
        for name in kept:
            del reader.kept[name]


def _walrus(node: Node) -> tuple[str, Node] | None:
    if node.type != "named_expression":
        return None
    return text_of(field(node, "name")), field(node, "value")


def _outermost(node: Node) -> tuple[Node, Node | None]:
    """A node with the parentheses around it, and what it stands in."""
    above = node.parent
    while above is not None and above.type == "parenthesized_expression":
        node, above = above, above.parent
    return node, above


def _is_argument(node: Node, above: Node | None, function: str, first: int) -> bool:
    """Whether a node is among the first arguments of a call of a function."""
    if above is None or above.type != "argument_list" or above.parent is None:
        return False
    called, arguments = call_parts(above.parent) or ("", [])
    return called.rpartition(".")[2] == function and node in arguments[:first]
