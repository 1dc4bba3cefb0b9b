"""Locals of Python that stand for an array of the object: `other = self._a if c else self._b`.

Such a local is the array and no copy. It is read as the array itself, so it must be bound once,
only its elements may be looked at or stored, and nothing may put another array in the place of that
one. What follows a local that is either of two is read twice: in both branches of an `if`.
"""

from __future__ import annotations

import re
from typing import Any

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.python.generated.member_places import name_around
from rebsync.reverse.python.generated.slicing.candidates import SET_UP
from rebsync.reverse.python.generated.statement_reader import ModelStatementReader
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import MODULE, PyCode
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import SCOPES, field, named, text_of

_UNSAFE = SCOPES | {"augmented_assignment", "named_expression", "delete_statement"}
_NO_ARRAY = frozenset(
    {"expression_list", "identifier", "integer", "true", "false", "unary_operator"}
)
_NONE: tuple[str, list[Node], Node | None] = "", [], None
_TARGETS = frozenset({"pattern_list", "tuple_pattern", "list_pattern", "attribute"})


def behind(reader: ModelStatementReader, node: Node, rest: list[Node]) -> list[m.Statement] | None:
    """The statements behind one that makes a local stand for an array; None if it does not."""
    name, arrays, condition = _declared(node)
    if not arrays or name in reader.expressions.locals or not _is_alias(node, name):
        return None
    if not all(is_kept(reader, array) for array in arrays):
        return None
    if condition is None:
        return _read(reader, name, arrays[0], rest)
    chosen = reader.expressions.condition(condition)
    span = reader.expressions.py.span(node)
    ways = [m.Block(tuple(_once_more(reader, name, a, rest)), (), span) for a in arrays]
    return [m.If(chosen, ways[0], ways[1], (), span)]


def _declared(node: Node) -> tuple[str, list[Node], Node | None]:
    """The local, the attributes that it may stand for, and what decides; no attributes if none."""
    if node.type == "if_statement":
        return _of_branches(node)
    inner = named(node)[0] if node.type == "expression_statement" and named(node) else node
    left, value = inner.child_by_field_name("left"), inner.child_by_field_name("right")
    if inner.type != "assignment" or left is None or value is None or left.type != "identifier":
        return _NONE
    while value.type == "parenthesized_expression":
        value = named(value)[0]
    condition: Node | None = None
    arrays = [value]
    if value.type == "conditional_expression":
        then, condition, otherwise = named(value)
        arrays = [then, otherwise]
    is_own = all(a.type == "attribute" and text_of(field(a, "object")) == "self" for a in arrays)
    return text_of(left), arrays if is_own else [], condition


def _of_branches(node: Node) -> tuple[str, list[Node], Node | None]:
    """The same of `if c: x = self._a` and `else: x = self._b`."""
    match node.children_by_field_name("alternative"):
        case [otherwise] if otherwise.type == "else_clause":
            blocks = named(field(node, "consequence")), named(field(otherwise, "body"))
            ways = [_declared(block[0]) if len(block) == 1 else _NONE for block in blocks]
            (name, arrays, asked), (other, others, also) = ways
            if name == other and len(arrays) == len(others) == 1 and asked is also is None:
                return name, [*arrays, *others], field(node, "condition")
            return _NONE
        case _:
            return _NONE


def _read(
    reader: ModelStatementReader, name: str, array: Node, rest: list[Node]
) -> list[m.Statement]:
    stands = reader.expressions.read(array)
    with reader.expressions.standing_for([name], [stands]):
        return list(reader.block(rest, array).statements)


def is_kept(reader: ModelStatementReader, array: Node) -> bool:
    """Whether an attribute is an array of one dimension that no other takes the place of."""
    code = reader.expressions.names.constants.code.code
    return is_array(reader, array) and not _is_put(code, text_of(field(array, "attribute")))


def is_array(reader: ModelStatementReader, node: Node) -> bool:
    """Whether something is an attribute of the object that is an array of one dimension."""
    if node.type != "attribute" or text_of(field(node, "object")) != "self":
        return False
    names = reader.expressions.names
    type_ = names.types.get(names.variables.get(text_of(field(node, "attribute")), ""))
    return type_ is not None and len(type_.dimensions) == 1


def _is_put(code: PyCode, attribute: str) -> bool:
    """Whether anything but the set-up of an object stores in an attribute as a whole."""
    every = (*code.modules.values(), *code.scopes.values())
    own = [scope for scope in every if not is_runtime_file(scope.py.source)]
    # As setattr names it, and what is no binding.
    other = re.compile(rf"([\"']){attribute}\1|\bdel\b[^\n]*\.{attribute}\b")
    if any(other.search(scope.py.source.text) for scope in own if scope.kind == MODULE):
        return True
    bound = [b for scope in own for b in scope.attributes.get(attribute, ())]
    stores = (item for scope in own for item in scope.stores.items())
    bound += [b for (_, name), found in stores if name == attribute for b in found]
    return any(name_around(b.node) not in SET_UP for b in bound)


def _is_alias(node: Node, name: str) -> bool:
    """Whether a local is bound once, and else only its elements are looked at or stored."""
    function = climb(node, lambda n: n.type in SCOPES)
    if function is None:
        return False
    uses = [n for n in nodes_in(function) if n.type == "identifier" and text_of(n) == name]
    made = [
        n for n in nodes_in(node) if n.type == "assignment" and text_of(field(n, "left")) == name
    ]
    lefts = [field(each, "left") for each in made]
    others = [n for n in uses if n not in lefts]
    return len(uses) == len(others) + len(lefts) and all(is_element(n, function) for n in others)


def is_element(use: Node, function: Node) -> bool:
    """Whether a use is `x[e]`, in a place that does not go by what it is called."""
    place = use.parent
    if place is None or place.type != "subscript" or field(place, "value") != use:
        return False
    above = place.parent
    if above is not None and above.type == "pattern_list" and _stores_plain(above):
        above = above.parent
    while above is not None and above != function:
        if above.type in _UNSAFE or above.type in _TARGETS - {"attribute"}:
            return False
        if above.type == "assignment" and not _is_simple(above):
            return False
        above = above.parent
    return above is not None


def _stores_plain(lefts: Node) -> bool:
    """Whether `x[0], x[1] = a, b` stores what no array is asked for: nothing goes by its name."""
    assignment = lefts.parent
    value = assignment.child_by_field_name("right") if assignment is not None else None
    return value is not None and all(n.type in _NO_ARRAY for n in nodes_in(value) if n.is_named)


def _is_simple(assignment: Node) -> bool:
    """Whether values are stored, each in one place."""
    above, left = assignment.parent, field(assignment, "left")
    value = assignment.child_by_field_name("right")
    if left.type == "pattern_list" and not _stores_plain(left):
        return False
    is_one = left.type == "pattern_list" or left.type in ("identifier", "attribute", "subscript")
    is_alone = above is not None and above.type == "expression_statement"
    return is_one and is_alone and value is not None and value.type != "assignment"


# --- reading twice ------------------------------------------------------------------------------


def _once_more(
    reader: ModelStatementReader, name: str, array: Node, rest: list[Node]
) -> list[m.Statement]:
    """What follows, read so that it can be read again: what it declares is not known afterwards."""
    own = reader.expressions
    tables: list[dict[str, Any]] = [own.locals, own.kept, own.closures]
    tables += [reader.hoisted, reader.inner]
    before = [dict(table) for table in tables]
    implied = set(reader.implied)
    found = _read(reader, name, array, rest)
    for table, known in zip(tables, before, strict=True):
        table.clear()
        table.update(known)
    reader.implied = implied
    return found
