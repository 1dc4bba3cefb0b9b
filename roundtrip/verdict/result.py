"""How a package stands to its model: what a check begins with, and what comes of it."""

from __future__ import annotations

from dataclasses import field
from typing import TYPE_CHECKING

from rebsync.diagnostics import Findings
from rebsync.records import dataclass
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.record import Record
from rebsync.roundtrip.package.state import PackageState

if TYPE_CHECKING:
    from rebsync.roundtrip.verdict.drift import Drift


@dataclass(frozen=True, slots=True)
class AcceptedFinding:
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
class CheckResult:
    """A package, and how it stands to its model.

    `drift` is None where digests alone tell that both are in step. `findings` are the places of
    the code that a model cannot tell exactly, and whatever else is to be put right, `accepted`
    those of them that a user has accepted.
    """

    package: ManagedPackage
    model: str
    record: Record | None
    state: PackageState
    drift: Drift | None = None
    findings: tuple[Findings, ...] = field(default=())
    accepted: tuple[AcceptedFinding, ...] = field(default=())


@dataclass(frozen=True, slots=True)
class StartedCheck:
    """A package of which digests alone do not tell how it stands."""

    package: ManagedPackage
    model: str
    record: Record | None
    state: PackageState
