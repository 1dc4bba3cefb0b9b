"""Warns about what is declared and never used."""

from __future__ import annotations

from dataclasses import field

from rebsync.diagnostics import Severity
from rebsync.model import Main
from rebsync.records import dataclass
from rebsync.reserved import OFFERS, OPEN
from rebsync.static.facts import Access, Facts, Invocation, Send, Use
from rebsync.static.symbols import (
    Callable,
    ClassInfo,
    KnownRebecSymbol,
    LocalSymbol,
    StateSymbol,
    Variable,
)

Key = tuple[str, str, tuple[str, ...]]


@dataclass(slots=True)
class _Uses:
    """Variables that are read or written, and callables that are meant somewhere."""

    reads: set[Variable] = field(default_factory=set)
    writes: set[Variable] = field(default_factory=set)
    meant: set[Key] = field(default_factory=set)
    below: set[Key] = field(default_factory=set)

    def means(self, symbol: Callable, receiver: str, facts: Facts) -> None:
        """A call on a rebec of `receiver` may run any version of the server or method."""
        self.meant.add(_key(receiver, symbol))
        info = facts.classes.get(receiver)
        for ancestor in info.ancestors if info is not None else ():
            self.below.add(_key(ancestor, symbol))

    def reaches(self, symbol: Callable, info: ClassInfo) -> bool:
        """Whether a call can mean the version that `info` declares."""
        own = _key(info.name, symbol)
        return own in self.below or any(_key(c, symbol) in self.meant for c in info.lineage)


def _key(owner: str, symbol: Callable) -> Key:
    return owner, symbol.name, tuple(str(p.type) for p in symbol.declaration.parameters)


def check_usage(facts: Facts, main: Main | None) -> None:
    """Warns about unused constants, variables, known rebecs, locals, servers, methods, classes."""
    uses = _collect(facts)
    for symbol in facts.env.values():
        if symbol not in uses.reads:
            message = f'the env variable "{symbol.name}" is never used'
            facts.warn("RS515", symbol.declaration.name_span, message)
    for info in facts.infos:
        _check_variables(facts, info, uses)
        _check_callables(facts, info, uses)
    for local in facts.symbols.values():
        if isinstance(local, LocalSymbol) and local not in uses.reads:
            uses.reads.add(local)
            message = f'the local variable "{local.name}" is never used'
            facts.warn("RS505", local.declaration.name_span, message)
    if main is not None and not facts.fragment:
        _check_instantiated(facts)


def _collect(facts: Facts) -> _Uses:
    uses = _Uses()
    for access in facts.outside:
        uses.reads.add(access.symbol)
    for body in facts.bodies:
        for event in body.events:
            match event:
                case Access(Use.READ, symbol, _):
                    uses.reads.add(symbol)
                case Access(Use.WRITE, symbol, _):
                    uses.writes.add(symbol)
                case Send(server, _, receiver, _):
                    uses.means(server, receiver, facts)
                case Invocation(method, _):
                    uses.means(method, body.owner.name, facts)
    return uses


def _check_variables(facts: Facts, info: ClassInfo, uses: _Uses) -> None:
    for name, symbol in info.variables.items():
        if symbol.owner != info.name or symbol in uses.reads:
            continue
        if isinstance(symbol, StateSymbol) and name in facts.observed:
            continue
        span = symbol.declaration.name_span
        if isinstance(symbol, KnownRebecSymbol):
            if not _is_robotic_pair(facts, info, symbol):
                facts.warn("RS502", span, f'the known rebec "{name}" is never used')
        elif symbol in uses.writes:
            if info.annotated("Robot") or info.annotated("Controller"):
                continue  # a property of the robot (thesis, 3.2): its node publishes it
            message = f'the state variable "{name}" is set and never read'
            hint = "of use only if a property reads it"
            facts.warn("RS504", span, message, hint, severity=Severity.NOTE)
        else:
            facts.warn("RS504", span, f'the state variable "{name}" is never used')


def _is_robotic_pair(facts: Facts, info: ClassInfo, symbol: KnownRebecSymbol) -> bool:
    """Robots and their controller know each other even where they send nothing."""
    other = facts.classes.get(symbol.type.name) if symbol.type is not None else None
    if other is None:
        return False
    pairs = (("Robot", "Controller"), ("Controller", "Robot"))
    return any(info.annotated(a) and other.annotated(b) for a, b in pairs)


def _check_callables(facts: Facts, info: ClassInfo, uses: _Uses) -> None:
    if info.is_interface:
        return
    for server in info.servers:
        if facts.fragment or server.owner != info.name or uses.reaches(server, info):
            continue
        if any(a.name in OFFERS | {OPEN} for a in server.declaration.annotations):
            continue  # clients from outside do
        message = f'no one sends the message "{server.name}"'
        hint = "core Rebeca up to 2.0 sends it at the start: verify --language core does, too"
        is_initial = server.name == "initial" and not server.declaration.parameters
        facts.warn("RS503", server.declaration.name_span, message, hint if is_initial else None)
    for method in info.methods:
        if method.owner == info.name and not uses.reaches(method, info):
            message = f'the method "{method.name}" is never called'
            facts.warn("RS516", method.declaration.name_span, message)


def _check_instantiated(facts: Facts) -> None:
    used: set[str] = set()
    for rebec in facts.rebecs.values():
        info = facts.classes.get(rebec.type.name) if rebec.type is not None else None
        used.update(info.lineage if info is not None else ())
    for info in facts.infos:
        if info.name not in used and not info.is_abstract:
            message = f'main has no rebec of the class "{info.name}"'
            facts.warn("RS517", info.declaration.name_span, message)
