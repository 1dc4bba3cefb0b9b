"""Builds the syntax tree while lark reduces: one method a rule of timed_rebeca.lark."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol, TypeAlias, TypeVar

from lark import Token

from rebsync import model as m
from rebsync.grammars.operators import order_chain
from rebsync.source import Span

Children: TypeAlias = list[Any]
_Kind = TypeVar("_Kind")


class _Node(Protocol):
    @property
    def span(self) -> Span: ...


_Placed: TypeAlias = "Token | _Node"


def _start(item: _Placed) -> int:
    return item.start_pos or 0 if isinstance(item, Token) else item.span.start


def _end(item: _Placed) -> int:
    return _start(item) + len(item) if isinstance(item, Token) else item.span.end


def _span(items: Sequence[Any]) -> Span:
    """From the first to the last of the items; leading annotations may be an empty tuple."""
    first = items[0]
    if isinstance(first, tuple):
        first = first[0] if first else items[1]
    return Span(_start(first), _end(items[-1]))


def _tokens(items: Sequence[Any], *kinds: str) -> list[Token]:
    return [i for i in items if isinstance(i, Token) and i.type in kinds]


def _nodes(items: Sequence[Any], *kinds: type) -> tuple[Any, ...]:
    return tuple(i for i in items if isinstance(i, kinds))


def _first(items: Sequence[Any], kind: type[_Kind]) -> _Kind | None:
    return next((i for i in items if isinstance(i, kind)), None)


def _at(token: Token) -> Span:
    return Span(_start(token), _end(token))


@dataclass(frozen=True, slots=True)
class _Names:
    """A list of names after `extends` or `implements`."""

    keyword: str
    names: tuple[Token, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class _Listed:
    """Expressions between commas."""

    items: tuple[m.Expression, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class _Parameters:
    items: tuple[m.Parameter, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class _Timing:
    keyword: str
    value: m.Expression
    span: Span


@dataclass(frozen=True, slots=True)
class _CallTail:
    """What follows the name of a call: arguments, after, deadline."""

    arguments: tuple[m.Expression, ...]
    after: m.Expression | None
    deadline: m.Expression | None
    span: Span


@dataclass(frozen=True, slots=True)
class _CaseLabel:
    value: m.Expression | None
    annotations: tuple[m.Annotation, ...]
    span: Span


def _listed(item: object) -> tuple[m.Expression, ...]:
    return item.items if isinstance(item, _Listed) else ()


class _Structure:
    """Rules of the model, of classes and of declarations."""

    def model(self, items: Children) -> m.Model:
        return m.Model(
            _nodes(items, m.Env, m.Refused),
            _nodes(items, m.ReactiveClass, m.Interface),
            _first(items, m.Main),
            _span(items) if items else Span(0, 0),
        )

    def env(self, items: Children) -> m.Env:
        return m.Env(items[1], _span(items))

    def refused(self, items: Children) -> m.Refused:
        text = "".join(str(t) for t in items[1:] if isinstance(t, Token)).rstrip(";")
        return m.Refused(str(items[0]), text.partition("{")[0], _span(items))

    def reactive_class(self, items: Children) -> m.ReactiveClass:
        name, queue = _tokens(items, "ID")[0], _tokens(items, "INT")[0]
        lists = {n.keyword: n for n in _nodes(items, _Names)}
        extends, implements = lists.get("extends"), lists.get("implements")
        kinds = (m.KnownRebecs, m.StateVars, m.Constructor, m.MessageServer, m.Method)
        return m.ReactiveClass(
            str(name),
            integer(queue),
            _nodes(items, *kinds),
            abstract=bool(_tokens(items, "ABSTRACT")),
            extends=str(extends.names[0]) if extends else None,
            implements=tuple(map(str, implements.names)) if implements else (),
            annotations=items[0],
            span=_span(items),
            name_span=_at(name),
            extends_span=_at(extends.names[0]) if extends else Span(0, 0),
            implements_spans=tuple(map(_at, implements.names)) if implements else (),
            queue_span=_at(queue),
        )

    def names(self, items: Children) -> _Names:
        return _Names(str(items[0]), tuple(_tokens(items, "ID")), _span(items))

    extends_class = implements = extends_interfaces = names

    def interface(self, items: Children) -> m.Interface:
        name = _tokens(items, "ID")[0]
        extends = _first(items, _Names)
        return m.Interface(
            str(name),
            _nodes(items, m.MessageServer),
            tuple(map(str, extends.names)) if extends else (),
            items[0],
            _span(items),
            _at(name),
            tuple(map(_at, extends.names)) if extends else (),
        )

    def known_rebecs(self, items: Children) -> m.KnownRebecs:
        return m.KnownRebecs(_nodes(items, m.Declaration), _span(items))

    def state_vars(self, items: Children) -> m.StateVars:
        return m.StateVars(_nodes(items, m.Declaration), _span(items))

    def constructor(self, items: Children) -> m.Constructor:
        annotations, name, parameters, body = items
        return m.Constructor(
            str(name), parameters.items, _body(body), annotations, _span(items), _at(name)
        )

    def message_server(self, items: Children) -> m.MessageServer:
        name = _tokens(items, "ID")[0]
        return m.MessageServer(
            str(name),
            items[-2].items,
            _body(items[-1]),
            bool(_tokens(items, "ABSTRACT")),
            items[0],
            _span(items),
            _at(name),
        )

    interface_server = message_server

    def method(self, items: Children) -> m.Method:
        *_, type_, name, parameters, body = items
        return m.Method(
            type_,
            str(name),
            parameters.items,
            _body(body),
            bool(_tokens(items, "ABSTRACT")),
            items[0],
            _span(items),
            _at(name),
        )

    def parameters(self, items: Children) -> _Parameters:
        return _Parameters(_nodes(items, m.Parameter), _span(items))

    def parameter(self, items: Children) -> m.Parameter:
        return m.Parameter(items[0], str(items[1]), _span(items), _at(items[1]))

    def declaration(self, items: Children) -> m.Declaration:
        return m.Declaration(items[1], _nodes(items, m.Declarator), items[0], _span(items))

    def plain_declaration(self, items: Children) -> m.Declaration:
        return m.Declaration(items[0], _nodes(items, m.Declarator), (), _span(items))

    def declarator(self, items: Children) -> m.Declarator:
        initial = items[2] if len(items) > 1 else None
        return m.Declarator(str(items[0]), initial, _span(items), _at(items[0]))

    def array_initializer(self, items: Children) -> m.ArrayInitializer:
        values = tuple(i for i in items if not isinstance(i, Token))
        return m.ArrayInitializer(values, _span(items))

    def type(self, items: Children) -> m.Type:
        return m.Type(str(items[0]), tuple(map(integer, _tokens(items, "INT"))), _span(items))

    def annotations(self, items: Children) -> tuple[m.Annotation, ...]:
        return tuple(items)

    def annotation(self, items: Children) -> m.Annotation:
        arguments = _listed(items[3]) if len(items) > 3 else ()
        return m.Annotation(str(items[1]), arguments if len(items) > 2 else None, _span(items))

    def main(self, items: Children) -> m.Main:
        return m.Main(_nodes(items, m.Rebec), _span(items))

    def rebec(self, items: Children) -> m.Rebec:
        annotations, type_, name = items[:3]
        colon = next(i for i, t in enumerate(items) if isinstance(t, Token) and t.type == "COLON")
        bindings, arguments = items[4 : colon - 1], items[colon + 2 : -2]
        return m.Rebec(
            type_,
            str(name),
            _listed(bindings[0]) if bindings else (),
            _listed(arguments[0]) if arguments else (),
            annotations,
            _span(items),
            _at(name),
        )


class _Statements:
    """Rules of statements."""

    def statement(self, items: Children) -> m.Statement:
        annotations: tuple[m.Annotation, ...]
        plain: m.Statement
        annotations, plain = items
        if not annotations:
            return plain
        return replace(plain, annotations=annotations, span=_span(items))

    def block(self, items: Children) -> m.Block:
        return m.Block(tuple(items[1:-1]), (), _span(items))

    def local(self, items: Children) -> m.Local:
        return m.Local(items[0], (), _span(items))

    def expression_statement(self, items: Children) -> m.ExpressionStatement:
        return m.ExpressionStatement(items[0], (), _span(items))

    def if_(self, items: Children) -> m.If:
        otherwise = items[6] if len(items) > 5 else None
        return m.If(items[2], items[4], otherwise, (), _span(items))

    def while_(self, items: Children) -> m.While:
        return m.While(items[2], items[4], (), _span(items))

    def for_(self, items: Children) -> m.For:
        first, second = (
            i for i, t in enumerate(items) if isinstance(t, Token) and t.type == "SEMICOLON"
        )
        initial = items[2] if first > 2 else None
        condition = items[first + 1] if second > first + 1 else None
        return m.For(
            initial if isinstance(initial, m.Declaration) else _listed(initial),
            condition,
            _listed(items[second + 1]),
            items[-1],
            (),
            _span(items),
        )

    def switch(self, items: Children) -> m.Switch:
        labels: list[tuple[_CaseLabel, list[m.Statement]]] = []
        for item in items[5:-1]:
            if isinstance(item, _CaseLabel):
                labels.append((item, []))
            elif labels:
                labels[-1][1].append(item)
            else:
                labels.append((_CaseLabel(m.Broken(item.span), (), item.span), [item]))
        return m.Switch(items[2], tuple(_case(*label) for label in labels), (), _span(items))

    def case_label(self, items: Children) -> _CaseLabel:
        value = items[2] if len(items) == 4 else None
        return _CaseLabel(value, items[0], _span(items))

    def return_(self, items: Children) -> m.Return:
        return m.Return(items[1] if len(items) > 2 else None, (), _span(items))

    def break_(self, items: Children) -> m.Break:
        return m.Break((), _span(items))

    def continue_(self, items: Children) -> m.Continue:
        return m.Continue((), _span(items))

    def empty(self, items: Children) -> m.Empty:
        return m.Empty((), _span(items))


class _Expressions:
    """Rules of expressions."""

    def expressions(self, items: Children) -> _Listed:
        return _Listed(tuple(items[::2]), _span(items))

    def conditional(self, items: Children) -> m.Conditional:
        return m.Conditional(items[0], items[2], items[4], _span(items))

    def assignment(self, items: Children) -> m.Assign:
        return m.Assign(items[1], items[0], items[2], _span(items))

    def assign(self, items: Children) -> str:
        return str(items[0])

    def chain(self, items: Children) -> m.Expression:
        return order_chain(items)

    def instance_type(self, items: Children) -> m.Type:
        return m.Type(str(items[0]), (), _at(items[0]))

    def prefix(self, items: Children) -> m.Unary:
        return m.Unary(str(items[0]), items[1], _span(items))

    def postfix(self, items: Children) -> m.Postfix:
        return m.Postfix(str(items[1]), items[0], _span(items))

    def select(self, items: Children) -> m.Expression:
        target, _, name, *tail = items
        if tail:
            return _call(target, name, tail[0], _span(items))
        return m.Member(target, str(name), _span(items), _at(name))

    def name(self, items: Children) -> m.Expression:
        name, *tail = items
        if tail:
            return _call(None, name, tail[0], _span(items))
        return m.Name(str(name), _at(name))

    def call_tail(self, items: Children) -> _CallTail:
        timing = {t.keyword: t.value for t in _nodes(items, _Timing)}
        return _CallTail(
            _listed(items[1]), timing.get("after"), timing.get("deadline"), _span(items)
        )

    def timing(self, items: Children) -> _Timing:
        return _Timing(str(items[0]), items[2], _span(items))

    after = deadline = timing

    def index(self, items: Children) -> m.Index:
        return m.Index(items[0], items[2], _span(items))

    def cast(self, items: Children) -> m.Cast:
        return m.Cast(items[1], items[3], _span(items))

    def paren(self, items: Children) -> m.Paren:
        return m.Paren(items[1], _span(items))

    def self_(self, items: Children) -> m.Self:
        return m.Self(_span(items))

    def super_(self, items: Children) -> m.Super:
        return m.Super(_span(items))

    def choice(self, items: Children) -> m.Choice:
        return m.Choice(_listed(items[2]), _span(items))

    def new(self, items: Children) -> m.New:
        colon = next(i for i, t in enumerate(items) if isinstance(t, Token) and t.type == "COLON")
        type_ = m.Type(str(items[1]), (), _at(items[1]))
        return m.New(type_, _listed(items[3]), _listed(items[colon + 2]), _span(items))

    def literal(self, items: Children) -> m.Expression:
        token: Token = items[0]
        span = _at(token)
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


class TreeBuilder(_Structure, _Statements, _Expressions):
    """The rules of timed_rebeca.lark, all together."""


def _case(label: _CaseLabel, statements: list[m.Statement]) -> m.Case:
    end = statements[-1] if statements else label
    return m.Case(label.value, tuple(statements), label.annotations, label.span.to(end.span))


def _body(item: m.Block | Token) -> m.Block | None:
    return item if isinstance(item, m.Block) else None


def _call(target: m.Expression | None, name: Token, tail: _CallTail, span: Span) -> m.Call:
    return m.Call(target, str(name), tail.arguments, tail.after, tail.deadline, span, _at(name))


def integer(token: Token) -> int:
    """The value of an integer literal: decimal, hexadecimal, binary or octal (leading 0)."""
    digits = token.rstrip("lL").replace("_", "").lower()
    if len(digits) > 1 and digits[0] == "0" and digits.isdigit():
        return int(digits, 8 if set(digits) <= set("01234567") else 10)
    return int(digits, 0)
