"""Lines of a model that no search ever ran."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from rebsync.checker.exploration import Covered
from rebsync.checker.program import Program
from rebsync.source import NOWHERE, Source


def silent_lines(program: Program, covered: Covered, source: Source) -> tuple[int, ...]:
    """The lines with code of which nothing ran; constructors run in any case.

    What follows something that failed counts as run when a branch of it would have been.
    """
    bodies = {program.servers[number].body for number in covered.servers}
    bodies |= {rebec.constructor for rebec in program.rebecs if rebec.constructor >= 0}
    entries = [program.bodies[number].entry for number in bodies]
    reached = reached_from(program, entries, covered.branches)
    code, ran = set(), set()
    for number, body in enumerate(program.bodies):
        if number in program.observers:
            continue
        for pc in range(body.entry, body.end):
            if program.spans[pc] != NOWHERE:
                line = source.position(program.spans[pc].start).line
                code.add(line)
                if pc in reached:
                    ran.add(line)
    return tuple(sorted(code - ran))


def reached_from(
    program: Program, starts: Iterable[int], branches: Collection[tuple[int, bool]]
) -> set[int]:
    """The instructions that are reached from some when branches go only where they went."""
    waiting = list(starts)
    reached: set[int] = set()
    while waiting:
        pc = waiting.pop()
        if pc not in reached:
            reached.add(pc)
            waiting += _followers(program, branches, pc)
    return reached


def _followers(program: Program, branches: Collection[tuple[int, bool]], pc: int) -> Iterator[int]:
    """Where a body may go on after an instruction."""
    instruction = program.code[pc]
    match instruction.op:
        case "RET":
            return
        case "JUMP":
            yield instruction.a
        case "JUMPF" | "JUMPT":
            for jumps, there in ((True, instruction.a), (False, pc + 1)):
                if instruction.b or (pc, jumps) in branches:
                    yield there
        case "CALL":
            yield program.bodies[instruction.a].entry
            yield pc + 1
        case _:
            yield pc + 1
