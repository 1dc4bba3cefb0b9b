"""Bodies that are given up: why, and what was running.

That a body never ends is proved by its local state: when all that it runs on comes back to what it
was, and nothing was chosen or sent in between, it goes on so for ever. The state is compared in
windows that grow with the run (Brent: "An improved Monte Carlo factorization algorithm", 1980).
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from rebsync.checker.program import Program
from rebsync.records import dataclass
from rebsync.source import Source
from rebsync.unions import assert_never

BUDGET = 10_000_000  # instructions of one body, where no search has a bound of its own
DEPTH = 10_000  # frames
WAYS = 2**20  # ways to choose in one run of a body
WATCHED = 2**20  # instructions before the first window of comparisons
SHARE = 8  # of the instructions so far, one part in so many is the next window

Cause: TypeAlias = Literal["repeats", "instructions", "calls", "ways"]
CAUSES: tuple[Cause, ...] = ("repeats", "instructions", "calls", "ways")


@dataclass(frozen=True, slots=True)
class Cut:
    """Where a body was given up: `pc` was running, called from `outer` in the body of the server.

    Of one that repeats, `pc` is the head of its outermost loop. `bound` is what it has reached.
    """

    cause: Cause
    pc: int
    outer: int
    bound: int = 0


class EndlessBody(Exception):
    """A body never ends, or reaches a bound."""

    def __init__(self, cut: Cut) -> None:
        super().__init__(cut)
        self.cut = cut
        self.pc = cut.pc


def endless_reason(program: Program, cut: Cut, source: Source | None = None) -> str:
    """Why a search ends at a body that does not; with a line if the text of the model is known."""
    body, running = program.body_at(cut.outer).name, program.body_at(cut.pc).name
    place = ""
    if source is not None:
        place = f" at line {source.position(program.spans[cut.pc].start).line}"
    if running != body:
        place = f" in {running}{place}"
    begun = f"the body of {body} did not end"
    match cut.cause:
        case "repeats":
            return f"{begun}, and never does: a loop{place} comes back to the same values"
        case "instructions":
            return f"{begun} within {cut.bound:,} instructions: it was running{place}"
        case "calls":
            return f"{begun} within {cut.bound:,} calls inside each other: it was running{place}"
        case "ways":
            return f"{begun} within {cut.bound:,} ways to choose"
        case _:
            assert_never(cut.cause)
