"""Cells as terms of bit-vector logic: what the operations of the stack machine make of them.

Integers, booleans and rebecs have 32 bits, floats and doubles the 64 bits of `checker/values.py`.
A cell whose value is known is a whole number. Arithmetic on floats is left uninterpreted: equal
operands give equal results, and nothing else is known. What each operation means is said in
`checker/machine.py`; tests hold this table against it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache, partial
from typing import Any, TypeAlias

import z3

from rebsync.checker.program import Kind

Term: TypeAlias = Any  # an int, or a z3.BitVecRef: z3 comes without types
Condition: TypeAlias = Any  # a z3.BoolRef

WORD, REAL = 32, 64
_RANGES: dict[Kind, tuple[int, int]] = {
    "byte": (-(2**7), 2**7 - 1),
    "short": (-(2**15), 2**15 - 1),
    "boolean": (0, 1),
}


def bits_of(kind: Kind) -> int:
    """The bits of a cell of a kind."""
    return REAL if kind in ("float", "double") else WORD


def symbol(name: str, kind: Kind) -> Term:
    """An unknown cell of a kind."""
    return z3.BitVec(name, bits_of(kind))


def is_word(number: int) -> bool:
    """Whether a number has 32 bits: others are floats or doubles."""
    return -(1 << (WORD - 1)) <= number < 1 << (WORD - 1)


def in_kind(term: Term, kind: Kind) -> Condition | None:
    """What holds of every cell of a kind, unless all values are possible."""
    if kind not in _RANGES:
        return None
    least, most = _RANGES[kind]
    return z3.And(term >= least, term <= most)


def widened(term: Term, bits: int) -> Term:
    """A term of so many bits; numbers have as many as are asked for."""
    return z3.BitVecVal(term, bits) if isinstance(term, int) else term


def reduced(term: Term) -> Term:
    """The same, simplified; a number where it is one."""
    simple = z3.simplify(term)
    if z3.is_bv_value(simple) and simple.size() == WORD:
        return int(simple.as_signed_long())
    return simple


def is_true(term: Term) -> Condition:
    """That a cell is not 0."""
    return z3.simplify(widened(term, WORD) != 0)


def differ(left: Term, right: Term) -> Condition:
    """That two cells are not the same."""
    bits = max((t.size() for t in (left, right) if not isinstance(t, int)), default=REAL)
    return z3.simplify(widened(left, bits) != widened(right, bits))


class Mixed(Exception):
    """Cells of different sizes, of which one is not known."""


def _bits_of(cells: Sequence[Term]) -> int:
    """The bits that some cells have: numbers of 32 bits have as many as the others."""
    sizes = {REAL if isinstance(c, int) else c.size() for c in cells if not _fits(c)}
    if len(sizes) > 1:
        raise Mixed
    return sizes.pop() if sizes else WORD


def _fits(cell: Term) -> bool:
    return isinstance(cell, int) and is_word(cell)


def element(cells: Sequence[Term], offset: Term) -> Term:
    """The cell at an offset that is within the bounds."""
    if isinstance(offset, int):
        return cells[offset]
    bits = _bits_of(cells)
    found = widened(cells[-1], bits)
    for number in reversed(range(len(cells) - 1)):
        found = z3.If(offset == number, widened(cells[number], bits), found)
    return reduced(found)


def stored_at(cells: Sequence[Term], offset: Term, value: Term) -> list[Term]:
    """The cells after a store at an offset that is within the bounds."""
    if isinstance(offset, int):
        return [value if i == offset else cell for i, cell in enumerate(cells)]
    bits = _bits_of((*cells, value))
    return [
        reduced(z3.If(offset == i, widened(value, bits), widened(cell, bits)))
        for i, cell in enumerate(cells)
    ]


# --- operations ---------------------------------------------------------------------------------


def _truth(compare: Callable[..., Condition]) -> Callable[..., Term]:
    def compute(*operands: Term) -> Term:
        return z3.If(compare(*operands), z3.BitVecVal(1, WORD), z3.BitVecVal(0, WORD))

    return compute


def _low(term: Term, bits: int) -> Term:
    return z3.SignExt(WORD - bits, z3.Extract(bits - 1, 0, term))


def _uninterpreted(name: str, *bits: int) -> Callable[..., Term]:
    function = z3.Function(name, *(z3.BitVecSort(b) for b in bits))
    return lambda *operands: function(*operands)


_OPERATIONS: dict[str, tuple[Callable[..., Term], int, int]] = {
    # what computes it, how many operands it takes, of how many bits
    "ADD": (lambda a, b: a + b, 2, WORD),
    "SUB": (lambda a, b: a - b, 2, WORD),
    "MUL": (lambda a, b: a * b, 2, WORD),
    "DIV": (lambda a, b: a / b, 2, WORD),
    "MOD": (z3.SRem, 2, WORD),
    "AND": (lambda a, b: a & b, 2, WORD),
    "OR": (lambda a, b: a | b, 2, WORD),
    "XOR": (lambda a, b: a ^ b, 2, WORD),
    "SHL": (lambda a, b: a << (b & 31), 2, WORD),
    "SHR": (lambda a, b: a >> (b & 31), 2, WORD),
    "NEG": (lambda a: -a, 1, WORD),
    "INV": (lambda a: ~a, 1, WORD),
    "NOT": (_truth(lambda a: a == 0), 1, WORD),
    "EQ": (_truth(lambda a, b: a == b), 2, WORD),
    "NE": (_truth(lambda a, b: a != b), 2, WORD),
    "LT": (_truth(lambda a, b: a < b), 2, WORD),
    "LE": (_truth(lambda a, b: a <= b), 2, WORD),
    "GT": (_truth(lambda a, b: a > b), 2, WORD),
    "GE": (_truth(lambda a, b: a >= b), 2, WORD),
    "BYTE": (partial(_low, bits=8), 1, WORD),
    "SHORT": (partial(_low, bits=16), 1, WORD),
    **{
        name: (_uninterpreted(name, REAL, REAL, REAL), 2, REAL)
        for name in ("FADD", "FSUB", "FMUL", "FDIV", "POW")
    },
    **{name: (_uninterpreted(name, REAL, REAL), 1, REAL) for name in ("SQRT", "FNEG", "SINGLE")},
    **{
        name: (_uninterpreted(name, REAL, REAL, WORD), 2, REAL)
        for name in ("FEQ", "FNE", "FLT", "FLE", "FGT", "FGE")
    },
    "REAL": (_uninterpreted("REAL", WORD, REAL), 1, WORD),
    "WHOLE": (_uninterpreted("WHOLE", REAL, WORD), 1, REAL),
}
ARITIES: dict[str, int] = {name: count for name, (_, count, _) in _OPERATIONS.items()}


def computed(op: str, *operands: Term) -> Term:
    """The result of an operation on its operands, from left to right."""
    if all(isinstance(operand, int) for operand in operands):
        return _of_numbers(op, *operands)
    return _result(op, *operands)


# Loops count: the same few sums and comparisons of numbers are asked for again and again.
@lru_cache(maxsize=4096)
def _of_numbers(op: str, *operands: int) -> Term:
    return _result(op, *operands)


def _result(op: str, *operands: Term) -> Term:
    compute, _, bits = _OPERATIONS[op]
    return reduced(compute(*(widened(operand, bits) for operand in operands)))


def is_one_of(term: Term, names: tuple[str, ...]) -> Term:
    """Whether a rebec is of one of some classes: all that is known is that equals are alike."""
    function = z3.Function(f"is {' or '.join(names)}", z3.BitVecSort(WORD), z3.BoolSort())
    return reduced(_truth(function)(widened(term, WORD)))
