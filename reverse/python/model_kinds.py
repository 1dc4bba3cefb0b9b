"""The types that expressions of the model have, for variables of Python that are given none."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from rebsync import model as m

_INT, _DOUBLE, _BOOLEAN = m.Type("int"), m.Type("double"), m.Type("boolean")
_INTEGERS = frozenset({"byte", "short", "int"})
_FLOATING = frozenset({"float", "double"})
_TIMES = frozenset({"now", *(f"currentMessage{n}" for n in ("Arrival", "Deadline", "WaitingTime"))})
_TESTS = frozenset({"<", "<=", ">", ">=", "==", "!=", "&&", "||"})

Known: TypeAlias = Callable[[str], "m.Type | None"]


def kind_of(expression: m.Expression, known: Known, results: Mapping[str, m.Type]) -> m.Type | None:
    """The widest type of the kind of an expression's value; None where it cannot be told.

    `known` tells those of variables, `results` those of functions. A variable of Python holds any
    integer and numbers of 64 bits, so that it is an `int` or a `double` whatever is stored in it.
    """

    def of(inner: m.Expression) -> m.Type | None:
        return kind_of(inner, known, results)

    match expression:
        case m.IntLiteral():
            return _INT
        case m.FloatLiteral():
            return _DOUBLE
        case m.BoolLiteral() | m.Unary("!") | m.InstanceOf():
            return _BOOLEAN
        case m.Paren(inner) | m.Unary(_, inner) | m.Postfix(_, inner):
            return of(inner)
        case m.Name(name) if name in _TIMES and known(name) is None:
            return _INT
        case m.Name(name) | m.Member(m.Self(), name):
            return _widest(known(name))
        case m.Index(target):
            return _element(target, known)
        case m.Cast(type_):
            return _widest(type_)
        case m.Call(None, "pow" | "sqrt" as name) if name not in results:
            return _DOUBLE
        case m.Call(None, name):
            return _widest(results.get(name))
        case m.Conditional(_, then, otherwise):
            return _joined(of(then), of(otherwise))
        case m.Binary(operator, left, right):
            kinds = of(left), of(right)
            is_real = operator not in _TESTS and _DOUBLE in kinds
            return _BOOLEAN if operator in _TESTS else _DOUBLE if is_real else _joined(*kinds)
        case _:
            return None


def is_floating(type_: m.Type | None) -> bool:
    """Whether values of a type have a fraction."""
    return type_ is not None and type_.name in _FLOATING and not type_.dimensions


def _element(target: m.Expression, known: Known) -> m.Type | None:
    depth = 1
    while isinstance(target, m.Index):
        target, depth = target.target, depth + 1
    name = target.name if isinstance(target, m.Name | m.Member) else ""
    type_ = known(name)
    if type_ is None or len(type_.dimensions) != depth:
        return None
    return _widest(m.Type(type_.name))


def _widest(type_: m.Type | None) -> m.Type | None:
    if type_ is None or type_.dimensions or type_.name == "void":
        return None
    if type_.name in _INTEGERS:
        return _INT
    return _DOUBLE if type_.name in _FLOATING else m.Type(type_.name)


def _joined(left: m.Type | None, right: m.Type | None) -> m.Type | None:
    if left == right or None in (left, right):
        return left if left == right else None
    return _DOUBLE if {left, right} == {_INT, _DOUBLE} else None
