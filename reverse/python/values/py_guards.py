"""What bindings of a name give after tests of it, and where an exception sets it instead.

`if p != "": p = "/" + p` leaves of the value before it only the one that it is compared with;
what an `except` clause sets stands in for the parameter that the `try` could not get.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.graph import FromParameter, Plain, Unresolved
from rebsync.reverse.python.values.py_evaluator import PyEvaluator
from rebsync.reverse.python.values.py_worth import Value, Ways, distinct
from rebsync.reverse.syntax.ancestors import holds
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of


def together(values: PyEvaluator, found: Sequence[tuple[Binding, Ways]], scope: Scope) -> Ways:
    """What several bindings of one name give together."""
    if len(found) > 1:
        found = [(b, _after_tests(values, b, ways, found, scope)) for b, ways in found]
        found = _with_handlers(found)
    return distinct(w for _, ways in found for w in ways)


# --- tests --------------------------------------------------------------------------------------


def _after_tests(
    values: PyEvaluator,
    binding: Binding,
    ways: Ways,
    found: Sequence[tuple[Binding, Ways]],
    scope: Scope,
) -> Ways:
    """What is left of a binding's values where others under a test of the name follow."""
    block = _block(binding.node)
    for other, _ in found:
        test = _test_around(other.node)
        if test is None or block is None or test.parent != block:
            continue
        if binding.node.end_byte > test.start_byte or field(test, "consequence") == block:
            continue
        compared = _compared(values, test, other, scope)
        if compared is not None:
            operator, constant = compared
            ways = distinct(w for way in ways for w in _left(way, operator, constant))
    return ways


def _left(way: Value, operator: str, constant: Plain) -> Ways:
    """What is left of a value that is not given another one after the test."""
    known = isinstance(way, (bool, int, float, str))
    if operator == "==":  # those that are equal got another value
        return () if known and way == constant else (way,)
    if known:
        return (way,) if way == constant else ()
    return (constant,) if isinstance(way, (FromParameter, Unresolved)) else (way,)


def _block(node: Node) -> Node | None:
    """The block that a binding is a statement of."""
    above = node.parent
    if above is not None and above.type == "expression_statement":
        above = above.parent
    return above if above is not None and above.type in ("block", "module") else None


def _test_around(node: Node) -> Node | None:
    """The `if` without alternatives whose block a binding is a statement of."""
    block = _block(node)
    above = block.parent if block is not None else None
    if above is None or above.type != "if_statement":
        return None
    return above if not above.children_by_field_name("alternative") else None


def _compared(
    values: PyEvaluator, test: Node, binding: Binding, scope: Scope
) -> tuple[str, Plain] | None:
    """The operator and the constant that an `if` compares with what a binding sets."""
    condition = field(test, "condition")
    target = binding.node.child_by_field_name("left")
    if condition.type != "comparison_operator" or target is None:
        return None
    sides = named(condition)
    operators = [text_of(o) for o in condition.children_by_field_name("operators")]
    if len(sides) != 2 or len(operators) != 1 or operators[0] not in ("==", "!="):
        return None
    if text_of(sides[0]) != text_of(target) or sides[1].type not in ("string", "integer", "float"):
        return None
    match values.ways(sides[1], scope):
        case ((bool() | int() | float() | str()) as constant,):
            return operators[0], constant
        case _:
            return None


# --- exceptions ---------------------------------------------------------------------------------


def _with_handlers(found: Sequence[tuple[Binding, Ways]]) -> list[tuple[Binding, Ways]]:
    """Parameters that a `try` gets, with what its `except` sets in their place."""
    kept = [*found]
    for handler, given in found:
        attempt = _try_of_handler(handler.node)
        if attempt is None or len(given) != 1 or not isinstance(given[0], (bool, int, float, str)):
            continue
        default = given[0]
        body = field(attempt, "body")
        inside = [b for b, _ in kept if holds(body, b.node)]
        changed = [
            (b, tuple(_standing_in(w, default) for w in ways) if b in inside else ways)
            for b, ways in kept
        ]
        if changed == kept:
            continue
        kept = [
            (b, tuple(w for w in ways if type(w) is not type(default) or w != default))
            if b is handler or b in inside
            else (b, ways)
            for b, ways in changed
        ]
    return kept


def _standing_in(way: Value, default: Plain) -> Value:
    if isinstance(way, FromParameter) and way.default is None:
        return replace(way, default=default)
    return way


def _try_of_handler(node: Node) -> Node | None:
    """The `try` in whose `except` clause a binding is a statement."""
    block = _block(node)
    clause = block.parent if block is not None else None
    return clause.parent if clause is not None and clause.type == "except_clause" else None
