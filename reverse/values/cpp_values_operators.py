"""The values of operations."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.graph import FromParameter, Unresolved
from rebsync.reverse.syntax.cpp_tree import part, text_of
from rebsync.reverse.values.cpp_evaluator import CppEvaluator
from rebsync.reverse.values.cpp_values_numbers import added, computed, used
from rebsync.reverse.values.cpp_values_plain import Frame, Length, Value, each, pairs, same


def unary(values: CppEvaluator, node: Node, frame: Frame) -> Value:
    """The value of an operation on one operand."""
    operator = frame.cpp.operator(node)

    def one(value: Value) -> Value:
        match value:
            case bool() | int() | float():
                results = {"-": -value, "+": value, "!": not value}
                return results.get(operator, values.unknown(f"{operator}", node, frame))
            case FromParameter():
                return used(value, f"{operator}value", one)
            case Unresolved():
                return value
            case _:
                return values.unknown(f"the operator {operator}", node, frame)

    return each(one, values.value(part(node, "argument"), frame))


def binary(values: CppEvaluator, node: Node, frame: Frame) -> Value:
    """The value of an operation on two operands."""
    left, right = part(node, "left"), part(node, "right")
    operator = text_of(part(node, "operator"))
    a = values.value(left, frame)
    if operator in ("&&", "||") and same(a, operator == "||"):
        return operator == "||"
    return pairs(
        lambda x, y: _operation(values, operator, x, y, node, frame), a, values.value(right, frame)
    )


def _operation(
    values: CppEvaluator, operator: str, a: Value, b: Value, node: Node, frame: Frame
) -> Value:
    match a, b:
        case ((bool() | int() | float() | str()), (bool() | int() | float() | str())):
            result = computed(operator, a, b)
            return result if result is not None else _no(values, operator, node, frame)
        case ((str() | Unresolved()), (str() | Unresolved())) if operator == "+":
            return added(a, b)
        case (FromParameter(), str()) | (str(), FromParameter()) if operator == "+":
            return added(a, b)
        case FromParameter(), (int() | float()) if operator in "+-*/":
            text = _operand(part(node, "right"), b)
            again = f"value{operator}{text}"
            return used(a, again, lambda v: _operation(values, operator, v, b, node, frame))
        case ((int() | float()), FromParameter()) if operator in "+-*/":
            text = _operand(part(node, "left"), a)
            again = f"{text}{operator}value"
            return used(b, again, lambda v: _operation(values, operator, a, v, node, frame))
        case (Length(), (int() | float())) | ((int() | float()), Length()):
            return _scaled(operator, a, b) or _no(values, operator, node, frame)
        case Unresolved(), _:
            return Unresolved(a.why, a.place)
        case _, Unresolved():
            return Unresolved(b.why, b.place)
        case _:
            return _no(values, operator, node, frame)


def _no(values: CppEvaluator, operator: str, node: Node, frame: Frame) -> Unresolved:
    return values.unknown(f"the operator {operator} on what is not known", node, frame)


def _operand(node: Node, value: Value) -> str:
    return text_of(node) if node.type == "number_literal" else str(value)


def _scaled(operator: str, a: Value, b: Value) -> Value | None:
    """A span of time times or by a number."""
    match a, b:
        case Length(seconds), (int() | float()) if isinstance(seconds, (int, float)):
            result = computed(operator, float(seconds), b) if operator in "*/" else None
            return Length(result) if result is not None else None
        case ((int() | float()), Length(seconds)) if isinstance(seconds, (int, float)):
            return Length(float(seconds) * a) if operator == "*" else None
        case _:
            return None
