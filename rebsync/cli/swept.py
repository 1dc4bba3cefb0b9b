"""What a parameter sweep asks of a model, and what it finds for some values."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rebsync.records import dataclass

if TYPE_CHECKING:
    from rebsync.checker.result import Verdict


@dataclass(frozen=True, slots=True)
class Swept:
    """A constant of a model, and the values that it is to have, as they are written."""

    name: str
    values: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class SweptResult:
    """What was found for some values.

    `violations` are their kinds and names, `measures` the least and greatest values.
    """

    values: tuple[str, ...]
    verdict: Verdict
    reason: str | None
    caveats: tuple[str, ...]
    properties: tuple[tuple[str, Verdict], ...]
    violations: tuple[tuple[str, str], ...]
    measures: tuple[tuple[str, int | str | None, int | str | None], ...]
    states: int
    seconds: float
    checks: Verdict  # of what is checked in every model
    assumed: bool = False  # not searched: taken from --monotone

    def told(self, verdict: Verdict) -> str:
        return f"{verdict}, if monotone" if self.assumed else verdict
