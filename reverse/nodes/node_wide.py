"""The state variables of a unit that hold more in the code than the model's `int` does."""

from __future__ import annotations

from collections.abc import Sequence

from rebsync import model as m
from rebsync.intervals import ANY, Interval, around, unsigned
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.interval_analysis import IntervalAnalysis
from rebsync.reverse.bodies.scope import WIDE
from rebsync.reverse.bodies.types.wide_locals import ranges_of, variables_in
from rebsync.reverse.nodes.node_bodies import Bodies


@dataclass(frozen=True, slots=True)
class Overflowing:
    """State variables by their names: those that may get a number which no `int` holds, and those
    that only do after they have counted for long.
    """

    broken: frozenset[str]
    counted: frozenset[str]


def overflowing(
    bodies: Bodies,
    constructor: m.Block,
    servers: Sequence[m.MessageServer],
    methods: Sequence[m.Method],
) -> Overflowing:
    """What the bodies of a unit do to its wide state variables."""
    state = bodies.state
    if not state.wide:
        return Overflowing(frozenset(), frozenset())
    if bodies.lowered:  # of these literals the bodies have only the lower bits
        return Overflowing(frozenset(state.wide), frozenset())
    wide = {n: w.bits for n, w in state.wide.items() if n not in bodies.overflowing}
    received = _received(bodies)
    locals_ = {n: b for n, b in bodies.wide.items() if n not in state.variables}
    always = {**_small(bodies), **dict.fromkeys(bodies.overflowing, ANY)}
    members: list[m.Method | m.MessageServer] = [*methods, *servers]
    while True:
        analysis = IntervalAnalysis(
            {**locals_, **wide}, state.variables, _given(bodies), always, called=state.variables
        )
        analysis.body(constructor.statements)
        analysis.known = {}
        for member in members:
            taken = received.get(member.name, {})
            analysis.widths = {**locals_, **{n: b for n, b in taken.items() if b >= WIDE}, **wide}
            small = {n: unsigned(b) for n, b in taken.items() if 0 < b < WIDE}
            analysis.always = {**always, **small}
            if member.body is not None:
                analysis.body(member.body.statements)
        # A local that has a wide one's name in another body.
        others = analysis.broken & locals_.keys()
        if not others:
            counted = analysis.counted & wide.keys()
            return Overflowing(frozenset(analysis.broken & wide.keys()), frozenset(counted))
        always |= dict.fromkeys(others, ANY)
        locals_ = {n: b for n, b in locals_.items() if n not in others}


def _received(bodies: Bodies) -> dict[str, dict[str, int]]:
    """The bits of the parameters of servers: senders see to it that wide ones fit."""
    found: dict[str, dict[str, int]] = {}
    for server in bodies.servers:
        widths = bodies.state.types.widths.get(server.type or "", {})
        found[server.name] = {p.name: widths.get(p.path, 0) for p in server.parameters}
    return found


def _small(bodies: Bodies) -> dict[str, Interval]:
    """What variables without a sign hold that are no wider than an `int`."""
    return ranges_of(v for x in bodies.state.members.values() for v in variables_in(x))


def _given(bodies: Bodies) -> dict[str, Interval]:
    """What the parameters of the constructor are given."""
    found = {}
    for given in bodies.setup.parameters:
        values = [int(v) for v in given.values if isinstance(v, int)]
        if values and len(values) == len(given.values):
            found[given.name] = around(values)
    return found
