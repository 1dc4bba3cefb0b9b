"""Of several violations the first run is told whole, of the others what is new in them."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.cli import main
from tests.consoles import ROOT

MODEL = ROOT / "examples/experiment2_unsafe/experiment2_unsafe.rebeca"


def told(capsys: pytest.CaptureFixture[str], *options: str) -> list[list[str]]:
    """The steps that are told of each violation: the numbers of their lines."""
    assert main(["verify", str(MODEL), *options]) == 3
    runs = capsys.readouterr().out.split("  step  time\n")[1:]
    lines = [[line[1:8].strip() for line in run.split("\n\n")[0].splitlines()] for run in runs]
    return [[number for number in run if number.isdecimal()] for run in lines]


def numbers(first: int, last: int) -> list[str]:
    return list(map(str, range(first, last + 1)))


def test_the_first_run_is_whole(capsys: pytest.CaptureFixture[str]) -> None:
    collision, left, deadlock = told(capsys, "--full")
    folded = told(capsys)
    assert folded[0] == collision == numbers(0, 24)
    assert folded[1] == left[-4:] == numbers(25, 28)
    assert folded[2] == deadlock[-4:]


def test_of_one_run_twice_the_last_step_is_told(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    two = "Assertion { a: robot1.pos[0] < 1; b: robot1.pos[0] == 0; }"
    properties = tmp_path / "two.property"
    properties.write_text(f"property {{ {two} }}\n", encoding="utf-8")
    first, second, _ = told(capsys, "--property", str(properties))
    assert second == first[-1:]


def test_a_cycle_is_whole(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    model = tmp_path / "walk.rebeca"
    walk = "statevars { int x; } W() { x = 0; self.go(); } msgsrv go() { x = (x + 1) % 9; %s }"
    again = "self.go() after(1);"
    text = f"reactiveclass W(3) {{ {walk.replace('%s', again)} }}\nmain {{ W w():(); }}\n"
    model.write_text(text, encoding="utf-8")
    properties = "property { Assertion { a: w.x < 4; } LTL { b: F(w.x == 20); } }\n"
    model.with_suffix(".property").write_text(properties, encoding="utf-8")
    assert main(["verify", str(model)]) == 3
    run = capsys.readouterr().out.partition("property b")[2]
    assert "steps before are not shown" not in run
    assert run.count("w.go() from w") == 9
