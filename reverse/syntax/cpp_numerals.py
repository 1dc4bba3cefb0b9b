"""Numbers as C++ writes them: integer and floating literals ([lex.icon], [lex.fcon])."""

from __future__ import annotations

import math
import re
from fractions import Fraction

from rebsync.records import dataclass

_SIGN = re.compile(r"\s*([+-]?)\s*")
_WHOLE = re.compile(r"(0x[0-9a-f]+|0b[01]+|[0-9]+)(u?(?:ll?|z)?|(?:ll?|z)u)\Z", re.IGNORECASE)
_REAL = re.compile(
    r"((?:[0-9]+\.[0-9]*|\.[0-9]+|[0-9]+(?=e))(?:e[+-]?[0-9]+)?)([fl]?)\Z", re.IGNORECASE
)
_REAL_OF_HEX = re.compile(
    r"(0x(?:[0-9a-f]+\.?[0-9a-f]*|\.[0-9a-f]+)p[+-]?[0-9]+)([fl]?)\Z", re.IGNORECASE
)
_SEPARATOR = re.compile(r"(?<=[0-9a-f])'(?=[0-9a-f])", re.IGNORECASE)  # `'2'` is a character
_OCTAL = re.compile(r"0[0-9]+\Z")


@dataclass(frozen=True, slots=True)
class Numeral:
    """A number as it is written.

    `value` is exact for whole numbers and a double for others; `digits` is what stands before the
    `suffix`, without `'`. A sign, which is no part of the literal, is in `value` alone.
    """

    value: int | float
    digits: str
    suffix: str

    @property
    def is_decimal(self) -> bool:
        """Whether it is written with ten digits: such a whole number is signed without a `u`."""
        return self.digits == "0" or self.digits[0] != "0"

    @property
    def whole(self) -> int | None:
        """The value of a whole number; None for others."""
        return self.value if isinstance(self.value, int) else None

    @property
    def exact(self) -> Fraction:
        """The number that is written, which a double only comes near to."""
        if isinstance(self.value, int) or _REAL_OF_HEX.match(self.digits):
            return Fraction(self.value)
        return Fraction(self.digits) * int(math.copysign(1, self.value))


def numeral(text: str) -> Numeral | None:
    """What a literal of C++ says, with a sign or without.

    None where it is no number of C++, or one that no double holds.
    """
    sign = _SIGN.match(text)
    plain = _SEPARATOR.sub("", text[sign.end() if sign is not None else 0 :])
    minus = -1 if sign is not None and sign[1] == "-" else 1
    try:
        if whole := _WHOLE.match(plain):
            value = int(whole[1], 8 if _OCTAL.match(whole[1]) else 0)
            return Numeral(minus * value, whole[1], whole[2])
        if real := _REAL.match(plain):
            found = float(real[1])
        elif real := _REAL_OF_HEX.match(plain):
            found = float.fromhex(real[1])
        else:
            return None
    except (ValueError, OverflowError):  # an octal number with an 8, or too large a one
        return None
    return Numeral(minus * found, real[1], real[2]) if math.isfinite(found) else None


def whole_number(text: str) -> int | None:
    """The value of a whole number, or of one with a sign before it; None for all else."""
    found = numeral(text)
    return found.whole if found is not None else None
