"""Models that are large in one thing: nothing breaks, and bounds hold."""

from __future__ import annotations

import pytest

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Exploration, Limits, Unavailable
from rebsync.checker.search import Interpreted
from tests.checker.comparing import System

ENGINES = pytest.mark.parametrize("engine", [Interpreted, CompiledSearch])


CHOOSER = """\
reactiveclass A(2) {
  statevars { int x; }
  A() { self.go(); }
  msgsrv go() { for (int i = 0; i < 60; i++) { x = ?(1, 2); } }
}
main { A a():(); }
"""


def searched(engine: type[Interpreted | CompiledSearch], model: str, limits: Limits) -> Exploration:
    try:
        return engine(System.of(model).program, "ftts").run(limits)
    except Unavailable as unavailable:
        pytest.skip(f"no compiled engine: {unavailable}")


@ENGINES
def test_a_system_of_many_rebecs(engine: type[Interpreted | CompiledSearch]) -> None:
    instances = " ".join(f"A a{n}():();" for n in range(1200))
    model = (
        f"reactiveclass A(2) {{ A() {{ self.go(); }} msgsrv go() {{ }} }} main {{ {instances} }}"
    )
    found = searched(engine, model, Limits(states=2))
    assert found.reason == "the bound of 2 states was reached"
    assert found.depth == 1


@ENGINES
def test_a_body_that_chooses_in_too_many_ways(engine: type[Interpreted | CompiledSearch]) -> None:
    found = searched(engine, CHOOSER, Limits(seconds=0.2 if engine is Interpreted else 60.0))
    if engine is Interpreted:
        assert found.reason == "the bound of 0.2 seconds was reached"
        assert found.seconds < 2
    else:
        assert str(found.reason).startswith("the body of A.go did not end within ")
    assert (found.states, found.transitions) == (1, 0)


def test_both_engines_stop_at_one_number_of_ways(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rebsync.checker.outcomes.WAYS", 7)
    three = searched(Interpreted, CHOOSER.replace("60", "3"), Limits())
    assert str(three.reason).startswith("the body of A.go did not end within ")
    assert searched(Interpreted, CHOOSER.replace("60", "2"), Limits()).reason is None


@ENGINES
def test_numbers_beyond_what_c_holds(engine: type[Interpreted | CompiledSearch]) -> None:
    model = CHOOSER.replace("60", "1").replace("A(2)", f"A({2**31 - 1})")
    found = searched(engine, model.replace("x = ", "self.go(); x = "), Limits(states=9))
    assert [event.cause for event in found.events] == []
    found = searched(engine, CHOOSER.replace("60", "1"), Limits(states=2**64 + 1, until=2**64))
    assert (found.reason, found.states) == (None, 3)
