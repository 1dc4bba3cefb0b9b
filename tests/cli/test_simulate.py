"""`rebsync simulate` as a user runs it."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.cli.run import ROOT, rebsync

MODEL = str(ROOT / "examples" / "experiment3" / "experiment3.rebeca")
ONCE = """\
reactiveclass A(2) {
  statevars { int x; }
  A() { self.go(); }
  int f(int n) { return f(n) + 1; }
  msgsrv go() { x = 1; }
}

main { A a():(); }
"""
UNSAFE = """\
reactiveclass Walker(2) {
  statevars { int place; }
  Walker() { self.go(); }
  msgsrv go() {
    place = place + ?(1, 2);
    assertion(place < 3, "too far");
    self.go() after(1);
  }
}

main { Walker walker():(); }
"""


def test_a_seed_repeats_a_run(tmp_path: Path) -> None:
    options = ("simulate", MODEL, "--format", "json", "--seed")
    first, again, other = (rebsync(*options, seed, cwd=tmp_path).out for seed in ("1", "1", "2"))
    assert first == again != other


def test_without_a_seed_it_is_told(tmp_path: Path) -> None:
    done = rebsync("simulate", MODEL, "--steps", "3", cwd=tmp_path)
    assert done.status == 0
    seed = done.err.split()[-1]
    again = rebsync("simulate", MODEL, "--steps", "3", "--seed", seed, cwd=tmp_path)
    assert again.out == done.out


@pytest.mark.parametrize(("option", "value"), [("--until", "7"), ("--steps", "7")])
def test_where_a_run_ends(tmp_path: Path, option: str, value: str) -> None:
    options = ("--seed", "3", "--format", "json", option, value)
    steps = json.loads(rebsync("simulate", MODEL, *options, cwd=tmp_path).out)["trace"]
    if option == "--steps":
        assert [s["number"] for s in steps] == list(range(8))
    else:
        assert max(s["until"] for s in steps) == 7


def test_a_run_that_fails(tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text(UNSAFE)
    done = rebsync("simulate", "m.rebeca", "--seed", "1", cwd=tmp_path)
    assert done.status == 3
    assert "too far" in done.out


def test_by_hand(tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text(UNSAFE)
    options = ("simulate", "m.rebeca", "--interactive", "--format", "json")
    done = rebsync(*options, cwd=tmp_path, stdin=b"1\n7\nx\n2\n")
    trace = json.loads(done.out)["trace"]
    assert [s["choices"] for s in trace] == [[], [1], [2]]
    assert done.status == 3
    left = rebsync(*options, cwd=tmp_path, stdin=b"1\nq\n")
    assert (left.status, len(json.loads(left.out)["trace"])) == (0, 2)


def test_by_hand_the_choices_can_be_told_apart(tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text(UNSAFE)
    done = rebsync("simulate", "m.rebeca", "--interactive", cwd=tmp_path, stdin=b"1\nq\n")
    assert "  1) walker.go() from walker, chooses 1\n  2) walker.go() from" in done.err
    assert "place: 0 -> 1\n" in done.err.partition("to end: ")[2]
    assert "place: 0 -> 1\n" in done.out


def test_a_simulated_run_can_be_made_again(tmp_path: Path) -> None:
    options = ("--seed", "5", "--format", "json")
    rebsync("simulate", MODEL, *options, "-o", "run.json", cwd=tmp_path)
    again = rebsync("verify", MODEL, "--replay", "run.json", "--format", "json", cwd=tmp_path)
    assert json.loads(again.out) == json.loads((tmp_path / "run.json").read_text())


@pytest.mark.parametrize("style", ["text", "svg", "html"])
def test_formats(tmp_path: Path, style: str) -> None:
    options = ("--seed", "5", "--format", style, "-o", "run.out")
    assert rebsync("simulate", MODEL, *options, cwd=tmp_path).status == 0
    assert "lidar" in (tmp_path / "run.out").read_text()


def test_a_hand_needs_no_seed(tmp_path: Path) -> None:
    done = rebsync("simulate", MODEL, "--interactive", "--seed", "1", cwd=tmp_path)
    assert done.status == 2


def test_a_body_that_does_not_end(tmp_path: Path) -> None:
    endless = ONCE.replace("x = 1;", "x = f(1);")
    (tmp_path / "m.rebeca").write_text(endless)
    done = rebsync("simulate", "m.rebeca", "--seed", "1", cwd=tmp_path)
    assert done.status == 4
    assert "the constructors run" in done.out
    assert "the body of A.go did not end within 10,000 calls" in done.err


@pytest.mark.parametrize("style", ["text", "json", "svg", "html"])
@pytest.mark.parametrize("main", ["", "A a():(0);"])
def test_runs_that_end_before_they_begin(tmp_path: Path, style: str, main: str) -> None:
    classes = "reactiveclass A(2) { statevars { int x; } A(int d) { x = 1 / d; } }"
    (tmp_path / "m.rebeca").write_text(f"{classes} main {{ {main} }}")
    done = rebsync("simulate", "m.rebeca", "--seed", "1", "--format", style, cwd=tmp_path)
    assert done.status == (3 if main else 0)
    assert done.out


def test_answers_that_are_none(tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text(ONCE.replace("main {", "main { A b():();"))
    answers = b"x\n\xff\n" + b"9" * 5000 + "\n\u00b2\n0\n1\n".encode()
    done = rebsync(
        "simulate",
        "m.rebeca",
        "--interactive",
        cwd=tmp_path,
        stdin=answers,
        env={"PYTHONIOENCODING": "utf-8:strict"},
    )
    assert done.status == 0
    assert done.err.count("q to end") == 6


def test_many_runs_are_a_distribution(tmp_path: Path) -> None:
    (tmp_path / "walker.rebeca").write_text(UNSAFE)
    runs = ("--runs", "40", "--seed", "5")
    options = ("simulate", "walker.rebeca", *runs, "--measure", "walker.place")
    done = rebsync(*options, "--format", "json", cwd=tmp_path)
    assert (done.status, done.err) == (3, "")
    found = json.loads(done.out)
    assert found["ends"] == {
        "assertion": {"runs": 40, "probability": [pytest.approx(0.91, abs=0.01), 1]}
    }
    greatest = found["measures"][0]["greatest"]
    assert [each["from"] for each in greatest["counts"]] == [1, 2]
    assert greatest["interval"][0] < 1.75 < greatest["interval"][1]
    told = rebsync(*options, cwd=tmp_path).out
    assert "40  fail: assertion (probability 0.91" in told
    assert "greatest of a run: mean 1." in told


@pytest.mark.parametrize(
    "options",
    [
        ("--measure", "walker.place"),
        ("--runs", "30", "--interactive"),
        ("--runs", "30", "--format", "svg"),
    ],
)
def test_a_distribution_is_of_many_runs(tmp_path: Path, options: tuple[str, ...]) -> None:
    (tmp_path / "walker.rebeca").write_text(UNSAFE)
    assert rebsync("simulate", "walker.rebeca", *options, cwd=tmp_path).status == 2


def test_the_page_marks_assertions_that_are_false(tmp_path: Path) -> None:
    (tmp_path / "walker.rebeca").write_text(UNSAFE.replace("assertion", "// assertion"))
    (tmp_path / "walker.property").write_text(
        "property { Assertion { Near: walker.place < 4; Whole: 6 / walker.place > 0; } }"
    )
    options = ("simulate", "walker.rebeca", "--seed", "1", "--steps", "8", "--format")
    page = rebsync(*options, "html", cwd=tmp_path).out
    steps = json.loads(rebsync(*options, "json", cwd=tmp_path).out)["trace"]
    places = [s["state"][0]["variables"]["place"] for s in steps]
    assert min(places) == 0
    assert max(places) >= 4
    marked = re.findall(r"<strong>property (\w+) (.*?) here</strong>", page)
    assert marked.count(("Near", "is false")) == sum(place >= 4 for place in places)
    assert marked.count(("Whole", "has no value")) == places.count(0)
    assert marked.count(("Whole", "is false")) == sum(place > 6 for place in places)
    chosen = rebsync(*options, "html", "--property-name", "Near", cwd=tmp_path).out
    assert ("Near is false" in chosen, "Whole is" in chosen) == (True, False)
    none = rebsync(*options, "html", "--property-name", "Nea", cwd=tmp_path)
    assert none.status == 2
    assert 'no property is called "Nea"' in none.err
