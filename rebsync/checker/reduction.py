"""Partial-order reduction: orders of steps that cannot matter to the verdict are left out.

A rebec is *self-driven* when only it sends messages to itself, and all that it sends, to anybody,
arrives later than now. What it does at a moment then neither depends on what others do at that
moment, nor changes what they can take; and since time advances only when nobody can act, it acts
at that moment on every run. So where a self-driven rebec can act without failing, its steps alone
are a persistent set (Godefroid, 1996): exploring them first keeps deadlocks, failures and the
values of properties that do not read its variables. A step of it makes only messages for later, so
it cannot put off the others for ever.

A full bag is the one thing that such a step shares with others: acting first takes the place
first. An overflow of that bag is then found on this order if it is found on any, but what comes
after another order that avoids it may not be seen: the verdict is kept, not every violation.
"""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.checker.program import UNRANKED, Instruction, Program

_SENDS = ("SEND", "SENDBY")


def self_driven(program: Program) -> frozenset[int]:
    """The rebecs that act by themselves and that no predicate reads."""
    if program.global_ranks or any(r.priority != UNRANKED for r in program.rebecs):
        return frozenset()
    read = set(_read_by_predicates(program))
    reached = {
        i.a for r in program.rebecs for i in _steps_of(program, r.class_name) if _to_others(i)
    }
    found = set()
    for index, rebec in enumerate(program.rebecs):
        answers = {selector for selector, server in enumerate(rebec.dispatch) if server >= 0}
        steps = tuple(_steps_of(program, rebec.class_name))
        if index not in read and not answers & reached and all(_is_for_later(i) for i in steps):
            found.add(index)
    return frozenset(found)


def _to_others(instruction: Instruction) -> bool:
    return instruction.op in _SENDS and not instruction.constants[1]


def _is_for_later(instruction: Instruction) -> bool:
    """Whether an instruction does nothing that others could notice at this moment."""
    if instruction.op in _SENDS:
        return bool(instruction.constants[0])
    return instruction.op != "DELAY" or bool(instruction.constants)


def _steps_of(program: Program, class_name: str) -> Iterator[Instruction]:
    """The instructions of a class; a constructor without delay is over before the first step."""
    constructors = {r.constructor for r in program.rebecs}
    for number, body in enumerate(program.bodies):
        code = program.code[body.entry : body.end]
        over = number in constructors and not any(i.op in ("DELAY", "CALL") for i in code)
        if body.name.startswith(f"{class_name}.") and not over:
            yield from code


def _read_by_predicates(program: Program) -> Iterator[int]:
    for number in program.observers:
        body = program.bodies[number]
        for instruction in program.code[body.entry : body.end]:
            if instruction.op in ("STATE", "STATEAT"):
                yield instruction.a
