"""The answer of `rebsync verify`: verdict, violations, coverage and figures."""

from __future__ import annotations

from typing import Literal, TypeAlias

from rebsync.checker.steps import Semantics, ViolationKind
from rebsync.checker.trace import Trace
from rebsync.records import dataclass

Verdict: TypeAlias = Literal["satisfied", "violated", "undetermined"]


@dataclass(frozen=True, slots=True)
class Violation:
    """Something that goes wrong, with a shortest run to it.

    `name` is the property's name, the assertion's text, or `Class.server:line`; `message` is a
    sentence; `line` and `path` the place in the model or property file (line 0: no place). Of a
    property there are its `formula` as written, and by step the definitions in it that are `true`.
    """

    kind: ViolationKind
    name: str
    message: str
    path: str
    line: int
    trace: Trace
    formula: str = ""
    true: tuple[tuple[str, ...], ...] = ()


@dataclass(frozen=True, slots=True)
class Extreme:
    """A least or greatest value, with a run: a shortest one to a state that has it.

    Of a time between two events it is a run with both; the value is None when the second need
    never come.
    """

    value: int | None
    trace: Trace


@dataclass(frozen=True, slots=True)
class MeasureRange:
    """The least and greatest value of an expression in the states that were seen.

    They are None when no state has a value; `undefined` is a run to a state that has none.
    """

    expression: str
    least: Extreme | None
    greatest: Extreme | None
    undefined: Trace | None


@dataclass(frozen=True, slots=True)
class Coverage:
    """What never ran: servers as `Class.server`, branches as (line, what never happened).

    `lines` are those of the model with code of which nothing ran.
    """

    servers: tuple[str, ...]
    branches: tuple[tuple[int, str], ...]
    largest_bags: tuple[tuple[str, int, int], ...]  # rebec, most places taken, capacity
    lines: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Result:
    """Everything that a verification found.

    `seconds` counts all of it; `search_seconds` is the part in which states were searched,
    `build_seconds` the one in which the engine that searched was made, and `temporal_seconds` that
    of LTL and TCTL, None where there is no such property.
    """

    verdict: Verdict
    reason: str | None
    caveats: tuple[str, ...]
    properties: tuple[tuple[str, Verdict], ...]
    violations: tuple[Violation, ...]
    coverage: Coverage
    states: int
    transitions: int
    depth: int
    semantics: Semantics
    engine: str
    seconds: float
    search_seconds: float
    build_seconds: float
    peak_memory_bytes: int
    measures: tuple[MeasureRange, ...] = ()
    temporal_seconds: float | None = None
