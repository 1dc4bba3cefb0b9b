"""Which cells of a state hold rebecs: what a permutation of the rebecs has to rename.

Of variables and parameters their types say so. Of the frames of suspended bodies it follows from a
forward data flow analysis over the instructions: the abstract value of a cell is NUMBER, REBEC, or
EMPTY for -1, which is null as well as a number; where paths meet that disagree it is MIXED.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeAlias

from rebsync.checker.compile_bodies import stack_change
from rebsync.checker.program import NULL, Body, Instruction, Program, Slot
from rebsync.records import dataclass

EMPTY, NUMBER, REBEC, MIXED = range(4)

_Cells: TypeAlias = tuple[int, ...]
_Frame: TypeAlias = tuple[_Cells, _Cells]
"""The abstract values of the cells of a frame, and of the operands above it."""

_STORES = ("SETVAR", "SETVARAT", "SETLOCAL", "SETLOCALAT", "POP", "JUMPF", "JUMPT", "DELAY")
_NO_RESULT = (*_STORES, "ASSERT", "SEND", "SENDBY", "JUMP", "RET", "MOVE")


@dataclass(frozen=True, slots=True)
class References:
    """The cells that hold rebecs: of the variables of each rebec, the arguments of each server,
    and the suspended frames that go on at an instruction.

    `mixed` are the bodies that keep over a delay what may be a rebec or a number.
    """

    variables: tuple[_Cells, ...]
    arguments: tuple[_Cells, ...]
    frames: dict[int, _Cells]
    mixed: tuple[str, ...]


def references_of(program: Program) -> References:
    """All of a program."""
    frames: dict[int, _Cells] = {}
    mixed: dict[str, None] = {}
    for pc, (cells, operands) in _suspensions(program):
        kept = (*cells[: program.code[pc].b], *operands)
        if MIXED in kept:
            mixed[program.body_at(pc).name] = None
        frames[pc + 1] = tuple(at for at, each in enumerate(kept) if each == REBEC)
    return References(
        tuple(_rebec_cells(rebec.state) for rebec in program.rebecs),
        tuple(_rebec_cells(program.bodies[s.body].parameters) for s in program.servers),
        frames,
        tuple(mixed),
    )


def _rebec_cells(slots: Iterable[Slot]) -> _Cells:
    return tuple(s.offset + i for s in slots if s.kind == "rebec" for i in range(s.size))


def _suspensions(program: Program) -> Iterator[tuple[int, _Frame]]:
    """The frames as they are kept at each delay, and call of what may delay, without arguments."""
    calls = [
        {i.a for i in program.code[body.entry : body.end] if i.op == "CALL"}
        for body in program.bodies
    ]
    suspended = {
        number
        for number, body in enumerate(program.bodies)
        if any(i.op == "DELAY" for i in program.code[body.entry : body.end])
    }
    while callers := {n for n, called in enumerate(calls) if called & suspended} - suspended:
        suspended |= callers
    analysed = set(suspended)
    while called := {callee for number in analysed for callee in calls[number]} - analysed:
        analysed |= called
    results: dict[int, _Cells] = {}
    while True:
        flows = {number: _Flow(program, program.bodies[number], results) for number in analysed}
        found = {number: flow.result for number, flow in flows.items()}
        if found == results:
            break
        results = found
    for number in sorted(suspended):
        for pc, (cells, operands) in flows[number].before.items():
            i = program.code[pc]
            if i.op == "DELAY" or (i.op == "CALL" and i.a in suspended):
                taken = 1 if i.op == "DELAY" else flows[number].arguments(i.a)
                yield pc, (cells, operands[: len(operands) - taken])


def _join(one: int, other: int) -> int:
    if EMPTY in (one, other) or one == other:
        return max(one, other)
    return MIXED


class _Flow:
    """The abstract values before each instruction of one body, and those of its `result`.

    `results` are those of all bodies as far as they are known.
    """

    def __init__(self, program: Program, body: Body, results: dict[int, _Cells]) -> None:
        self.program = program
        self.results = results
        self.before: dict[int, _Frame] = {}
        self.result: _Cells = ()
        rebecs = _rebec_cells(body.parameters)
        frame = tuple(REBEC if at in rebecs else NUMBER for at in range(body.frame))
        self.variables = self._variables(body)
        waiting: list[tuple[int, _Frame]] = [(body.entry, (frame, ()))]
        while waiting:
            pc, reached = waiting.pop()
            joined = self._joined(self.before.get(pc), reached)
            if joined != self.before.get(pc):
                self.before[pc] = joined
                waiting += self._after(pc, *joined)

    def arguments(self, body: int) -> int:
        """How many cells a body is called with."""
        return sum(p.size for p in self.program.bodies[body].parameters)

    def _variables(self, body: Body) -> _Cells:
        """The variables that hold rebecs in the class that runs the body."""
        name = body.name.partition(".")[0]
        return next(
            (_rebec_cells(r.state) for r in self.program.rebecs if r.class_name == name), ()
        )

    def _joined(self, known: _Frame | None, reached: _Frame) -> _Frame:
        if known is None or known == reached:
            return reached
        cells, operands = (tuple(map(_join, *both)) for both in zip(known, reached, strict=True))
        return cells, operands

    def _after(self, pc: int, cells: _Cells, operands: _Cells) -> Iterator[tuple[int, _Frame]]:
        """Where an instruction leads to, with the frame that it leaves."""
        i = self.program.code[pc]
        if i.op == "RET":
            found = operands[len(operands) - i.a :]
            self.result = tuple(map(_join, self.result, found)) if self.result else found
            return
        depth = len(operands) + stack_change(self.program, i)
        if i.op == "CALL":
            made = self._results(i.a)
        else:
            made = () if i.op in _NO_RESULT else (self._made(i, cells, operands),)
        if i.op in ("SETLOCAL", "SETLOCALAT"):
            cells = self._stored(i, cells, operands[-1])
        frame = cells, (*operands[: depth - len(made)], *made)
        if i.op in ("JUMP", "JUMPF", "JUMPT"):
            yield i.a, frame
        if i.op != "JUMP":
            yield pc + 1, frame

    def _results(self, body: int) -> _Cells:
        called = self.program.bodies[body]
        code = self.program.code[called.entry : called.end]
        count = next(i.a for i in reversed(code) if i.op == "RET")
        return self.results.get(body) or (EMPTY,) * count

    def _made(self, i: Instruction, cells: _Cells, operands: _Cells) -> int:
        match i.op:
            case "KNOWN" | "SELF" | "SENDER":
                return REBEC
            case "CONST" if i.a == NULL:
                return EMPTY
            case "VAR" | "VARAT":
                return REBEC if i.a in self.variables else NUMBER
            case "LOCAL":
                return cells[i.a]
            case "LOCALAT":
                return MIXED if REBEC in cells[i.a :] or MIXED in cells[i.a :] else NUMBER
            case _:
                return NUMBER

    def _stored(self, i: Instruction, cells: _Cells, value: int) -> _Cells:
        if i.op == "SETLOCAL":
            return (*cells[: i.a], value, *cells[i.a + 1 :])
        return (*cells[: i.a], *(_join(each, value) for each in cells[i.a :]))
