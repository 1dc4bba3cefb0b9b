"""Whether two models do the same, as a value and as lines."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, TypeAlias

from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import Place

Answer: TypeAlias = Literal["same", "different", "undetermined"]


@dataclass(frozen=True, slots=True)
class RunStep:
    """A step of a run: when it happens, what, and where in both; None where a side lacks it."""

    time: int
    text: str
    left: Place | None
    right: Place | None


@dataclass(frozen=True, slots=True)
class Behaviour:
    """Whether two models do the same, and if not, a shortest run that only one of them has.

    `reason` says why it is not known, or what is different where both have the same runs. `only`
    is the side that can make the last step of `run`; `instead` is something that the other one can
    do there, and this one cannot. `states` are those that were looked at.
    """

    verdict: Answer
    reason: str = ""
    states: tuple[int, int] = (0, 0)
    only: Literal["left", "right"] | None = None
    run: tuple[RunStep, ...] = ()
    instead: RunStep | None = None


SAME = Behaviour("same", "the two say the same")


def lines(behaviour: Behaviour) -> Iterator[str]:
    """The verdict, and the run with the places of both sides."""
    states = " and ".join(f"{n:,}" for n in behaviour.states)
    seen = f" ({states} states)" if any(behaviour.states) else ""
    why = f": {behaviour.reason}" if behaviour.reason else ""
    yield f"behaviour: {behaviour.verdict}{why}{seen}"
    if behaviour.only is None:
        return
    name = "first" if behaviour.only == "left" else "second"
    yield f"  a shortest run that only the {name} side has:"
    rows = [
        (str(s.time), *(str(p) if p is not None else "-" for p in (s.left, s.right)), s.text)
        for s in behaviour.run
    ]
    wide = [max(len(row[i]) for row in rows) for i in range(3)]
    for number, row in enumerate(rows, start=1):
        mark = ">" if number == len(rows) else " "
        yield f"  {mark} {row[0]:>{wide[0]}}  {row[1]:{wide[1]}}  {row[2]:{wide[2]}}  {row[3]}"
    if behaviour.instead is not None:
        other = "second" if behaviour.only == "left" else "first"
        yield f"  where the {other} side can do this: {behaviour.instead.text}"
