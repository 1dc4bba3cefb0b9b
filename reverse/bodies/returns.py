"""Early returns: what follows one stands in the other branch, or nowhere."""

from __future__ import annotations

from collections.abc import Sequence

from rebsync import model as m
from rebsync.reverse.models.building import negated

# So many branches within each other may go on with the same statements.
_MOST_COPIES = 8


def without_returns(
    statements: Sequence[m.Statement], result: m.Expression | None = None, copies: int = 0
) -> tuple[m.Statement, ...] | None:
    """The same statements where nothing ends them early; what they return is stored in `result`.

    None where they cannot be so written: a return in a loop, or too many ways to go on.
    """
    for number, statement in enumerate(statements):
        if not any(isinstance(n, m.Return) for n in m.walk(statement)):
            continue
        rest = statements[number + 1 :]
        done: tuple[m.Statement, ...] | None = None
        match statement:
            case m.Return(value):
                done = ()
                if value is not None and result is not None:
                    done = (m.ExpressionStatement(m.Assign("=", result, value)),)
            case m.Block(inner):
                done = without_returns((*inner, *rest), result, copies)
            case m.If():
                done = _split(statement, rest, result, copies)
            case _:
                pass
        return (*statements[:number], *done) if done is not None else None
    return tuple(statements)


def _split(
    branch: m.If, rest: Sequence[m.Statement], result: m.Expression | None, copies: int
) -> tuple[m.Statement, ...] | None:
    """A branch of which a way may end all; the others go on with what follows."""
    ways = [_listed(way) for way in (branch.then, branch.otherwise)]
    copies += not any(map(always_leaves, map(m.Block, ways)))
    if copies > _MOST_COPIES:
        return None
    first, second = (without_returns((*way, *rest), result, copies) for way in ways)
    if first is None or second is None:
        return None
    if not first and second:
        condition = negated(branch.condition)
        return (m.If(condition, m.Block(second), None, branch.annotations, branch.span),)
    last = m.Block(second) if second else None
    return (m.If(branch.condition, m.Block(first), last, branch.annotations, branch.span),)


def _listed(statement: m.Statement | None) -> tuple[m.Statement, ...]:
    match statement:
        case None:
            return ()
        case m.Block(statements):
            return statements
        case _:
            return (statement,)


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
