"""State spaces in the XML that RMC writes, for the tools that read it.

RMC counts time from the start: a state has the times at which it was first reached, and an edge
that leads back to an equal state at another time says by how much in `shift`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from heapq import heappop, heappush

from rebsync.checker.program import Program, RebecInfo
from rebsync.checker.show.markup import escaped
from rebsync.checker.show.space import SpaceEdge, StateSpace
from rebsync.checker.trace import ShownMessage, ShownRebec


def rmc_xml(space: StateSpace, program: Program) -> str:
    """The state space of a program; states are numbered from 1, as RMC numbers them."""
    reached = _times(space)
    lines = ["<transitionsystem>"]
    for number, rebecs in enumerate(space.states):
        lines += _state(space, program, number, rebecs, reached[number])
    lines += (_transition(edge, reached) for edge in space.edges if edge.target is not None)
    return "\n".join([*lines, "</transitionsystem>"]) + "\n"


def _times(space: StateSpace) -> list[int]:
    """The earliest time at which each state is reached; 0 for one that nothing leads to."""
    following: dict[int, list[SpaceEdge]] = defaultdict(list)
    for edge in space.edges:
        following[edge.source].append(edge)
    times: dict[int, int] = {}
    waiting = [(0, state) for state in space.initial]
    while waiting:
        time, state = heappop(waiting)
        if state not in times:
            times[state] = time
            for edge in following[state]:
                if edge.target is not None:
                    heappush(waiting, (time + edge.time, edge.target))
    return [times.get(state, 0) for state in range(len(space.states))]


def _state(
    space: StateSpace, program: Program, number: int, rebecs: tuple[ShownRebec, ...], time: int
) -> Iterator[str]:
    holding = space.holds[number] if space.holds else ()
    propositions = escaped("".join(f"{name}," for name in holding))
    yield f'<state id="{number + 1}_0" atomicpropositions="{propositions}">'
    for info, rebec in zip(program.rebecs, rebecs, strict=True):
        yield f'\t<rebec name="{escaped(rebec.name)}">'
        yield "\t\t<statevariables>"
        yield from (_variable(info, name, value) for name, value in rebec.variables)
        yield "\t\t</statevariables>"
        yield "\t\t<queue>"
        yield from (_message(message, time) for message in rebec.bag)
        yield "\t\t</queue>"
        yield f"\t\t<now>{time + (rebec.busy_until or 0)}</now>"
        if space.semantics == "tts":
            yield f"\t\t<pc>{rebec.suspended_at or ''}</pc>"
            yield f"\t\t<res>{'' if rebec.busy_until is None else time + rebec.busy_until}</res>"
        yield "\t</rebec>"
    yield "</state>"


def _variable(info: RebecInfo, name: str, value: str) -> str:
    plain = name.split("[")[0]
    kind = next(slot.type.name for slot in info.state if slot.name == plain)
    return (
        f'\t\t\t<variable name="{escaped(info.class_name)}.{escaped(name)}" '
        f'type="{escaped(kind)}">{escaped(value)}</variable>'
    )


def _message(message: ShownMessage, time: int) -> str:
    due = "infinity" if message.deadline is None else str(time + message.deadline)
    told = f"{message.server}({','.join(value for _, value in message.arguments)})"
    return (
        f'\t\t\t<message arrival="{time + message.arrival}" deadline="{due}" '
        f'sender="{escaped(message.sender)}">{escaped(told)}</message>'
    )


def _transition(edge: SpaceEdge, reached: list[int]) -> str:
    assert edge.target is not None
    started = reached[edge.source]
    shift = started + edge.time - reached[edge.target]
    if edge.rebec:
        title = ("tau=>" if edge.resumes else "") + edge.server.upper()
        inner = (
            f'<messageserver sender="{escaped(edge.sender)}" owner="{escaped(edge.rebec)}" '
            f'title="{escaped(title)}"/>'
        )
    else:
        inner = f'<time value="{edge.time}"/>'
    return (
        f'<transition source="{edge.source + 1}_0" destination="{edge.target + 1}_0" '
        f'executionTime="{started}" shift="{shift}"> {inner}</transition>'
    )
