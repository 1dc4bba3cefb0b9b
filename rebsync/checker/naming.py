"""Names of what went wrong, and of what never ran."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.checker.exploration import Covered
from rebsync.checker.program import Body, Program
from rebsync.checker.reached import silent_lines
from rebsync.checker.result import Coverage
from rebsync.checker.steps import Failure
from rebsync.source import Source


def event_name(failure: Failure, body: Body, line: int, program: Program) -> str:
    """What a failure is called: a rebec, a rebec's server, a text, or `Class.server:line`."""
    match failure.kind:
        case "overflow":
            return program.rebecs[failure.rebec].name
        case "deadline":
            return f"{program.rebecs[failure.rebec].name}.{body.name.split('.')[-1]}"
        case "assertion" if failure.text:
            return failure.text
        case _:
            return f"{body.name}:{line}"


def coverage_of(program: Program, covered: Covered, source: Source) -> Coverage:
    """What the search never ran, and how full the bags became.

    A class inherits code: a server or branch counts as run when any class has run it.
    """
    places = {program.servers[n].span for n in covered.servers}
    silent = dict.fromkeys(
        f"{server.class_name}.{server.name}"
        for number, server in enumerate(program.servers)
        if number not in covered.servers and server.span not in places
    )
    rebecs = zip(program.rebecs, covered.largest, strict=True)
    return Coverage(
        tuple(silent),
        tuple(dict.fromkeys(_branches(program, covered, source))),
        tuple((rebec.name, most, rebec.capacity) for rebec, most in rebecs),
        silent_lines(program, covered, source),
    )


def _branches(program: Program, covered: Covered, source: Source) -> Iterator[tuple[int, str]]:
    """Conditions that never had one of their values, and cases that were never entered."""
    ran = {(program.spans[pc], jumped) for pc, jumped in covered.branches}
    reached = {span for span, _ in ran}
    places = []
    for pc, instruction in enumerate(program.code):
        span = program.spans[pc]
        if instruction.b or span not in reached:
            continue
        if instruction.op == "JUMPF":
            places += [(span, s) for j, s in _NEVER if (span, j) not in ran]
        elif instruction.op == "JUMPT" and (span, True) not in ran:
            places.append((span, "case never entered"))
    for span, said in sorted(places, key=lambda p: p[0].start):
        yield source.position(span.start).line, said


_NEVER = ((False, "condition never true"), (True, "condition never false"))
