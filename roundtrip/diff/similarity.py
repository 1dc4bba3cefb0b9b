"""How alike two statements are, and what one has inside of it."""

from __future__ import annotations

import re
from collections import Counter
from typing import TypeAlias

from rebsync import model as m
from rebsync.printing import print_statement
from rebsync.roundtrip.diff.expressions import statements_of

Statements: TypeAlias = tuple[m.Statement, ...]

_WORD = re.compile(r"%?\w+|[^\w\s%(){},;.]+")


def words_of(statement: m.Statement) -> Counter[str]:
    """The words of a statement but for what only separates."""
    return Counter(_WORD.findall(print_statement(statement)))


def head_of(statement: m.Statement) -> m.Statement:
    """A statement without what is inside of it."""
    nothing = m.Block(())
    match statement:
        case m.If(condition):
            return m.If(condition, nothing)
        case m.While(condition):
            return m.While(condition, nothing)
        case m.For(initial, condition, updates):
            return m.For(initial, condition, updates, nothing)
        case m.Switch(subject):
            return m.Switch(subject, ())
        case _:
            return statement


def inner_lists(statement: m.Statement) -> list[Statements]:
    """The lists of statements directly inside of one."""
    match statement:
        case m.If(_, then, otherwise):
            return [statements_of(then), statements_of(otherwise)]
        case m.While(_, body) | m.For(body=body):
            return [statements_of(body)]
        case m.Block(inner):
            return [inner]
        case _:
            return []


def around_some(
    outer: list[m.Statement], statements: list[m.Statement]
) -> tuple[m.Statement, Statements] | None:
    """A statement that has some others inside, with the list in which they are."""
    wanted = [s for s in statements if s != m.Empty()]
    for statement in outer:
        for inner in inner_lists(statement):
            if any(s in inner for s in wanted):
                return statement, inner
    return None


def with_inner(statements: list[m.Statement], outer: m.Statement, inner: Statements) -> Statements:
    """The statements with what is inside of one of them in its place, and its other branch."""
    branches = [b for b in inner_lists(outer) if b is not inner]
    rest = tuple(s for branch in branches for s in branch)
    return tuple(each for s in statements for each in ((*inner, *rest) if s is outer else (s,)))


def are_akin(x: m.Statement, r: m.Statement) -> bool:
    """Whether two statements do the same to the same, if perhaps with other values."""
    match x, r:
        case (m.Return(), m.Return()) | (m.Empty(), m.Empty()):
            return True
        case (m.ExpressionStatement(m.Call() as a), m.ExpressionStatement(m.Call() as b)):
            return (a.name, a.target) == (b.name, b.target)
        case (m.ExpressionStatement(m.Assign() as a), m.ExpressionStatement(m.Assign() as b)):
            return a.target == b.target
        case (m.Local(a), m.Local(b)):
            return [d.name for d in a.declarators] == [d.name for d in b.declarators]
        case (m.Switch(a), m.Switch(b)):
            return a == b
        case _:
            return False
