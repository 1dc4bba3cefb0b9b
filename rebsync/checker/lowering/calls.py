"""Sends, calls of methods, and the built-in functions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from rebsync.checker.lowering import waiting
from rebsync.checker.lowering.conversions import convert
from rebsync.checker.lowering.emitter import Emitter, kind_of, size_of
from rebsync.checker.program import ANYBODY, ITS_SENDER, ITSELF, Instruction, Kind
from rebsync.model import Call, Choice, Expression, Method, StringLiteral, Type
from rebsync.static.names import bare
from rebsync.static.symbols import BuiltinFunctionSymbol, MethodSymbol, ServerSymbol
from rebsync.static.types import DOUBLE, INT

# Pushes the value of an expression; gives the kind of its cells.
Value: TypeAlias = Callable[[Expression, Emitter], Kind]


def call(node: Call, e: Emitter, value: Value) -> Kind:
    """Pushes the result of a call, if it has one."""
    symbol = e.world.analysis.symbol_of(node)
    match symbol:
        case ServerSymbol():
            _send(node, symbol, e, value)
            return "int"
        case MethodSymbol():
            return _invoke(node, symbol, e, value)
        case BuiltinFunctionSymbol(name):
            return _builtin(name, node, e, value)
        case _:
            raise AssertionError(f"not a call: {node}")


def _arguments(
    arguments: tuple[Expression, ...], signature: tuple[Type | None, ...], e: Emitter, value: Value
) -> int:
    before = 0
    for argument, type_ in zip(arguments, signature, strict=True):
        assert type_ is not None
        convert(value(argument, e), kind_of(type_), e)
        before += size_of(type_)
    return before


def _send(node: Call, server: ServerSymbol, e: Emitter, value: Value) -> None:
    start = e.here
    if node.target is None:
        e.emit("SELF")
    else:
        value(node.target, e)
    receiver = _receiver(e.world.code[start:])
    cells = _arguments(node.arguments, server.signature, e, value)
    if node.after is None:
        e.emit("CONST", 0)
    else:
        convert(value(node.after, e), kind_of(INT), e)
    marks = (int(_is_positive(node.after, e)), receiver)
    with e.at(node.span):
        if node.deadline is None:
            e.emit("SEND", e.world.selector(server), cells, marks)
        else:
            convert(value(node.deadline, e), kind_of(INT), e)
            e.emit("SENDBY", e.world.selector(server), cells, marks)


def _receiver(pushed: Sequence[Instruction]) -> int:
    """Who receives a message, by the instructions that push the receiver."""
    match pushed:
        case [Instruction("KNOWN", number)]:
            return number
        case [Instruction("SELF")]:
            return ITSELF
        case [Instruction("SENDER")]:
            return ITS_SENDER
        case _:
            return ANYBODY


def _is_positive(time: Expression | None, e: Emitter) -> bool:
    """Whether a time can be seen to be more than zero, whatever is chosen."""
    if time is None:
        return False
    inner = bare(time)
    if isinstance(inner, Choice):
        return all(_is_positive(option, e) for option in inner.options)
    known = e.world.analysis.value_of(inner)
    return known is not None and known > 0


def _invoke(node: Call, symbol: MethodSymbol, e: Emitter, value: Value) -> Kind:
    assert e.info is not None
    _arguments(node.arguments, symbol.signature, e, value)
    called = waiting.as_run(node, symbol, e.info).declaration
    assert isinstance(called, Method)
    if waiting.takes_waiting(called, e.info, e.world):
        waiting.push(e)
    with e.at(node.span):
        e.emit("CALL", e.world.body_of(e.info, called), e.free)
    assert symbol.type is not None
    return kind_of(symbol.type)


def _builtin(name: str, node: Call, e: Emitter, value: Value) -> Kind:
    with e.at(node.span):
        match name:
            case "delay":
                convert(value(node.arguments[0], e), "int", e)
                passes = (1,) if _is_positive(node.arguments[0], e) else ()
                e.emit("DELAY", 0, e.free, passes)
                return "int"
            case "assertion":
                value(node.arguments[0], e)
                text = node.arguments[1] if len(node.arguments) > 1 else None
                said = e.text(text.text[1:-1]) if isinstance(text, StringLiteral) else -1
                e.emit("ASSERT", said)
                return "int"
            case _:
                for argument in node.arguments:
                    convert(value(argument, e), kind_of(DOUBLE), e)
                e.emit(name.upper())
                return "double"
