"""Warns about state variables that are read before they are set."""

from __future__ import annotations

from dataclasses import field

from rebsync.model import Constructor, MessageServer
from rebsync.records import dataclass
from rebsync.source import Span
from rebsync.static.facts import Access, BodyFacts, Facts, Invocation, Send, Use
from rebsync.static.symbols import ClassInfo, StateSymbol


@dataclass(slots=True)
class _Summary:
    """What a body sets, what it reads before setting it, and which servers it starts."""

    sets: set[StateSymbol] = field(default_factory=set)
    exposed: dict[StateSymbol, Span] = field(default_factory=dict)
    starts: list[int] = field(default_factory=list)


@dataclass(slots=True)
class _Summaries:
    bodies: dict[int, BodyFacts]
    done: dict[int, _Summary] = field(default_factory=dict)

    def of(self, key: int) -> _Summary:
        """The summary of a body, in textual order; an assignment in a branch counts as one."""
        summary = self.done.get(key)
        if summary is None:
            summary = self.done[key] = _Summary()
            if key in self.bodies:
                self._fill(summary, self.bodies[key])
        return summary

    def _fill(self, summary: _Summary, body: BodyFacts) -> None:
        for event in body.events:
            match event:
                case Access(Use.READ, StateSymbol() as symbol, span):
                    if symbol not in summary.sets:
                        summary.exposed.setdefault(symbol, span)
                case Access(Use.WRITE, StateSymbol() as symbol, _):
                    summary.sets.add(symbol)
                case Invocation(symbol, _):
                    self._include(summary, self.of(id(symbol.declaration)))
                case Send(symbol, _, _, True):
                    summary.starts.append(id(symbol.declaration))

    def _include(self, summary: _Summary, called: _Summary) -> None:
        for symbol, span in called.exposed.items():
            if symbol not in summary.sets:
                summary.exposed.setdefault(symbol, span)
        summary.sets |= called.sets
        summary.starts.extend(called.starts)


def check_unset(facts: Facts) -> None:
    """A variable that no constructor sets is reported where it is first read."""
    summaries = _Summaries({id(b.declaration): b for b in facts.bodies})
    below = _set_by_descendants(facts, summaries)
    by_class: dict[int, list[BodyFacts]] = {}
    for body in facts.bodies:
        by_class.setdefault(id(body.owner), []).append(body)
    for info in facts.infos:
        own = {v for v in info.state if v.owner == info.name}
        if info.is_abstract or not info.constructors:
            own -= below
        _check_class(facts, info, own, by_class.get(id(info), []), summaries)


def _set_by_descendants(facts: Facts, summaries: _Summaries) -> set[StateSymbol]:
    found: set[StateSymbol] = set()
    for body in facts.bodies:
        if isinstance(body.declaration, Constructor):
            sets = summaries.of(id(body.declaration)).sets
            found.update(s for s in sets if s.owner != body.owner.name)
    return found


def _check_class(
    facts: Facts,
    info: ClassInfo,
    own: set[StateSymbol],
    bodies: list[BodyFacts],
    summaries: _Summaries,
) -> None:
    constructors = [summaries.of(id(c.declaration)) for c in info.constructors]
    initial = set(own) if constructors else set()
    later = set(own) if constructors else set()
    exposed: dict[StateSymbol, Span] = {}
    for summary in constructors:
        initial &= summary.sets
        started = (s for key in summary.starts for s in summaries.of(key).sets)
        later &= summary.sets.union(started)
        exposed.update({s: at for s, at in summary.exposed.items() if s in own})
    starters = {key for summary in constructors for key in summary.starts}
    for body in bodies:
        if not isinstance(body.declaration, MessageServer):
            continue
        key = id(body.declaration)
        known = initial if key in starters else later
        for symbol, span in summaries.of(key).exposed.items():
            if symbol in own and symbol not in known:
                exposed.setdefault(symbol, span)
    for symbol, span in exposed.items():
        _report(facts, symbol, span)


def _report(facts: Facts, symbol: StateSymbol, span: Span) -> None:
    start = _initial(symbol)
    facts.warn(
        "RS501",
        span,
        f'"{symbol.name}" is read before it is set',
        f"set it in the constructor: here it starts as {start}, elsewhere as anything",
        related=((symbol.declaration.name_span, "declared here"),),
    )


def _initial(symbol: StateSymbol) -> str:
    match symbol.type.name if symbol.type is not None else "":
        case "boolean":
            return "false"
        case "byte" | "short" | "int" | "float" | "double":
            return "0"
        case _:
            return "null"
