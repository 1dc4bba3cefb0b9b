"""The stack machine that runs bodies: what every instruction means.

A body runs from a message, or from the point where it was suspended, to its end, to a `delay`
that splits it (exact view), or to a failure. It changes the variables of its own rebec and makes
messages; nothing else. Arithmetic is 32-bit after C's promotions (semantics of the language: the
official compiler 2.30; where RMC 2.14 differs, see docs/semantics.md).
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from dataclasses import field
from typing import NamedTuple

from rebsync.checker.course import Course, Delayed, Moved
from rebsync.checker.endless import BUDGET, DEPTH, WAYS
from rebsync.checker.look import Look, unwatched
from rebsync.checker.program import NO_DEADLINE, NULL, Cell, Instruction, Program, RebecInfo
from rebsync.checker.running import Running
from rebsync.checker.state import Frame, Local, Message, Point
from rebsync.checker.steps import Failure, FailureKind
from rebsync.checker.values import (
    cell_of,
    divide,
    power,
    quotient,
    real,
    remainder,
    whole,
)
from rebsync.records import dataclass
from rebsync.static.constants import single, wrap

FOREVER = 2**31 - 1  # what currentMessageDeadline reads without a deadline, as in RMC


class Failed(Exception):
    """A rule of the model is broken: the step has no successor."""

    def __init__(self, failure: Failure) -> None:
        super().__init__(failure)
        self.failure = failure


class Sent(NamedTuple):
    """A message on its way; `choices` counts those made before it, `pc` is its instruction."""

    receiver: int
    message: Message
    choices: int
    pc: int


@dataclass
class Coverage:
    """What has run: servers (numbers), and branches as (instruction, whether it jumped)."""

    servers: set[int] = field(default_factory=set)
    branches: set[tuple[int, bool]] = field(default_factory=set)


@dataclass
class Machine(Running):
    """One run of one body; `choices` are the options to take, beyond them the first ones.

    `room` is how many messages the rebec may still send to itself, `budget` how many instructions
    the body may run. After the run `options` has
    the number of options of each choice that was evaluated, `picked` its instruction, `choices`
    the option taken. `elapsed` is the time that delays took (floating view). `delayed` is the
    delay at which the body was suspended (exact view), or None when it ended. `course` has its
    delays, and its moves if the program has them.
    """

    program: Program
    rebec: RebecInfo
    index: int
    variables: list[Cell]
    message: Message
    clock: int
    choices: list[int]
    splits: bool
    room: int
    coverage: Coverage = field(default_factory=Coverage)
    states: tuple[Local, ...] = ()
    pc: int = 0
    base: int = 0
    elapsed: int = 0
    stack: list[Cell] = field(default_factory=list)
    frames: list[tuple[int, int]] = field(default_factory=list)
    options: list[int] = field(default_factory=list)
    picked: list[int] = field(default_factory=list)
    sends: list[Sent] = field(default_factory=list)
    course: list[Course] = field(default_factory=list)
    running: bool = True
    delayed: int | None = None
    look: Look = unwatched
    budget: int = BUDGET

    def start(self, body: int, arguments: tuple[Cell, ...]) -> None:
        """Runs a body from its beginning."""
        entered = self.program.bodies[body]
        self.pc = entered.entry
        self.stack = [*arguments, *[0] * (entered.frame - len(arguments))]
        self.run(_OPERATIONS)

    def resume(self, point: Point) -> None:
        """Runs a suspended body from where it stopped."""
        for position, frame in enumerate(point.frames):
            self.base = len(self.stack)
            live = self.program.code[frame.pc - 1].b
            size = self.program.body_at(frame.pc - 1).frame
            self.stack += [*frame.cells[:live], *[0] * (size - live), *frame.cells[live:]]
            if position < len(point.frames) - 1:
                self.frames.append((frame.pc, self.base))
            self.pc = frame.pc
        self.run(_OPERATIONS)

    def suspended(self) -> Point:
        """Where the body goes on after the delay that has split it."""
        places = [*self.frames, (self.pc, self.base)]
        ends = [base for _, base in places[1:]] + [len(self.stack)]
        return Point(
            self.message,
            tuple(self._frame(pc, base, end) for (pc, base), end in zip(places, ends, strict=True)),
        )

    def _frame(self, pc: int, base: int, end: int) -> Frame:
        """The cells that still matter: variables in scope, and operands."""
        live = self.program.code[pc - 1].b
        operands = base + self.program.body_at(pc - 1).frame
        return Frame(pc, (*self.stack[base : base + live], *self.stack[operands:end]))

    def fail(self, kind: FailureKind, text: str = "") -> Failed:
        """The failure of the instruction that runs."""
        return Failed(Failure(kind, self.pc - 1, self.index, text))

    def choose(self, count: int) -> int:
        """The option of the next choice."""
        position = len(self.options)
        if position == WAYS:
            raise self.endless("ways", self.pc - 1, WAYS)
        self.options.append(count)
        self.picked.append(self.pc - 1)
        if position == len(self.choices):
            self.choices.append(0)
        return self.choices[position]

    def place(self, index: int, length: int, stride: int) -> int:
        """The offset of an element; failure `index` outside of the array."""
        if not 0 <= index < length:
            raise self.fail("index")
        return index * stride

    def call(self, i: Instruction) -> None:
        """The arguments on the stack become the first cells of the frame of body `a`."""
        body = self.program.bodies[i.a]
        count = sum(p.size for p in body.parameters)
        self.frames.append((self.pc, self.base))
        if len(self.frames) > DEPTH:
            raise self.endless("calls", self.pc - 1, DEPTH)
        self.base = len(self.stack) - count
        self.stack += [0] * (body.frame - count)
        self.pc = body.entry

    def leave(self, results: int) -> None:
        """The frame goes, its results stay; at the outermost frame the run is over."""
        values = self.stack[len(self.stack) - results :]
        self.stack[self.base :] = values
        if self.frames:
            self.pc, self.base = self.frames.pop()
        else:
            self.running = False

    def send(self, i: Instruction, deadline: int | None) -> None:
        """Puts a message on its way: receiver, `b` cells of arguments, after (, deadline)."""
        after = self.stack.pop()
        cut = len(self.stack) - i.b
        arguments = tuple(self.stack[cut:])
        receiver = self.stack[cut - 1]
        del self.stack[cut - 1 :]
        server = self.program.rebecs[receiver].dispatch[i.a] if receiver != NULL else -1
        if server < 0:
            raise self.fail("null")
        if after < 0:
            raise self.fail("time")
        due = NO_DEADLINE if deadline is None else self.elapsed + deadline
        message = Message(self.elapsed + after, server, self.index, due, arguments)
        if receiver == self.index:
            if self.room == 0:
                raise self.fail("overflow")
            self.room -= 1
        if len(self.sends) > self.program.places:  # one of them is too many for its receiver
            raise self.fail("overflow")
        self.sends.append(Sent(receiver, message, len(self.options), self.pc - 1))

    def delay(self) -> None:
        """Time passes for this rebec: within the body, or the body is split here."""
        time = self.stack.pop()
        if time < 0:
            raise self.fail("time")
        self.course.append(Delayed(self.elapsed, len(self.sends), time, self.pc - 1))
        if self.splits:
            self.delayed, self.running = time, False
        else:
            self.elapsed += time

    def move(self, i: Instruction) -> None:
        """Pops a robot's offsets along X and Y; unless `a`, there are none: they are not known."""
        y, x = (self.stack.pop(), self.stack.pop()) if i.a else (None, None)
        self.course.append(Moved(self.elapsed, len(self.sends), x, y))

    def branch(self, i: Instruction, when: bool) -> None:
        """Jumps to `a` if the operand is `when`; `b` is 1 where no branch of the model is meant."""
        jumps = bool(self.stack.pop()) is when
        if not i.b:
            self.coverage.branches.add((self.pc - 1, jumps))
        if jumps:
            self.pc = i.a

    def jump(self, i: Instruction) -> None:
        """Goes on at `a`."""
        self.pc = i.a

    def put(self, cells: list[Cell], place: int) -> None:
        """Pops a value, and stores it."""
        cells[place] = self.stack.pop()

    def put_at(self, cells: list[Cell], start: int) -> None:
        """Pops a value and the offset that was pushed before it, and stores the value."""
        value = self.stack.pop()
        cells[start + self.stack.pop()] = value

    def check(self, i: Instruction) -> None:
        """Pops the condition of an assertion with text `a` (-1: none)."""
        if not self.stack.pop():
            raise self.fail("assertion", self.program.texts[i.a] if i.a >= 0 else "")

    def deadline(self) -> int:
        """What currentMessageDeadline reads."""
        due = self.message.deadline
        return FOREVER if due == NO_DEADLINE else wrap(self.clock + due)


