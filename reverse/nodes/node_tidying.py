"""Bodies of a model without what reading hand-written code leaves in them.

Nothing that a body does changes: conditions that are known, locals that nobody reads, and values
that a local has only until it gets its own, go.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import replace
from operator import is_

from rebsync import model as m
from rebsync.reverse.models.building import bare, is_idle, may_divide_by_zero
from rebsync.reverse.models.rewriting import STATEMENTS, rewritten

_MOST_ROUNDS = 6


def tidy(body: m.Block, variables: Collection[str] = ()) -> m.Block:
    """The same body, shorter; `variables` are those of the class, which stay."""
    for _ in range(_MOST_ROUNDS if body.statements else 0):
        unread = _unread(body).difference(variables)

        def change(node: object, unread: set[str] = unread) -> object:
            match node:
                case m.Block(statements) | m.Case(_, statements):
                    kept = _tidied(statements, unread)
                    same = len(kept) == len(statements) and all(map(is_, kept, statements))
                    return node if same else replace(node, statements=kept)
                case _:
                    return node

        after = rewritten(body, change, STATEMENTS)
        if after == body:
            break
        body = after
    return body


def _unread(body: m.Block) -> set[str]:
    """The locals that nobody reads: what is only assigned, and may go with its value, is not."""
    names: Counter[str] = Counter()
    locals_: set[str] = set()
    for node in m.walk(body):
        match node:
            case m.Name(name):
                names[name] += 1
            case m.ExpressionStatement(m.Assign("=", m.Name(name), value)) if is_idle(value):
                names[name] -= 1
            case m.Local(declaration):
                locals_.update(d.name for d in declaration.declarators)
            case m.Annotation(_, arguments) if arguments:
                names.update(n.name for a in arguments for n in m.walk(a) if isinstance(n, m.Name))
    return {name for name in locals_ if names[name] <= 0}


def _tidied(statements: Sequence[m.Statement], unread: set[str]) -> tuple[m.Statement, ...]:
    done: list[m.Statement] = []
    for statement in statements:
        for each in _one(statement, unread):
            if done and (merged := _merged(done[-1], each)) is not None:
                done[-1] = merged
            else:
                done.append(each)
    return tuple(done)


def _one(statement: m.Statement, unread: set[str]) -> tuple[m.Statement, ...]:
    match statement:
        case m.If(condition, then, otherwise, ()):
            known = _known(condition)
            if known is True:
                return _spread(then)
            if known is False:
                return _spread(otherwise) if otherwise is not None else ()
            if then == m.Block(()) and otherwise is None and _is_idle(condition):
                return ()
        case m.ExpressionStatement(m.Assign("=", m.Name(name), value), ()) if name in unread:
            return () if is_idle(value) else (statement,)
        case m.Local(m.Declaration(_, (declarator,)), ()) if declarator.name in unread:
            initial = declarator.initial
            plain = initial is None or not isinstance(initial, m.ArrayInitializer)
            if plain and (initial is None or is_idle(_expression(initial))):
                return ()
    return (statement,)


def _is_idle(expression: m.Expression) -> bool:
    """Whether evaluating it changes nothing and does not fail, whatever it gives."""
    if may_divide_by_zero(expression):
        return False
    for node in m.walk(expression):
        match node:
            case m.Assign() | m.Postfix() | m.Unary(operator="++" | "--") | m.Call():
                return False
    return True


def without_values(body: m.Block) -> m.Block:
    """The body of a function that returns something as that of one that returns nothing."""

    def change(node: object) -> object:
        match node:
            case m.Return(value, annotations, span) if value is not None:
                ends = m.Return(None, annotations, span)
                if _is_idle(value):
                    return ends
                return m.Block((m.ExpressionStatement(value, (), span), ends), (), span)
            case _:
                return node

    return rewritten(body, change, STATEMENTS) if body.statements else body


def _expression(initial: m.Initializer) -> m.Expression:
    assert not isinstance(initial, m.ArrayInitializer)
    return initial


def _known(condition: m.Expression) -> bool | None:
    match bare(condition):
        case m.BoolLiteral(value):
            return value
        case m.Unary("!", operand):
            inner = _known(operand)
            return None if inner is None else not inner
        case _:
            return None


def _spread(statement: m.Statement) -> tuple[m.Statement, ...]:
    """The statements of a branch in its place, if none declares what ends with the branch."""
    if not isinstance(statement, m.Block) or statement.annotations:
        return (statement,)
    if any(isinstance(s, m.Local) for s in statement.statements):
        return (statement,)
    return statement.statements


def _merged(before: m.Statement, after: m.Statement) -> m.Statement | None:
    """`int x = 0; x = e;` as `int x = e;`."""
    match before, after:
        case (
            m.Local(m.Declaration(type_, (declarator,)) as declaration, ()) as local,
            m.ExpressionStatement(m.Assign("=", m.Name(name), value), ()),
        ) if declarator.name == name and not type_.dimensions:
            initial = declarator.initial
            plain = initial is None or not isinstance(initial, m.ArrayInitializer)
            names = {n.name for n in m.walk(value) if isinstance(n, m.Name)}
            if plain and name not in names and (initial is None or is_idle(_expression(initial))):
                new = replace(declarator, initial=value)
                return replace(local, declaration=replace(declaration, declarators=(new,)))
    return None
