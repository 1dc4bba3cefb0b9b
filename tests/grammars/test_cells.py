"""`[cells]` of rebsync.toml: what gives the cells of robots, and what is said about mistakes."""

from __future__ import annotations

import pytest

from rebsync.config import parse_config
from rebsync.diagnostics import RebsyncError
from rebsync.grammars.cells import parse_cells
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse
from rebsync.static.cells import CellOf, Start

MODEL = """
env int wide = 4;
@Robot reactiveclass R(2) {
  statevars { int cell; int[2] pos; boolean up; float f; }
  R() { self.go(); }
  msgsrv go() { @Move(X + 1, Y); delay(1); }
}
main { R one():(); R other():(); }
"""
ANALYSIS = analyse(parse_model(Source("model.rebeca", MODEL)).model)
STATE = {"cell": "6", "pos[0]": "3", "pos[1]": "-2", "up": "true", "f": "0.5"}


def cells(text: str) -> dict[str, CellOf]:
    source = Source("rebsync.toml", f"[cells]\n{text}\n")
    return parse_cells(source, parse_config(source), ANALYSIS)


@pytest.mark.parametrize(
    ("x", "y", "place"),
    [
        ('"cell"', '"0"', (6, 0)),
        ('"cell % wide"', "-1", (2, -1)),
        ('"cell < wide ? cell : 2 * wide - 1 - cell"', '"cell / wide"', (1, 1)),
        ('"self.pos[0] + 1"', '"-pos[1]"', (4, 2)),
        ('"up ? 1 : 0"', '"(int) f"', (1, 0)),
        ('"f"', '"pos[1] * 2"', (0.5, -4)),
    ],
)
def test_expressions_over_the_state(x: str, y: str, place: tuple[float, float]) -> None:
    start = cells(f"R = [{x}, {y}]")["R"].at(STATE, ANALYSIS.env)
    assert (start.x, start.y, start.known) == (*place, True)


@pytest.mark.parametrize("text", ["cell / 0", "up", "f ? 1 : 0"])
def test_what_has_no_value_is_not_known(text: str) -> None:
    found = cells(f'R = ["{text}", "7"]')["R"]
    assert found.at(STATE, ANALYSIS.env) == Start(0, 7, (None, "7"))


@pytest.mark.parametrize(
    ("text", "message", "hint"),
    [
        ('Q = ["1", "2"]', 'there is no rebec or class "Q" in the model', None),
        ('othr = ["1", "2"]', 'there is no rebec or class "othr" in the model', "other"),
        ('R = ["cel", "2"]', '"cel" is no state variable of "R"', "cell"),
        ('one = ["1", "pos[7]"]', '"pos[7]" is no state variable of "one"', "pos"),
        ('R = ["1 +", "2"]', '"1 +" is no expression', "as in the model"),
        ('R = ["1"]', "`R` must have two coordinates", 'R = ["x", "y"]'),
        ("R = [true, 1]", "`R` must have two coordinates", 'R = ["x", "y"]'),
        ('R = "x, y"', "`R` must have two coordinates", 'R = ["x", "y"]'),
    ],
)
def test_mistakes_are_told_with_their_place(text: str, message: str, hint: str | None) -> None:
    with pytest.raises(RebsyncError) as caught:
        cells(text)
    (findings,) = caught.value.findings
    (found,) = findings.diagnostics
    assert (found.code, found.message) == ("RS809", message)
    assert findings.source.position(found.span.start).line == 2
    assert hint is None or (found.hint is not None and hint in found.hint)


def test_no_cells_are_none() -> None:
    assert cells("") == {}
