"""Trees of statements and expressions."""

from __future__ import annotations

from dataclasses import replace

from lark import Token

from rebsync import model as m
from rebsync.grammars.operators import order_chain
from rebsync.grammars.tree_parts import (
    CallTail,
    CaseLabel,
    Children,
    Listed,
    Timing,
    call_of,
    case_of,
    integer,
    listed,
    nodes_of,
    place_of,
    span_of,
)


class Statements:
    """Rules of statements."""

    def statement(self, items: Children) -> m.Statement:
        annotations: tuple[m.Annotation, ...]
        plain: m.Statement
        annotations, plain = items
        if not annotations:
            return plain
        return replace(plain, annotations=annotations, span=span_of(items))

    def block(self, items: Children) -> m.Block:
        return m.Block(tuple(items[1:-1]), (), span_of(items))

    def local(self, items: Children) -> m.Local:
        return m.Local(items[0], (), span_of(items))

    def expression_statement(self, items: Children) -> m.ExpressionStatement:
        return m.ExpressionStatement(items[0], (), span_of(items))

    def if_(self, items: Children) -> m.If:
        otherwise = items[6] if len(items) > 5 else None
        return m.If(items[2], items[4], otherwise, (), span_of(items))

    def while_(self, items: Children) -> m.While:
        return m.While(items[2], items[4], (), span_of(items))

    def for_(self, items: Children) -> m.For:
        first, second = (
            i for i, t in enumerate(items) if isinstance(t, Token) and t.type == "SEMICOLON"
        )
        initial = items[2] if first > 2 else None
        condition = items[first + 1] if second > first + 1 else None
        return m.For(
            initial if isinstance(initial, m.Declaration) else listed(initial),
            condition,
            listed(items[second + 1]),
            items[-1],
            (),
            span_of(items),
        )

    def switch(self, items: Children) -> m.Switch:
        labels: list[tuple[CaseLabel, list[m.Statement]]] = []
        for item in items[5:-1]:
            if isinstance(item, CaseLabel):
                labels.append((item, []))
            elif labels:
                labels[-1][1].append(item)
            else:
                labels.append((CaseLabel(m.Broken(item.span), (), item.span), [item]))
        return m.Switch(items[2], tuple(case_of(*label) for label in labels), (), span_of(items))

    def case_label(self, items: Children) -> CaseLabel:
        value = items[2] if len(items) == 4 else None
        return CaseLabel(value, items[0], span_of(items))

    def return_(self, items: Children) -> m.Return:
        return m.Return(items[1] if len(items) > 2 else None, (), span_of(items))

    def break_(self, items: Children) -> m.Break:
        return m.Break((), span_of(items))

    def continue_(self, items: Children) -> m.Continue:
        return m.Continue((), span_of(items))

    def empty(self, items: Children) -> m.Empty:
        return m.Empty((), span_of(items))


class Expressions:
    """Rules of expressions."""

    def expressions(self, items: Children) -> Listed:
        return Listed(tuple(items[::2]), span_of(items))

    def conditional(self, items: Children) -> m.Conditional:
        return m.Conditional(items[0], items[2], items[4], span_of(items))

    def assignment(self, items: Children) -> m.Assign:
        return m.Assign(items[1], items[0], items[2], span_of(items))

    def assign(self, items: Children) -> str:
        return str(items[0])

    def chain(self, items: Children) -> m.Expression:
        return order_chain(items)

    def instance_type(self, items: Children) -> m.Type:
        return m.Type(str(items[0]), (), place_of(items[0]))

    def prefix(self, items: Children) -> m.Unary:
        return m.Unary(str(items[0]), items[1], span_of(items))

    def postfix(self, items: Children) -> m.Postfix:
        return m.Postfix(str(items[1]), items[0], span_of(items))

    def select(self, items: Children) -> m.Expression:
        target, _, name, *tail = items
        if tail:
            return call_of(target, name, tail[0], span_of(items))
        return m.Member(target, str(name), span_of(items), place_of(name))

    def name(self, items: Children) -> m.Expression:
        name, *tail = items
        if tail:
            return call_of(None, name, tail[0], span_of(items))
        return m.Name(str(name), place_of(name))

    def call_tail(self, items: Children) -> CallTail:
        timing = {t.keyword: t.value for t in nodes_of(items, Timing)}
        return CallTail(
            listed(items[1]), timing.get("after"), timing.get("deadline"), span_of(items)
        )

    def timing(self, items: Children) -> Timing:
        return Timing(str(items[0]), items[2], span_of(items))

    after = deadline = timing

    def index(self, items: Children) -> m.Index:
        return m.Index(items[0], items[2], span_of(items))

    def cast(self, items: Children) -> m.Cast:
        return m.Cast(items[1], items[3], span_of(items))

    def cast_of_sign(self, items: Children) -> m.Cast:
        """`(int)-x`, which RMC reads although a cast binds tighter than a sign."""
        signed = m.Unary(str(items[3]), items[4], span_of(items[3:]))
        return m.Cast(items[1], m.Paren(signed, signed.span), span_of(items))

    def paren(self, items: Children) -> m.Paren:
        return m.Paren(items[1], span_of(items))

    def self_(self, items: Children) -> m.Self:
        return m.Self(span_of(items))

    def super_(self, items: Children) -> m.Super:
        return m.Super(span_of(items))

    def choice(self, items: Children) -> m.Choice:
        return m.Choice(listed(items[2]), span_of(items))

    def new(self, items: Children) -> m.New:
        colon = next(i for i, t in enumerate(items) if isinstance(t, Token) and t.type == "COLON")
        type_ = m.Type(str(items[1]), (), place_of(items[1]))
        return m.New(type_, listed(items[3]), listed(items[colon + 2]), span_of(items))

    def literal(self, items: Children) -> m.Expression:
        token: Token = items[0]
        span = place_of(token)
        match token.type:
            case "INT":
                return m.IntLiteral(integer(token), span)
            case "FLOAT":
                return m.FloatLiteral(str(token), span)
            case "STRING":
                return m.StringLiteral(str(token), span)
            case "TRUE" | "FALSE":
                return m.BoolLiteral(token == "true", span)
            case "NULL":
                return m.NullLiteral(span)
            case _:
                return m.Broken(span)
