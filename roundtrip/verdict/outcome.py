"""What came of checking a package."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.records import dataclass
from rebsync.roundtrip.verdict.result import CheckResult

if TYPE_CHECKING:
    from rebsync.roundtrip.behaviour.proof import Proof

IN_STEP = "in step"


@dataclass(frozen=True, slots=True)
class Outcome:
    """What there is to say of a package: how it stands, or why that cannot be told.

    `is_same` says that model and code differ, and are proved to do the same.
    """

    root: str
    checked: CheckResult | None
    error: RebsyncError | None = None
    proof: Proof | None = None
    is_same: bool = False

    @property
    def findings(self) -> tuple[Findings, ...]:
        """Everything with a place but for differences and runs."""
        if self.error is not None:
            return self.error.findings
        return self.checked.findings if self.checked is not None else ()

    @property
    def is_plain(self) -> bool:
        """Whether there is nothing to say but that both are in step."""
        plain = self.checked is not None and self.checked.drift is None
        return plain and self.proof is None and not self.findings


def verdict_of(outcome: Outcome) -> str:
    """The verdict in a word or two; `unusable` where there is none."""
    if outcome.checked is None:
        return "unusable"
    drift = outcome.checked.drift
    verdict = drift.verdict.value if drift is not None else IN_STEP
    has_old_settings = any(d.code == "RS955" for f in outcome.findings for d in f.diagnostics)
    return "model ahead" if verdict == IN_STEP and has_old_settings else verdict
