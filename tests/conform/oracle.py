"""Whether there is a run with some observations, by trying everything: short, slow, and apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rebsync.checker.state import State
from rebsync.checker.steps import TIME, Failure
from rebsync.checker.views import Exact
from rebsync.conform.recording import Served
from tests.conform.simulated import Given


class TooMany(Exception):
    """There are more possibilities than are tried."""


@dataclass(frozen=True)
class _Possible:
    state: State
    time: int
    positions: tuple[int, ...]
    starts: tuple[int, ...]  # when the rebecs took what they serve


def is_run(given: Given, observed: Sequence[Served], most: int = 3_000) -> bool:
    """Whether a run of the model, from its constructors on, shows just these steps.

    After the last of them bodies may end that are not observed.
    """
    own = [[s for s in observed if s.rebec == r] for r in range(len(given.program.rebecs))]
    horizon = max((s.now for s in observed), default=0)
    exact = Exact(given.program)
    seen: set[_Possible] = set()
    work: list[_Possible] = []
    for step in exact.initial_states():
        if isinstance(step.result, Failure):
            continue
        positions = [0] * len(own)
        fits = True
        for rebec, local in enumerate(step.result):
            if local.point is None and given.program.rebecs[rebec].constructor >= 0:
                first = own[rebec][0] if own[rebec] else None
                found = ("constructor", "", 0, 0, 0, local.variables)
                fits = fits and first is not None and first[1:7] == found
                positions[rebec] = 1
        if fits:
            work.append(_Possible(step.result, 0, tuple(positions), (0,) * len(own)))
    while work:
        each = work.pop()
        if each in seen:
            continue
        seen.add(each)
        if len(seen) > most:
            raise TooMany
        if sum(each.positions) == len(observed):
            return True
        if each.time <= horizon:
            work += _following(given, exact, each, own, horizon)
    return False


def _following(
    given: Given, exact: Exact, each: _Possible, own: list[list[Served]], horizon: int
) -> list[_Possible]:
    found = []
    for step in exact.steps(each.state):
        if isinstance(step.result, Failure):
            continue
        rebec, slot = step.action.actor, step.action.slot
        if rebec == TIME:
            time = each.time + step.time
            found.append(_Possible(step.result, time, each.positions, each.starts))
            continue
        starts, positions = list(each.starts), list(each.positions)
        if slot >= 0:
            starts[rebec] = each.time
        if step.result[rebec].point is None:
            point = each.state[rebec].point
            message = each.state[rebec].bag[slot] if slot >= 0 else point and point.message
            assert message is not None
            shown = ["constructor", "", 0]
            if message.server >= 0:
                name = given.program.servers[message.server].name
                arguments = given.observable.arguments(message.server, message.arguments)
                shown = [name, arguments, each.time + message.arrival]
            ended = (*shown, starts[rebec], each.time, step.result[rebec].variables)
            if positions[rebec] < len(own[rebec]):
                if own[rebec][positions[rebec]][1:7] != ended:
                    continue
                positions[rebec] += 1
            elif each.time < horizon:
                continue
        found.append(_Possible(step.result, each.time, tuple(positions), tuple(starts)))
    return found
