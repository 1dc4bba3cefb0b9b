"""Running the instructions of a body, until it ends or is given up."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, TypeAlias

from rebsync.checker.endless import SHARE, WATCHED, Cause, Cut, EndlessBody
from rebsync.checker.look import Look
from rebsync.checker.program import Cell, Program

Operations: TypeAlias = Mapping[str, Callable[..., None]]

_GLANCE = 10_000  # instructions between two looks at the bounds


class _State(NamedTuple):
    """With the instruction all that decides how a body goes on; the figures only grow."""

    figures: tuple[int, int, int]  # choices, messages, time
    frames: list[tuple[int, int]]
    stack: list[Cell]
    variables: list[Cell]

    def is_that_of(self, m: Running) -> bool:
        """Whether a machine will go on as it did from here; it is at the same instruction."""
        return (
            self.stack == m.stack
            and self.variables == m.variables
            and self.frames == m.frames
            and self.figures == (len(m.options), len(m.sends), m.elapsed)
        )


class Running:
    """A run of a body, as far as it takes to go on with it; `budget` are its instructions."""

    program: Program
    pc: int
    running: bool
    budget: int
    look: Look
    frames: list[tuple[int, int]]
    stack: list[Cell]
    variables: list[Cell]
    options: list[int]
    sends: list[Any]  # of Sent, which is defined above this
    elapsed: int

    def run(self, operations: Operations) -> None:
        """Runs to the end. After a while, windows look whether it all repeats."""
        done, window = 0, WATCHED
        while self.running and done < self.budget:
            if done < window:
                count = min(_GLANCE, self.budget - done, window - done)
                self._go_on(count, operations)
            else:
                count = min(done // SHARE, self.budget - done)
                self._compare(count, operations)
                window = 2 * done
            done += count
            self.look()
        if self.running:
            raise self.endless("instructions", self.pc, self.budget)

    def _go_on(self, count: int, operations: Operations) -> None:
        """Runs so many instructions, or to the end."""
        code = self.program.code
        for _ in range(count):
            instruction = code[self.pc]
            self.pc += 1
            operations[instruction.op](self, instruction)
            if not self.running:
                return

    def _compare(self, count: int, operations: Operations) -> None:
        """The same, and raises EndlessBody when the state comes back to what it is now."""
        before, start = self._state(), self.pc
        depth, head = len(self.frames), self.pc
        code = self.program.code
        for done in range(count):
            instruction = code[self.pc]
            self.pc += 1
            operations[instruction.op](self, instruction)
            if not self.running:
                return
            if len(self.frames) < depth or (self.pc < head and len(self.frames) == depth):
                depth, head = len(self.frames), self.pc
            if self.pc == start and before.is_that_of(self):
                raise self.endless("repeats", head, 0)
            if done % _GLANCE == 0:
                self.look()

    def _state(self) -> _State:
        figures = len(self.options), len(self.sends), self.elapsed
        return _State(figures, [*self.frames], [*self.stack], [*self.variables])

    def endless(self, cause: Cause, pc: int, bound: int) -> EndlessBody:
        """That the body is given up."""
        outer = self.frames[0][0] - 1 if self.frames else pc
        return EndlessBody(Cut(cause, pc, outer, bound))
