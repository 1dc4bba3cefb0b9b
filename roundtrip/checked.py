"""How a package stands to its model: what a check begins with, and what comes of it."""

from __future__ import annotations

from dataclasses import field
from typing import TYPE_CHECKING

from rebsync.diagnostics import Findings
from rebsync.records import dataclass
from rebsync.roundtrip.digests import Standing
from rebsync.roundtrip.kept import Kept
from rebsync.roundtrip.recorded import Record

if TYPE_CHECKING:
    from rebsync.roundtrip.verdict import Drift


@dataclass(frozen=True, slots=True)
class Accepted:
    """An accepted finding: its code, the file in the package, its message, its place's digest."""

    code: str
    path: str
    finding: str
    place: str
    reason: str = ""

    @property
    def key(self) -> tuple[str, str, str, str]:
        """By what the finding is known again."""
        return self.code, self.path, self.finding, self.place


@dataclass(frozen=True, slots=True)
class Checked:
    """A package, and how it stands to its model.

    `drift` is None where digests alone tell that both are in step. `findings` are the places of
    the code that a model cannot tell exactly, and whatever else is to be put right, `accepted`
    those of them that a user has accepted.
    """

    kept: Kept
    model: str
    record: Record | None
    standing: Standing
    drift: Drift | None = None
    findings: tuple[Findings, ...] = field(default=())
    accepted: tuple[Accepted, ...] = field(default=())


@dataclass(frozen=True, slots=True)
class Begun:
    """A package of which digests alone do not tell how it stands."""

    kept: Kept
    model: str
    record: Record | None
    standing: Standing
