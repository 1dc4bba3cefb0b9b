"""Verdicts for people and programs: lines, one JSON object, or findings with places."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from rebsync.diagnostics import Diagnostic, Findings
from rebsync.roundtrip.verdict.outcome import IN_STEP, Outcome, verdict_of
from rebsync.roundtrip.verdict.report.movers import change_of_mover
from rebsync.roundtrip.verdict.result import CheckResult
from rebsync.source import NOWHERE, Source, Span
from rebsync.terminal import encoded, named

if TYPE_CHECKING:
    from rebsync.roundtrip.diff.difference import Difference
    from rebsync.roundtrip.verdict.drift import Mover

Json: TypeAlias = dict[str, Any]
Remark: TypeAlias = tuple[Source, Span, str]

_CODES = {"model": "RS951", "code": "RS952", "conflict": "RS953", "unknown": "RS954"}


def sentence(outcome: Outcome) -> str:
    """The verdict as people are told it."""
    return f"{_sentence(outcome)}; same behaviour" if outcome.is_same else _sentence(outcome)


def _sentence(outcome: Outcome) -> str:
    checked = outcome.checked
    if checked is None:
        return "cannot be checked"
    match verdict_of(outcome):
        case "model ahead" if checked.drift is None or not checked.drift.differences:
            return "the settings are ahead"
        case "model ahead":
            return f"the model is ahead: `rebsync sync` takes {checked.model} into the code"
        case "code ahead" if any(
            d.code == "RS956" for f in checked.findings for d in f.diagnostics
        ):
            return "the code joins nodes otherwise, which no model tells: take that back"
        case "code ahead":
            return f"the code is ahead: `rebsync sync` takes its changes into {checked.model}"
        case "both moved":
            return "model and code both moved, apart: `rebsync sync` merges them"
        case "conflict":
            elements = checked.drift.conflicts if checked.drift is not None else ()
            return f"conflict: model and code both changed {', '.join(map(str, elements))}"
        case "apart":
            return "model and code differ; who moved is not known"
        case "undetermined":
            count = len(checked.accepted)
            said = "undetermined: not all of the code can be told in a model"
            return f"{said} ({count} accepted)" if count else said
        case _:
            inexact = any(
                d.code in ("RS942", "RS947") for f in checked.findings for d in f.diagnostics
            )
            said = "in step, as far as the code can be told" if inexact else IN_STEP
            count = len(checked.accepted)
            return f"{said}, with {count} accepted" if count else said


# --- text ---------------------------------------------------------------------------------------


def told_lines(outcome: Outcome, *, is_full: bool) -> Iterator[str]:
    """Everything but findings, line by line; of long runs what matters, unless it is `is_full`."""
    yield from lines(outcome)
    if outcome.proof is not None:
        from rebsync.roundtrip.behaviour.report import proof_lines

        drifted = verdict_of(outcome) != IN_STEP
        yield from proof_lines(outcome.proof, drifted, is_full=is_full)


def differences(checked: CheckResult | None) -> Iterator[tuple[Difference, Mover]]:
    """What is different, but for places that are among the findings anyway."""
    if checked is None or checked.drift is None:
        return
    from rebsync.roundtrip.diff.difference import Place, Undetermined

    told: dict[tuple[str, int | None], list[str]] = {}
    for found in checked.findings:
        for d in found.diagnostics:
            where = found.source.path, Place(found.source, d.span).line
            told.setdefault(where, []).append(d.message)
    for difference, mover in checked.drift.differences:
        place = difference.right
        if isinstance(difference, Undetermined) and place is not None:
            messages = told.get((place.source.path, place.line), [])
            if any(difference.why in message for message in messages):
                continue
        yield difference, mover


def lines(outcome: Outcome) -> Iterator[str]:
    """The verdict, and below it the differences with both places, by class."""
    yield f"{named(outcome.root)}: {sentence(outcome)}"
    checked = outcome.checked
    if checked is None or checked.drift is None:
        return

    rows = []
    for difference, mover in differences(checked):
        left, right = (str(p) if p else "-" for p in (difference.left, difference.right))
        whose = {"unknown": "", "conflict": "  [both]"}.get(mover.value, f"  [{mover.value}]")
        what = f"{difference.element}: {change_of_mover(difference, mover)}{whose}"
        rows.append((difference.element.group, left, right, what))
    wide = [max((len(row[i]) for row in rows), default=0) for i in (1, 2)]
    for group in dict.fromkeys(row[0] for row in rows):
        yield f"  {group or 'system'}"
        for row in rows:
            if row[0] == group:
                yield f"    {row[1]:{wide[0]}}  {row[2]:{wide[1]}}  {row[3]}"


# --- findings -----------------------------------------------------------------------------------


def as_sarif(outcomes: Sequence[Outcome]) -> str:
    """A SARIF 2.1.0 log; a difference is known again by its element, wherever that is."""
    from rebsync.report_data import fingerprints, sarif_log

    found: list[Findings] = []
    prints: list[dict[str, str]] = []
    related: list[list[Remark]] = []
    for outcome in outcomes:
        for difference, mover, print_ in _printed(outcome):
            assert outcome.checked is not None
            found.append(_finding(outcome.checked, difference, mover))
            prints.append({"rebsyncElement/v1": print_})
            pairs = ((difference.left, "the model"), (difference.right, "the code"))
            related.append([(p.source, p.span, remark) for p, remark in pairs if p is not None])
        others = [(f, list[Remark]()) for f in _others(outcome)] + _proofs(outcome)
        prints += [{"rebsyncFinding/v1": p} for p in fingerprints([f for f, _ in others])]
        found += [f for f, _ in others]
        related += [places for f, places in others for _ in f.diagnostics]
    return sarif_log(found, prints, related)


def as_github(outcomes: Sequence[Outcome]) -> str:
    """Workflow commands that GitHub shows beside the changed lines."""
    from rebsync.report_data import as_github as commands

    return commands([found for outcome in outcomes for found in findings_of(outcome)])


def findings_of(outcome: Outcome) -> list[Findings]:
    """Everything that there is to say of a package, differences included, as findings."""
    found = [_finding(outcome.checked, *d) for d in differences(outcome.checked)]
    return [*found, *_others(outcome), *(f for f, _ in _proofs(outcome))]


def _others(outcome: Outcome) -> list[Findings]:
    """The findings but for those that are told as differences of an element already."""
    places = {
        (d.right.source.path, d.right.span)
        for d, _ in differences(outcome.checked)
        if d.right is not None
    }
    return [
        found
        for found in outcome.findings
        if not all(
            d.code == "RS956" and (found.source.path, d.span) in places for d in found.diagnostics
        )
    ]


def _printed(outcome: Outcome) -> Iterator[tuple[Difference, Mover, str]]:
    """Each difference with its fingerprint, which is another one in each package."""
    told = list(differences(outcome.checked))
    if not told:
        return
    from rebsync.roundtrip.diff.report import fingerprints

    prints = fingerprints([d for d, _ in told])
    for (difference, mover), print_ in zip(told, prints, strict=True):
        root = Path(outcome.root).as_posix()
        yield difference, mover, hashlib.sha256(encoded(f"{root}\0{print_}")).hexdigest()[:32]


def _proofs(outcome: Outcome) -> list[tuple[Findings, list[Remark]]]:
    if outcome.proof is None:
        return []
    from rebsync.roundtrip.behaviour.report import proof_findings

    return list(proof_findings(outcome.proof))


def _finding(checked: CheckResult | None, difference: Difference, mover: Mover) -> Findings:
    """A difference at the place of whoever moved."""
    from rebsync.roundtrip.diff.difference import Undetermined

    by_model = mover.value == "model"
    first, other = difference.left, difference.right
    here, there = (first, other) if by_model and first is not None else (other, first)
    if here is None:
        here, there = there, None
    what = f"{difference.element}: {change_of_mover(difference, mover)}"
    hint = f"its place in the {'code' if by_model else 'model'} is {there}" if there else None
    model = checked.model if checked is not None else "-"
    source = here.source if here is not None else Source(model, "")
    span = here.span if here is not None else NOWHERE
    code = "RS978" if isinstance(difference, Undetermined) else _CODES[mover.value]
    return Findings(source, (Diagnostic(code, span, what, hint),))


# --- JSON ---------------------------------------------------------------------------------------


def as_json(outcomes: Sequence[Outcome]) -> str:
    """One object with all packages (docs/check.schema.json)."""
    from rebsync.report_data import dump

    return dump({"version": 1, "packages": [_package(outcome) for outcome in outcomes]})


def _package(outcome: Outcome) -> Json:
    from rebsync.report_data import as_json as findings_json
    from rebsync.roundtrip.diff.report import data_of
    from rebsync.roundtrip.verdict.report.movers import change_of_mover

    return {
        "path": outcome.root,
        "model": outcome.checked.model if outcome.checked is not None else None,
        "verdict": verdict_of(outcome),
        "message": sentence(outcome),
        "differences": [
            {
                **data_of(difference, print_),
                "message": change_of_mover(difference, mover),
                "moved": mover.value,
            }
            for difference, mover, print_ in _printed(outcome)
        ],
        "findings": json.loads(findings_json(outcome.findings))["findings"],
        "accepted": [
            {"code": e.code, "path": e.path, "message": e.finding, "reason": e.reason}
            for e in (outcome.checked.accepted if outcome.checked is not None else ())
        ],
        "verification": _verification(outcome),
    }


def _verification(outcome: Outcome) -> Json | None:
    if outcome.proof is None:
        return None
    from rebsync.roundtrip.behaviour.report import proof_data

    return proof_data(outcome.proof)
