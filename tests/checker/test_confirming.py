"""What a search says is wrong is seen again at the end of its run."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given

from rebsync.checker.confirming import confirmed
from rebsync.checker.exploration import Event, Limits
from rebsync.checker.search import Interpreted
from rebsync.checker.telling import Teller
from tests.checker.comparing import System
from tests.checker.draw_systems import TIMED, Drawn, systems

MODEL = """\
reactiveclass A(3) {
  statevars { int x; }
  A() { self.go(); }
  msgsrv go() { x = ?(1, 2); assertion(x < 2); if (x < 2) { self.go() after(1); } }
}
main { A a():(); }
"""
PROPERTIES = "property { define { one = a.x == 1; } Assertion { never: !one; } }"


def _searched(system: System) -> tuple[Teller, Interpreted, tuple[Event, ...]]:
    search = Interpreted(system.program, "ftts", system.invariants())
    found = search.run(Limits(states=300))
    return Teller(search.view, system.source), search, found.events


@given(drawn=systems(TIMED))
def test_what_is_found_is_confirmed(drawn: Drawn) -> None:
    teller, search, events = _searched(System.of(drawn.model, drawn.properties))
    for event in events:
        path = search.path(event.state)
        assert confirmed(teller, path, event) == path
        assert confirmed(teller, path, Event("", event.state)) == path


def test_what_is_not_there_is_not_confirmed() -> None:
    teller, search, events = _searched(System.of(MODEL, PROPERTIES))
    assert {type(event.cause).__name__ for event in events} == {"Failure", "int"}
    for event in events:
        path = search.path(event.state)
        wrong = [
            (path[:-1], event) if event.ordinal < 0 else (path, replace(event, ordinal=0)),
            ((*path, 99), event),
            (path, replace(event, cause="deadlock")),
        ]
        for other, claim in wrong:
            with pytest.raises(RuntimeError, match="does not show"):
                confirmed(teller, other, claim)
