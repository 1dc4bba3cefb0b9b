"""The formats of numbers in generated Python, by which `int32.add(x, 1)` is the model's `x++`."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import binary
from rebsync.reverse.python.generated import idioms
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.syntax.py_tree import text_of

FORMATS = {
    "int8": "byte",
    "int16": "short",
    "int32": "int",
    "float32": "float",
    "float64": "double",
    "boolean": "boolean",
}
NARROW = frozenset({"int8", "int16"})
_UPDATES = {
    "add": "+",
    "subtract": "-",
    "multiply": "*",
    "divide": "/",
    "remainder": "%",
    "shift_left": "<<",
    "shift_right": ">>",
    "all_of": "&",
    "any_of": "|",
    "one_of": "^",
}
# Those of whole numbers and numbers with a point alike, without a format.
_ALONE = {name: _UPDATES[name] for name in ("divide", "remainder", "shift_left", "shift_right")}
_ALONE |= {"quotient": "/", "modulus": "%"}


def updated(
    reader: ModelExpressionReader, target: m.Expression, called: str, arguments: list[Node]
) -> m.Unary | m.Assign | None:
    """`x = int32.add(x, 1)` as `++x` or `x += e`; None for another value of the target `x`."""
    operator = _operator(called, arguments)
    holder = called.rpartition(".")[0]
    if (
        not (holder and operator)
        or reader.expression(arguments[0]) != target
        or not is_kept(reader, target, holder)
    ):
        return None
    if operator in "+-" and text_of(arguments[1]) == "1":
        return m.Unary(operator * 2, target)
    return m.Assign(f"{operator}=", target, reader.expression(arguments[1]))


def operation(
    reader: ModelExpressionReader, node: Node, called: str, arguments: list[Node]
) -> m.Expression | None:
    """`divide(a, b)` as `a / b`; `int32.add(a, b)` as `a + b`, cut where the model would not; None
    for another call.
    """
    operator = _operator(called, arguments)
    if not operator:
        return None
    left, right = map(reader.expression, arguments)
    made = binary(operator, left, right, reader.py.span(node))
    holder = called.rpartition(".")[0]
    if not holder:
        return reader.cuts.operated(called, made)
    if holder in NARROW:
        return cast(holder, made)
    return idioms.grouped(node, reader.cuts.converted(holder, made, update=True))


def _operator(called: str, arguments: list[Node]) -> str:
    holder, _, method = called.partition(".")
    table = _ALONE if not method else _UPDATES if holder in FORMATS else {}
    return table.get(method or holder, "") if len(arguments) == 2 else ""


def is_kept(reader: ModelExpressionReader, target: m.Expression, called: str) -> bool:
    """Whether a variable is of the type of a format, so that storing implies the conversion."""
    type_ = idioms.type_of(reader, target)
    return type_ is None or type_.name == FORMATS[called]


def cast(called: str, read: m.Expression) -> m.Expression:
    """A conversion that the model does not imply."""
    is_plain = not isinstance(read, m.Binary | m.Conditional | m.Assign)
    return m.Cast(m.Type(FORMATS[called]), read if is_plain else m.Paren(read))
