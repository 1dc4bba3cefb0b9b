"""`rebsync conform --times`, `--calibrate` and `--apply`: what a recorded run took."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from rebsync.cli.status import Status, worst

if TYPE_CHECKING:
    from rebsync.calibration.calibrate import Calibration
    from rebsync.checker.problem import Problem
    from rebsync.checker.result import Result
    from rebsync.conform.matching import Subject
    from rebsync.conform.recording import Recording
    from rebsync.records import dataclass
else:
    from rebsync.records import dataclass

LONGEST = 120.0  # s that the calibrated model is searched for


@dataclass(frozen=True, slots=True)
class Calibrated:
    """What was measured; with `proposes` also what becomes of the model, and of its properties.

    `result` is of the model as proposed, None where nothing changes; `written` where it was.
    """

    calibration: Calibration
    proposes: bool
    result: Result | None = None
    written: str | None = None

    def lines(self, path: str, old: str) -> Iterator[str]:
        """What there is to say, for people; `old` is the text of the model, at `path`."""
        from rebsync.calibration.report import proposal_lines, times_lines
        from rebsync.patches import patch

        yield from times_lines(self.calibration.times)
        if not self.proposes:
            return
        yield "calibration"
        yield from proposal_lines(self.calibration)
        if self.written is None and self.calibration.changes:
            new = self.calibration.text
            yield from patch(old, new, path, f"{path} (calibrated)").splitlines()
        if self.written is not None:
            yield f"wrote {self.written}"
        if self.result is not None:
            yield f"with what was measured: {said(self.result)}"

    @property
    def verdict(self) -> str | None:
        """The verdict on the model as proposed."""
        return self.result.verdict if self.result is not None else None

    @property
    def status(self) -> Status:
        """The status of the command, as far as it is about times."""
        found = [Status.CLEAN]
        open_ = self.calibration.is_open or (self.calibration.changes and self.written is None)
        if self.proposes and open_:
            found.append(Status.FINDINGS)
        if self.result is not None and self.result.verdict == "violated":
            found.append(Status.VIOLATED)
        if self.result is not None and self.result.verdict == "undetermined":
            found.append(Status.UNDETERMINED)
        return worst(found)


def calibrated(
    subject: Subject, problem: Problem, recording: Recording, proposes: bool, applies: bool
) -> Calibrated:
    """Measures a recording and, if asked for, writes what follows into the model."""
    from rebsync.calibration.calibrate import calibrate
    from rebsync.calibration.measure import measure

    model = problem.analysis.model
    found = calibrate(problem.source, model, measure(subject, model, recording))
    if not proposes or not found.changes:
        return Calibrated(found, proposes)
    result = _verified(problem, found.text)
    written = None
    if applies:
        from rebsync.writing import replace_text

        replace_text(problem.source.path, found.text)
        written = problem.source.path
    return Calibrated(found, proposes, result, written)


def _verified(problem: Problem, text: str) -> Result:
    """The verdict on the model with other text; mistakes in it are bugs of the proposal."""
    from rebsync.checker.exploration import Limits
    from rebsync.checker.problem import Options
    from rebsync.checker.verify import verify
    from rebsync.cli.problem import with_text
    from rebsync.config import settings_beside

    allowed = frozenset(settings_beside(problem.source.path)[1].allow)
    return verify(
        with_text(problem, text), Options(limits=Limits(seconds=LONGEST), allowed=allowed)
    )


def said(result: Result) -> str:
    """The verdict of a calibrated model in a line."""
    about = [f"{name} {verdict}" for name, verdict in result.properties]
    about += [f"{v.kind}: {v.message}" for v in result.violations if v.kind != "property"]
    if result.reason is not None:
        about.append(result.reason)
    return f"{result.verdict}{' (' + '; '.join(about) + ')' if about else ''}"
