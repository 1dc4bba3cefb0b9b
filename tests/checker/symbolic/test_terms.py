"""Every instruction gives as a term what it gives in the interpreter."""

from __future__ import annotations

import pytest
import z3

from rebsync.checker.machine import _OPERATIONS as MEANT
from rebsync.checker.program import Kind
from rebsync.checker.symbolic import terms
from rebsync.checker.symbolic.execution import _DONE, _PUSHED
from tests.checker.comparing import System
from tests.checker.test_instructions import ON_REAL, operations, result

OF_PREDICATES = {"STATE", "STATEAT"}  # what only properties read
OF_REPLAYS = {"MOVE"}  # what only a run that is made again for its drawing has
UNKNOWN = {*ON_REAL, "REAL", "FNEG", "WHOLE", "SINGLE", "SQRT"}
PROGRAM = System.of("reactiveclass A(2) { A() { } } main { A a():(); }").program


def test_all_instructions_have_a_meaning() -> None:
    assert {*terms.ARITIES, *_DONE, *_PUSHED} == MEANT.keys() - OF_PREDICATES - OF_REPLAYS


def test_known_operands() -> None:
    wrong = []
    for op, operands in operations():
        if op not in UNKNOWN and terms.computed(op, *operands) != result(PROGRAM, op, operands):
            wrong.append((op, operands))
    assert not wrong


def test_unknown_operands() -> None:
    """Terms of unknown cells have the value of the interpreter where the cells become known."""
    wrong = []
    for op, operands in operations():
        if op in UNKNOWN:
            continue
        unknown = [terms.symbol(f"x{i}", "int") for i in range(len(operands))]
        values = [(x, z3.BitVecVal(v, terms.WORD)) for x, v in zip(unknown, operands, strict=True)]
        value = z3.simplify(z3.substitute(terms.computed(op, *unknown), *values))
        if value.as_signed_long() != result(PROGRAM, op, operands):
            wrong.append((op, operands))
    assert not wrong


KINDS: list[tuple[Kind, int, int]] = [
    ("byte", -128, 127),
    ("short", -(2**15), 2**15 - 1),
    ("boolean", 0, 1),
]


@pytest.mark.parametrize(("kind", "least", "most"), KINDS)
def test_what_a_kind_holds(kind: Kind, least: int, most: int) -> None:
    cell = terms.symbol("x", kind)
    for value in (least - 1, least, most, most + 1):
        known = z3.BitVecVal(value, terms.WORD)
        holds = z3.simplify(z3.substitute(terms.in_kind(cell, kind), (cell, known)))
        assert z3.is_true(holds) is (least <= value <= most)
