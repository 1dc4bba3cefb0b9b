"""The law of extraction for generated Python, and what Python does not show of a model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from rebsync import model as m
from rebsync.config import Config
from rebsync.forward.generate import generate
from rebsync.forward.py_loops import steps
from rebsync.forward.py_switches import Branch, branches
from rebsync.roundtrip.diff.normal_form import as_in_python, normal, rewrite
from rebsync.static import analyse
from tests.reverse.laws import assert_same, extracted

_COMPARED = frozenset({"<", "<=", ">", ">=", "==", "!="})

__all__ = ["assert_says", "extracted", "python_files", "python_normal", "without_chains"]


def python_files(model: m.Model, target: str = "ros1-py") -> dict[str, str]:
    """The package of a model that has no errors; in ROS 2 without that of its messages."""
    files = generate(model, (), analyse(model), Config(target=target), "drawn")
    inside = {p.removeprefix("drawn/"): t for p, t in files.items() if p.startswith("drawn/")}
    return inside if "package.xml" in inside else files


def assert_says(files: Mapping[str, str], model: m.Model) -> None:
    """The law: what a package says is the model that it was generated from."""
    found = extracted(files)
    assert [(f.text, f.why) for f in found.findings] == []
    assert_same(python_normal(found.model), python_normal(normal(model)))


def python_normal(model: m.Model) -> m.Model:
    """A normal form without what Python does not show, nor what compares as one anyway.

    The latter is `self.x` against `x` where nothing hides it, `++x` against `x++` as statements,
    `m()` against `self.m()`, and parentheses that a formatter of Python takes away (around a whole
    condition or value, doubled ones) or that are there in any case (around comparisons and `!`
    below other operators, assignments that are values, conditional expressions in another).
    """
    return rewrite(as_in_python(model), _rule)


def without_chains(model: m.Model) -> m.Model:
    """A model without what only a marker tells in Python: a `switch` among `if`, a step among what
    a loop does last (docs/mapping.md, "What needs a marker")."""
    return rewrite(model, _chained)


def _chained(node: object) -> object:
    match node:
        case m.Switch(subject) if (found := branches(node)) is not None:
            return _chain(subject, found)
        case m.For(condition=condition, body=m.Block(body)) if condition is not None:
            last = tuple(m.ExpressionStatement(e) for e in steps(node))
            return m.While(condition, m.Block((*body, *last))) if last else node
        case _:
            return node


def _chain(subject: m.Expression, found: tuple[Branch, ...]) -> m.Statement:
    otherwise: m.Statement | None = None
    for branch in reversed(found):
        body = m.Block(branch.statements)
        if not branch.values:
            otherwise = body
            continue
        first, *others = (m.Binary("==", subject, v) for v in branch.values)
        condition: m.Expression = first
        for other in others:
            condition = m.Binary("||", condition, other)
        otherwise = m.If(condition, body, otherwise)
    assert otherwise is not None
    return otherwise


def _rule(node: object) -> object:
    match node:
        case m.Member(m.Self(), name):
            return m.Name(name)
        case m.Call(target=m.Paren(inner)):
            return replace(node, target=inner)
        case m.Call(target=m.Self()):
            return replace(node, target=None)
        case m.ExpressionStatement(expression):
            return replace(node, expression=_step(_bare(expression)))
        case m.Paren(m.Paren() | m.Assign() | m.Unary("!") as inner):
            return inner
        case m.Paren(m.Binary(operator) as inner) if operator in _COMPARED:
            return inner
        case m.Assign(value=value):
            return replace(node, value=_bare(value))
        case m.Declarator(initial=m.Paren() as value):
            return replace(node, initial=_bare(value))
        case m.ArrayInitializer(values):
            plain = (v if isinstance(v, m.ArrayInitializer) else _bare(v) for v in values)
            return replace(node, values=tuple(plain))
        case m.Return(m.Paren() as value):
            return replace(node, value=_bare(value))
        case m.For(updates=updates, condition=condition):
            bare = condition.inner if isinstance(condition, m.Paren) else condition
            return replace(node, updates=tuple(_step(_bare(u)) for u in updates), condition=bare)
        case m.If() | m.While():
            return replace(node, condition=_bare(node.condition))
        case m.Conditional(condition, then, otherwise):
            return m.Conditional(_inner(condition), _inner(then), _inner(otherwise))
        case _:
            return node


def _step(expression: m.Expression) -> m.Expression:
    match expression:
        case m.Unary("++" | "--" as operator, operand):
            return m.Postfix(operator, operand)
        case _:
            return expression


def _bare(expression: m.Expression) -> m.Expression:
    return _bare(expression.inner) if isinstance(expression, m.Paren) else expression


def _inner(expression: m.Expression) -> m.Expression:
    is_inner = isinstance(expression, m.Paren) and isinstance(expression.inner, m.Conditional)
    return expression.inner if isinstance(expression, m.Paren) and is_inner else expression
