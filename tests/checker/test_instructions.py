"""Every instruction that computes gives in C what it gives in the interpreter, to the last bit."""

from __future__ import annotations

import math
import random
import shutil
from collections.abc import Iterator
from dataclasses import replace
from itertools import product

import pytest

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Limits
from rebsync.checker.machine import Machine
from rebsync.checker.program import NO_DEADLINE, Cell, Instruction, Program, Slot
from rebsync.checker.state import Message
from rebsync.checker.values import cell_of
from rebsync.model import Type
from rebsync.static.constants import single
from tests.checker.comparing import System

pytestmark = pytest.mark.skipif(
    not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler"
)

WHOLE = (0, 1, -1, 2, 31, 32, -128, 255, 46341, 2**31 - 1, -(2**31))
_EDGES = (2**31 - 0.5, -(2.0**31) - 0.5, -(2.0**31) - 1, 2.0**53 + 1, 0.1, -2.5, 1.5, 3.0, 1e-320)
_GREAT = (single(3.4028235e38), 3.4028235677973366e38, 1e308, 5e-324, 1e-46)
REAL = tuple(cell_of(v) for v in (0.0, -0.0, math.inf, -math.inf, math.nan, *_EDGES, *_GREAT))
ON_WHOLE = ("ADD", "SUB", "MUL", "DIV", "MOD", "AND", "OR", "XOR", "SHL", "SHR")
COMPARED = ("EQ", "NE", "LT", "LE", "GT", "GE")
ON_REAL = ("FADD", "FSUB", "FMUL", "FDIV", "POW", "FEQ", "FNE", "FLT", "FLE", "FGT", "FGE")
OF_WHOLE = ("NEG", "INV", "NOT", "BYTE", "SHORT", "REAL")
OF_REAL = ("FNEG", "WHOLE", "SINGLE", "SQRT")


def operations() -> Iterator[tuple[str, tuple[Cell, ...]]]:
    chance = random.Random(2026)
    for ops, values in (((*ON_WHOLE, *COMPARED), WHOLE), (ON_REAL, REAL)):
        pairs = list(product(values, values))
        for op in ops:
            allowed = [p for p in pairs if p[1] or op not in ("DIV", "MOD")]
            yield from ((op, pair) for pair in chance.sample(allowed, 20))
    for op, value in (*product(OF_WHOLE, WHOLE), *product(OF_REAL, REAL)):
        yield op, (value,)


def result(program: Program, op: str, operands: tuple[Cell, ...]) -> Cell:
    """What the interpreter computes."""
    code = (*(Instruction("CONST", value) for value in operands), Instruction(op))
    body = replace(program.bodies[0], entry=0, end=len(code) + 1, parameters=(), frame=0)
    short = replace(program, code=(*code, Instruction("RET", 1)), bodies=(body,))
    message = Message(0, -1, 0, NO_DEADLINE, ())
    machine = Machine(short, program.rebecs[0], 0, [], message, 0, [], False, 0)
    machine.start(0, ())
    return machine.stack[-1]


def _checking(program: Program) -> tuple[Program, list[tuple[str, tuple[Cell, ...]]]]:
    """A program whose constructor asserts every result; its arguments are the operands, so that
    the C compiler computes nothing itself."""
    drawn = list(operations())
    cells: list[Cell] = []
    code: list[Instruction] = []
    for op, operands in drawn:
        code += [Instruction("LOCAL", len(cells) + i) for i in range(len(operands))]
        cells += operands
        expected = Instruction("CONST", result(program, op, operands))
        code += [Instruction(op), expected, Instruction("EQ"), Instruction("ASSERT", -1)]
    code.append(Instruction("RET"))
    parameter = Slot("operands", Type("int"), "int", 0, len(cells))
    body = replace(
        program.bodies[0], entry=0, end=len(code), parameters=(parameter,), frame=len(cells)
    )
    rebec = replace(program.rebecs[0], constructor=0, arguments=tuple(cells))
    spans = program.spans[:1] * len(code)
    checking = replace(program, code=tuple(code), spans=spans, bodies=(body,), rebecs=(rebec,))
    return checking, drawn


def test_c_computes_what_the_interpreter_computes() -> None:
    plain = System.of("reactiveclass A(2) { A() { } } main { A a():(); }").program
    program, drawn = _checking(plain)
    found = CompiledSearch(program, "core").run(Limits())
    failed = [event.cause for event in found.events if event.cause != "deadlock"]
    checks = [pc for pc, i in enumerate(program.code) if i.op == "ASSERT"]
    assert [drawn[checks.index(f.pc)] for f in failed] == []  # type: ignore[union-attr]
    assert found.states == 1
