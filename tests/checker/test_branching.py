"""What else could happen in a run: all possible steps, the one taken, and runs along them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from rebsync.checker.branching import MOST_TOLD, NoSuchStep, branchings, run_along
from rebsync.checker.lowering import lower
from rebsync.checker.problem import Problem
from rebsync.checker.simulate import by_chance, walk
from rebsync.checker.state import State
from rebsync.checker.steps import Failure, Semantics
from rebsync.checker.telling import Teller
from rebsync.checker.trace import Trace
from rebsync.checker.views import view_of
from tests.checker.movement.moving import analysed

MODELS = sorted((Path(__file__).parent / "models").glob("*.rebeca"))
CHOICES = """\
reactiveclass Walker(2) {
  statevars { int place; }
  Walker() { place = 9; self.go(); }
  msgsrv go() { place = place + ?(1, 2); assertion(place < 11); self.go() after(1); }
}
main { Walker walker():(); }
"""
MANY = """\
reactiveclass A(2) {
  statevars { int x; }
  A() { self.go(); }
  msgsrv go() { x = ?(1, 2, 3, 4) * 10 + ?(1, 2, 3, 4, 5); }
}
main { A a():(); }
"""
ENDLESS = """\
reactiveclass A(2) {
  statevars { int x; }
  A() { self.go(); }
  msgsrv go() { x = 1; self.turn(); }
  msgsrv turn() { while (x > 0) { } }
}
main { A a():(); }
"""


def teller_of(problem: Problem, semantics: Semantics = "tts") -> Teller:
    """The teller of a model in a view."""
    program, _ = lower(problem.analysis)
    return Teller(view_of(program, semantics), problem.source)


def along(problem: Problem, seed: int, steps: int, semantics: Semantics = "tts") -> list[int]:
    """The ordinals of a run by chance, counted apart from what tells runs."""
    view = teller_of(problem, semantics).view
    chance = by_chance(seed)
    ordinals: list[int] = []

    def choose(time: int, state: object, possible: Sequence[object]) -> int:
        picked = chance(time, (), possible)  # type: ignore[arg-type]
        assert picked is not None
        ordinals.append(picked)
        return picked

    assert list(walk(view, choose, steps=steps))
    return ordinals


def without_end(trace: Trace) -> bool:
    return trace.steps[-1].failure is None


@pytest.mark.parametrize("semantics", ["tts", "ftts"])
@pytest.mark.parametrize("model", MODELS, ids=lambda path: path.stem)
def test_every_possible_step_is_told_and_can_be_followed(model: Path, semantics: Semantics) -> None:
    problem = analysed(model.read_text(encoding="utf-8"))
    ordinals = along(problem, 1, 8, semantics)
    teller = teller_of(problem, semantics)
    trace = run_along(teller, ordinals)
    found = branchings(teller, trace)
    assert [each.taken for each in found[: len(ordinals)]] == ordinals
    assert len(found) == len(ordinals) + without_end(trace)
    state: State = ()
    for number, branching in enumerate(found):
        steps = teller.view.steps(state) if number else teller.view.initial_states()
        assert branching.count == len(steps)
        assert len(branching.successors) >= min(branching.count, MOST_TOLD)
        for successor in branching.successors:
            other = run_along(teller, [*ordinals[:number], successor.ordinal])
            assert other.steps[:-1] == trace.steps[:number]
            assert other.steps[-1] == successor.step
        if number < len(ordinals):
            result = steps[ordinals[number]].result
            assert isinstance(result, Failure) == (trace.steps[number].failure is not None)
            if not isinstance(result, Failure):
                state = result


def test_what_is_possible_says_what_it_would_do() -> None:
    teller = teller_of(analysed(CHOICES))
    (start, after) = branchings(teller, run_along(teller, [0]))
    assert (start.taken, start.count) == (0, 1)
    assert (after.taken, after.count) == (None, 2)
    assert [s.step.choices for s in after.successors] == [("1",), ("2",)]
    assert [s.step.failure is not None for s in after.successors] == [False, True]


def test_after_a_step_that_fails_there_is_nothing() -> None:
    teller = teller_of(analysed(CHOICES))
    failed = run_along(teller, [0, 1])
    assert failed.steps[-1].failure is not None
    assert len(branchings(teller, failed)) == 2
    with pytest.raises(NoSuchStep, match="after a step that fails"):
        run_along(teller, [0, 1, 0])


@pytest.mark.parametrize("ordinals", [[1], [0, 2], [0, -1], [-1]])
def test_a_step_that_there_is_not_is_none(ordinals: list[int]) -> None:
    with pytest.raises(NoSuchStep) as found:
        run_along(teller_of(analysed(CHOICES)), ordinals)
    assert found.value.number == len(ordinals) - 1


def test_of_many_steps_the_first_are_told_and_the_one_that_is_taken() -> None:
    teller = teller_of(analysed(MANY))
    (_, here, after) = branchings(teller, run_along(teller, [0, 17]))
    assert [s.ordinal for s in here.successors] == [*range(MOST_TOLD), 17]
    assert (here.count, here.taken) == (20, 17)
    assert after.is_end


def test_a_body_that_does_not_end_makes_the_steps_unknown() -> None:
    teller = teller_of(analysed(ENDLESS))
    found = branchings(teller, run_along(teller, [0, 0]))
    assert not found[-1].is_end
    assert "did not end" in str(found[-1].unknown)
    with pytest.raises(NoSuchStep, match="did not end"):
        run_along(teller, [0, 0, 0])


def test_a_run_of_another_model_ends_where_it_differs() -> None:
    trace = run_along(teller_of(analysed(MANY)), [0, 17])
    found = branchings(teller_of(analysed(CHOICES)), trace)
    assert [each.taken for each in found] == [0, None]


def test_a_run_goes_on_by_chance_until_it_ends() -> None:
    teller = teller_of(analysed(MANY))
    ended = run_along(teller, [0], by_chance=50)
    assert [step.kind for step in ended.steps] == ["start", "take"]
    endless = run_along(teller_of(analysed(ENDLESS)), [0], by_chance=50)
    assert len(endless.steps) == 2
    (choices, many) = (analysed(CHOICES), 20)
    ends = {run_along(teller_of(choices), [0], by_chance=5).steps[1].choices for _ in range(many)}
    assert ends == {("1",), ("2",)}  # but for one chance in half a million
    failed = [run_along(teller_of(choices), [0, 1], by_chance=5) for _ in range(3)]
    assert {len(run.steps) for run in failed} == {2}
    with pytest.raises(NoSuchStep):
        run_along(teller, [1], by_chance=5)
