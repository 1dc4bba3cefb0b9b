"""`rebsync simulate --runs`: how many runs by chance are told of."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from operator import attrgetter
from typing import TYPE_CHECKING, Any

from rebsync.cli.options import write_output
from rebsync.cli.status import Status

if TYPE_CHECKING:
    from rebsync.checker.problem import Problem
    from rebsync.checker.sampling import Estimate, Sample
    from rebsync.checker.steps import Semantics

_WIDE = 40  # columns of the longest bar
_OF = (("least of a run", "least"), ("greatest of a run", "greatest"), ("last of a run", "last"))
_CAVEAT = (
    "every possible step was taken as likely as any other: the model says what may happen, not how "
    "often"
)
_ENDS = {
    "cut": "go on after the bound",
    "ended": "end, as nobody has anything to do",
    "endless": "end in a body that does not end",
}


def write_estimates(
    problem: Problem,
    semantics: Semantics,
    seed: int,
    runs: Sequence[Sample],
    style: str,
    output: str,
) -> Status:
    """Writes what runs by chance were like: violated when one of them fails."""
    ends: Counter[str] = Counter(run.end for run in runs)
    measured = [(m.text, _estimates(runs, n)) for n, m in enumerate(problem.measures)]
    if style == "json":
        write_output(output, _json(problem, semantics, seed, ends, measured))
    else:
        lines = _lines(problem.source.path, ends, measured)
        write_output(output, "".join(f"{line}\n" for line in lines))
    if any(end not in _ENDS for end in ends):
        return Status.VIOLATED
    return Status.UNDETERMINED if ends["endless"] else Status.CLEAN


def _estimates(runs: Sequence[Sample], number: int) -> dict[str, Estimate | None]:
    from rebsync.checker.sampling import estimate

    known = [value for run in runs if (value := run.values[number]) is not None]
    return {key: estimate([attrgetter(key)(value) for value in known]) for _, key in _OF}


def _lines(
    model: str, ends: Counter[str], measured: list[tuple[str, dict[str, Estimate | None]]]
) -> Iterator[str]:
    from rebsync.checker.sampling import share
    from rebsync.terminal import one_line

    count = ends.total()
    yield one_line(f"{model}: {count:,} runs by chance")
    yield f"caveat: {_CAVEAT}"
    yield ""
    for end, number in ends.most_common():
        low, high = share(number, count)
        what = _ENDS.get(end, f"fail: {end}")
        yield f"  {number:>{len(f'{count:,}')},}  {what} (probability {low:.4f} to {high:.4f})"
    for text, estimates in measured:
        yield ""
        yield one_line(text)
        for name, key in _OF:
            yield from _distribution(name, estimates[key])
    yield ""
    yield "intervals have a confidence of 95 %"


def _distribution(name: str, found: Estimate | None) -> Iterator[str]:
    if found is None:
        yield f"  {name}: fewer than two runs have a value"
        return
    low, high = found.interval
    least, first, median, third, greatest = found.quartiles
    yield f"  {name}: mean {found.mean:.4g} ({low:.4g} to {high:.4g}), median {median}"
    yield f"    {least} to {greatest}, half of the {found.count:,} runs {first} to {third}"
    most = max(count for _, _, count in found.counts)
    names = [str(a) if a == b else f"{a}..{b}" for a, b, _ in found.counts]
    wide = max(map(len, names))
    for label, (_, _, count) in zip(names, found.counts, strict=True):
        bar = "#" * max(1, round(_WIDE * count / most))
        yield f"    {label:>{wide}}  {count:>8,}  {bar}"


def _json(
    problem: Problem,
    semantics: Semantics,
    seed: int,
    ends: Counter[str],
    measured: list[tuple[str, dict[str, Estimate | None]]],
) -> str:
    from rebsync.checker.sampling import LEVEL, share
    from rebsync.checker.show.data import dump

    count = ends.total()
    return dump(
        {
            "model": problem.source.path,
            "semantics": semantics,
            "seed": seed,
            "runs": count,
            "confidence": LEVEL,
            "caveats": [_CAVEAT],
            "ends": {
                end: {"runs": number, "probability": list(share(number, count))}
                for end, number in ends.most_common()
            },
            "measures": [
                {"expression": text} | {key: _estimate(each) for key, each in estimates.items()}
                for text, estimates in measured
            ],
        }
    )


def _estimate(found: Estimate | None) -> dict[str, Any] | None:
    return (
        found
        if found is None
        else {
            "runs": found.count,
            "mean": found.mean,
            "interval": list(found.interval),
            "quartiles": list(found.quartiles),
            "counts": [{"from": a, "to": b, "runs": count} for a, b, count in found.counts],
        }
    )
