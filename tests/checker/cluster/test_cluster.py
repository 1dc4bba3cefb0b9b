"""A cluster finds what one machine finds: a real Ray of four workers on this one."""

from __future__ import annotations

import os
import shutil
import signal
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from typing import Any
from unittest import mock

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rebsync.checker.cluster import NoCluster
from rebsync.checker.cluster.connecting import connected
from rebsync.checker.cluster.pool import Pool
from rebsync.checker.cluster.search import NO_GRAPH, ClusterSearch
from rebsync.checker.cluster.shard import Task
from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Exploration, Faults, Limits
from rebsync.checker.problem import Cluster, Options, Problem
from rebsync.checker.program import Program
from rebsync.checker.reduction import PersistentSets, persistent_sets
from rebsync.checker.result import Result
from rebsync.checker.search import FIRST
from rebsync.checker.steps import Semantics
from rebsync.checker.verify import verify
from tests.checker.comparing import System
from tests.checker.draw_networks import networks
from tests.checker.draw_outlines import Features
from tests.checker.draw_systems import TIMED, UNTIMED, Drawn, systems
from tests.checker.test_compiled import _walkers
from tests.checker.test_models import ROWS, Expected, read

pytest.importorskip("ray", reason="Ray is not installed: pip install 'rebsync[cluster]'")

