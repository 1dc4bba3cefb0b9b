"""Early returns: what follows one stands in the other branch, or nowhere."""

from __future__ import annotations

from rebsync import model as m
from rebsync.reverse.bodies.building import negated


def without_returns(statements: tuple[m.Statement, ...]) -> tuple[m.Statement, ...] | None:
    """The same statements where nothing ends them early; None where they cannot be so written."""
    for number, statement in enumerate(statements):
        if isinstance(statement, m.Return):
            return statements[:number]
        if not _returns(statement):
            continue
        if not isinstance(statement, m.If):
            return None
        rest = statements[number + 1 :]
        done = _split(statement, rest)
        return (*statements[:number], *done) if done is not None else None
    return statements


def _split(statement: m.If, rest: tuple[m.Statement, ...]) -> tuple[m.Statement, ...] | None:
    """A branch that ends all, with what follows in the other branch."""
    then = _listed(statement.then)
    other = _listed(statement.otherwise) if statement.otherwise is not None else ()
    if always_leaves(statement.then):
        first, second = without_returns(then), without_returns((*other, *rest))
    elif not _returns(statement.then) and other and always_leaves(m.Block(other)):
        first, second = without_returns((*then, *rest)), without_returns(other)
    elif not rest:
        first, second = without_returns(then), without_returns(other)
    else:
        return None
    if first is None or second is None:
        return None
    if not first:
        return (m.If(negated(statement.condition), m.Block(second)),) if second else ()
    return (m.If(statement.condition, m.Block(first), m.Block(second) if second else None),)


def _listed(statement: m.Statement) -> tuple[m.Statement, ...]:
    return statement.statements if isinstance(statement, m.Block) else (statement,)


def _returns(statement: m.Statement) -> bool:
    return any(isinstance(n, m.Return) for n in m.walk(statement))


def always_leaves(statement: m.Statement) -> bool:
    """Whether what follows a statement does not run after it."""
    match statement:
        case m.Return() | m.Break() | m.Continue():
            return True
        case m.Block(statements):
            return any(map(always_leaves, statements))
        case m.If(_, then, otherwise) if otherwise is not None:
            return always_leaves(then) and always_leaves(otherwise)
        case _:
            return False
