"""`rebsync verify --for-all` as a user runs it: one verdict for each value of constants."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import click
import pytest
from jsonschema import Draft202012Validator  # type: ignore[import-untyped]

from rebsync.cli.problem import analysed
from rebsync.cli.sweep import parameter, with_values
from rebsync.cli.swept import Swept
from rebsync.source import Source
from tests.cli.run import ROOT, rebsync

SCHEMA = json.loads((ROOT / "docs" / "sweep.schema.json").read_text())
MODEL = """\
env int limit = 3;
env int step = 1; env boolean quick = true;

reactiveclass Walker(2) {
  statevars { int place; }
  Walker() { self.go(); }
  msgsrv go() {
    place = (place + step) % 6;
    self.go() after(quick ? 1 : 2);
  }
}

main { Walker walker():(); }
"""
PROPERTY = "property { Assertion { Low: walker.place <= limit; } }\n"


@pytest.fixture
def model(tmp_path: Path) -> str:
    (tmp_path / "walker.rebeca").write_text(MODEL)
    (tmp_path / "walker.property").write_text(PROPERTY)
    return "walker.rebeca"


def _swept(model: str, cwd: Path, *ranges: str, status: int) -> list[dict[str, Any]]:
    options = [option for each in ranges for option in ("--for-all", each)]
    options += ["--measure", "walker.place * 2"]
    done = rebsync("verify", model, *options, "--format", "json", cwd=cwd)
    assert (done.status, done.err) == (status, "")
    found = json.loads(done.out)
    Draft202012Validator(SCHEMA).validate(found)
    results: list[dict[str, Any]] = found["results"]
    return results


def test_each_value_has_the_verdict_of_a_model_with_it(model: str, tmp_path: Path) -> None:
    results = _swept(model, tmp_path, "env.limit=2..6", "step=1,2,5", status=3)
    reached = {"1": 5, "2": 4, "5": 5}
    assert [tuple(r["values"].values()) for r in results] == [
        (limit, step) for limit in range(2, 7) for step in (1, 2, 5)
    ]
    for result in results:
        values = result["values"]
        holds = reached[str(values["step"])] <= values["limit"]
        assert result["verdict"] == ("satisfied" if holds else "violated")
        assert result["properties"] == {"Low": result["verdict"]}
        assert [v["name"] for v in result["violations"]] == ([] if holds else ["Low"])
        most = 2 * reached[str(values["step"])]
        assert result["measures"] == {"walker.place * 2": {"least": 0, "greatest": most}}
        assert result["states"] == {1: 6, 2: 3, 5: 6}[values["step"]]


def test_the_table_says_for_which_values_it_holds(model: str, tmp_path: Path) -> None:
    done = rebsync("verify", model, "--for-all", "env.limit=3..7", cwd=tmp_path)
    assert done.status == 3
    lines = done.out.splitlines()
    assert lines[3].split() == ["3", "violated", "6", "Low"]
    assert lines[-2:] == [
        "satisfied for 3 of 5: limit = 5..7",
        "violated for 2 of 5: limit = 3, 4",
    ]


def test_a_bound_holds_for_each_search(model: str, tmp_path: Path) -> None:
    options = ("--for-all", "quick=true,false", "--max-states", "2")
    done = rebsync("verify", model, *options, cwd=tmp_path)
    assert done.status == 4
    assert "undetermined for 2 of 2: quick = true, false" in done.out
    assert done.out.count("the bound of 2 states was reached") == 2


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("limti=1..2", 'RS928 the model has no constant "limti"'),
        ("limit=1,99999999999", "RS305"),
        ("limit=0..99 --for-all step=0..999", "more than 10,000 searches"),
        ("limit=1 --for-all env.limit=2", "names a constant twice"),
    ],
)
def test_what_cannot_be_swept_is_a_mistake(
    model: str, tmp_path: Path, text: str, said: str
) -> None:
    done = rebsync("verify", model, "--for-all", *text.split(), cwd=tmp_path)
    assert done.status == 2
    assert said in done.err


def test_a_parameter_is_a_range_or_a_list() -> None:
    assert parameter("env.a=-1..1") == Swept("a", ("-1", "0", "1"))
    assert parameter(" b = 2, 0.5,2 ") == Swept("b", ("2", "0.5"))


@pytest.mark.parametrize("text", ["a", "a=2..1", "a=1..", "a=0..10000", "a=b", "a b=1"])
def test_what_is_neither_is_refused(text: str) -> None:
    with pytest.raises(click.UsageError):
        parameter(text)


def test_values_change_nothing_else_of_the_text() -> None:
    source = Source("walker.rebeca", MODEL)
    env = analysed(source).env
    declared = [env["limit"].declaration, env["quick"].declaration]
    text = with_values(MODEL, declared, ("10", "false"))
    assert text == MODEL.replace("limit = 3", "limit = 10").replace("= true", "= false")


def test_the_table_is_drawn(model: str, tmp_path: Path) -> None:
    """A cell for each verdict, and a line for the least and for the greatest value."""
    options = ["--for-all", "limit=2..4", "--for-all", "step=1,2", "--measure", "walker.place"]
    done = rebsync("verify", model, *options, "--format", "svg", cwd=tmp_path)
    assert done.status == 3
    drawn = ElementTree.fromstring(done.out)
    told = [title.text for title in drawn.iter("{http://www.w3.org/2000/svg}title")]
    assert told[0] == "walker.rebeca: verdicts by the values of limit, step"
    columns = [f"{limit}, {step}" for limit in (2, 3, 4) for step in (1, 2)]
    cells = [(each, "satisfied" if each == "4, 2" else "violated") for each in columns]
    for name in ("verdict", "Low"):
        assert [t for t in told if f": {name} " in str(t)] == [
            f"{values}: {name} {verdict}" for values, verdict in cells
        ]
    assert [t for t in told if "greatest" in str(t)] == [
        f"{values}: greatest {5 if values.endswith('1') else 4}" for values, _ in cells
    ]
    assert len(drawn.findall(".//{http://www.w3.org/2000/svg}path[@class='way']")) == 2


# --- bisection

BORDERS = """\
property { Assertion { Low: walker.place <= limit; High: limit < 9; Odd: %s; } }
"""


def _bisected(cwd: Path, odd: str, *more: str) -> tuple[dict[int, dict[str, Any]], str]:
    """The results by value, and what is told beside them."""
    (cwd / "walker.property").write_text(BORDERS % odd)
    options = ("--for-all", "limit=0..15", "--monotone", "--format", "json", *more)
    done = rebsync("verify", "walker.rebeca", *options, cwd=cwd)
    found = json.loads(done.out)
    Draft202012Validator(SCHEMA).validate(found)
    return {each["values"]["limit"]: each for each in found["results"]}, done.err


def _searched(results: dict[int, dict[str, Any]]) -> list[int]:
    return [value for value, each in results.items() if each["states"] is not None]


def test_one_border_takes_six_searches(model: str, tmp_path: Path) -> None:
    """Values are taken from the least on, however they are written."""
    values = ",".join(map(str, reversed(range(16))))
    done = rebsync("verify", model, "--for-all", f"limit={values}", "--monotone", cwd=tmp_path)
    assert (done.status, done.err) == (3, "")
    lines = done.out.splitlines()
    assert lines[3].split() == ["0", "violated", "6", "Low"]
    assert lines[4].split() == ["1", "violated,", "if", "monotone"]
    assert lines[-4:] == [
        "satisfied for 3 of 16: limit = 5, 7, 15",
        "satisfied, if monotone for 8 of 16: limit = 6, 8..14",
        "violated for 3 of 16: limit = 0, 3, 4",
        "violated, if monotone for 2 of 16: limit = 1, 2",
    ]


def test_each_property_has_its_own_border(model: str, tmp_path: Path) -> None:
    """Of one that changes between two values that are not searched nothing can be known."""
    results, told = _bisected(tmp_path, "limit != 13")
    assert (told, _searched(results)) == ("", [0, 3, 4, 5, 7, 8, 9, 11, 15])
    for limit, each in results.items():
        suffix = "" if each["states"] else ", if monotone"
        holds = {"Low": limit >= 5, "High": limit < 9, "Odd": True}
        assert each["properties"] == {
            name: ("satisfied" if true else "violated") + suffix for name, true in holds.items()
        }
        assert each["verdict"] == ("satisfied" if 5 <= limit < 9 else "violated") + suffix


def test_a_contradiction_is_told_and_all_is_searched(model: str, tmp_path: Path) -> None:
    results, told = _bisected(tmp_path, "limit < 4 || limit > 10")
    assert _searched(results) == [*range(16)]
    assert 'RS935 "Odd" is not monotone: satisfied for 0, violated for 4, satisfied for 11' in told
    assert [v for v, each in results.items() if each["properties"]["Odd"] == "violated"] == [
        *range(4, 11)
    ]


def test_what_is_always_checked_has_a_border(model: str, tmp_path: Path) -> None:
    """A deadlock from some value on is no verdict of a property."""
    (tmp_path / "walker.property").unlink()
    ends = MODEL.replace("self.go() after", "if (limit < 9) self.go() after")
    (tmp_path / "walker.rebeca").write_text(ends)
    options = ("--for-all", "limit=0..15", "--monotone", "--format", "json")
    results = json.loads(rebsync("verify", model, *options, cwd=tmp_path).out)["results"]
    verdicts = [each["verdict"].split(",")[0] for each in results]
    assert verdicts == ["satisfied"] * 9 + ["violated"] * 7
    assert sum(each["states"] is not None for each in results) == 6


def test_what_is_undetermined_has_no_border(model: str, tmp_path: Path) -> None:
    results, told = _bisected(tmp_path, "true", "--max-states", "2")
    assert (told, _searched(results)) == ("", [*range(16)])


def test_what_was_not_searched_is_drawn_so(model: str, tmp_path: Path) -> None:
    options = ("--for-all", "limit=2..9", "--monotone", "--format", "svg")
    drawn = rebsync("verify", model, *options, cwd=tmp_path).out
    assert "8: Low satisfied, if monotone" in drawn
    assert "9: Low satisfied<" in drawn
    assert "if monotone</text>" in drawn


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("--monotone", "about the values of --for-all"),
        ("--monotone --for-all limit=1..2 --for-all step=1..2", "the values of one --for-all"),
        ("--monotone --for-all quick=true,false", "about numbers"),
    ],
)
def test_what_has_no_order_is_refused(model: str, tmp_path: Path, options: str, said: str) -> None:
    done = rebsync("verify", model, *options.split(), cwd=tmp_path)
    assert done.status == 2
    assert said in done.err