Operation = Callable[[Machine, Instruction], None]


def _push(value: Callable[[Machine, Instruction], Cell]) -> Operation:
    return lambda m, i: m.stack.append(value(m, i))


def _unary(compute: Callable[[Cell], Cell]) -> Operation:
    def operation(m: Machine, i: Instruction) -> None:
        m.stack.append(compute(m.stack.pop()))

    return operation


def _binary(compute: Callable[[Cell, Cell], Cell]) -> Operation:
    def operation(m: Machine, i: Instruction) -> None:
        right = m.stack.pop()
        m.stack.append(compute(m.stack.pop(), right))

    return operation


def _dividing(compute: Callable[[Cell, Cell], Cell]) -> Operation:
    def operation(m: Machine, i: Instruction) -> None:
        right = m.stack.pop()
        if right == 0:
            raise m.fail("division")
        m.stack.append(compute(m.stack.pop(), right))

    return operation


def _reals(compute: Callable[[float, float], float]) -> Operation:
    return _binary(lambda a, b: cell_of(compute(real(a), real(b))))


def _compare(compare: Callable[[float, float], bool]) -> Operation:
    return _binary(lambda a, b: int(compare(real(a), real(b))))


_MOVES: dict[str, Operation] = {
    "CONST": _push(lambda m, i: i.a),
    "VAR": _push(lambda m, i: m.variables[i.a]),
    "VARAT": _push(lambda m, i: m.variables[i.a + m.stack.pop()]),
    "LOCAL": _push(lambda m, i: m.stack[m.base + i.a]),
    "LOCALAT": _push(lambda m, i: m.stack[m.base + i.a + m.stack.pop()]),
    "STATE": _push(lambda m, i: m.states[i.a].variables[i.b]),
    "STATEAT": _push(lambda m, i: m.states[i.a].variables[i.b + m.stack.pop()]),
    "SETVAR": lambda m, i: m.put(m.variables, i.a),
    "SETVARAT": lambda m, i: m.put_at(m.variables, i.a),
    "SETLOCAL": lambda m, i: m.put(m.stack, m.base + i.a),
    "SETLOCALAT": lambda m, i: m.put_at(m.stack, m.base + i.a),
    "TABLE": _push(lambda m, i: i.constants[m.stack.pop()]),
    "OFFSET": _push(lambda m, i: m.place(m.stack.pop(), i.a, i.b)),
    "POP": lambda m, i: m.stack.__delitem__(-1),
    "KNOWN": _push(lambda m, i: m.rebec.known[i.a]),
    "SELF": _push(lambda m, i: m.index),
    "SENDER": _push(lambda m, i: m.message.sender),
    "NOW": _push(lambda m, i: wrap(m.clock + m.elapsed)),
    "ARRIVAL": _push(lambda m, i: wrap(m.clock + m.message.arrival)),
    "DEADLINE": _push(lambda m, i: m.deadline()),
    "WAITING": _push(lambda m, i: wrap(m.elapsed - m.message.arrival)),
    "CHOICE": _push(lambda m, i: i.constants[m.choose(len(i.constants))]),
}

