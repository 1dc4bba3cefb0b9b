"""Checks statements and the locals that they declare."""

from __future__ import annotations

from rebsync.model import (
    ArrayInitializer,
    Assign,
    Block,
    Break,
    Broken,
    Call,
    Conditional,
    Continue,
    Declaration,
    Empty,
    Expression,
    ExpressionStatement,
    For,
    If,
    Initializer,
    Local,
    New,
    Postfix,
    Return,
    Statement,
    Switch,
    Type,
    Unary,
    While,
)
from rebsync.static.annotations import check_annotations, check_statement_annotations
from rebsync.static.conversions import check_condition, check_conversion
from rebsync.static.expressions import type_of
from rebsync.static.names import bare
from rebsync.static.resolve import resolve
from rebsync.static.scope import Body, Kind
from rebsync.static.switches import check_label, check_order
from rebsync.static.symbols import LocalSymbol
from rebsync.static.types import element, is_integer
from rebsync.unions import assert_never

_EFFECTS = (Assign, Call, Postfix, Conditional, New, Broken)


def check_statements(statements: tuple[Statement, ...], body: Body) -> None:
    """Checks a sequence of statements in the current scope."""
    for statement in statements:
        check_statement(statement, body)


def check_statement(statement: Statement, body: Body) -> None:
    """Checks one statement and everything in it."""
    if statement.annotations:
        check_statement_annotations(statement, body)
    match statement:
        case ExpressionStatement():
            _check_expression(statement, body)
        case Block(statements):
            with body.block():
                check_statements(statements, body)
        case Local(declaration):
            check_local(declaration, body)
        case If():
            _check_if(statement, body)
        case While(condition, inner):
            check_condition(condition, type_of(condition, body), "while", body)
            _check_loop_body(inner, body)
        case For():
            _check_for(statement, body)
        case Switch():
            _check_switch(statement, body)
        case Return():
            _check_return(statement, body)
        case Break():
            if not body.loops and not body.switches:
                message = "break stands outside of a loop or switch"
                body.facts.error("RS415", statement.span, message)
        case Continue():
            if not body.loops:
                body.facts.error("RS416", statement.span, "continue stands outside of a loop")
        case Empty():
            pass
        case _:
            assert_never(statement)


def _check_expression(statement: ExpressionStatement, body: Body) -> None:
    type_of(statement.expression, body)
    inner = bare(statement.expression)
    steps = isinstance(inner, Unary) and inner.operator in ("++", "--")
    if not steps and not isinstance(inner, _EFFECTS):
        hint = "an assignment is written with a single =" if _compares(inner) else None
        body.facts.warn("RS518", statement.span, "this statement has no effect", hint)


def _compares(expression: object) -> bool:
    return getattr(expression, "operator", None) == "=="


# --- locals ------------------------------------------------------------------------------------


def check_local(declaration: Declaration, body: Body) -> None:
    """Checks a declaration of locals and enters them into the innermost scope."""
    check_annotations(body.facts, declaration.annotations, "a local variable")
    type_ = resolve(body.facts, declaration.type)
    for declarator in declaration.declarators:
        if declarator.initial is not None:
            check_initializer(declarator.initial, type_, body)
        body.declare(LocalSymbol(declarator.name, type_, declarator))


def check_initializer(initial: Initializer, type_: Type | None, body: Body) -> None:
    """Checks that an initial value fits the type of its variable."""
    if not isinstance(initial, ArrayInitializer):
        source = type_of(initial, body)
        if source is not None and type_ is not None:
            check_conversion(initial, source, type_, body)
        return
    inner = None
    if type_ is not None and not type_.dimensions:
        message = f'a variable of type "{type_}" cannot start as a list of values'
        body.facts.error("RS316", initial.span, message)
    elif type_ is not None:
        inner = element(type_)
        if len(initial.values) != type_.dimensions[0]:
            message = f'"{type_}" takes {type_.dimensions[0]} values, not {len(initial.values)}'
            body.facts.error("RS316", initial.span, message)
    for value in initial.values:
        check_initializer(value, inner, body)


# --- control flow ------------------------------------------------------------------------------


def _check_branch(statement: Statement, body: Body) -> None:
    with body.block():
        check_statement(statement, body)


def _check_if(statement: If, body: Body) -> None:
    # A loop, since a chain of else-ifs nests as deep as it is long.
    current: Statement | None = statement
    while isinstance(current, If):
        check_condition(current.condition, type_of(current.condition, body), "if", body)
        _check_branch(current.then, body)
        current = current.otherwise
        if isinstance(current, If) and current.annotations:
            check_statement_annotations(current, body)
    if current is not None:
        _check_branch(current, body)


def _check_loop_body(inner: Statement, body: Body) -> None:
    body.loops += 1
    _check_branch(inner, body)
    body.loops -= 1


def _check_for(statement: For, body: Body) -> None:
    with body.block():
        if isinstance(statement.initial, Declaration):
            check_local(statement.initial, body)
        else:
            for expression in statement.initial:
                type_of(expression, body)
        if statement.condition is not None:
            check_condition(statement.condition, type_of(statement.condition, body), "for", body)
        _check_loop_body(statement.body, body)
        for expression in statement.updates:
            type_of(expression, body)


def _check_switch(statement: Switch, body: Body) -> None:
    subject = type_of(statement.subject, body)
    if subject is not None and not is_integer(subject):
        message = f'switch takes an integer, not "{subject}"'
        body.facts.error("RS306", statement.subject.span, message, "use if and else")
    check_order(statement, body)
    seen: dict[int, Expression] = {}
    body.switches += 1
    with body.block():
        for case in statement.cases:
            check_annotations(body.facts, case.annotations, "a case")
            if case.value is not None:
                check_label(case.value, type_of(case.value, body), seen, body)
            check_statements(case.statements, body)
    body.switches -= 1


def _check_return(statement: Return, body: Body) -> None:
    given = type_of(statement.value, body) if statement.value is not None else None
    facts, wanted = body.facts, body.returns
    if wanted is None:
        return
    if statement.value is None:
        if wanted.name != "void":
            message = f'this method must return a value of type "{wanted}"'
            facts.error("RS320", statement.span, message)
    elif wanted.name == "void":
        what = "method" if body.kind is Kind.METHOD else body.kind.value
        message = f"this {what} returns no value"
        facts.error("RS320", statement.value.span, message, "write return;")
    elif given is not None:
        check_conversion(statement.value, given, wanted, body)
