"""A few hundred mutated inputs with every run of the tests; `python -m tests.fuzz` takes more."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fuzz.cases import case
from tests.fuzz.oracle import run
from tests.fuzz.running import Finding, run_inputs, warm_up


def test_inputs_are_the_same_for_the_same_seed() -> None:
    assert [case(7, n) for n in range(60)] == [case(7, n) for n in range(60)]


def test_no_command_fails() -> None:
    warm_up()
    found = [f for f in run_inputs(0, range(150), 240.0, 60.0) if isinstance(f, Finding)]
    assert not found, "\n".join(f.text() for f in found)


@pytest.mark.parametrize("seen", [False, True])
def test_the_oracle_sees_failures(
    seen: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is not blind: an exception, an escape, an odd status are found."""

    def broken(arguments: list[str]) -> int:
        if arguments[1] == "raise":
            raise ValueError("x")
        print("\x1b[2J" if arguments[1] == "escape" else "")
        return 9 if arguments[1] == "status" else 0

    monkeypatch.setattr("rebsync.cli.main", broken)
    assert run(("lint", "fine"), tmp_path, 9.0, seen).wrong == ""
    for what in ("raise", "escape", "status"):
        assert run(("lint", what), tmp_path, 9.0, seen).wrong
