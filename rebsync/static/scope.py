"""The body being checked: where it stands and which names it sees."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import field
from enum import Enum

from rebsync.model import Declarator, Parameter, Type
from rebsync.records import dataclass
from rebsync.source import Span
from rebsync.static.facts import Access, Event, Facts, Use
from rebsync.static.symbols import (
    BuiltinFunctionSymbol,
    BuiltinSymbol,
    ClassInfo,
    LocalSymbol,
    ParameterSymbol,
    Variable,
)
from rebsync.static.types import BOOLEAN, DOUBLE, INT, REACTIVE_CLASS, STRING, TYPE_NAMES, VOID


class Kind(Enum):
    """Where an expression or statement stands."""

    CONSTRUCTOR = "constructor"
    SERVER = "message server"
    METHOD = "method"
    MAIN = "main"
    ENV = "env variable"


CLOCK = {
    name: BuiltinSymbol(name, INT)
    for name in (
        "now",
        "currentMessageArrival",
        "currentMessageDeadline",
        "currentMessageWaitingTime",
    )
}
SENDER = BuiltinSymbol("sender", REACTIVE_CLASS)

FUNCTIONS = {
    symbol.name: symbol
    for symbol in (
        BuiltinFunctionSymbol("delay", VOID, ((INT,),)),
        BuiltinFunctionSymbol("assertion", VOID, ((BOOLEAN,), (BOOLEAN, STRING))),
        BuiltinFunctionSymbol("pow", DOUBLE, ((DOUBLE, DOUBLE),)),
        BuiltinFunctionSymbol("sqrt", DOUBLE, ((DOUBLE,),)),
    )
}
HIDEABLE = frozenset((*CLOCK, "sender"))


@dataclass(slots=True)
class Body:
    """One constructor, server, method, `main` or `env` value while it is checked."""

    facts: Facts
    kind: Kind
    owner: ClassInfo | None = None
    returns: Type | None = VOID
    visible: Mapping[str, Variable] = field(default_factory=dict)
    events: list[Event] = field(default_factory=list)
    scopes: list[dict[str, LocalSymbol | ParameterSymbol]] = field(default_factory=list)
    loops: int = 0
    switches: int = 0
    self_symbol: BuiltinSymbol | None = None

    def find(self, name: str) -> Variable | None:
        """The variable that a name means here."""
        for scope in reversed(self.scopes):
            if name in scope:
                return scope[name]
        found = self.visible.get(name) or self.facts.env.get(name)
        if found is None and self.owner is not None:
            found = CLOCK.get(name) or (SENDER if name == "sender" else None)
        return found

    def names(self) -> set[str]:
        """Every name that means a variable here."""
        names = {name for scope in self.scopes for name in scope}
        names.update(self.visible, self.facts.env, CLOCK if self.owner is not None else ())
        if self.kind is Kind.SERVER:
            names.add("sender")
        return names

    @contextmanager
    def block(self) -> Iterator[None]:
        """A scope of its own for local variables."""
        self.scopes.append({})
        yield
        self.scopes.pop()

    def declare(self, symbol: LocalSymbol | ParameterSymbol) -> None:
        """Adds a local variable or parameter to the innermost scope."""
        span = symbol.declaration.name_span
        check_name(self.facts, symbol.name, span)
        scope = self.scopes[-1]
        if symbol.name in scope:
            redeclared(self.facts, symbol.name, span, scope[symbol.name].declaration)
        else:
            scope[symbol.name] = symbol
            self.facts.symbols[id(symbol.declaration)] = symbol

    def read(self, symbol: Variable, span: Span) -> None:
        self.events.append(Access(Use.READ, symbol, span))

    def write(self, symbol: Variable, span: Span) -> None:
        self.events.append(Access(Use.WRITE, symbol, span))

    @property
    def is_partial(self) -> bool:
        """Whether a reported mistake hides part of what the class inherits."""
        return self.owner is not None and self.owner.partial


def check_name(facts: Facts, name: str, span: Span) -> None:
    """Reports a name that a variable or class must not or should not have."""
    if name in TYPE_NAMES:
        facts.error("RS210", span, f'"{name}" is the name of a type', "choose another name")
    elif name in HIDEABLE:
        facts.warn(
            "RS511", span, f'"{name}" hides the built-in of that name', "choose another name"
        )


def redeclared(facts: Facts, name: str, span: Span, first: Declarator | Parameter) -> None:
    """Reports the second declaration of a variable."""
    place = ((first.name_span, "first declared here"),)
    facts.error("RS206", span, f'"{name}" is already declared', related=place)
