"""Bodies that do not end: told by a state that repeats, or by a bound; and long ones that do."""

from __future__ import annotations

import shutil
from typing import TypeAlias

import pytest

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.endless import endless_reason
from rebsync.checker.exploration import Exploration, Limits
from rebsync.checker.search import Interpreted
from rebsync.checker.steps import Failure, Semantics
from tests.checker.comparing import System

Engine: TypeAlias = Interpreted | CompiledSearch
ENGINES: tuple[type[Engine], ...] = (Interpreted,)
if any(map(shutil.which, ("cc", "gcc", "clang"))):
    ENGINES = (Interpreted, CompiledSearch)

MODEL = """\
reactiveclass A(3) {
    statevars { int x; }
    A() { CONSTRUCTOR }
    msgsrv go(boolean on) {
        GO
    }
    int f(int n) {
        F
    }
}
main { A a():(); }
"""


def written(go: str, f: str = "return n;", constructor: str = "self.go(true);") -> System:
    text = MODEL.replace("CONSTRUCTOR", constructor).replace("GO", go)
    return System.of(text.replace("F\n", f"{f}\n"))


def searched(
    go: str = "",
    f: str = "return n;",
    constructor: str = "self.go(true);",
    view: Semantics = "tts",
    instructions: int = 10_000_000,
) -> tuple[str | None, list[Exploration]]:
    """Why the engines did not see all, in one text; and what they found."""
    system = written(go, f, constructor)
    found = [
        engine(system.program, view).run(Limits(instructions=instructions)) for engine in ENGINES
    ]
    reasons = {
        endless_reason(system.program, one.cut, system.source) if one.cut else one.reason
        for one in found
    }
    (reason,) = reasons
    return reason, found


REPEATS = (
    "the body of {} did not end, and never does: a loop{} at line {} comes back to the same values"
)


@pytest.mark.parametrize(
    ("parts", "reason"),
    [
        ({"go": "while (on) { }"}, REPEATS.format("A.go", "", 5)),
        ({"go": "for (;;) { x = 1; }"}, REPEATS.format("A.go", "", 5)),
        ({"constructor": "while (true) { }"}, REPEATS.format("A.A", "", 3)),
        (
            {"go": "while (on) { x = f(x); }", "f": "return (n + 1) % 7;"},
            REPEATS.format("A.go", "", 5),
        ),
        (
            {"go": "if (on) { x = f(1); }", "f": "while (n != 0) { n = n ^ 2; } return n;"},
            REPEATS.format("A.go", " in A.f", 8),
        ),
        (
            {"go": "int i = 5;\n while (on) { i = (i + 1) % 9; for (int k = i; k > 0; k--) { } }"},
            REPEATS.format("A.go", "", 6),
        ),
        (
            {"go": "while (on) { delay(0); }", "view": "ftts"},
            REPEATS.format("A.go", "", 5),
        ),
    ],
)
def test_what_comes_back_to_its_state_never_ends(parts: dict[str, str], reason: str) -> None:
    assert searched(**parts)[0] == reason  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("parts", "instructions", "reason"),
    [
        (
            {"go": "while (on) { x++; }"},
            2000,
            "the body of A.go did not end within 2,000 instructions: it was running at line 5",
        ),
        (
            {"go": "x = f(x);", "f": "while (true) { n++; } return n;"},
            2001,
            "the body of A.go did not end within 2,001 instructions: "
            "it was running in A.f at line 8",
        ),
        (
            {"go": "while (on) { x++; }", "view": "ftts"},
            1_100_003,
            "the body of A.go did not end within 1,100,003 instructions: it was running at line 5",
        ),
        (
            {"go": "x = f(x);", "f": "return f(n + 1);"},
            10_000_000,
            "the body of A.go did not end within 10,000 calls inside each other: "
            "it was running in A.f at line 8",
        ),
    ],
)
def test_the_bounds_say_what_was_running(
    parts: dict[str, str], instructions: int, reason: str
) -> None:
    found, _ = searched(**parts, instructions=instructions)  # type: ignore[arg-type]
    assert found == reason


def test_long_bodies_end() -> None:
    reason, found = searched("for (int i = 0; i < 120000; i++) { x = x ^ (i % 64); }")
    assert reason is None
    assert {(one.states, one.transitions) for one in found} == {(2, 1)}


def test_choices_are_no_repetition(monkeypatch: pytest.MonkeyPatch) -> None:
    """The loop can be left at each round: it is not one that never ends."""
    monkeypatch.setattr("rebsync.checker.machine.WAYS", 100)
    program = written("while (?(true, false)) { }").program
    found = [engine(program, "tts").run(Limits()) for engine in ENGINES]
    for one in found:
        assert str(one.reason).startswith("the body of A.go did not end within ")
        assert str(one.reason).endswith(" ways to choose")


def test_sending_for_ever_is_an_overflow() -> None:
    text = """\
reactiveclass A(3) {
    knownrebecs { B b; }
    A() { self.go(); }
    msgsrv go() { while (true) { b.take(); } }
}
reactiveclass B(5) { B() { } msgsrv take() { } }
main { A a(b):(); B b():(); }
"""
    program = System.of(text).program
    for engine in ENGINES:
        found = engine(program, "tts").run(Limits())
        (event,) = found.events
        assert found.reason is None
        assert isinstance(event.cause, Failure)
        assert (event.cause.kind, event.cause.rebec) == ("overflow", 1)
        assert (found.states, found.transitions) == (1, 1)


def test_a_search_is_given_up_at_the_same_body_again() -> None:
    program = written("while (on) { }").program
    for engine in ENGINES[-1:]:
        search = engine(program, "tts")
        assert search.run(Limits()).reason == search.run(Limits()).reason is not None