_CONTROL: dict[str, Operation] = {
    "JUMP": Machine.jump,
    "JUMPF": lambda m, i: m.branch(i, False),
    "JUMPT": lambda m, i: m.branch(i, True),
    "CALL": Machine.call,
    "RET": lambda m, i: m.leave(i.a),
    "SEND": lambda m, i: m.send(i, None),
    "SENDBY": lambda m, i: m.send(i, m.stack.pop()),
    "DELAY": lambda m, i: m.delay(),
    "MOVE": Machine.move,
    "ASSERT": Machine.check,
}

_ARITHMETIC: dict[str, Operation] = {
    "ADD": _binary(lambda a, b: wrap(a + b)),
    "SUB": _binary(lambda a, b: wrap(a - b)),
    "MUL": _binary(lambda a, b: wrap(a * b)),
    "DIV": _dividing(divide),
    "MOD": _dividing(remainder),
    "AND": _binary(operator.and_),
    "OR": _binary(operator.or_),
    "XOR": _binary(operator.xor),
    "SHL": _binary(lambda a, b: wrap(a << (b & 31))),
    "SHR": _binary(lambda a, b: a >> (b & 31)),
    "NEG": _unary(lambda a: wrap(-a)),
    "INV": _unary(lambda a: ~a),
    "NOT": _unary(lambda a: int(not a)),
    "EQ": _binary(lambda a, b: int(a == b)),
    "NE": _binary(lambda a, b: int(a != b)),
    "LT": _binary(lambda a, b: int(a < b)),
    "LE": _binary(lambda a, b: int(a <= b)),
    "GT": _binary(lambda a, b: int(a > b)),
    "GE": _binary(lambda a, b: int(a >= b)),
    "BYTE": _unary(lambda a: wrap(a, 8)),
    "SHORT": _unary(lambda a: wrap(a, 16)),
}

_REAL: dict[str, Operation] = {
    "FADD": _reals(operator.add),
    "FSUB": _reals(operator.sub),
    "FMUL": _reals(operator.mul),
    "FDIV": _reals(quotient),
    "POW": _reals(power),
    "SQRT": _unary(lambda a: cell_of(math.sqrt(real(a)) if real(a) >= 0 else math.nan)),
    "FNEG": _unary(lambda a: cell_of(-real(a))),
    "FEQ": _compare(operator.eq),
    "FNE": _compare(operator.ne),
    "FLT": _compare(operator.lt),
    "FLE": _compare(operator.le),
    "FGT": _compare(operator.gt),
    "FGE": _compare(operator.ge),
    "REAL": _unary(lambda a: cell_of(float(a))),
    "WHOLE": _unary(lambda a: whole(real(a))),
    "SINGLE": _unary(lambda a: cell_of(single(real(a)))),
    "IS": lambda m, i: m.stack.append(int(_class_of(m) in i.constants)),
}


def _class_of(m: Machine) -> int:
    rebec = m.stack.pop()
    return m.program.rebecs[rebec].class_index if rebec != NULL else -1


_OPERATIONS: dict[str, Operation] = {**_MOVES, **_CONTROL, **_ARITHMETIC, **_REAL}
