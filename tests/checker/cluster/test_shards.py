"""Workers in this process, without Ray: with little room, and replaced after each level."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Sequence
from typing import Any
from unittest import mock

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rebsync.checker.cluster.search import ClusterSearch
from rebsync.checker.cluster.shard import Task
from rebsync.checker.cluster.worker import Worker, before
from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Limits
from rebsync.checker.problem import Cluster
from rebsync.checker.program import Program
from rebsync.checker.steps import Semantics
from tests.checker.comparing import System
from tests.checker.draw_outlines import Features
from tests.checker.draw_systems import CLOCKED, DRIVEN, UNTIMED, systems
from tests.checker.test_compiled import _walkers

_COMPILERS = tuple(filter(None, map(shutil.which, ("cc", "gcc", "clang"))))

pytestmark = pytest.mark.skipif(not _COMPILERS, reason="no C compiler")


class _InProcess:
    """A pool of workers that are functions; one after the other is replaced after each level."""

    lost = 0

    def __init__(self, crew: None, task: Task, look: Callable[[], None]) -> None:
        self._task = task
        self._checkpoints: list[list[bytes]] = [[] for _ in range(task.shares)]
        self._workers = [self._started(number) for number in range(task.shares)]

    def _started(self, number: int) -> Worker:
        worker = Worker()
        worker.prepare(self._task, self._task.seal, number, *self._checkpoints[number])
        return worker

    def call(self, name: str, arguments: Sequence[tuple[Any, ...]], parts: int) -> Any:  # noqa: ANN401
        pairs = zip(self._workers, arguments, strict=True)
        answers = [getattr(worker, name)(*given) for worker, given in pairs]
        assert all(len(answer) == 1 + parts for answer in answers)
        return [answer[0] for answer in answers], [answer[1:] for answer in answers]

    def checkpoint(self, texts: Sequence[bytes]) -> None:
        for known, text in zip(self._checkpoints, texts, strict=True):
            known.append(text)
        number = len(self._checkpoints[0]) % len(self._workers)
        self._workers[number] = self._started(number)

    def before(self, level: int, number: int) -> tuple[int, int]:
        found = [before(known[level], number) for known in self._checkpoints]
        (answer,) = filter(None, found)
        return answer


def _compare(
    program: Program,
    view: Semantics,
    invariants: tuple[int, ...],
    limits: Limits,
    compacted: bool,
    workers: int = 3,
) -> int:
    """One machine and some workers: figures, events, runs. Gives how many states there are."""
    compiler = f"{os.environ.get('CC') or _COMPILERS[0]} -DLITTLE_ROOM"
    one = CompiledSearch(program, view, invariants)
    expected = one.run(limits)
    with (
        mock.patch.dict(os.environ, CC=compiler),
        mock.patch("rebsync.checker.cluster.search.Pool", _InProcess),
        mock.patch("rebsync.checker.cluster.search.connected", return_value=(None, workers)),
    ):
        many = ClusterSearch(program, view, invariants, (), Cluster("local"), compacted)
        found = many.run(limits)
    names = "states", "transitions", "depth", "events", "covered", "reason"
    for name in names:
        assert getattr(found, name) == getattr(expected, name), name
    some = range(0, found.states, 1 + found.states // 20)
    assert [many.path(state) for state in some] == [one.path(state) for state in some]
    return found.states


@pytest.mark.parametrize("compacted", [False, True])
@pytest.mark.parametrize(("limits", "least"), [(Limits(), 1000), (Limits(until=4), 100)])
def test_walkers(limits: Limits, least: int, compacted: bool) -> None:
    """With fingerprints local states are given up after each level."""
    assert _compare(_walkers(3, 8).program, "ftts", (0, 1), limits, compacted) > least


DICE = """
reactiveclass Dice(2) {
  statevars { int sum; }
  Dice() { self.roll(); }
  msgsrv roll() {
    sum = ?(%TENS%) + ?(%ONES%);
    self.roll() after(1);
  }
}
main { Dice a():(); }
"""


@pytest.mark.parametrize(("most", "workers"), [(600, 2), (90_000, 3), (90_000, 1)])
def test_many_local_states_of_one_rebec(most: int, workers: int) -> None:
    """Of 90,000 in one text the numbers take four bytes, of 300 or 30,000 two."""
    sides = range(0, most, 300), range(300)
    tens, ones = (", ".join(map(str, side)) for side in sides)
    program = System.of(DICE.replace("%TENS%", tens).replace("%ONES%", ones)).program
    assert _compare(program, "ftts", (), Limits(states=most), False, workers) >= most


@pytest.mark.parametrize(
    ("features", "view"),
    [(DRIVEN, "ftts"), (DRIVEN, "tts"), (CLOCKED, "tts"), (UNTIMED, "core")],
)
@settings(max_examples=max(4, settings().max_examples // 10))
@given(data=st.data())
def test_drawn_systems(features: Features, view: Semantics, data: st.DataObject) -> None:
    drawn = data.draw(systems(features))
    system = System.of(drawn.model, drawn.properties)
    limits = Limits(states=2000, until=12 if features.clock else None)
    one = CompiledSearch(system.program, view, system.invariants()).run(limits)
    assume(one.states < 2000)
    compacted = data.draw(st.booleans())
    _compare(system.program, view, system.invariants(), limits, compacted)
