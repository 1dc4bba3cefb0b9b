"""Tables of constants: dictionaries, lists and tuples that are made once and only looked into."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync.reverse.python.bodies.body_expression_reader import BodyExpressionReader
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import unknown
from rebsync.reverse.python.bodies.body_units import scope_around
from rebsync.reverse.python.expressions.tables import pairs_of, selected
from rebsync.reverse.python.expressions.values import STRING, TRUTH, WHOLE, Value
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import External, Items, Table
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import field, text_of

# What may store an element, or take it out, if that is a part of it.
_CHANGES = frozenset(
    {"delete_statement", "augmented_assignment", "expression_list", "as_pattern_target"}
    | {"pattern_list", "list_pattern", "tuple_pattern"}
)
_LOOKS = frozenset({"get", "keys", "values", "items"})
# Functions that only go through what they are given.
_READERS = tuple(
    (External(f"builtins.{name}"),)
    for name in ("all", "any", "enumerate", "len", "max", "min", "sum", "zip")
)
# Functions that make a container of their own.
_MAKING = frozenset({"dict", "frozenset", "list", "range", "set", "sorted", "tuple"})
_MOST = 32
_DEEPEST = 8
_KEYS = frozenset({STRING, WHOLE})


def container(reader: BodyExpressionReader, node: Node, ordered: bool) -> Sequence[Value] | None:
    """The elements of a constant list, or the keys of a constant table.

    Those of a table have no order in Python 2.
    """
    if (pairs := table(reader, node)) is not None:
        is_ordered = reader.reading.unit.version == 3
        return [key for key, _ in pairs] if is_ordered or not ordered else None
    match reader.reading.values.ways(node, reader.frame.scope):
        case (Items(each),) if _is_constant(reader.reading, node):
            values = [reader.reading.constant(ways) for ways in each]
            return None if None in values else [v for v in values if v is not None]
        case _:
            return None


def element(reader: BodyExpressionReader, node: Node) -> Value:
    """`TABLE[key]`."""
    keys = node.children_by_field_name("subscript")
    pairs = pairs_of(reader, field(node, "value"))
    if len(keys) != 1 or not pairs:
        raise unknown(reader.frame, node, f'"{text_of(node)}"')
    found = selected(reader, node, reader.read(keys[0]), pairs[:-1], pairs[-1][1])
    if _has_all(reader, pairs, keys[0]):
        reader.reading.exact.add((reader.frame.py.source.path, reader.frame.span(node)))
    return found


def _has_all(reader: BodyExpressionReader, pairs: Sequence[tuple[Value, Value]], key: Node) -> bool:
    """Whether a table has all that a key may be."""
    ways = reader.reading.values.ways(key, reader.frame.scope)
    values = [reader.reading.constant((way,)) for way in ways]
    known = [each.expression for each, _ in pairs]
    return bool(values) and all(v is not None and v.expression in known for v in values)


def table(reader: BodyExpressionReader, node: Node) -> list[tuple[Value, Value]] | None:
    """The keys and values of a table, all constants, no key twice; None for other expressions."""
    match reader.reading.values.ways(node, reader.frame.scope):
        case (Table(pairs),) if 0 < len(pairs) <= _MOST:
            pass
        case _:
            return None
    if not _is_constant(reader.reading, node):
        return None
    found: list[tuple[Value, Value]] = []
    for keys, values in pairs:
        key, value = reader.reading.constant(keys), reader.reading.constant(values)
        if key is None or value is None or key.kind not in _KEYS or value.kind == TRUTH:
            return None
        found.append((key, value))
    keys_ = [key.expression for key, _ in found]
    kinds = {key.kind for key, _ in found}
    is_plain = len(kinds) == 1 and all(k not in keys_[:n] for n, k in enumerate(keys_))
    return found if is_plain else None


def _is_constant(reading: Reading, node: Node, depth: int = 0) -> bool:
    """Whether a table is a literal, or has a name that is bound once and only looked into.

    What it is bound to is such a table, or is made for it: no other name changes that.
    """
    match node.type:
        case "dictionary" | "tuple" | "list" | "set":
            return True
        case "call":
            function = field(node, "function")
            if function.type == "identifier":
                return text_of(function) in _MAKING
            is_view = function.type == "attribute"
            return is_view and _is_constant(reading, field(function, "object"), depth + 1)
        case "identifier" | "attribute" if depth < _DEEPEST:
            made = bound_once(reading.values, text_of(node).rpartition(".")[2])
            return made is not None and _is_constant(reading, made, depth + 1)
        case _:
            return False


def bound_once(values: PyValues, name: str) -> Node | None:
    """The one value that code binds a name to of which it does no more than to look into it."""
    made: list[Node] = []
    for module in values.code.modules.values():
        for each in nodes_in(module.node):
            if each.type == "identifier" and text_of(each) == name:
                use = _use(values, each, module.py.source.path)
                if use is None:
                    return None
                made += use
    return made[0] if len(made) == 1 else None


def _use(values: PyValues, name: Node, path: str) -> list[Node] | None:
    """What a place in the code binds a name to; None where it may do more than to look."""
    at = name
    above = at.parent
    if above is not None and above.type == "attribute" and field(above, "attribute") == name:
        at, above = above, above.parent
    match above.type if above is not None else "":
        case "assignment" if above is not None and above.child_by_field_name("left") == at:
            value = above.child_by_field_name("right")
            return [value] if value is not None else None
        case "subscript" if above is not None and field(above, "value") == at:
            return None if _is_changed(above) else []
        case "attribute" if above is not None and field(above, "object") == at:
            return [] if text_of(field(above, "attribute")) in _LOOKS else None
        case "comparison_operator":
            return []
        case "for_in_clause" if above is not None and field(above, "right") == at:
            return []  # its elements are constants
        case "argument_list" if above is not None and above.parent is not None:
            function = field(above.parent, "function")
            ways = values.ways(function, scope_around(values.code, name, path))
            return [] if ways in _READERS else None
        case _:
            return None


def _is_changed(element_: Node) -> bool:
    above = element_.parent
    if above is None or above.type in _CHANGES:
        return True
    return above.type in ("assignment", "for_statement") and (
        above.child_by_field_name("right") != element_
    )
