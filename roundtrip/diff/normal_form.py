"""The normal form of a model: what a package can say of it (mapping, "What is not carried").

Models with one normal form have one meaning. Folded are

* the order of classes, and of the kinds of members within a class; sections and declarations of
  several variables; which variable is declared beside which,
* braces: the bodies of branches and loops have them, but for `else if`,
* `env` variables and the arguments in `main`, which are constants: their values,
* spellings of one number: `1_0.f` and `10.0f`, a negative literal and a minus before it,
* in `@Move`, parentheses, `X + 0`, and `X + -1` for `X - 1`.

Comments and places take no part in the equality of models anyway. What only Python does not show is
folded apart from that (`as_in_python`), as C++ does show it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from operator import is_not
from typing import TypeVar, cast

from rebsync import model as m
from rebsync.literals import initial_of, literal_of, plain_float
from rebsync.static import Analysis, analyse
from rebsync.static.constants import constant
from rebsync.static.symbols import EnvSymbol
from rebsync.static.values import converted, env_value

_Node = TypeVar("_Node")


def normal(model: m.Model) -> m.Model:
    """The normal form; in a model with errors, constants stay as they are written."""
    classes = sorted((normal_class(c) for c in model.classes), key=lambda c: c.name)
    heads, main = normal_frame(model)
    return m.Model(heads, tuple(classes), main)


def normal_frame(model: m.Model) -> tuple[tuple[m.Head, ...], m.Main | None]:
    """What is around the classes: `env` variables and `main`."""
    analysis = analyse(model, fragment=True)
    if analysis.errors:
        return model.heads, model.main
    main = _main(model, analysis) if model.main is not None else None
    return tuple(_heads(model, analysis)), main


def rewrite(node: _Node, rule: Callable[[object], object]) -> _Node:
    """A tree with `rule` applied to every node, to the innermost ones first.

    Nodes in which nothing changes stay the ones that they are.
    """
    changed: dict[str, object] = {}
    kind: type = type(node)
    for name in m.child_fields(kind):
        value = getattr(node, name)
        if isinstance(value, tuple):
            inner = tuple([rewrite(each, rule) for each in value])
            if any(map(is_not, inner, value)):
                changed[name] = inner
        elif value is not None and (rewritten := rewrite(value, rule)) is not value:
            changed[name] = rewritten
    rebuilt = replace(node, **changed) if changed else node  # type: ignore[type-var]
    return cast("_Node", rule(rebuilt))


def as_in_python(node: _Node) -> _Node:
    """A class, or a model, without what Python does not show of it.

    `x += 1` and `++x`, `1.5f` and `1.5`, whether the start of a `for` stands in its head or right
    before it, and a `break` at the end of a `switch`. What compares as one anyway is left:
    parentheses, `x++` as a statement.
    """
    return rewrite(rewrite(node, _unwritten), _started)


# --- constants ----------------------------------------------------------------------------------


def _lookup(analysis: Analysis) -> Callable[[m.Name], int | float | bool | None]:
    def value(name: m.Name) -> int | float | bool | None:
        symbol = analysis.symbols.get(id(name))
        return symbol.value if isinstance(symbol, EnvSymbol) else None

    return value


def _heads(model: m.Model, analysis: Analysis) -> Iterator[m.Head]:
    for head in model.heads:
        if not isinstance(head, m.Env):
            yield head
            continue
        type_ = head.declaration.type
        for declarator in head.declaration.declarators:
            value = initial_of(env_value(declarator, type_, _lookup(analysis)))
            one = replace(declarator, initial=value)
            yield replace(head, declaration=replace(head.declaration, declarators=(one,)))


def _main(model: m.Model, analysis: Analysis) -> m.Main:
    rebecs = model.main.rebecs if model.main is not None else ()
    return m.Main(tuple(_rebec(r, analysis) for r in rebecs))


def _rebec(rebec: m.Rebec, analysis: Analysis) -> m.Rebec:
    constructor = analysis.constructor_of(rebec)
    parameters = constructor.parameters if constructor is not None else ()
    arguments = list(rebec.arguments)
    for i, (argument, parameter) in enumerate(zip(rebec.arguments, parameters, strict=False)):
        value = constant(argument, _lookup(analysis))
        if value is not None:
            literal = literal_of(converted(value, parameter.type))
            arguments[i] = replace(literal, span=argument.span)
    bindings = tuple(rewrite(b, _rule) for b in rebec.bindings)
    return replace(rebec, bindings=bindings, arguments=tuple(arguments))


# --- classes ------------------------------------------------------------------------------------


def normal_class(declaration: m.ReactiveClass | m.Interface) -> m.ReactiveClass | m.Interface:
    """The normal form of a class, which follows from this class alone."""
    plain = rewrite(declaration, _rule)
    if isinstance(plain, m.Interface):
        return plain
    known = [d for x in plain.members if isinstance(x, m.KnownRebecs) for d in _single(x)]
    state = [d for x in plain.members if isinstance(x, m.StateVars) for d in _single(x)]
    members: list[m.ClassMember] = [m.KnownRebecs(tuple(known))] if known else []
    members += [m.StateVars(tuple(state))] if state else []
    for kind in (m.Constructor, m.MessageServer, m.Method):
        members += [x for x in plain.members if isinstance(x, kind)]
    return replace(plain, members=tuple(members))


def _single(section: m.KnownRebecs | m.StateVars) -> Iterator[m.Declaration]:
    for declaration in section.declarations:
        for declarator in declaration.declarators:
            yield replace(declaration, declarators=(declarator,))


# --- statements and expressions -----------------------------------------------------------------


def _rule(node: object) -> object:
    match node:
        case m.If(then=then, otherwise=otherwise):
            return replace(node, then=_braced(then), otherwise=_otherwise(otherwise))
        case m.While(body=body) | m.For(body=body):
            return replace(node, body=_braced(body))
        case m.IntLiteral(value) if value < 0:
            return m.Unary("-", m.IntLiteral(-value))
        case m.FloatLiteral(text):
            return m.FloatLiteral(_float(text))
        case m.Annotation("Move", arguments) if arguments:
            return replace(node, arguments=tuple(map(_cell, arguments)))
        case _:
            return node


def _braced(body: m.Statement) -> m.Block:
    if isinstance(body, m.Block) and not body.annotations:
        return body
    return m.Block((body,))


def _otherwise(otherwise: m.Statement | None) -> m.Statement | None:
    if otherwise is None or (isinstance(otherwise, m.If) and not otherwise.annotations):
        return otherwise
    return _braced(otherwise)


def _float(text: str) -> str:
    digits, suffix = text.replace("_", ""), ""
    if digits[-1] in "fFdD":
        digits, suffix = digits[:-1], digits[-1].lower()
    return digits + (".0" if suffix and not any(c in digits for c in ".eE") else "") + suffix


def _cell(argument: m.Expression) -> m.Expression:
    match argument:
        case m.Paren(inner):
            return _cell(inner)
        case m.Binary("+" | "-", m.Name() as axis, m.IntLiteral(0)):
            return axis
        case m.Binary("+", m.Name() as axis, m.Unary("-", by)):
            return m.Binary("-", axis, _cell(by), argument.span)
        case m.Binary(operator, left, right):
            return m.Binary(operator, _cell(left), _cell(right))
        case _:
            return argument


# --- what Python does not show ------------------------------------------------------------------


def _unwritten(node: object) -> object:
    match node:
        case m.Assign("+=" | "-=" as operator, target, m.IntLiteral(1)):
            return m.Unary(operator[0] * 2, target, node.span)
        case m.FloatLiteral(text):
            digits, suffix = text.rstrip("fFdD"), text[-1:].strip("0123456789.fF")
            return replace(node, text=plain_float(digits) + suffix)
        case m.Switch(cases=(*others, m.Case(statements=(*kept, m.Break())) as last)):
            return replace(node, cases=(*others, replace(last, statements=tuple(kept))))
        case _:
            return node


def _started(node: object) -> object:
    """Takes the start of a loop out of it, to before it."""
    match node:
        case m.Block(statements) | m.Case(statements=statements):
            return replace(node, statements=tuple(_spread(statements)))
        case _:
            return node


def _spread(statements: Iterable[m.Statement]) -> Iterator[m.Statement]:
    for statement in statements:
        if isinstance(statement, m.For) and statement.initial:
            yield from _starts(statement.initial)
            statement = replace(statement, initial=())
        yield statement


def with_starts(node: _Node) -> _Node:
    """What was read from Python as it is written: what gives a loop its variable in its head."""
    return rewrite(node, _headed)


def _headed(node: object) -> object:
    match node:
        case m.Block(statements) | m.Case(statements=statements):
            return replace(node, statements=joined_starts(statements))
        case _:
            return node


def joined_starts(statements: Iterable[m.Statement]) -> tuple[m.Statement, ...]:
    """Statements of which those that start a loop are in its head."""
    found: list[m.Statement] = []
    for statement in statements:
        if isinstance(statement, m.For) and not statement.initial and found:
            initial = _initial_of(found[-1], statement)
            if initial:
                found.pop()
                statement = replace(statement, initial=initial)
        found.append(statement)
    return tuple(found)


def _initial_of(start: m.Statement, loop: m.For) -> m.Declaration | tuple[m.Expression, ...]:
    """What a statement gives to a variable that the head of a loop uses; nothing if it does not."""
    parts = (*([loop.condition] if loop.condition is not None else []), *loop.updates)
    used = {n.name for part in parts for n in m.walk(part) if isinstance(n, m.Name)}
    match start:
        case m.Local(declaration, annotations=()) if len(declaration.declarators) == 1:
            return declaration if declaration.declarators[0].name in used else ()
        case m.ExpressionStatement(m.Assign("=", m.Name(name)) as first, annotations=()):
            return (first,) if name in used else ()
        case _:
            return ()


def _starts(initial: m.Declaration | tuple[m.Expression, ...]) -> Iterator[m.Statement]:
    if not isinstance(initial, m.Declaration):
        yield from (m.ExpressionStatement(e, span=e.span) for e in initial)
        return
    for each in initial.declarators:
        yield m.Local(replace(initial, declarators=(each,)), span=initial.span)
