"""The units that code is merged by: lines that declare, import, include or assign something."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class CodeUnit:
    """Whole lines of code, with the remarks above them and those at their ends.

    `key` identifies what they declare, assign or import among the units around; it is empty for all
    else. `inside` is a partition of the same lines where a body has units of its own. `names` is
    what an import or include brings.
    """

    key: str
    text: str
    inside: tuple[CodeUnit, ...] = ()
    names: frozenset[str] = frozenset()


class UnitScope(Enum):
    """What the lines of a body are units by."""

    DECLARATIONS = "declarations"
    SET_UP = "set-up"  # the statements of a constructor: assigned members are declarations
    STATEMENTS = "statements"  # none has a key


NO_UNIT = CodeUnit("", "")


def unit_with_body(key: str, head: str, body: Sequence[CodeUnit], tail: str) -> CodeUnit:
    """A unit of units: the lines that open it, its body, the lines that close it."""
    inside = (CodeUnit("head", head), *body, CodeUnit("tail", tail))
    return CodeUnit(key, "".join(unit.text for unit in inside), inside)


def lines_of(text: str) -> list[str] | None:
    """The lines of a text with their ends; None where the last has none, or an end is of old."""
    if not text.endswith("\n") or "\r" in text.replace("\r\n", "\n"):
        return [] if not text else None
    return [f"{line}\n" for line in text.split("\n")[:-1]]
