"""A difference between model and code in words, as the change of whoever has moved."""

from __future__ import annotations

from dataclasses import replace

from rebsync.roundtrip.diff.difference import (
    Added,
    Changed,
    Difference,
    Moved,
    Removed,
    Renamed,
    StatementInserted,
    StatementMoved,
    StatementRemoved,
    Undetermined,
    both_clipped,
    clipped,
    explain,
)
from rebsync.roundtrip.verdict.drift import Mover
from rebsync.unions import assert_never


def change_of_mover(difference: Difference, mover: Mover) -> str:
    """What somebody has changed; or how the two differ, where both have or it is not known who.

    The left of the difference is the model, the right is the code.
    """
    match mover:
        case Mover.CODE:
            return explain(difference)
        case Mover.MODEL:
            return _by_model(difference)
        case Mover.CONFLICT | Mover.UNKNOWN:
            return _apart(difference)
        case _:
            assert_never(mover)


def _by_model(difference: Difference) -> str:
    """The same, the code being what it was before."""
    match difference:
        case Added(element, left, right):
            return explain(Removed(element, right, left))
        case Removed(element, left, right):
            return explain(Added(element, right, left))
        case Renamed(name=name):
            return f"renamed from {name}"
        case Moved():
            return "moved"
        case Changed(old=old, new=new):
            return explain(replace(difference, old=new, new=old))
        case StatementInserted(element, text, left, right):
            return explain(StatementRemoved(element, text, right, left))
        case StatementRemoved(element, text, left, right):
            return explain(StatementInserted(element, text, right, left))
        case StatementMoved() | Undetermined():
            return explain(difference)
        case _:
            assert_never(difference)


def _apart(difference: Difference) -> str:
    match difference:
        case Added():
            return "only in the code"
        case Removed():
            return "only in the model"
        case Renamed(name=name):
            return f"called {name} in the code"
        case Moved(to=to):
            return f"elsewhere in the code: {to}"
        case Changed(aspect=aspect, of=of, old=old, new=new):
            what = f"{aspect.value} of {of}" if of else aspect.value
            if not (old and new):
                return f"{what} only in the {'model' if old else 'code'}: {clipped(old or new)}"
            first, second = both_clipped(old, new)
            if first == second:
                return f"{what} is written alike in both, and means something else: {first}"
            return f"{what} is {first} in the model, {second} in the code"
        case StatementInserted(text=text):
            return f"statement only in the code: {clipped(text)}"
        case StatementRemoved(text=text):
            return f"statement only in the model: {clipped(text)}"
        case StatementMoved(text=text):
            return f"statement elsewhere in the code: {clipped(text)}"
        case Undetermined():
            return explain(difference)
        case _:
            assert_never(difference)
