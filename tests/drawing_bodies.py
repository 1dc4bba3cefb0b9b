"""Draws well-typed statements over the names in scope."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rebsync import model as m
from tests.drawing import (
    INTEGERS,
    NUMBERS,
    PRIMITIVES,
    Scope,
    Variable,
    chance,
    draw_boolean,
    draw_call,
    draw_expression,
    draw_value,
    element,
    one,
    type_of,
)

_Drawer: TypeAlias = "Callable[[DrawFn, Scope, int], m.Statement]"
_COMPOUND = ("+=", "-=", "*=", "/=")
_COMPOUND_INTEGER = (*_COMPOUND, "%=", "&=", "|=", "^=", "<<=", ">>=")


def draw_block(draw: DrawFn, scope: Scope, depth: int, most: int = 3) -> m.Block:
    """A block; what it declares is gone behind it."""
    known = len(scope.variables)
    count = draw(st.integers(0, most))
    statements = tuple(draw_statement(draw, scope, depth) for _ in range(count))
    del scope.variables[known:]
    return m.Block(statements)


def draw_body(draw: DrawFn, scope: Scope) -> m.Block:
    """The whole body of a server, method or constructor."""
    block = draw_block(draw, scope, 2, most=5)
    if scope.result == "void":
        return block
    end = m.Return(draw_expression(draw, scope, scope.result))
    return m.Block((*block.statements, end))


def draw_statement(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    """One statement."""
    simple: list[_Drawer] = [_assign, _assign, _step, _send, _send, _local, _builtin, _annotated]
    nested: list[_Drawer] = [_if, _if, _while, _for, _switch, _inner_block]
    kind = one(draw, simple + nested if depth else simple)
    return kind(draw, scope, depth)


def _inner(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    """The statement that a header governs: with braces or without."""
    if draw(st.booleans()):
        return draw_block(draw, scope, depth - 1)
    known = len(scope.variables)
    statement = draw_statement(draw, scope, depth - 1)
    del scope.variables[known:]
    return m.Block((statement,)) if isinstance(statement, m.Local) else statement


def _inner_block(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    return draw_block(draw, scope, depth - 1)


def _assign(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    targets = [v for v in scope.variables if v.assignable]
    if not targets:
        return m.Empty()
    target = one(draw, targets)
    kind = target.type.name
    operator = "="
    if kind in NUMBERS and chance(draw, 3):
        operator = one(draw, _COMPOUND_INTEGER if kind in INTEGERS else _COMPOUND)
    value = (
        draw_value(draw, scope, kind) if operator == "=" else draw_expression(draw, scope, kind, 1)
    )
    return m.ExpressionStatement(m.Assign(operator, element(draw, target), value))


def _step(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    targets = [v for v in scope.variables if v.assignable and v.type.name in INTEGERS]
    if not targets:
        return m.Empty()
    target = element(draw, one(draw, targets))
    operator = one(draw, ("++", "--"))
    prefix = draw(st.booleans())
    step = m.Unary(operator, target) if prefix else m.Postfix(operator, target)
    return m.ExpressionStatement(step)


def _receivers(draw: DrawFn, scope: Scope) -> list[tuple[m.Expression | None, str]]:
    receivers: list[tuple[m.Expression | None, str]] = [(m.Self(), scope.owner)]
    if scope.kind == "constructor":
        return receivers
    receivers.append((None, scope.owner))
    for variable in scope.variables:
        if variable.type.name not in PRIMITIVES:
            receivers.append((element(draw, variable), variable.type.name))
    if scope.sender:
        kind = one(draw, sorted(scope.servers))
        receivers.append((m.Paren(m.Cast(type_of(kind), m.Name("sender"))), kind))
    return receivers


def _send(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    options = [
        (target, server)
        for target, kind in _receivers(draw, scope)
        for server in scope.servers[kind]
        if all(not t.dimensions or _has(scope, t) for t in server.types)
    ]
    if not options:
        return m.Empty()
    target, server = one(draw, options)
    call = draw_call(draw, scope, target, server, 1)
    if draw(st.booleans()):
        call = replace(call, after=_time(draw, scope))
    if chance(draw, 4):
        call = replace(call, deadline=_time(draw, scope, at_least=50))
    return m.ExpressionStatement(call)


def _has(scope: Scope, wanted: m.Type) -> bool:
    return any(v.type == wanted for v in scope.variables)


def _time(draw: DrawFn, scope: Scope, at_least: int = 0) -> m.Expression:
    if scope.kind == "server" and chance(draw, 5):
        return m.Choice((m.IntLiteral(at_least + 1), m.IntLiteral(at_least + 2)))
    return m.IntLiteral(at_least + draw(st.integers(0, 40)))


def _local(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    kind = one(draw, PRIMITIVES)
    name = scope.fresh()
    if chance(draw, 4):
        length = draw(st.integers(1, 3))
        type_ = type_of(kind, length)
        values = tuple(draw_expression(draw, scope, kind, 1) for _ in range(length))
        initial: m.Initializer | None = m.ArrayInitializer(values)
    else:
        type_ = type_of(kind)
        initial = draw_value(draw, scope, kind) if draw(st.integers(0, 3)) else None
    scope.variables.append(Variable(m.Name(name), type_))
    return m.Local(m.Declaration(type_, (m.Declarator(name, initial),)))


def _builtin(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    if scope.kind == "server" and draw(st.booleans()):
        return m.ExpressionStatement(m.Call(None, "delay", (_time(draw, scope),)))
    condition = draw_boolean(draw, scope, 1)
    text = (m.StringLiteral('"holds"'),) if draw(st.booleans()) else ()
    return m.ExpressionStatement(m.Call(None, "assertion", (condition, *text)))


def _annotated(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    if scope.robot and scope.kind == "server":
        right = m.Binary("+", m.Name("X"), m.IntLiteral(draw(st.integers(1, 2))))
        down = m.Binary("-", m.Name("Y"), m.IntLiteral(1))
        x: m.Expression = right if draw(st.booleans()) else m.Name("X")
        y: m.Expression = down if draw(st.booleans()) else m.Name("Y")
        return m.Empty((m.Annotation("Move", (x, y)),))
    return m.Empty((m.Annotation("note", (m.IntLiteral(1),)),) if draw(st.booleans()) else ())


def _if(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    condition = draw_boolean(draw, scope, 2)
    then = _inner(draw, scope, depth)
    if draw(st.booleans()):
        return m.If(condition, _closed(then), _inner(draw, scope, depth))
    return m.If(condition, then)


def _closed(then: m.Statement) -> m.Statement:
    """Without an `if` at its end that would take the `else`."""
    nested = (m.If, m.While, m.For)
    return m.Block((then,)) if isinstance(then, nested) else then


def _while(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    body = draw_block(draw, scope, depth - 1)
    end = m.Break()
    return m.While(draw_boolean(draw, scope, 1), m.Block((*body.statements, end)))


def _for(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    name = scope.fresh()
    counter = Variable(m.Name(name), type_of("int"), assignable=False)
    scope.variables.append(counter)
    body = _inner(draw, scope, depth)
    if isinstance(body, m.Block) and chance(draw, 3):
        skip: m.Statement = m.Break() if draw(st.booleans()) else m.Continue()
        leave = m.If(draw_boolean(draw, scope, 1), skip)
        body = m.Block((leave, *body.statements))
    scope.variables.remove(counter)
    declaration = m.Declaration(type_of("int"), (m.Declarator(name, m.IntLiteral(0)),))
    bound = m.Binary("<", m.Name(name), m.IntLiteral(draw(st.integers(1, 4))))
    counted = m.Name(name)
    update = m.Postfix("++", counted) if draw(st.booleans()) else m.Unary("++", counted)
    return m.For(declaration, bound, (update,), body)


def _switch(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    subject = draw_expression(draw, scope, "int", 1)
    values = draw(st.lists(st.integers(-2, 5), min_size=1, max_size=3, unique=True))
    cases = [_case(draw, scope, depth, _signed(value)) for value in values]
    if draw(st.booleans()):
        cases.append(_case(draw, scope, depth, None))
    return m.Switch(subject, tuple(cases))


def _signed(value: int) -> m.Expression:
    if value < 0:
        return m.Unary("-", m.IntLiteral(-value))
    return m.IntLiteral(value)


def _case(draw: DrawFn, scope: Scope, depth: int, value: m.Expression | None) -> m.Case:
    inner = draw_block(draw, scope, depth - 1, most=2).statements
    statements = tuple(s for s in inner if not isinstance(s, m.Local))
    if len(statements) < len(inner):
        statements = (m.Block(inner),)
    end = (m.Break(),) if draw(st.integers(0, 2)) else ()
    return m.Case(value, (*statements, *end))
