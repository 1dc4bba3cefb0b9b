"""Partial-order reduction: orders of steps that cannot matter to a verdict are left out.

The steps of one rebec at one moment are a *persistent set* (Godefroid, 1996) when nothing that the
others can do before it acts disturbs them. A body sees only its own rebec, and time advances only
when nobody can act; so of a rebec that can act, nothing changes before it does, unless another that
can act at this moment sends to it, or makes somebody act at this moment who does. Its step in turn
changes nothing for the others but what is in their bags: a message for later, or one that is a
further choice, unless `@priority` puts it before others.

So one such rebec acts alone. This keeps deadlocks, failures, what ran, the fullest bags, and the
values of predicates that read of such a rebec nothing, or nothing else. Two provisos:

* No rebec is put off for ever: those that act alone end their moment, for the model has no cycle
  without time, or all that they send, and each delay, takes time.
* A full bag is what steps share besides. Where all orders together overflow a bag, so does this
  one, but what other orders reach may not be seen: after an overflow all orders are searched.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple, TypeAlias

from rebsync.checker.program import ITS_SENDER, ITSELF, NULL, UNRANKED, Instruction, Program
from rebsync.checker.standstill import may_stand_still
from rebsync.checker.steps import Semantics

_SENDS = ("SEND", "SENDBY")

_Relation: TypeAlias = Sequence[set[int]]
"""For each rebec the rebecs that it is related to."""


class Candidate(NamedTuple):
    """A rebec whose steps are a persistent set where it can act and no disturber can."""

    rebec: int
    disturbers: tuple[int, ...]


PersistentSets: TypeAlias = tuple[Candidate, ...]
"""The rebecs that may act alone, in the order in which they are asked; none: no reduction."""


def persistent_sets(program: Program, semantics: Semantics) -> PersistentSets:
    """The rebecs that may act alone, with those that can disturb each of them."""
    if semantics == "core":
        return ()  # bags are queues: a message behind another is another state
    if program.global_ranks or any(r.priority != UNRANKED for r in program.rebecs):
        return ()
    if any(server.depth for server in program.servers):
        return ()  # a message takes the place of another, also of one that could be taken now
    sends = _receivers(program, _all_sends)
    at_once = _receivers(program, _sends_at_once)
    acting = [_closure(at_once, rebec) for rebec in range(len(program.rebecs))]
    read_together = _read_together(program)
    cyclic = may_stand_still(program)
    return tuple(
        Candidate(rebec, _disturbers(rebec, sends, acting))
        for rebec in range(len(program.rebecs))
        if rebec not in read_together
        and not any(_is_ranked(program, receiver) for receiver in at_once[rebec])
        and not (cyclic and not _takes_time(program, rebec))
    )


def _disturbers(rebec: int, sends: _Relation, acting: _Relation) -> tuple[int, ...]:
    """The others that make somebody act at the same moment who sends to a rebec."""
    others = [other for other in range(len(sends)) if other != rebec]
    senders = {other for other in others if rebec in sends[other]}
    return tuple(other for other in others if senders & acting[other])


def _closure(relation: _Relation, start: int) -> set[int]:
    """What a relation leads to in any number of steps, none included."""
    found, waiting = {start}, [start]
    while waiting:
        new = relation[waiting.pop()] - found
        found |= new
        waiting += new
    return found


def _is_ranked(program: Program, rebec: int) -> bool:
    """Whether a message can come before another that arrived with it."""
    servers = {program.servers[s].priority for s in program.rebecs[rebec].dispatch if s >= 0}
    return len(servers) > 1


def _takes_time(program: Program, rebec: int) -> bool:
    """Whether all that a rebec sends arrives later, and each of its delays takes time."""
    steps = list(_steps_of(program, program.rebecs[rebec].class_name))
    delays = all(i.constants for i in steps if i.op == "DELAY")
    return delays and not any(_sends_at_once(i) for i in steps)


# --- who sends to whom


def _all_sends(instruction: Instruction) -> bool:
    return instruction.op in _SENDS


def _sends_at_once(instruction: Instruction) -> bool:
    """Whether a message may arrive at the moment in which it is sent."""
    return instruction.op in _SENDS and not instruction.constants[0]


def _receivers(program: Program, is_meant: Callable[[Instruction], bool]) -> _Relation:
    """To whom each rebec may send by the instructions that are meant.

    A sender is whoever may send to the rebec, by any instruction.
    """
    sends = [
        [i for i in _steps_of(program, r.class_name) if i.op in _SENDS] for r in program.rebecs
    ]
    found: list[set[int]] = [set() for _ in sends]
    while True:  # a sender answers those who send to it: to the least fixpoint
        before = [len(receivers) for receivers in found]
        for rebec, instructions in enumerate(sends):
            senders = {r for r, receivers in enumerate(found) if rebec in receivers}
            for instruction in instructions:
                found[rebec] |= _named(program, rebec, senders | {rebec}, instruction)
        if before == [len(receivers) for receivers in found]:
            break
    senders_of = [{s for s, to in enumerate(found) if r in to} | {r} for r in range(len(found))]
    return [
        {
            receiver
            for i in filter(is_meant, instructions)
            for receiver in _named(program, rebec, senders_of[rebec], i)
        }
        for rebec, instructions in enumerate(sends)
    ]


def _named(program: Program, rebec: int, senders: set[int], send: Instruction) -> set[int]:
    """Who may receive a message: of those that have its server."""
    named: Iterable[int]
    match send.constants[1]:
        case known if known >= 0:
            named = (program.rebecs[rebec].known[known],)
        case marks if marks == ITSELF:
            named = (rebec,)
        case marks if marks == ITS_SENDER:
            named = senders
        case _:
            named = range(len(program.rebecs))
    return {r for r in named if r != NULL and program.rebecs[r].dispatch[send.a] >= 0}


def _steps_of(program: Program, class_name: str) -> Iterator[Instruction]:
    """The instructions of a class; a constructor without delay is over before the first step."""
    constructors = {r.constructor for r in program.rebecs}
    for number, body in enumerate(program.bodies):
        code = program.code[body.entry : body.end]
        over = number in constructors and not any(i.op in ("DELAY", "CALL") for i in code)
        if body.name.startswith(f"{class_name}.") and not over:
            yield from code


# --- what is seen of a rebec


def _read_together(program: Program) -> set[int]:
    """The rebecs that some predicate reads together with others."""
    found: set[int] = set()
    for number in program.observers:
        body = program.bodies[number]
        code = program.code[body.entry : body.end]
        read = {i.a for i in code if i.op in ("STATE", "STATEAT")}
        found |= read if len(read) > 1 else set()
    return found
