"""What of a statement is different: each part with the trees on both sides."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from rebsync import model as m
from rebsync.printing import print_expression
from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import Aspect
from rebsync.roundtrip.diff.tokens import Tokens

Statements: TypeAlias = tuple[m.Statement, ...]

_TIMES = ((Aspect.AFTER, "after"), (Aspect.DEADLINE, "deadline"))


@dataclass(frozen=True, slots=True, eq=False)
class StatementPart:
    """A part of a statement; None where a side has none. `of` says what it is a part of."""

    aspect: Aspect
    of: str
    left: object
    right: object


Parts: TypeAlias = "Iterator[StatementPart | tuple[Statements, Statements]]"


@dataclass(frozen=True, slots=True, eq=False)
class _Two:
    """The two sides that parts are taken from."""

    left: Tokens
    right: Tokens

    def lists(self, x: m.Statement | None, r: m.Statement | None) -> tuple[Statements, Statements]:
        """The statements of two branches."""
        return statements_of(x), statements_of(r)

    def name(self, expression: m.Expression) -> str:
        """An expression as it is written on the left."""
        return print_expression(self.left.written(expression))


def statements_of(statement: m.Statement | None) -> Statements:
    """The statements of a branch or body."""
    if statement is None:
        return ()
    if isinstance(statement, m.Block) and not statement.annotations:
        return statement.statements
    return (statement,)


def parts_of(x: m.Statement, r: m.Statement, left: Tokens, right: Tokens) -> Parts:
    """The parts in which two statements of one kind differ; lists are for the caller to compare."""
    two = _Two(left, right)
    if x.annotations != r.annotations:
        yield StatementPart(Aspect.ANNOTATION, "", x.annotations or None, r.annotations or None)
    match x, r:
        case (m.ExpressionStatement(a), m.ExpressionStatement(b)):
            yield from _expression(a, b, two)
        case (m.Local(a), m.Local(b)):
            yield from _declaration(a, b, two)
        case (m.If(), m.If()):
            yield from _part(Aspect.CONDITION, "if", x.condition, r.condition)
            yield two.lists(x.then, r.then)
            yield two.lists(x.otherwise, r.otherwise)
        case (m.While(), m.While()):
            yield from _part(Aspect.CONDITION, "while", x.condition, r.condition)
            yield two.lists(x.body, r.body)
        case (m.For(), m.For()):
            yield from _for(x, r, two)
        case (m.Switch(), m.Switch()):
            yield from _switch(x, r, two)
        case (m.Return(a), m.Return(b)):
            yield from _part(Aspect.EXPRESSION, "return", a, b)
        case (m.Block(a), m.Block(b)):
            yield a, b
        case _:
            return


def _part(aspect: Aspect, of: str, x: object, r: object) -> Iterator[StatementPart]:
    if x != r:
        yield StatementPart(aspect, of, *_narrowed(x, r))


def _narrowed(x: object, r: object) -> tuple[object, object]:
    """Of conditions that are put together in one way, the one that is different."""
    while True:
        match x, r:
            case m.Paren(a), m.Paren(b):
                x, r = a, b
            case m.Unary("!", a), m.Unary("!", b):
                x, r = a, b
            case m.Binary("&&" | "||" as one, a, c), m.Binary(other, b, d) if one == other:
                if a != b and c != d:
                    return x, r
                x, r = (a, b) if a != b else (c, d)
            case _:
                return x, r


# --- expressions --------------------------------------------------------------------------------


def _expression(x: m.Expression, r: m.Expression, two: _Two) -> Iterator[StatementPart]:
    match x, r:
        case (m.Call(), m.Call()) if x.name == r.name:
            yield from _call(x, r, two)
        case (m.Assign(), m.Assign()) if (x.operator, x.target) == (r.operator, r.target):
            yield from _part(Aspect.EXPRESSION, two.name(x.target), x.value, r.value)
        case _:
            yield from _part(Aspect.EXPRESSION, "", x, r)


def _call(x: m.Call, r: m.Call, two: _Two) -> Iterator[StatementPart]:
    same = x.target == r.target
    one_only = not same and (x.target is None or r.target is None)
    if one_only or len(x.arguments) != len(r.arguments):
        yield StatementPart(Aspect.EXPRESSION, "", x, r)
        return
    called = two.left.written(x)
    name = two.name(m.Call(called.target, called.name)).removesuffix("()")
    yield from _part(Aspect.RECEIVER, name, x.target, r.target)
    for number, (a, b) in enumerate(zip(x.arguments, r.arguments, strict=True), start=1):
        aspect, of = _argument(x, name, number)
        yield from _part(aspect, of, a, b)
    for aspect, each in _TIMES:
        yield from _part(aspect, name, getattr(x, each), getattr(r, each))


def _argument(call: m.Call, name: str, number: int) -> tuple[Aspect, str]:
    if call.target is None and call.name == "delay":
        return Aspect.DELAY, ""
    if call.target is None and call.name == "assertion":
        return Aspect.CONDITION, "assertion"
    return Aspect.ARGUMENT, f"{name}, number {number}" if len(call.arguments) > 1 else name


# --- declarations and control flow --------------------------------------------------------------


def _declaration(x: m.Declaration, r: m.Declaration, two: _Two) -> Iterator[StatementPart]:
    if len(x.declarators) != len(r.declarators) or x.annotations != r.annotations:
        yield StatementPart(Aspect.EXPRESSION, "", x, r)
        return
    names = ", ".join(two.left.written(d).name for d in x.declarators)
    if [d.name for d in x.declarators] != [d.name for d in r.declarators]:
        yield StatementPart(Aspect.EXPRESSION, "", x, r)
        return
    yield from _part(Aspect.TYPE, names, x.type, r.type)
    for a, b in zip(x.declarators, r.declarators, strict=True):
        yield from _part(Aspect.INITIAL, names, a.initial, b.initial)


def _for(x: m.For, r: m.For, two: _Two) -> Parts:
    if isinstance(x.initial, m.Declaration) and isinstance(r.initial, m.Declaration):
        yield from _declaration(x.initial, r.initial, two)
    else:
        yield from _part(Aspect.EXPRESSION, "for", x.initial, r.initial)
    yield from _part(Aspect.CONDITION, "for", x.condition, r.condition)
    yield from _part(Aspect.EXPRESSION, "for", x.updates, r.updates)
    yield two.lists(x.body, r.body)


def _switch(x: m.Switch, r: m.Switch, two: _Two) -> Parts:
    yield from _part(Aspect.EXPRESSION, "switch", x.subject, r.subject)
    labels = [[c.value for c in each.cases] for each in (x, r)]
    if labels[0] != labels[1]:
        cases = [_cases(each, tokens) for each, tokens in ((x, two.left), (r, two.right))]
        yield StatementPart(Aspect.EXPRESSION, "cases", *cases)
    for case, same in _case_pairs(x.cases, r.cases):
        notes = [each.annotations if each is not None else () for each in (case, same)]
        if case is not None and same is not None:
            yield from _part(Aspect.ANNOTATION, "case", notes[0] or None, notes[1] or None)
        yield (
            case.statements if case is not None else (),
            same.statements if same is not None else (),
        )


def _case_pairs(
    lefts: tuple[m.Case, ...], rights: tuple[m.Case, ...]
) -> Iterator[tuple[m.Case | None, m.Case | None]]:
    """Cases of one label, and those without a partner in their order."""
    by_label = {case.value: case for case in reversed(rights)}
    paired = {id(by_label[c.value]) for c in lefts if c.value in by_label}
    others = iter([case for case in rights if id(case) not in paired])
    for case in lefts:
        yield case, by_label.get(case.value) or next(others, None)
    yield from ((None, case) for case in others)


def _cases(switch: m.Switch, tokens: Tokens) -> str:
    """The labels of a switch in their order."""
    return ", ".join(
        print_expression(tokens.written(c.value)) if c.value is not None else "default"
        for c in switch.cases
    )
