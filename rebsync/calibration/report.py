"""What was measured and what is proposed: as lines of text, as JSON, and in a page."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import Any, TypeAlias

from rebsync.calibration.calibrate import Calibration
from rebsync.calibration.proposals import Proposal
from rebsync.calibration.times import Measured, RunTimes, Slow, Statistics
from rebsync.checker.show.markup import Markup, element, joined

Json: TypeAlias = dict[str, Any]

HEADS = ("line", "kind", "time", "model", "count", "least", "median", "99 %", "greatest", "body")
_LEFT = frozenset({1, 2, 9})  # columns of text


def times_lines(times: RunTimes) -> Iterator[str]:
    """The table of what was measured."""
    yield f"times in units of {times.time_unit:g} s: {_about(times)}"
    yield from table([HEADS, *(_row(place) for place in times.places)], _LEFT)
    for slow in times.slow:
        yield f"  line {slow.line}: {_slow(slow)}"


def table(rows: Sequence[Sequence[str]], texts: Collection[int]) -> Iterator[str]:
    """Rows as lines: the columns with these numbers are texts, all others numbers."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = [
            cell.ljust(width) if column in texts else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        yield f"  {'  '.join(cells)}".rstrip()


def proposal_lines(found: Calibration) -> Iterator[str]:
    """What becomes of the model."""
    for proposal in found.proposals:
        site = proposal.measured.site
        match proposal.state:
            case "change":
                yield f"  line {site.line}: {site.text} -> {proposal.text}  ({_why(proposal)})"
            case "impossible":
                yield f"  line {site.line}: {site.text} took longer: {proposal.reason}"
            case "kept":
                pass
    if not found.changes and not found.is_open:
        yield f"  no change of the model is needed: {_kept(found.times)}"


def _about(times: RunTimes) -> str:
    said = f"{times.bodies:,} bodies"
    if times.unknown:
        said += f", {times.unknown:,} of which are not certain"
    return f"{said}; one without a delay takes {times.latency:.3f}; slack {times.slack:g}"


def _kept(times: RunTimes) -> str:
    return (
        f"nothing took longer than in the model by itself and ended more than the slack "
        f"({times.slack:g}) after its time"
    )


def _row(place: Measured) -> tuple[str, ...]:
    site = place.site
    head = (str(site.line), site.kind, site.text, ", ".join(map(str, place.model)) or "-")
    shown = place.statistics
    if shown is None:
        return (*head, "0", "-", "-", "-", "-", _remarks(place))
    return (*head, str(shown.count), *(f"{v:.2f}" for v in numbers_of(shown)), _remarks(place))


def numbers_of(shown: Statistics) -> tuple[float, float, float, float]:
    """Least, median, 99 % and greatest."""
    return shown.least, shown.median, shown.most, shown.greatest


def _remarks(place: Measured) -> str:
    said = [place.site.body]
    if place.shared:
        said.append(f"at most: together with line {', '.join(map(str, place.shared))}")
    if place.shortened:
        said.append(f"{place.shortened} begun late and shortened")
    return "; ".join(said)


def _slow(slow: Slow) -> str:
    greatest = max(sample.measured for sample in slow.samples)
    times = "once" if len(slow.samples) == 1 else f"{len(slow.samples)} times"
    return f"{slow.body} has no delay, and took up to {greatest:.2f} ({times}): give it one"


def _why(proposal: Proposal) -> str:
    measured = proposal.measured
    shown = measured.statistics
    assert shown is not None
    said = " or ".join(map(str, measured.model))
    return f"{measured.site.body} took up to {shown.greatest:.2f}, {said} in the model"


# --- JSON --------------------------------------------------------------------------------------


def calibration_json(found: Calibration, verdict: str | None) -> Json:
    """What was measured and is proposed, and the verdict on that."""
    times = found.times
    return {
        "time_unit": times.time_unit,
        "slack": times.slack,
        "latency": times.latency,
        "bodies": times.bodies,
        "uncertain": times.unknown,
        "places": [_place(place) for place in times.places],
        "slow": [
            {"body": s.body, "line": s.line, "times": statistics_json(_of(s))} for s in times.slow
        ],
        "proposals": [_proposal(proposal) for proposal in found.proposals],
        "verified": verdict,
    }


def _place(place: Measured) -> Json:
    site = place.site
    return {
        "kind": site.kind,
        "line": site.line,
        "text": site.text,
        "body": site.body,
        "model": list(place.model),
        "measured": statistics_json(place.statistics),
        "shortened": place.shortened,
        "together": list(place.shared),
    }


def _of(slow: Slow) -> Statistics | None:
    return Statistics.of([sample.measured for sample in slow.samples])


def statistics_json(shown: Statistics | None) -> Json:
    """Some times for other programs."""
    if shown is None:
        return {"count": 0, "least": None, "median": None, "most": None, "greatest": None}
    least, middle, most, greatest = (round(value, 6) for value in numbers_of(shown))
    return {
        "count": shown.count, "least": least, "median": middle, "most": most, "greatest": greatest,
    }  # fmt: skip


def _proposal(proposal: Proposal) -> Json:
    site = proposal.measured.site
    return {
        "kind": site.kind,
        "line": site.line,
        "text": site.text,
        "state": proposal.state,
        "proposed": proposal.text or None,
        "reason": proposal.reason or None,
    }


# --- page --------------------------------------------------------------------------------------


def times_section(found: Calibration) -> Markup:
    """The table in a page, with what is proposed."""
    head = element("tr", *(element("th", text, scope="col") for text in HEADS))
    rows = [
        element("tr", *(element("td", cell) for cell in _row(place)))
        for place in found.times.places
    ]
    first, *_ = times_lines(found.times)
    said = [*(f"line {s.line}: {_slow(s)}" for s in found.times.slow)]
    said += [line.strip() for line in proposal_lines(found)]
    table = element("table", element("thead", head), element("tbody", joined(*rows)))
    items = [element("li", text) for text in said]
    return element(
        "section",
        element("h2", "Times"),
        element("p", first),
        element("div", table, class_="times"),
        element("ul", *items),
        id="times",
    )
