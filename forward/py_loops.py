"""A `for` of the model that is `for i in range(...)` or `while` of Python."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from rebsync import model as m
from rebsync.forward.py_places import bare
from rebsync.static import Analysis
from rebsync.static.symbols import (
    EnvSymbol,
    LocalSymbol,
    MethodSymbol,
    ParameterSymbol,
    StateSymbol,
)
from rebsync.static.types import INT, is_integer


def counting(loop: m.For, analysis: Analysis) -> m.Declarator | None:
    """The variable of a counted loop, `for (int i = a; i < b; i++)`; None for other loops.

    Python evaluates `a` and `b` once, the model `b` each time: nothing in the body may store in
    `i` or in what they read.
    """
    match loop:
        case m.For(
            m.Declaration(type_, (m.Declarator(name, initial) as counter,)),
            m.Binary("<", m.Name(compared), bound),
            (update,),
        ) if type_ == INT and compared == name and _is_step(update, name):
            ends = (initial, bound)
        case _:
            return None
    stored = set(_stored(loop.body))
    if name in stored:
        return None
    return counter if all(_is_steady(e, loop.body, stored, analysis) for e in ends) else None


def counters(block: m.Block, analysis: Analysis) -> set[int]:
    """The ids of the variables of all counted loops in a body."""
    loops = (counting(n, analysis) for n in m.walk(block) if isinstance(n, m.For))
    return {id(counter) for counter in loops if counter is not None}


def steps(loop: m.For) -> tuple[m.Expression, ...]:
    """The updates of a `for` that is a `while` of Python which ends with them; else none.

    A `continue` would leave them out.
    """
    return loop.updates if loop.condition is not None and not _goes_on(loop.body) else ()


def _goes_on(statement: m.Node) -> bool:
    """Whether a `continue` within a statement is one of the loop that the statement is in."""
    if isinstance(statement, m.Continue):
        return True
    if isinstance(statement, m.For | m.While):
        return False
    return any(map(_goes_on, m.children(statement)))


def _is_step(update: m.Expression, name: str) -> bool:
    """Whether something adds one to a variable."""
    match update:
        case m.Postfix("++", m.Name(stepped)) | m.Unary("++", m.Name(stepped)):
            return stepped == name
        case m.Assign("+=", m.Name(stepped), m.IntLiteral(1)):
            return stepped == name
        case _:
            return False


def _is_steady(
    end: m.Initializer | None, body: m.Statement, stored: Collection[str], analysis: Analysis
) -> bool:
    """Whether a bound is an integer that stays the same throughout a loop."""
    match end:
        case m.IntLiteral() | m.Unary("-", m.IntLiteral()):
            return True
        case m.Name(name) as place:
            symbol = analysis.symbols.get(id(place))
        case _:
            return False
    type_ = getattr(symbol, "type", None)
    if type_ is None or not is_integer(type_) or name in stored:
        return False
    match symbol:
        case LocalSymbol() | ParameterSymbol():
            return True
        case StateSymbol() | EnvSymbol():
            return not any(_runs_code(n, analysis) for n in m.walk(body))
        case _:
            return False


def _stored(body: m.Statement) -> Iterator[str]:
    """The names of what a statement stores in; of an element, that of its array."""
    for node in m.walk(body):
        match node:
            case m.Assign(target=target) | m.Postfix(operand=target):
                yield _name(target)
            case m.Unary("++" | "--", target):
                yield _name(target)
            case _:
                pass


def _name(place: m.Expression) -> str:
    place = bare(place)
    match place:
        case m.Index(target):
            return _name(target)
        case m.Member(name=name) | m.Name(name):
            return name
        case _:
            return ""


def _runs_code(node: m.Node, analysis: Analysis) -> bool:
    """Whether a method runs, or a user's function that samples a sensor: these may store."""
    is_method = isinstance(analysis.symbols.get(id(node)), MethodSymbol)
    return is_method or isinstance(node, m.Choice)
