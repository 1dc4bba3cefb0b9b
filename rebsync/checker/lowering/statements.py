"""Statements: each leaves the stack as it found it."""

from __future__ import annotations

from rebsync.checker.lowering.conversions import convert
from rebsync.checker.lowering.emitter import Emitter, kind_of, size_of
from rebsync.checker.lowering.expressions import as_kind, discard, value
from rebsync.checker.lowering.moves import moves
from rebsync.checker.lowering.places import Place, store
from rebsync.checker.program import Slot
from rebsync.model import (
    ArrayInitializer,
    Block,
    Break,
    Case,
    Continue,
    Declaration,
    Declarator,
    Empty,
    Expression,
    ExpressionStatement,
    For,
    If,
    Initializer,
    Local,
    Return,
    Statement,
    Switch,
    While,
)
from rebsync.statements import UNREADABLE
from rebsync.static.symbols import LocalSymbol
from rebsync.unions import assert_never


def statements(body: tuple[Statement, ...], e: Emitter) -> None:
    """A sequence in the current scope."""
    for each in body:
        statement(each, e)


def statement(node: Statement, e: Emitter) -> None:
    """One statement."""
    match node:
        case ExpressionStatement(expression):
            with e.at(node.span):
                discard(expression, e)
        case Block(inner):
            with e.scope():
                statements(inner, e)
        case Local(declaration):
            with e.at(node.span):
                _local(declaration, e)
        case If():
            _if(node, e)
        case While(condition, inner_body):
            _loop(condition, (), inner_body, e)
        case For():
            _for(node, e)
        case Switch():
            _switch(node, e)
        case Return(returned):
            with e.at(node.span):
                _return(returned, e)
        case Break():
            e.breaks[-1].append(e.emit("JUMP"))
        case Continue():
            e.continues[-1].append(e.emit("JUMP"))
        case Empty():
            moves(node, e)
            if any(a.name == UNREADABLE for a in node.annotations):
                with e.at(node.span):  # what does nothing, to tell which runs pass it
                    e.emit("CONST", 0)
                    e.emit("POP")
        case _:
            assert_never(node)


# --- local variables ---------------------------------------------------------------------------


def _local(declaration: Declaration, e: Emitter) -> None:
    for declarator in declaration.declarators:
        slot, initial = e.slots.get(id(declarator)), declarator.initial
        if slot is not None:
            _initialise(initial, _cells(slot), e)
        elif initial is None or isinstance(initial, ArrayInitializer):
            place = _cells(declare(declarator, e))
            _zero(place, e)
            if initial is not None:
                _initialise(initial, place, e)
        else:
            # The value comes first: cells in scope must be set, also while it is computed.
            kind = value(initial, e)
            place = _cells(declare(declarator, e))
            convert(kind, place.kind, e)
            store(place, e)


def declare(declarator: Declarator, e: Emitter) -> Slot:
    """Takes the cells of a local variable."""
    symbol = e.world.analysis.symbol_of(declarator)
    assert isinstance(symbol, LocalSymbol)
    assert symbol.type is not None
    return e.declare(declarator, declarator.name, symbol.type)


def _cells(slot: Slot) -> Place:
    return Place("LOCAL", slot.offset, slot.type)


def _initialise(initial: Initializer | None, place: Place, e: Emitter) -> None:
    if isinstance(initial, ArrayInitializer):
        size = place.size // len(initial.values)
        inner = type(place.type)(place.type.name, place.type.dimensions[1:])
        for i, part in enumerate(initial.values):
            _initialise(part, Place("LOCAL", place.start + i * size, inner), e)
        return
    if initial is None:
        _zero(place, e)
        return
    as_kind(initial, place.kind, e)
    store(place, e)


def _zero(place: Place, e: Emitter) -> None:
    empty = -1 if place.kind == "rebec" else 0
    for cell in range(place.size):
        e.emit("CONST", empty)
        e.emit("SETLOCAL", place.start + cell)


# --- control flow ------------------------------------------------------------------------------


def _test(condition: Expression, e: Emitter) -> int:
    """Evaluates a condition; the jump that is taken when it is false."""
    with e.at(condition.span):
        value(condition, e)
        return e.emit("JUMPF")


def _if(node: If, e: Emitter) -> None:
    ends = []
    current: Statement | None = node
    while isinstance(current, If):
        skip = _test(current.condition, e)
        with e.scope():
            statement(current.then, e)
        current = current.otherwise
        if current is not None:
            ends.append(e.emit("JUMP"))
        e.patch(skip)
    if current is not None:
        with e.scope():
            statement(current, e)
    e.patch(*ends)


def _for(node: For, e: Emitter) -> None:
    with e.scope():
        if isinstance(node.initial, Declaration):
            with e.at(node.initial.span):
                _local(node.initial, e)
        else:
            for expression in node.initial:
                discard(expression, e)
        _loop(node.condition, node.updates, node.body, e)


def _loop(
    condition: Expression | None, updates: tuple[Expression, ...], body: Statement, e: Emitter
) -> None:
    e.breaks.append([])
    e.continues.append([])
    top = e.here
    if condition is not None:
        e.breaks[-1].append(_test(condition, e))
    with e.scope():
        statement(body, e)
    e.patch(*e.continues.pop())
    for update in updates:
        with e.at(update.span):
            discard(update, e)
    e.emit("JUMP", top)
    e.patch(*e.breaks.pop())


def _switch(node: Switch, e: Emitter) -> None:
    with e.scope():
        with e.at(node.subject.span):
            value(node.subject, e)
        # A case may be entered past the declarations of earlier ones.
        for local in (s for c in node.cases for s in c.statements if isinstance(s, Local)):
            for declarator in local.declaration.declarators:
                _zero(_cells(declare(declarator, e)), e)
        with e.scope():
            subject = e.allocate(1)
            e.emit("SETLOCAL", subject)
            entries = [_entry(case, subject, e) for case in node.cases]
        e.breaks.append([])
        if all(case.value is not None for case in node.cases):
            e.breaks[-1].append(e.emit("JUMP"))
        for case, entry in zip(node.cases, entries, strict=True):
            e.patch(entry)
            statements(case.statements, e)
        e.patch(*e.breaks.pop())


def _entry(case: Case, subject: int, e: Emitter) -> int:
    if case.value is None:
        return e.emit("JUMP")
    with e.at(case.value.span):
        e.emit("LOCAL", subject)
        value(case.value, e)
        e.emit("EQ")
        return e.emit("JUMPT")


def _return(returned: Expression | None, e: Emitter) -> None:
    if returned is not None:
        as_kind(returned, kind_of(e.returns), e)
        e.emit("RET", size_of(e.returns))
    else:
        e.emit("RET")
