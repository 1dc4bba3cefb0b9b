"""Differences for people and programs: lines by class, one JSON object, SARIF, GitHub commands."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterator, Sequence

from rebsync.diagnostics import Diagnostic, Findings, Severity
from rebsync.report_data import Json, as_github, dump, region, sarif_log
from rebsync.roundtrip.diff.behaviour import Behaviour, RunStep
from rebsync.roundtrip.diff.behaviour import lines as behaviour_lines
from rebsync.roundtrip.diff.difference import (
    Added,
    Changed,
    Comparison,
    Difference,
    Moved,
    Place,
    Removed,
    Renamed,
    StatementInserted,
    StatementMoved,
    StatementRemoved,
    Undetermined,
    explain,
)
from rebsync.source import NOWHERE, Source, Span
from rebsync.terminal import encoded

_CODES: dict[type[Difference], str] = {
    Added: "RS971",
    Removed: "RS972",
    Renamed: "RS973",
    Moved: "RS974",
    StatementMoved: "RS974",
    StatementInserted: "RS975",
    StatementRemoved: "RS976",
    Changed: "RS977",
    Undetermined: "RS978",
}
_BEHAVIOUR = "0" * 32  # the fingerprint of what one side alone does
_KINDS: dict[type[Difference], str] = {
    Added: "added",
    Removed: "removed",
    Renamed: "renamed",
    Moved: "moved",
    StatementMoved: "statement moved",
    StatementInserted: "statement inserted",
    StatementRemoved: "statement removed",
    Changed: "changed",
    Undetermined: "undetermined",
}


def code_of(difference: Difference) -> str:
    """The code of a kind of differences."""
    return _CODES[type(difference)]


def verdict_of(comparison: Comparison) -> str:
    """`same`, `different`, or `undetermined` where it is not known of all."""
    if comparison.is_undetermined:
        return "undetermined"
    return "same" if comparison.is_empty else "different"


def counted(comparison: Comparison) -> str:
    """`3 differences in 2 classes, 1 place undetermined`."""
    unknown = sum(isinstance(d, Undetermined) for d in comparison.differences)
    number = len(comparison.differences) - unknown
    texts = [f"{number} difference{'s' * (number != 1)}"] if number or not unknown else []
    if unknown:
        texts.append(f"{unknown} place{'s' * (unknown != 1)} undetermined")
    return ", ".join(texts)


# --- text ---------------------------------------------------------------------------------------


def lines(comparison: Comparison, behaviour: Behaviour | None = None) -> Iterator[str]:
    """A line for each difference with both places, below the class that it is in."""
    rows = [
        (d.element.group or "system", *map(_shown, (d.left, d.right)), f"{d.element}: {explain(d)}")
        for d in comparison.differences
    ]
    wide = [max((len(row[i]) for row in rows), default=0) for i in (1, 2)]
    last = ""
    for group, left, right, what in rows:
        if group != last:
            yield group
        last = group
        yield f"  {left:{wide[0]}}  {right:{wide[1]}}  {what}"
    if behaviour is not None:
        yield from behaviour_lines(behaviour)


def _shown(place: Place | None) -> str:
    return str(place) if place is not None else "-"


# --- JSON ---------------------------------------------------------------------------------------


def as_json(
    comparison: Comparison, left: str, right: str, depth: str, behaviour: Behaviour | None = None
) -> str:
    """One object (docs/diff.schema.json)."""
    prints = fingerprints(comparison.differences)
    data: Json = {
        "version": 1,
        "left": left,
        "right": right,
        "depth": depth,
        "verdict": verdict_of(comparison),
        "differences": [
            data_of(d, print_) for d, print_ in zip(comparison.differences, prints, strict=True)
        ],
    }
    if behaviour is not None:
        data["behaviour"] = _behaviour(behaviour)
    return dump(data)


def _run_step(step: RunStep) -> Json:
    return {
        "time": step.time,
        "text": step.text,
        "left": _place(step.left),
        "right": _place(step.right),
    }


def _behaviour(behaviour: Behaviour) -> Json:
    instead = behaviour.instead
    return {
        "verdict": behaviour.verdict,
        "reason": behaviour.reason or None,
        "states": list(behaviour.states),
        "only": behaviour.only,
        "run": [_run_step(step) for step in behaviour.run],
        "instead": _run_step(instead) if instead is not None else None,
    }


def data_of(difference: Difference, fingerprint: str) -> Json:
    """A difference as JSON has it."""
    data: Json = {
        "kind": _KINDS[type(difference)],
        "code": code_of(difference),
        "element": {"kind": difference.element.kind, "path": difference.element.path},
        "class": difference.element.group or None,
        "message": explain(difference),
        "left": _place(difference.left),
        "right": _place(difference.right),
        "fingerprint": fingerprint,
    }
    match difference:
        case Renamed(name=name):
            data["name"] = name
        case Changed(aspect=aspect, of=of, old=old, new=new):
            data |= {"aspect": aspect.value, "of": of or None, "old": old, "new": new}
        case StatementInserted(text=text) | StatementRemoved(text=text) | StatementMoved(text=text):
            data["statement"] = text
        case _:
            pass
    return data


def _place(place: Place | None) -> Json | None:
    if place is None:
        return None
    where = region(place.source, place.span) if place.span != NOWHERE else None
    return {"path": place.source.path, "region": where}


# --- findings -----------------------------------------------------------------------------------


def fingerprints(differences: Sequence[Difference]) -> Iterator[str]:
    """Codes of differences that stay when lines or values around them change: by element."""
    seen: Counter[str] = Counter()
    for difference in differences:
        key = "\0".join((code_of(difference), str(difference.element), _part(difference)))
        seen[key] += 1
        yield hashlib.sha256(encoded(f"{key}\0{seen[key]}")).hexdigest()[:32]


def _part(difference: Difference) -> str:
    match difference:
        case Changed(aspect=aspect, of=of):
            return f"{aspect.value} {of}"
        case StatementInserted(text=text) | StatementRemoved(text=text) | StatementMoved(text=text):
            return text  # another one beside it makes no difference to this one
        case _:
            return ""


def findings(comparison: Comparison, behaviour: Behaviour | None = None) -> tuple[Findings, ...]:
    """Each difference as a finding on the right side; where there is nothing, on the left.

    Where both do the same, these are notes; what one alone does is a finding of its own.
    """
    same = behaviour is not None and behaviour.verdict == "same"
    severity = Severity.NOTE if same else Severity.WARNING
    found = [_finding(difference, severity) for difference in comparison.differences]
    if behaviour is not None and behaviour.verdict != "same":
        found.append(_of_behaviour(behaviour))
    return tuple(found)


def _of_behaviour(behaviour: Behaviour) -> Findings:
    """The last step of the run that only one side has, with the run as a hint."""
    last = behaviour.run[-1] if behaviour.run else None
    place = (last.right or last.left) if last is not None else None
    message, *rest = behaviour_lines(behaviour)
    hint = "\n".join(rest) or None
    source, span = (place.source, place.span) if place is not None else (Source("-", ""), NOWHERE)
    found = Diagnostic("RS979", span, message, hint, severity=Severity.WARNING)
    return Findings(source, (found,))


def _finding(difference: Difference, severity: Severity) -> Findings:
    here, there = difference.right, difference.left
    if here is None or (here.span == NOWHERE and there is not None and there.span != NOWHERE):
        here, there = there, here
    hint = f"the other side is {there}" if there is not None else None
    source, span = (here.source, here.span) if here is not None else (Source("-", ""), NOWHERE)
    message = f"{difference.element}: {explain(difference)}"
    found = Diagnostic(code_of(difference), span, message, hint, severity=severity)
    return Findings(source, (found,))


def as_sarif(comparison: Comparison, behaviour: Behaviour | None = None) -> str:
    """A SARIF 2.1.0 log: each difference with both places, and a fingerprint that stays."""
    prints = [{"rebsyncElement/v1": p} for p in fingerprints(comparison.differences)]
    related = [both_places(d) for d in comparison.differences]
    found = findings(comparison, behaviour)
    if len(found) > len(prints):
        prints.append({"rebsyncElement/v1": _BEHAVIOUR})
    return sarif_log(found, prints, related)


def both_places(difference: Difference) -> list[tuple[Source, Span, str]]:
    """The places on both sides, each with a remark that tells which it is."""
    pairs = ((difference.left, "the first side"), (difference.right, "the second side"))
    return [(place.source, place.span, remark) for place, remark in pairs if place is not None]


def as_commands(comparison: Comparison, behaviour: Behaviour | None = None) -> str:
    """Workflow commands that GitHub shows beside the changed lines."""
    return as_github(findings(comparison, behaviour))
