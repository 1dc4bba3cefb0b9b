"""What a drawn system consists of, before its bodies are written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

_T = TypeVar("_T")


@dataclass(frozen=True)
class Features:
    """What a family of systems may use."""

    timed: bool = True
    delays: bool = True
    clock: bool = False
    floats: bool = False
    drivers: bool = False  # rebecs to which only they themselves send, and only for later
    equals: bool = False  # several rebecs of the first class, most of them with equal bindings


@dataclass(frozen=True)
class Callee:
    """A server or method: its parameters as (type, name), and what a method returns."""

    name: str
    parameters: tuple[tuple[str, str], ...] = ()
    result: str = "void"


@dataclass
class Outline:
    """A class in the making; `state` and `known` as (type, name)."""

    name: str
    capacity: int
    base: Outline | None = None
    state: list[tuple[str, str]] = field(default_factory=list)
    known: list[tuple[str, str]] = field(default_factory=list)
    servers: list[Callee] = field(default_factory=list)
    methods: list[Callee] = field(default_factory=list)

    def line(self) -> list[Outline]:
        """The class and its ancestors, the oldest first."""
        return [*(self.base.line() if self.base else ()), self]

    def all_servers(self) -> list[Callee]:
        """With the inherited ones, each once."""
        return list(dict.fromkeys(s for c in self.line() for s in c.servers))

    def all_methods(self) -> list[Callee]:
        """With the inherited ones, each once."""
        return list(dict.fromkeys(s for c in self.line() for s in c.methods))


@dataclass
class Drawer:
    """Draws choices for one system."""

    draw: DrawFn
    features: Features
    classes: list[Outline] = field(default_factory=list)

    def one(self, options: Sequence[_T]) -> _T:
        """One of the options."""
        return self.draw(st.sampled_from(options))

    def flag(self, out_of: int = 2) -> bool:
        """True once in so many times."""
        return self.draw(st.integers(0, out_of - 1)) == out_of - 1

    def up_to(self, most: int, least: int = 0) -> int:
        """A number."""
        return self.draw(st.integers(least, most))

    def servers_of(self, name: str) -> list[Callee]:
        """What can be sent to a rebec of a class."""
        return next(c for c in self.classes if c.name == name).all_servers()


def outline(drawer: Drawer) -> None:
    """Draws the classes of a system: names, variables, signatures."""
    count = drawer.up_to(3, least=1)
    for number in range(count):
        base = drawer.one(drawer.classes) if drawer.classes and drawer.flag(4) else None
        drawer.classes.append(_class(drawer, number, base))
    for each in drawer.classes:
        for number in range(drawer.up_to(2)):
            name = f"k{drawer.classes.index(each)}{number}"
            each.known.append((drawer.one(drawer.classes).name, name))


def _class(drawer: Drawer, number: int, base: Outline | None) -> Outline:
    each = Outline(f"C{number}", drawer.up_to(6, least=2), base)
    kinds = ["int", "int", "byte", "boolean", "int[2]", "byte[2][2]", each.name]
    if drawer.features.floats:
        kinds += ["float", "double"]
    for position in range(drawer.up_to(3, least=1)):
        each.state.append((drawer.one(kinds), f"v{number}{position}"))
    for position in range(drawer.up_to(2, least=1)):
        each.servers.append(_callee(drawer, each, f"s{number}{position}"))
    if base is not None and drawer.flag():
        each.servers.append(drawer.one(base.servers))
    for position in range(drawer.up_to(1)):
        callee = _callee(drawer, each, f"m{number}{position}")
        result = drawer.one(["void", "int", "byte", "boolean"])
        each.methods.append(Callee(callee.name, callee.parameters, result))
    if base is not None and base.methods and drawer.flag():
        each.methods.append(drawer.one(base.methods))
    return each


def _callee(drawer: Drawer, each: Outline, name: str) -> Callee:
    kinds = ["int", "int", "byte", "boolean", each.name]
    count = drawer.one([0, 0, 1, 1, 2])
    return Callee(name, tuple((drawer.one(kinds), f"p{i}") for i in range(count)))
