"""Checks of constants when a node of generated Python starts, which the constants pass."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping

from tree_sitter import Node

from rebsync.intervals import Interval
from rebsync.reverse.python.generated.py_types import without_parentheses
from rebsync.reverse.python.generated.roles import EnvUse
from rebsync.reverse.python.generated.slicing.logs import only_logs
from rebsync.reverse.syntax.py_tree import field, named, text_of, whole_number_of

_COMPARED: Mapping[str, Callable[[int, int], bool]] = {
    **{"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge},
    **{"==": operator.eq, "!=": operator.ne},
}
_COMPUTED: Mapping[str, Callable[[int, int], int]] = {
    **{"+": operator.add, "-": operator.sub, "*": operator.mul},
}


def is_passed(
    statement: Node, env: Mapping[str, EnvUse], constants: Mapping[str, Interval]
) -> bool:
    """Whether a statement only raises if constants are not as they are: `if self._n < 1: raise`.

    `env` are the attributes that hold constants of the model, `constants` the numbers of these.
    """
    found = {n: constants[use.name] for n, use in env.items() if use.name in constants}
    known = {f"self.{name}": i.low for name, i in found.items() if i.low == i.high}
    if statement.type == "assert_statement":
        return _value(named(statement)[0], known) is True
    if statement.type != "if_statement" or statement.children_by_field_name("alternative"):
        return False
    body = named(field(statement, "consequence"))
    only_raises = all(s.type == "raise_statement" or only_logs(s) for s in body)
    return only_raises and _value(field(statement, "condition"), known) is False


def _value(node: Node, known: Mapping[str, int]) -> int | bool | None:
    """What an expression of constants gives; None if that is not known."""
    node = without_parentheses(node)
    match node.type:
        case "integer":
            return whole_number_of(node)
        case "true" | "false":
            return node.type == "true"
        case "attribute":
            return known.get(text_of(node))
        case "not_operator":
            value = _value(field(node, "argument"), known)
            return None if value is None else not value
        case "unary_operator" if text_of(field(node, "operator")) == "-":
            value = _value(field(node, "argument"), known)
            return None if value is None else -value
        case "binary_operator" | "boolean_operator":
            left, right = (_value(field(node, side), known) for side in ("left", "right"))
            return _joined(text_of(field(node, "operator")), left, right)
        case "comparison_operator":
            return _compared(node, known)
        case _:
            return None


def _joined(word: str, left: int | bool | None, right: int | bool | None) -> int | bool | None:
    if left is None or right is None:
        return None
    match word:
        case "and":
            return left and right
        case "or":
            return left or right
        case _:
            return _COMPUTED[word](left, right) if word in _COMPUTED else None


def _compared(node: Node, known: Mapping[str, int]) -> bool | None:
    """`0 < a <= b`, from one to the next."""
    values = [_value(each, known) for each in named(node)]
    words = [text_of(c) for c in node.children if not c.is_named]
    if None in values or not set(words) <= _COMPARED.keys() or len(words) != len(values) - 1:
        return None
    numbers = [v for v in values if v is not None]
    pairs = zip(words, numbers, numbers[1:], strict=False)
    return all(_COMPARED[word](one, other) for word, one, other in pairs)
