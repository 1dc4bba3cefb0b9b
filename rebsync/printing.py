"""Trees to text, in the canonical layout."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rebsync import model as m
from rebsync.layout import (
    Token,
    layout_line,
    layout_members,
    layout_model,
    layout_statements,
)
from rebsync.unions import assert_never
from rebsync.words import (
    Words,
    listed,
    put_annotations,
    put_expression,
    put_type,
    separated,
)


def print_model(model: m.Model) -> str:
    """A whole model."""
    words: Words = []
    for head in model.heads:
        _head(words, head)
    for each in model.classes:
        _class(words, each)
    if model.main:
        words += ("main", "{")
        for rebec in model.main.rebecs:
            _rebec(words, rebec)
        words.append("}")
    return layout_model(_tokens(words))


def print_class(node: m.ReactiveClass | m.Interface) -> str:
    """A class or an interface."""
    words: Words = []
    _class(words, node)
    return layout_model(_tokens(words))


def print_member(node: m.ClassMember) -> str:
    """A member of a class, without indentation."""
    words: Words = []
    _member(words, node)
    return layout_members(_tokens(words))


def print_statement(node: m.Statement) -> str:
    """A statement, without indentation and without the last line end."""
    words: Words = []
    _statement(words, node)
    return layout_statements(_tokens(words)).removesuffix("\n")


def print_expression(node: m.Expression) -> str:
    """An expression on one line."""
    words: Words = []
    put_expression(words, node)
    return layout_line(_tokens(words))


def print_line(node: m.Env | m.Declaration | m.Rebec | m.Annotation) -> str:
    """A declaration, an instance of `main` or an annotation on one line."""
    words: Words = []
    match node:
        case m.Env():
            _head(words, node)
        case m.Declaration():
            _declaration(words, node)
            words.append(";")
        case m.Rebec():
            _rebec(words, node)
        case m.Annotation():
            put_annotations(words, (node,))
        case _:
            assert_never(node)
    return layout_line(_tokens(words))


def _tokens(words: Words) -> list[Token]:
    return [Token(word) for word in words]


# --- declarations ------------------------------------------------------------------------------


def _head(words: Words, head: m.Head) -> None:
    match head:
        case m.Env(declaration):
            words.append("env")
            _declaration(words, declaration)
        case m.Refused(keyword, text):
            words += (keyword, text) if text else (keyword,)
        case _:
            assert_never(head)
    words.append(";")


def _class(words: Words, node: m.ReactiveClass | m.Interface) -> None:
    put_annotations(words, node.annotations)
    match node:
        case m.ReactiveClass():
            if node.abstract:
                words.append("abstract")
            words += ("reactiveclass", node.name)
            _names(words, "extends", (node.extends,) if node.extends else ())
            _names(words, "implements", node.implements)
            words += ("(", str(node.queue_length), ")", "{")
            for member in node.members:
                _member(words, member)
        case m.Interface():
            words += ("interface", node.name)
            _names(words, "extends", node.extends)
            words.append("{")
            for server in node.servers:
                _member(words, server)
        case _:
            assert_never(node)
    words.append("}")


def _names(words: Words, keyword: str, names: Sequence[str]) -> None:
    if names:
        words.append(keyword)
        separated(words, names, Words.append)


def _member(words: Words, node: m.ClassMember) -> None:
    match node:
        case m.KnownRebecs(declarations):
            _section(words, "knownrebecs", declarations)
        case m.StateVars(declarations):
            _section(words, "statevars", declarations)
        case m.Constructor():
            _callable(words, node, ())
        case m.MessageServer():
            _callable(words, node, ("abstract", "msgsrv") if node.abstract else ("msgsrv",))
        case m.Method():
            _callable(words, node, ("abstract",) if node.abstract else (), node.type)
        case _:
            assert_never(node)


def _section(words: Words, name: str, declarations: Iterable[m.Declaration]) -> None:
    words += (name, "{")
    for declaration in declarations:
        _declaration(words, declaration)
        words.append(";")
    words.append("}")


def _callable(
    words: Words,
    node: m.Constructor | m.MessageServer | m.Method,
    keywords: Sequence[str],
    type_: m.Type | None = None,
) -> None:
    put_annotations(words, node.annotations)
    words += keywords
    if type_:
        put_type(words, type_)
    words += (node.name, "(")
    separated(words, node.parameters, _parameter)
    words.append(")")
    if node.body is None:
        words.append(";")
    else:
        _statement(words, node.body)


def _parameter(words: Words, node: m.Parameter) -> None:
    put_type(words, node.type)
    words.append(node.name)


def _rebec(words: Words, node: m.Rebec) -> None:
    put_annotations(words, node.annotations)
    put_type(words, node.type)
    words.append(node.name)
    listed(words, node.bindings)
    words.append(":")
    listed(words, node.arguments)
    words.append(";")


def _declaration(words: Words, node: m.Declaration) -> None:
    put_annotations(words, node.annotations)
    put_type(words, node.type)
    separated(words, node.declarators, _declarator)


def _declarator(words: Words, node: m.Declarator) -> None:
    words.append(node.name)
    if node.initial is not None:
        words.append("=")
        _initializer(words, node.initial)


def _initializer(words: Words, node: m.Initializer) -> None:
    if isinstance(node, m.ArrayInitializer):
        words.append("{")
        separated(words, node.values, _initializer)
        words.append("}")
    else:
        put_expression(words, node)


# --- statements --------------------------------------------------------------------------------


def _statement(words: Words, node: m.Statement) -> None:
    put_annotations(words, node.annotations)
    match node:
        case m.Block(statements):
            _block(words, statements)
        case m.ExpressionStatement(expression):
            put_expression(words, expression)
            words.append(";")
        case m.Local(declaration):
            _declaration(words, declaration)
            words.append(";")
        case m.If():
            _if(words, node)
        case m.While(condition, body):
            words.append("while")
            listed(words, (condition,))
            _statement(words, body)
        case m.For():
            _for(words, node)
        case m.Switch():
            _switch(words, node)
        case m.Return(value):
            words.append("return")
            if value is not None:
                put_expression(words, value)
            words.append(";")
        case m.Break():
            words += ("break", ";")
        case m.Continue():
            words += ("continue", ";")
        case m.Empty():
            words.append(";")
        case _:
            assert_never(node)


def _block(words: Words, statements: Iterable[m.Statement]) -> None:
    words.append("{")
    for statement in statements:
        _statement(words, statement)
    words.append("}")


def _if(words: Words, node: m.If) -> None:
    """A chain of `else if` is a loop here: it may be longer than Python's stack is deep."""
    while True:
        words.append("if")
        listed(words, (node.condition,))
        if node.otherwise is None:
            _statement(words, node.then)
            return
        if _takes_else(node.then):
            _block(words, (node.then,))
        else:
            _statement(words, node.then)
        words.append("else")
        if not isinstance(node.otherwise, m.If) or node.otherwise.annotations:
            _statement(words, node.otherwise)
            return
        node = node.otherwise


def _takes_else(node: m.Statement) -> bool:
    """Whether an `else` behind this statement would belong to an `if` inside of it."""
    while True:
        match node:
            case m.If(otherwise=None):
                return True
            case m.If(otherwise=inner) if inner is not None:
                node = inner
            case m.While(body=inner) | m.For(body=inner):
                node = inner
            case _:
                return False


def _for(words: Words, node: m.For) -> None:
    words += ("for", "(")
    if isinstance(node.initial, m.Declaration):
        _declaration(words, node.initial)
    else:
        separated(words, node.initial, put_expression)
    words.append(";")
    if node.condition is not None:
        put_expression(words, node.condition)
    words.append(";")
    separated(words, node.updates, put_expression)
    words.append(")")
    _statement(words, node.body)


def _switch(words: Words, node: m.Switch) -> None:
    words.append("switch")
    listed(words, (node.subject,))
    words.append("{")
    for case in node.cases:
        put_annotations(words, case.annotations)
        if case.value is None:
            words.append("default")
        else:
            words.append("case")
            put_expression(words, case.value)
        words.append(":")
        for statement in case.statements:
            _statement(words, statement)
    words.append("}")
