"""The state variables of a unit that hold more in the code than the model's `int` does."""

from __future__ import annotations

from collections.abc import Sequence

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.proving import ANY, Interval, Proof
from rebsync.reverse.bodies.scope import WIDE
from rebsync.reverse.bodies.wide_locals import ranges_of, variables_in
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
    wide = {n: w.bits for n, w in state.wide.items() if n not in bodies.overflowing}
    received = _received(bodies)
    locals_ = {n: b for n, b in bodies.wide.items() if n not in state.variables}
    known = {**_known(bodies), **dict.fromkeys(bodies.overflowing, ANY)}
    members: list[m.Method | m.MessageServer] = [*methods, *servers]
    while True:
        proof = Proof({**locals_, **wide}, state.variables, state.variables, known)
        proof.body(constructor.statements)
        for member in members:
            taken = received.get(member.name, {})
            proof.wide = {**locals_, **{n: b for n, b in taken.items() if b >= WIDE}, **wide}
            small = {n: (0, (1 << b) - 1) for n, b in taken.items() if 0 < b < WIDE}
            proof.known = {**known, **small}
            if member.body is not None:
                proof.body(member.body.statements)
        # A local that has a wide one's name in another body.
        others = proof.broken & locals_.keys()
        if not others:
            counted = proof.counted & wide.keys()
            return Overflowing(frozenset(proof.broken & wide.keys()), frozenset(counted))
        known |= dict.fromkeys(others, ANY)
        locals_ = {n: b for n, b in locals_.items() if n not in others}


def _received(bodies: Bodies) -> dict[str, dict[str, int]]:
    """The bits of the parameters of servers: senders see to it that wide ones fit."""
    found: dict[str, dict[str, int]] = {}
    for server in bodies.servers:
        widths = bodies.state.types.widths.get(server.type or "", {})
        found[server.name] = {p.name: widths.get(p.path, 0) for p in server.parameters}
    return found


def _known(bodies: Bodies) -> dict[str, Interval]:
    """What is known of variables without a sign, and of the parameters of the constructor."""
    found = ranges_of(v for x in bodies.state.members.values() for v in variables_in(x))
    for given in bodies.setup.parameters:
        values = [v for v in given.values if isinstance(v, int)]
        if values and len(values) == len(given.values):
            found[given.name] = int(min(values)), int(max(values))
    return found