pytestmark = [
    pytest.mark.skipif(not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler"),
    pytest.mark.filterwarnings("ignore"),  # those of Ray
]

_MOST = 4
_IN_CI = "CI" in os.environ  # each row starts workers
_ALL = Limits()


@pytest.fixture(scope="module", autouse=True)
def _ray() -> Iterator[None]:
    """Ray on this machine, with as many workers as any test wants."""
    crew, _ = connected(Cluster("local", _MOST))
    yield
    crew.ray.shutdown()


def _same(
    program: Program,
    view: Semantics,
    invariants: tuple[int, ...] = (),
    persistent: PersistentSets = (),
    limits: Limits = _ALL,
    workers: int = 2,
    compacted: bool = False,
) -> tuple[Exploration, ClusterSearch]:
    """What a cluster finds, after a comparison with one machine: figures, events, runs."""
    one = CompiledSearch(program, view, invariants, persistent)
    many = ClusterSearch(
        program, view, invariants, persistent, Cluster("local", workers), compacted
    )
    expected, found = one.run(limits), many.run(limits)
    assert _figures(found) == _figures(expected)
    some = range(0, found.states, 1 + found.states // 4)
    assert [many.path(state) for state in some] == [one.path(state) for state in some]
    return found, many


def _figures(exploration: Exploration) -> tuple[object, ...]:
    found = exploration
    return found.states, found.transitions, found.depth, found.events, found.covered, found.reason


@pytest.mark.parametrize(
    "row", ROWS[:: 8 if _IN_CI else 1], ids=lambda row: f"{row.model}-{row.view}"
)
def test_all_models(row: Expected) -> None:
    """With states in full and with fingerprints, by two workers and by four."""
    system, number = read(row.model), ROWS.index(row)
    workers, compacted = (2, 4)[number % 2], number % 4 > 1
    found, _ = _same(
        system.program, row.view, system.invariants(), workers=workers, compacted=compacted
    )
    assert (found.states, found.transitions) == (row.states, row.transitions)


# --- workers that are lost -----------------------------------------------------------------------


@contextmanager
def _killing(*kills: tuple[int, str, int]) -> Iterator[list[int]]:
    """Ends the process of a worker as soon as it is called for a phase of a level.

    Each is (the how-manieth call of this name, the name, the worker). Gives who was ended.
    """
    call, calls, ended = Pool._report, Counter[str](), list[int]()

    def report(pool: Pool, number: int) -> Any:  # noqa: ANN401 - what Ray gives
        name = pool._members[number].calls[-1][0]
        if number == 0:
            calls[name] += 1
        if (calls[name], name, number) in kills and number not in ended:
            os.kill(_process(pool._members[number].actor), signal.SIGKILL)
            ended.append(number)
        return call(pool, number)

    with mock.patch.object(Pool, "_report", report):
        yield ended


def _process(actor: Any) -> int:  # noqa: ANN401 - of Ray
    import ray

    return int(ray.get(actor.__ray_call__.remote(lambda _: os.getpid())))


@pytest.mark.parametrize("compacted", [False, True])
def test_a_worker_of_two_is_lost(compacted: bool) -> None:
    """It has some ten levels behind it, which the one in its place has from checkpoints."""
    system = _walkers(3, 8)
    with _killing((12, "expand", 1)) as ended:
        found, _ = _same(system.program, "ftts", (0, 1), compacted=compacted)
    assert ended == [1]
    assert "workers that were lost, and replaced: 1" in found.notes
    assert found.events


def test_each_worker_of_four_is_lost_in_another_phase() -> None:
    """Of a search whose texts are so long that they lie in the store of objects."""
    system = _walkers(3, 18)
    kills = (3, "expand", 0), (6, "receive", 1), (9, "rank", 2), (12, "accept", 3)
    with _killing(*kills) as ended:
        found, search = _same(system.program, "ftts", (0, 1), workers=4)
    assert ended == [0, 1, 2, 3]
    assert "workers that were lost, and replaced: 4" in found.notes
    assert search.traffic.checkpoints > 100_000 * 4 * (found.depth + 1)


def test_runs_are_told_without_workers() -> None:
    system = _walkers(2, 5)
    _, search = _same(system.program, "ftts")
    path = search.path(30)
    for number in range(2):
        os.kill(_process(search._crew.actor(number)), signal.SIGKILL)
    assert search.path(30) == path


def test_workers_that_are_lost_again_and_again_end_the_search() -> None:
    """Nothing that is left out counts as seen."""
    system = _walkers(2, 5)
    report = Pool._report

    def killed(pool: Pool, number: int) -> Any:  # noqa: ANN401 - what Ray gives
        with suppress(pool._ray.exceptions.RayActorError):  # it has been ended in the phase before
            os.kill(_process(pool._members[number].actor), signal.SIGKILL)
        return report(pool, number)

    with (
        mock.patch.object(Pool, "_report", killed),
        mock.patch("rebsync.checker.cluster.pool.PATIENCE", 0),
    ):
        search = ClusterSearch(system.program, "ftts", (), (), Cluster("local", 2))
        found = search.run(Limits())
    assert found.reason
    assert found.reason.startswith("workers of the cluster were lost again and again")
    assert found.states == 0


# --- drawn systems, and options ------------------------------------------------------------------

_FEW = settings(max_examples=3)  # each is compiled


@pytest.mark.parametrize(("features", "view"), [(TIMED, "tts"), (UNTIMED, "core")])
@_FEW
@given(data=st.data())
def test_drawn_systems(features: Features, view: Semantics, data: st.DataObject) -> None:
    drawn: Drawn = data.draw(systems(features))
    system = System.of(drawn.model, drawn.properties)
    limits = Limits(states=3000)
    one = CompiledSearch(system.program, view, system.invariants()).run(limits)
    assume(one.states < 3000)
    _same(system.program, view, system.invariants(), limits=limits, workers=3)


@_FEW
@given(drawn=networks())
def test_orders_that_are_left_out(drawn: Drawn) -> None:
    program = System.of(drawn.model, drawn.properties).program
    _same(program, "ftts", (), persistent_sets(program, "ftts"), Limits(until=30))


def _problem(row: Expected) -> Problem:
    system = read(row.model)
    assertions = replace(system.properties, ltl=(), tctl=())
    return Problem(system.source, system.analysis, assertions)


def _told(result: Result) -> tuple[object, ...]:
    runs = [(v.kind, v.name, v.message, v.trace) for v in result.violations]
    figures = result.states, result.transitions, result.depth
    return result.verdict, result.properties, runs, result.coverage, *figures


@pytest.mark.parametrize(
    "row", ROWS[:: 24 if _IN_CI else 5], ids=lambda row: f"{row.model}-{row.view}"
)
def test_verify_tells_what_it_tells_of_one_machine(row: Expected) -> None:
    """All but whether time can stand still, for which the verdict stays open."""
    problem = _problem(row)
    one = verify(problem, Options(row.view, "compiled"))
    many = verify(problem, Options(row.view, cluster=Cluster("local", 2)))
    if many.reason == NO_GRAPH:
        still = [v for v in one.violations if v.kind == "zeno"]
        kept = tuple(v for v in one.violations if v not in still)
        one = replace(one, violations=kept, verdict="violated" if kept else "undetermined")
    assert _told(many) == _told(one)
    assert many.engine == "cluster"


def test_bounds() -> None:
    """A search ends between two levels; what it has found by then is told."""
    system = _walkers(3, 8)

    def found(limits: Limits) -> Exploration:
        return ClusterSearch(system.program, "ftts", (0, 1), (), Cluster("local", 2)).run(limits)

    whole = found(Limits())
    some = found(Limits(states=500))
    assert some.reason == "the bound of 500 states was reached"
    assert 500 <= some.states < whole.states
    assert found(Limits(seconds=0.0)).reason == "the bound of 0 seconds was reached"
    assert found(Limits(memory=1)).reason == "the bound of 1 bytes of memory was reached"
    first = found(Limits(first=True, faults=Faults(frozenset((0, 1)))))
    assert first.reason == FIRST
    assert first.events[0] == whole.events[0]
    assert first.depth < whole.depth
    _same(system.program, "ftts", (0, 1), limits=Limits(until=4))


def test_a_body_that_does_not_end() -> None:
    """It ends the search where one machine ends it; what was found before is told."""
    system = System.of(ENDLESS)
    limits = Limits(instructions=10_000)
    one = CompiledSearch(system.program, "tts").run(limits)
    many = ClusterSearch(system.program, "tts", (), (), Cluster("local", 3)).run(limits)
    assert one.cut
    assert one.events
    assert (many.cut, many.reason, many.events) == (one.cut, one.reason, one.events)
    assert many.states == one.states


# With 3 the second step does not end; what the others could reach then, one machine has not seen.
ENDLESS = """
reactiveclass Counter(3) {
  statevars { int n; }
  Counter() { self.begin(); }
  msgsrv begin() { n = ?(10, 3, 20, 30, 40, 50, 60); self.count() after(1); }
  msgsrv count() {
    n = n + 1;
    int luck = ?(0, 1);
    assertion(n != 11 || luck == 1);
    while (n == 5) { n = 5; }
    self.count() after(1);
  }
}
main { Counter a():(); }
"""


def test_more_workers_than_processors() -> None:
    with pytest.raises(NoCluster, match=f"has {_MOST} processors for 99 workers"):
        connected(Cluster("local", 99))


def test_machines_with_different_versions() -> None:
    """They would not agree on what a state is."""
    system = _walkers(2, 5)
    with mock.patch.object(Task, "seal", "another"), pytest.raises(NoCluster, match="versions"):
        ClusterSearch(system.program, "ftts", (), (), Cluster("local", 2)).run(Limits())
