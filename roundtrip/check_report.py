"""Verdicts for people and programs: lines, one JSON object, or findings with places."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.records import dataclass
from rebsync.roundtrip.checked import Checked
from rebsync.source import NOWHERE, Source

if TYPE_CHECKING:
    from rebsync.roundtrip.difference import Difference, Place
    from rebsync.roundtrip.proof import Proof
    from rebsync.roundtrip.verdict import Mover

Json: TypeAlias = dict[str, Any]

IN_STEP = "in step"
_CODES = {"model": "RS951", "code": "RS952", "conflict": "RS953", "unknown": "RS954"}


@dataclass(frozen=True, slots=True)
class Outcome:
    """What there is to say of a package: how it stands, or why that cannot be told."""

    root: str
    checked: Checked | None
    error: RebsyncError | None = None
    proof: Proof | None = None

    @property
    def findings(self) -> tuple[Findings, ...]:
        """Everything with a place but for differences and runs."""
        if self.error is not None:
            return self.error.findings
        return self.checked.findings if self.checked is not None else ()


def verdict_of(outcome: Outcome) -> str:
    """The verdict in a word or two; `unusable` where there is none."""
    if outcome.checked is None:
        return "unusable"
    drift = outcome.checked.drift
    return drift.verdict.value if drift is not None else IN_STEP


def sentence(outcome: Outcome) -> str:
    """The verdict as people are told it."""
    checked = outcome.checked
    if checked is None:
        return "cannot be checked"
    match verdict_of(outcome):
        case "model ahead":
            return f"the model is ahead: `rebsync generate` takes {checked.model} into the code"
        case "code ahead":
            return f"the code is ahead: take its changes into {checked.model}"
        case "both moved":
            return "model and code both moved, apart: they can be merged"
        case "conflict":
            elements = checked.drift.conflicts if checked.drift is not None else ()
            return f"conflict: model and code both changed {', '.join(map(str, elements))}"
        case "apart":
            return "model and code differ; who moved is not known"
        case "undetermined":
            return "undetermined: not all of the code can be told in a model"
        case _:
            inexact = any(d.code == "RS942" for f in checked.findings for d in f.diagnostics)
            return "in step, as far as the code can be told" if inexact else IN_STEP


# --- text ---------------------------------------------------------------------------------------


def differences(checked: Checked) -> Iterator[tuple[Difference, Mover]]:
    """What is different, but for places that are among the findings anyway."""
    if checked.drift is None:
        return
    from rebsync.roundtrip.difference import Undetermined

    told = {(f.source.path, d.span.start) for f in checked.findings for d in f.diagnostics}
    for difference, mover in checked.drift.differences:
        place = difference.right
        known = place is not None and (place.source.path, place.span.start) in told
        if not (isinstance(difference, Undetermined) and known):
            yield difference, mover


def lines(outcome: Outcome) -> Iterator[str]:
    """The verdict, and below it the differences with both places, by class."""
    yield f"{outcome.root}: {sentence(outcome)}"
    checked = outcome.checked
    if checked is None or checked.drift is None:
        return
    from rebsync.roundtrip.difference import explain

    rows = []
    for difference, mover in differences(checked):
        left, right = (str(p) if p else "-" for p in (difference.left, difference.right))
        whose = {"unknown": "", "conflict": "  [both]"}.get(mover.value, f"  [{mover.value}]")
        what = f"{difference.element}: {explain(difference)}{whose}"
        rows.append((difference.element.group, left, right, what))
    wide = [max((len(row[i]) for row in rows), default=0) for i in (1, 2)]
    for group in dict.fromkeys(row[0] for row in rows):
        yield f"  {group or 'system'}"
        for row in rows:
            if row[0] == group:
                yield f"    {row[1]:{wide[0]}}  {row[2]:{wide[1]}}  {row[3]}"


# --- findings -----------------------------------------------------------------------------------


def findings(outcome: Outcome) -> Iterator[Findings]:
    """Each difference as a finding at the place of whoever moved, and all other findings."""
    checked = outcome.checked
    if checked is not None:
        for difference, mover in differences(checked):
            yield _finding(checked, difference, mover)
    yield from outcome.findings
    if outcome.proof is not None:
        from rebsync.roundtrip.proof_report import proof_findings

        yield from proof_findings(outcome.proof)


def _finding(checked: Checked, difference: Difference, mover: Mover) -> Findings:
    from rebsync.roundtrip.difference import Undetermined, explain

    by_model = mover.value == "model"
    first, other = difference.left, difference.right
    here, there = (first, other) if by_model and first is not None else (other, first)
    if here is None:
        here, there = there, None
    what = f"{difference.element}: {explain(difference)}"
    hint = f"the {'code' if by_model else 'model'} says this at {there}" if there else None
    source = here.source if here is not None else Source(checked.model, "")
    span = here.span if here is not None else NOWHERE
    code = "RS978" if isinstance(difference, Undetermined) else _CODES[mover.value]
    return Findings(source, (Diagnostic(code, span, what, hint),))


# --- JSON ---------------------------------------------------------------------------------------


def as_json(outcomes: Sequence[Outcome]) -> str:
    """One object with all packages."""
    data = {"version": 1, "packages": [_package(outcome) for outcome in outcomes]}
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"


def _package(outcome: Outcome) -> Json:
    from rebsync.report_data import as_json as findings_json

    checked = outcome.checked
    told = json.loads(findings_json(outcome.findings))["findings"]
    return {
        "path": outcome.root,
        "model": checked.model if checked is not None else None,
        "verdict": verdict_of(outcome),
        "message": sentence(outcome),
        "differences": [_difference(*d) for d in differences(checked)] if checked else [],
        "findings": told,
        "verification": _verification(outcome),
    }


def _verification(outcome: Outcome) -> Json | None:
    if outcome.proof is None:
        return None
    from rebsync.roundtrip.proof_report import proof_data

    return proof_data(outcome.proof)


def _difference(difference: Difference, mover: Mover) -> Json:
    from rebsync.roundtrip.difference import explain

    return {
        "element": {"kind": difference.element.kind, "path": difference.element.path},
        "kind": type(difference).__name__,
        "message": explain(difference),
        "moved": mover.value,
        "model": _place(difference.left),
        "code": _place(difference.right),
    }


def _place(place: Place | None) -> Json | None:
    if place is None:
        return None
    if place.line is None:
        return {"path": place.source.path, "line": None, "column": None}
    position = place.source.position(place.span.start)
    return {"path": place.source.path, "line": position.line, "column": position.column}
