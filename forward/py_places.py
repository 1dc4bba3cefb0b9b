"""Assignments of the model as expressions of Python, in the model's order of evaluation."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from rebsync import model as m
from rebsync.forward.py_operators import ATOM
from rebsync.forward.py_types import py_format
from rebsync.static.effects import assigns_apart
from rebsync.static.types import INT

if TYPE_CHECKING:
    from rebsync.forward.py_expression_writer import PyExpressionWriter

_METHODS = {
    "+=": "add",
    "-=": "subtract",
    "*=": "multiply",
    "/=": "divide",
    "%=": "remainder",
    "<<=": "shift_left",
    ">>=": "shift_right",
    "&=": "all_of",
    "|=": "any_of",
    "^=": "one_of",
}


def bare(target: m.Expression) -> m.Expression:
    """A target without parentheses."""
    return bare(target.inner) if isinstance(target, m.Paren) else target


def is_in_order(e: PyExpressionWriter, expression: m.Assign) -> bool:
    """Whether Python's order, the value before the target's index, is as good as the model's."""
    if not isinstance(bare(expression.target), m.Index):
        return True
    return not assigns_apart(expression, e.analysis)


def compound(e: PyExpressionWriter, expression: m.Assign, target: str) -> str:
    """What `target += value` and its kin store, `target` being what is read."""
    value = e.text(expression.value)
    return f"{_format(e, expression.target)}.{_METHODS[expression.operator]}({target}, {value})"


def step(e: PyExpressionWriter, expression: m.Unary | m.Postfix, target: str) -> str:
    """What `++` and `--` store."""
    method = _METHODS[f"{expression.operator[0]}="]
    return f"{_format(e, expression.operand)}.{method}({target}, 1)"


def _format(e: PyExpressionWriter, target: m.Expression) -> str:
    return py_format(e.type_of(target) or INT)


def assigned(e: PyExpressionWriter, expression: m.Assign) -> str:
    """An assignment whose value is used, or whose target must be found before the value is."""
    target = bare(expression.target)
    if expression.operator != "=":
        return _updated(e, target, lambda old: compound(e, expression, old))
    type_ = e.type_of(expression.target) or INT
    if isinstance(target, m.Index):
        values = e.temporary("values")
        of, index = e.text(target.target), e.text(target.index)
        value = e.stored(expression.value, type_)
        return f"put_item(({values} := {of}), {values}.at({index}), {value})"
    return _store(e, target, e.stored(expression.value, type_))


def stepped(e: PyExpressionWriter, expression: m.Unary | m.Postfix) -> str:
    """`++` and `--` whose value is used."""
    target = bare(expression.operand)
    if isinstance(expression, m.Unary):
        return _updated(e, target, lambda old: step(e, expression, old))
    if isinstance(target, m.Index):
        values, at = e.temporary("values"), e.temporary("index")
        of, index = e.text(target.target), e.text(target.index)
        first = f"({values} := {of})[({at} := {values}.at({index}))]"
        value = step(e, expression, f"{values}[{at}]")
        return f"before({first}, put_item({values}, {at}, {value}))"
    name = e.operand(target, ATOM)
    return f"before({name}, {_store(e, target, step(e, expression, name))})"


def _updated(e: PyExpressionWriter, target: m.Expression, new: Callable[[str], str]) -> str:
    """A store of what is made of the value that is there."""
    if isinstance(target, m.Index):
        values, at = e.temporary("values"), e.temporary("index")
        of, index = e.text(target.target), e.text(target.index)
        where = f"({values} := {of}), ({at} := {values}.at({index}))"
        return f"put_item({where}, {new(f'{values}[{at}]')})"
    return _store(e, target, new(e.operand(target, ATOM)))


def _store(e: PyExpressionWriter, target: m.Expression, value: str) -> str:
    name = e.operand(target, ATOM)
    if name.startswith("self."):
        return f'put(self, "{name.removeprefix("self.")}", {value})'
    return f"({name} := {value})"
