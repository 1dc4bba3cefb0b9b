"""What C has found, as values of the checker."""

from __future__ import annotations

import ctypes
from collections.abc import Callable

from rebsync.checker import native
from rebsync.checker.compile_bodies import branches
from rebsync.checker.endless import CAUSES, DEPTH, WAYS, Cut
from rebsync.checker.exploration import Covered
from rebsync.checker.program import Program
from rebsync.checker.steps import Failure


def cause_of(program: Program, kind: int, pc: int, rebec: int) -> Failure | int | str:
    """What is wrong, by the numbers that C gives it."""
    match native.KINDS[kind]:
        case "deadlock":
            return "deadlock"
        case "property":
            return pc
        case failure:
            failing = program.code[pc]
            said = failure == "assertion" and failing.a >= 0
            return Failure(failure, pc, rebec, program.texts[failing.a] if said else "")


def covered(program: Program, ask: Callable[..., object]) -> Covered:
    """What ran, from three arrays that are filled when C is asked."""
    numbers = branches(program)
    served = (ctypes.c_ubyte * max(1, len(program.servers)))()
    taken = (ctypes.c_ubyte * max(1, 2 * len(numbers)))()
    largest = (ctypes.c_uint32 * len(program.rebecs))()
    ask(served, taken, largest)
    return Covered(
        frozenset(i for i in range(len(program.servers)) if served[i]),
        frozenset(
            (pc, jumps)
            for pc, n in numbers.items()
            for jumps in (False, True)
            if taken[2 * n + jumps]
        ),
        tuple(largest),
    )


def risk_of_hashes(program: Program, states: int) -> str:
    """The risk: pairs of states, times 2^-64 for each hash (Wolper & Leroy 1993)."""
    hashes = len(program.rebecs) + 2  # of local states, and to put these together
    risk = hashes * states**2 / 2**65
    return (
        "only 64 bits of each state were kept: the chance that a state was left out "
        f"is at most {risk:.1e}"
    )


def cut_of(cause: int, pc: int, outer: int, instructions: int) -> Cut:
    """The body that ended a search; it might run so many instructions."""
    name = CAUSES[cause]
    bounds = {"instructions": instructions, "calls": DEPTH, "ways": WAYS, "repeats": 0}
    return Cut(name, pc, outer, bounds[name])
