"""What a verification of code says, with the model's line and the code's beside each step."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any, TypeAlias

from rebsync.checker.result import Violation
from rebsync.checker.show import words
from rebsync.checker.show.data import result_json
from rebsync.diagnostics import Diagnostic, Findings, Severity
from rebsync.roundtrip.behaviour.proof import Proof
from rebsync.roundtrip.behaviour.run_table import run_table
from rebsync.roundtrip.diff.correspondence import Both
from rebsync.roundtrip.diff.difference import Place
from rebsync.source import NOWHERE, Source, Span

Json: TypeAlias = dict[str, Any]
Remark: TypeAlias = tuple[Source, Span, str]

_NOWHERE = Both(None, None)


def outcome_of(proof: Proof, drifted: bool) -> str:
    """The verdict in one line: `drifted, all properties still hold`."""
    head = "drifted" if drifted else "in step"
    still = "still " if drifted else ""
    match proof.verdict:
        case "satisfied":
            what = f"all properties {still}hold"
            if proof.names:
                one = len(proof.names) == 1
                what = f"{', '.join(proof.names)} {still}hold{'s' if one else ''}"
        case "violated":
            what = _broken(proof)
        case _:
            what = f"whether the properties hold is undetermined: {proof.reason}{_open(proof)}"
    return f"{head}, {what}"


def _open(proof: Proof) -> str:
    """What a search that was stopped has not come to an end with."""
    properties = proof.result.properties if proof.result is not None else ()
    names = [name for name, verdict in properties if verdict == "undetermined"]
    return f"; not finished: {', '.join(names)}" if names else ""


def _broken(proof: Proof) -> str:
    """`property Small broken; deadlock`."""
    names = [v.name for v in violations(proof) if v.kind == "property"]
    others = [words.title(v) for v in violations(proof) if v.kind != "property"]
    told = f"propert{'ies' if len(names) > 1 else 'y'} {', '.join(names)} broken" if names else ""
    return "; ".join(filter(None, (told, ", ".join(others))))


def proof_lines(proof: Proof, drifted: bool, *, is_full: bool) -> Iterator[str]:
    """The verdict; then each run in which something goes wrong, with both places of each step.

    Of long runs only what matters, and a run once, unless it is `is_full`.
    """
    yield f"  {outcome_of(proof, drifted)}"
    if proof.verdict == "violated" and proof.reason:
        yield f"  caveat: {proof.reason}"
    if proof.result is None:
        return
    for caveat in caveats(proof):
        yield f"  caveat: {caveat}"
    for number, violation in enumerate(proof.result.violations):
        yield ""
        yield f"  {words.title(violation)}: {violation.message}"
        before = proof.result.violations[:number]
        same = next((each for each in before if each.trace == violation.trace), None)
        if same is None or is_full:
            yield from run_lines(proof, violation, is_full=is_full)
        else:
            yield f"    on the run of {words.title(same)}"


def caveats(proof: Proof) -> tuple[str, ...]:
    """What the verdict rests on, or leaves open."""
    return proof.result.caveats if proof.result is not None else ()


def run_lines(proof: Proof, violation: Violation, *, is_full: bool = True) -> Iterator[str]:
    """A run as a table: what happens in each step, and both places of it."""
    return run_table(violation, proof.places, proof.subject, is_full=is_full)


# --- for other programs -------------------------------------------------------------------------


def proof_findings(proof: Proof) -> Iterator[tuple[Findings, list[Remark]]]:
    """What is violated, where in the code the run ends; with the places that it comes by.

    What the verdict rests on is a note.
    """
    for remark in proof.remarks:
        yield remark, [(remark.source, d.span, d.message) for d in remark.diagnostics]
    for caveat in caveats(proof):
        note = Diagnostic("RS949", NOWHERE, caveat, severity=Severity.NOTE)
        yield Findings(Source(proof.path, ""), (note,)), []
    if proof.verdict == "undetermined":
        message = f"whether the properties hold is undetermined: {proof.reason}"
        yield _finding("RS958", None, proof, message, None), []
        return
    for violation in violations(proof):
        steps = list(_places(proof, violation))
        end = steps[-1][0] if steps else None
        told = f"{words.title(violation)}: {violation.message}"
        hint = proof.reason or f"the run has {words.counted(len(violation.trace.steps), 'step')}"
        remarks = [(place.source, place.span, what) for place, what in steps]
        yield _finding("RS957", end, proof, told, hint), remarks


def _places(proof: Proof, violation: Violation) -> Iterator[tuple[Place, str]]:
    """The places that a run comes by, in the code where that is known, and what happens there."""
    for step in violation.trace.steps:
        both = proof.places.get(step.line, _NOWHERE)
        place = both.code or both.model
        if place is not None:
            yield place, f"step {step.number}, time {step.time}: {words.heading(step)}"


def _finding(
    code: str, place: Place | None, proof: Proof, message: str, hint: str | None
) -> Findings:
    source = place.source if place is not None else Source(proof.path, "")
    span = place.span if place is not None else NOWHERE
    return Findings(source, (Diagnostic(code, span, message, hint),))


def proof_data(proof: Proof) -> Json:
    """The verdict and the whole result; `places` are those of the lines that its runs name."""
    result = json.loads(result_json(proof.result)) if proof.result is not None else None
    lines = {s.line for v in violations(proof) for s in v.trace.steps if s.line}
    return {
        "verdict": proof.verdict,
        "reason": proof.reason or None,
        "broken": list(proof.broken),
        "extracted": proof.source.text,
        "places": {str(n): _both(proof.places.get(n, _NOWHERE)) for n in sorted(lines)},
        "result": result,
    }


def violations(proof: Proof) -> tuple[Violation, ...]:
    """The runs in which something goes wrong."""
    return proof.result.violations if proof.result is not None else ()


def _both(both: Both) -> Json:
    return {
        name: {"path": place.source.path, "line": place.line} if place is not None else None
        for name, place in (("model", both.model), ("code", both.code))
    }
