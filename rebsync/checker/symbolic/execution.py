"""Symbolic execution of one body (King, 1976): what it does on one path, in terms of its inputs.

Which way it goes where a condition is not known, `decide` says. What others can see of a path is
its `events`, in their order, and the variables after it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import field
from typing import TypeAlias, cast

from rebsync.checker.program import Instruction, Kind, Program, Slot
from rebsync.checker.symbolic import terms
from rebsync.checker.symbolic.terms import Condition, Term
from rebsync.records import dataclass

DEPTH = 50  # calls within one another
BUDGET = 10_000  # instructions of one path


class Unproved(Exception):
    """It cannot be told: the text says why."""


@dataclass(frozen=True, slots=True)
class Event:
    """Something that others can see: what it is, by its name in both models, and the terms in it.

    A send has the server for each receiver; a failure its kind; a choice its options.
    """

    what: tuple[object, ...]
    terms: tuple[Term, ...] = ()


Decide: TypeAlias = Callable[[Condition], bool]
"""Which way a condition goes on this path."""

Choose: TypeAlias = Callable[[int, tuple[int, ...]], Term]
"""What the choice of a number among some options gives on this path."""


@dataclass(frozen=True, slots=True)
class Names:
    """What a program's numbers stand for, alike in two programs that are compared.

    `state` are the variables of the rebec; `known` the terms of its known rebecs.
    """

    state: tuple[Slot, ...]
    known: tuple[Term, ...]
    selectors: Callable[[int], tuple[object, ...]]
    classes: Callable[[tuple[int, ...]], tuple[str, ...]]


@dataclass
class Execution:
    """One path through a body."""

    program: Program
    names: Names
    variables: list[Term]
    decide: Decide
    choose: Choose
    events: list[Event] = field(default_factory=list)
    stack: list[Term] = field(default_factory=list)
    frames: list[tuple[int, int, int]] = field(default_factory=list)
    pc: int = 0
    base: int = 0
    body: int = 0
    choices: int = 0
    elapsed: Term = 0
    is_running: bool = True
    steps: int = 0

    def run(self, body: int, arguments: tuple[Term, ...]) -> None:
        """Runs to the end of the body, or to what fails. Unproved: that takes too long."""
        entered = self.program.bodies[body]
        self.pc, self.body = entered.entry, body
        self.stack = [*arguments, *[0] * (entered.frame - len(arguments))]
        for self.steps in range(1, BUDGET + 1):
            instruction = self.program.code[self.pc]
            self.pc += 1
            self._step(instruction)
            if not self.is_running:
                return
        raise Unproved("a body is too long, or does not end")

    def _step(self, i: Instruction) -> None:
        if i.op in terms.ARITIES:
            self._compute(i.op)
        elif i.op in _PUSHED:
            self.stack.append(_PUSHED[i.op](self, i))
        elif i.op in _DONE:
            _DONE[i.op](self, i)
        else:
            raise Unproved(f"{i.op} has no terms")

    def _compute(self, op: str) -> None:
        operands = self.pop(terms.ARITIES[op])
        if op in ("DIV", "MOD") and not self.decide(terms.is_true(operands[1])):
            self.fail("division")
            return
        self.stack.append(terms.computed(op, *operands))

    def pop(self, count: int) -> list[Term]:
        """The topmost operands, the lowest first."""
        cut = len(self.stack) - count
        found = self.stack[cut:]
        del self.stack[cut:]
        return found

    def fail(self, kind: str) -> None:
        """Ends the path."""
        self.events.append(Event(("fails", kind)))
        self.is_running = False

    # --- cells ----------------------------------------------------------------------------------

    def constant(self, mark: int, element: str = "") -> Term:
        """A constant of the model: whatever its value is, both models have the same."""
        kind, _, name = self.program.texts[mark - 1].partition(" ")
        return terms.symbol(f"env {name}{element}", cast("Kind", kind))

    def table(self, i: Instruction) -> Term:
        """An element of a constant of the model."""
        cells: Sequence[Term] = i.constants
        if i.a:
            places = range(i.b, i.b + len(cells))
            cells = [self.constant(i.a, f"[{place}]") for place in places]
        return terms.element(cells, self.stack.pop())

    def whole(self, start: int) -> tuple[int, int]:
        """Where the variable begins and ends that a cell is of."""
        slot = next(s for s in self.names.state if s.offset <= start < s.offset + s.size)
        return slot.offset, slot.offset + slot.size

    def variable_at(self, i: Instruction) -> Term:
        """The element of a state variable, by the offset on the stack."""
        _, end = self.whole(i.a)
        return terms.element(self.variables[i.a : end], self.stack.pop())

    def local_at(self, i: Instruction) -> Term:
        """The element of a local variable, by the offset on the stack."""
        return terms.element(self._locals(i.a), self.stack.pop())

    def _locals(self, start: int) -> list[Term]:
        """The cells that an element may be: where the variable ends is not known."""
        frame = self.program.bodies[self.body].frame
        return self.stack[self.base + start : self.base + frame]

    def set_variable_at(self, i: Instruction) -> None:
        """Stores into an element of a state variable."""
        offset, value = self.pop(2)
        _, end = self.whole(i.a)
        self.variables[i.a : end] = terms.stored_at(self.variables[i.a : end], offset, value)

    def set_local_at(self, i: Instruction) -> None:
        """Stores into an element of a local variable."""
        offset, value = self.pop(2)
        cells = terms.stored_at(self._locals(i.a), offset, value)
        start = self.base + i.a
        self.stack[start : start + len(cells)] = cells

    def offset(self, i: Instruction) -> None:
        """The offset of an element; failure `index` outside of the array."""
        (index,) = self.pop(1)
        inside = terms.is_true(
            terms.computed("AND", terms.computed("GE", index, 0), terms.computed("LT", index, i.a))
        )
        if self.decide(inside):
            self.stack.append(terms.computed("MUL", index, i.b))
        else:
            self.fail("index")

    # --- control --------------------------------------------------------------------------------

    def call(self, i: Instruction) -> None:
        """The arguments on the stack become the first cells of the frame of body `a`."""
        body = self.program.bodies[i.a]
        count = sum(p.size for p in body.parameters)
        self.frames.append((self.pc, self.base, self.body))
        if len(self.frames) > DEPTH:
            raise Unproved("calls are too deep")
        self.base = len(self.stack) - count
        self.stack += [0] * (body.frame - count)
        self.pc, self.body = body.entry, i.a

    def leave(self, results: int) -> None:
        """The frame goes, its results stay; at the outermost frame the path ends."""
        values = self.pop(results)
        self.stack[self.base :] = values
        if self.frames:
            self.pc, self.base, self.body = self.frames.pop()
        else:
            self.is_running = False

    def branch(self, i: Instruction, when: bool) -> None:
        """Jumps to `a` if the operand is `when`."""
        if self.decide(terms.is_true(self.stack.pop())) is when:
            self.pc = i.a

    def jump(self, i: Instruction) -> None:
        """Goes on at `a`."""
        self.pc = i.a

    # --- what others can see --------------------------------------------------------------------

    def send(self, i: Instruction) -> None:
        """A message: receiver, `b` cells of arguments, after and, if it has one, its deadline.

        Whether it fails depends on nothing else; where it may, others see the variables then.
        """
        times = 2 if i.op == "SENDBY" else 1
        found = self.pop(1 + i.b + times)
        after = found[1 + i.b]
        is_sure = isinstance(after, int) and after >= 0 and self._is_there(found[0])
        shown = [] if is_sure else self.seen()
        what = "sends", i.op, *self.names.selectors(i.a)
        self.events.append(Event(what, (*found, *shown)))

    def _is_there(self, receiver: Term) -> bool:
        """Whether a receiver is the rebec itself, or one that it knows."""
        known = (_SELF, *self.names.known)
        return not isinstance(receiver, int) and any(receiver.eq(each) for each in known)

    def delay(self, _: Instruction) -> None:
        """Time passes; meanwhile others see the variables."""
        (time,) = self.pop(1)
        self.events.append(Event(("delays",), (time, *self.seen())))
        self.elapsed = terms.computed("ADD", self.elapsed, time)

    def check(self, i: Instruction) -> None:
        """An assertion with text `a` (-1: none)."""
        (held,) = self.pop(1)
        text = self.program.texts[i.a] if i.a >= 0 else None
        self.events.append(Event(("asserts", text), (held,)))
        if not self.decide(terms.is_true(held)):
            self.fail("assertion")

    def choice(self, i: Instruction) -> Term:
        """One of the options, as cells."""
        options = tuple(sorted(i.constants))
        self.events.append(Event(("chooses", i.a, options)))
        self.choices += 1
        return self.choose(self.choices, options)

    def seen(self) -> list[Term]:
        """The cells of the variables, by their names."""
        slots = sorted(self.names.state, key=lambda s: s.name)
        return [c for s in slots for c in self.variables[s.offset : s.offset + s.size]]


_CLOCK, _ARRIVAL = terms.symbol("now", "int"), terms.symbol("currentMessageArrival", "int")
_DUE, _SENDER = terms.symbol("currentMessageDeadline", "int"), terms.symbol("sender", "rebec")
_SELF = terms.symbol("self", "rebec")


def _now(e: Execution) -> Term:
    return terms.computed("ADD", _CLOCK, e.elapsed)


_PUSHED: dict[str, Callable[[Execution, Instruction], Term]] = {
    "CONST": lambda e, i: e.constant(i.b) if i.b else i.a,
    "VAR": lambda e, i: e.variables[i.a],
    "VARAT": Execution.variable_at,
    "LOCAL": lambda e, i: e.stack[e.base + i.a],
    "LOCALAT": Execution.local_at,
    "TABLE": Execution.table,
    "KNOWN": lambda e, i: e.names.known[i.a],
    "SELF": lambda e, i: _SELF,
    "SENDER": lambda e, i: _SENDER,
    "NOW": lambda e, i: _now(e),
    "ARRIVAL": lambda e, i: _ARRIVAL,
    "DEADLINE": lambda e, i: _DUE,
    "WAITING": lambda e, i: terms.computed("SUB", _now(e), _ARRIVAL),
    "CHOICE": Execution.choice,
    "IS": lambda e, i: terms.is_one_of(e.stack.pop(), e.names.classes(i.constants)),
}

_DONE: dict[str, Callable[[Execution, Instruction], None]] = {
    "SETVAR": lambda e, i: e.variables.__setitem__(i.a, e.stack.pop()),
    "SETVARAT": Execution.set_variable_at,
    "SETLOCAL": lambda e, i: e.stack.__setitem__(e.base + i.a, e.stack.pop()),
    "SETLOCALAT": Execution.set_local_at,
    "OFFSET": Execution.offset,
    "POP": lambda e, i: e.stack.__delitem__(-1),
    "JUMP": Execution.jump,
    "JUMPF": lambda e, i: e.branch(i, False),
    "JUMPT": lambda e, i: e.branch(i, True),
    "CALL": Execution.call,
    "RET": lambda e, i: e.leave(i.a),
    "SEND": Execution.send,
    "SENDBY": Execution.send,
    "DELAY": Execution.delay,
    "ASSERT": Execution.check,
}
