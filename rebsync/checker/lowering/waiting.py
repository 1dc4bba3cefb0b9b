"""How long a message waited until it was taken: read before its first delay, kept in a local.

The instruction WAITING reads the time since the arrival of the message, which goes on in delays; a
state in a delay has no time at which its body began. So a body that both delays and asks reads it
first, and hands it to its methods as one more argument.
"""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.checker.lowering.emitter import Declared, Emitter, World
from rebsync.checker.program import Slot
from rebsync.model import Call, Method, Self, Super, walk
from rebsync.static import Analysis
from rebsync.static.names import bare
from rebsync.static.symbols import BuiltinFunctionSymbol, BuiltinSymbol, ClassInfo, MethodSymbol
from rebsync.static.types import INT

NAME = "currentMessageWaitingTime"


def as_run(call: Call, symbol: MethodSymbol, info: ClassInfo) -> MethodSymbol:
    """The version of a method that a call runs in a class."""
    target = bare(call.target) if call.target is not None else None
    if isinstance(target, Super):
        return symbol
    assert isinstance(target, Self | None)
    same = (symbol.name, symbol.signature)
    return next(m for m in info.methods if (m.name, m.signature) == same)


def takes_waiting(method: Method, info: ClassInfo, world: World) -> bool:
    """Whether a method has the waiting time as its last argument."""
    bodies: list[Declared] = [s.declaration for s in info.servers]
    bodies += [c.declaration for c in info.constructors]
    return _asks(world, method, info) and any(_delays(world, b, info) for b in bodies)


def is_asked(analysis: Analysis) -> bool:
    """Whether anything in a model reads the waiting time."""
    return any(_is_waiting(symbol) for symbol in analysis.symbols.values())


def begin(declared: Declared, parameters: tuple[Slot, ...], e: Emitter) -> tuple[Slot, ...]:
    """The parameters of a body with the waiting time, where it has to be kept."""
    assert e.info is not None
    if isinstance(declared, Method):
        if not takes_waiting(declared, e.info, e.world):
            return parameters
        e.waited = Slot(NAME, INT, "int", e.allocate(1), 1)
        return (*parameters, e.waited)
    if _asks(e.world, declared, e.info) and _delays(e.world, declared, e.info):
        e.waited = Slot(NAME, INT, "int", e.allocate(1), 1)
        e.emit("WAITING")
        e.emit("SETLOCAL", e.waited.offset)
    return parameters


def push(e: Emitter) -> None:
    """Pushes the waiting time."""
    if e.waited is None:
        e.emit("WAITING")
    else:
        e.emit("LOCAL", e.waited.offset)


def _asks(world: World, declared: Declared, info: ClassInfo) -> bool:
    """Whether a body or what it calls reads the waiting time."""
    return world.asks_waiting and any(map(_is_waiting, _meant(world, declared, info)))


def _is_waiting(symbol: object) -> bool:
    return isinstance(symbol, BuiltinSymbol) and symbol.name == NAME


def _delays(world: World, declared: Declared, info: ClassInfo) -> bool:
    """Whether a body or what it calls delays."""
    return any(
        isinstance(symbol, BuiltinFunctionSymbol) and symbol.name == "delay"
        for symbol in _meant(world, declared, info)
    )


def _meant(world: World, declared: Declared, info: ClassInfo) -> Iterator[object]:
    """The symbols in a body, and in the methods that it calls, each of these once."""
    work, seen = [declared], {id(declared)}
    while work:
        for node in walk(work.pop()):
            symbol = world.analysis.symbol_of(node)
            yield symbol
            if isinstance(node, Call) and isinstance(symbol, MethodSymbol):
                called = as_run(node, symbol, info).declaration
                if id(called) not in seen:
                    seen.add(id(called))
                    work.append(called)
