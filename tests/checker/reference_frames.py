"""What running bodies of the reference consist of, and what they may ask for."""

from __future__ import annotations

from dataclasses import dataclass, field

from rebsync import model as m
from rebsync.static.symbols import MethodSymbol, ServerSymbol, Symbol
from tests.checker.reference_values import Value, bits, tag

Key = tuple[str, tuple[str, ...]]
Variables = dict[Symbol, Value]


class Fails(Exception):
    """A rule of the model is broken at a node of the tree; `rebec` when it is another's."""

    def __init__(self, kind: str, node: m.Node, rebec: int | None = None) -> None:
        super().__init__(kind, node)
        self.kind, self.node, self.rebec = kind, node, rebec


class Endless(Exception):
    """A body runs for very many statements."""


class World:
    """What a body may ask for; the explorer says what the answers are."""

    def choose(self, count: int) -> int:
        raise NotImplementedError

    def read(self, name: str) -> int:
        raise NotImplementedError

    def send(
        self, node: m.Call, receiver: int, key: Key, arguments: Value, times: tuple[int, int | None]
    ) -> None:
        raise NotImplementedError

    def wait(self, time: int) -> None:
        raise NotImplementedError


@dataclass
class Frame:
    """A running server, method or constructor; `point` is the call in which it stands."""

    scopes: list[Variables]
    operands: list[Value] = field(default_factory=list)
    point: m.Node | None = None
    result: Value = None

    def identity(self) -> tuple[object, ...]:
        """Where it is, its locals in scope, and what is computed so far of an expression."""
        cells = [bits(v) for scope in self.scopes for v in scope.values()]
        return id(self.point), tuple(cells), tuple(bits(v) for v in self.operands)


def key_of(symbol: ServerSymbol | MethodSymbol) -> Key:
    """The name and the types of parameters."""
    return symbol.name, tuple(str(p.type) for p in symbol.declaration.parameters)


@dataclass(frozen=True)
class Place:
    """A variable or an element of it."""

    symbol: Symbol
    type: m.Type
    path: tuple[int, ...] = ()

    @property
    def kind(self) -> str:
        return tag(self.type)


def replaced(value: Value, path: tuple[int, ...], new: Value) -> Value:
    if not path:
        return new
    assert isinstance(value, tuple)
    inner = replaced(value[path[0]], path[1:], new)
    return (*value[: path[0]], inner, *value[path[0] + 1 :])
