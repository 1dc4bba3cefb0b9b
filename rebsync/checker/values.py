"""Cells and the values that they stand for; 32-bit arithmetic after C's promotions."""

from __future__ import annotations

import math
import struct

from rebsync.checker.program import Cell, Kind
from rebsync.static.constants import single, wrap

_BITS: dict[str, int] = {"byte": 8, "short": 16, "int": 32}
_NAN = 0x7FF8000000000000
_PACK, _UNPACK = struct.Struct("<d").pack, struct.Struct("<d").unpack
_PACK_CELL, _UNPACK_CELL = struct.Struct("<q").pack, struct.Struct("<q").unpack


def cell_of(value: float) -> Cell:
    """The bits of a double; every NaN becomes the same one."""
    if value != value:
        return _NAN
    bits: int = _UNPACK_CELL(_PACK(value))[0]
    return bits


def real(cell: Cell) -> float:
    """The double that a cell holds."""
    value: float = _UNPACK(_PACK_CELL(cell))[0]
    return value


def whole(value: float) -> int:
    """The value without its fraction as an int; what does not fit is the least int, as on x86."""
    if not abs(value) < 2**31 and value != -(2**31):
        inside = value == value and -(2**31) - 1 < value < 2**31
        return int(value) if inside else -(2**31)
    return int(value)


def divide(left: int, right: int) -> int:
    """Division that truncates; the least int divided by -1 wraps."""
    quotient = abs(left) // abs(right)
    return wrap(quotient if (left < 0) == (right < 0) else -quotient)


def remainder(left: int, right: int) -> int:
    """What truncating division leaves; its sign is that of `left`."""
    rest = abs(left) % abs(right)
    return -rest if left < 0 else rest


def power(base: float, exponent: float) -> float:
    """C's `pow`."""
    try:
        return math.pow(base, exponent)
    except OverflowError:
        odd = exponent == math.floor(exponent) and exponent % 2 == 1
        return -math.inf if base < 0 and odd else math.inf
    except ValueError:
        if base == 0:
            odd = exponent == math.floor(exponent) and exponent % 2 == 1
            return math.copysign(math.inf, base) if odd else math.inf
        return math.nan


def quotient(left: float, right: float) -> float:
    """Division of floating numbers, by zero too, as IEEE 754 has it."""
    if right != 0:
        return left / right
    if left == 0 or left != left:
        return math.nan
    return math.copysign(math.inf, left) * math.copysign(1.0, right)


def stored(value: int | float | bool, kind: Kind) -> Cell:
    """The cell of a constant that is stored in a variable of a kind."""
    if kind in ("float", "double"):
        return cell_of(single(float(value)) if kind == "float" else float(value))
    number = whole(value) if isinstance(value, float) else int(value)
    return wrap(number, _BITS[kind]) if kind in _BITS else number


def shown(cell: Cell, kind: Kind) -> str:
    """A cell as a model would write its value; one of a rebec is its number, or null."""
    match kind:
        case "boolean":
            return "true" if cell else "false"
        case "rebec":
            return str(cell) if cell >= 0 else "null"
        case "float":
            return f"{real(cell):.9g}"
        case "double":
            return repr(real(cell))
        case _:
            return str(cell)
