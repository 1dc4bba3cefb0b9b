"""`rebsync verify` as a user runs it."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from rebsync.cli import main
from tests.checker.test_reducing import FLEET, ONCE
from tests.cli.run import ROOT, environment, rebsync

EXAMPLES = ROOT / "examples"
WALK = """\
env int last = 3;

reactiveclass Walker(3) {
  statevars { int place; int[2] seen; }
  Walker() { self.go(1); }
  msgsrv go(int by) {
    place = place + by;
    if (place < last) { self.go(?(1, 2)) after(2) deadline(5); }
  }
}

main { Walker walker():(); }
"""
ENDLESS = """\
reactiveclass Counter(2) {
  statevars { int count; }
  Counter() { self.go(); }
  msgsrv go() { count++; self.go() after(1); }
}

main { Counter counter():(); }
"""


def verified(folder: Path, text: str, *options: str, properties: str = "") -> dict[str, Any]:
    """The JSON object for a model, with the exit status as `status`."""
    (folder / "m.rebeca").write_text(text)
    if properties:
        (folder / "m.property").write_text(f"property {{ {properties} }}")
    done = rebsync("verify", "m.rebeca", "--format", "json", *options, cwd=folder)
    assert done.out, done.err
    return {**json.loads(done.out), "status": done.status}


def kinds(result: dict[str, Any]) -> list[tuple[str, str]]:
    return [(v["kind"], v["name"]) for v in result["violations"]]


# --- verdicts ----------------------------------------------------------------------------------


def test_a_system_that_ends_is_a_deadlock_unless_that_is_allowed(tmp_path: Path) -> None:
    result = verified(tmp_path, WALK)
    assert (result["status"], kinds(result)) == (3, [("deadlock", "deadlock")])
    allowed = verified(tmp_path, WALK, "--allow", "deadlock")
    assert (allowed["status"], allowed["verdict"]) == (0, "satisfied")
    assert (allowed["states"], allowed["transitions"]) == (7, 7)


def test_property_beside_the_model_and_elsewhere(tmp_path: Path) -> None:
    inside = "Assertion { Near: walker.place <= last; }"
    result = verified(tmp_path, WALK, "--allow", "deadlock", properties=inside)
    assert result["properties"] == {"Near": "violated"}
    assert kinds(result) == [("property", "Near")]
    assert result["violations"][0]["trace"][-1]["time"] == 4
    (tmp_path / "other.property").write_text("property { Assertion { Low: walker.place < 9; } }")
    elsewhere = verified(tmp_path, WALK, "--allow", "deadlock", "--property", "other.property")
    assert elsewhere["properties"] == {"Low": "satisfied"}


def test_the_initial_state_counts(tmp_path: Path) -> None:
    properties = "Assertion { Moved: walker.place > 0; }"
    result = verified(tmp_path, WALK, "--allow", "deadlock", properties=properties)
    assert [len(v["trace"]) for v in result["violations"]] == [1]


def test_every_kind_is_found_in_one_run(tmp_path: Path) -> None:
    text = """
reactiveclass A(3) {
  knownrebecs { A other; }
  statevars { int n; int[2] cells; A nobody; }
  A() { self.go(); }
  msgsrv go() {
    int k = ?(0, 1, 2, 3, 4, 5, 6, 7);
    switch (k) {
      case 0: assertion(n == 1, "one"); break;
      case 1: cells[n + 2] = 1; break;
      case 2: n = 1 / n; break;
      case 3: nobody.go(); break;
      case 4: self.go() after(n - 1); break;
      case 5: other.late(); other.late(); other.late(); break;
      case 6: self.late() after(2) deadline(1 + n); break;
      default: assertion(n > 0);
    }
  }
  msgsrv late() { }
}
main { A a(a):(); }
"""
    result = verified(tmp_path, text)
    assert result["verdict"] == "violated"
    assert set(kinds(result)) == {
        ("assertion", "one"),
        ("assertion", "A.go:16"),
        ("index", "A.go:10"),
        ("division", "A.go:11"),
        ("null", "A.go:12"),
        ("time", "A.go:13"),
        ("overflow", "a"),
        ("deadline", "a.late"),
    }
    assert result["transitions"] == 9


def test_time_that_cannot_advance(tmp_path: Path) -> None:
    text = """
reactiveclass Loop(2) {
  statevars { boolean on; }
  Loop() { self.go(); }
  msgsrv go() { on = !on; STAY }
}
main { Loop loop():(); }
"""
    stuck = verified(tmp_path, text.replace("STAY", "self.go();"))
    assert kinds(stuck) == [("zeno", "zeno")]
    left = verified(tmp_path, text.replace("STAY", "self.go() after(?(0, 1));"))
    assert left["verdict"] == "satisfied"
    assert any("cycle" in c for c in left["caveats"])


def test_core_models_have_queues_and_no_time(tmp_path: Path) -> None:
    text = """
reactiveclass A(4) {
  statevars { int last; }
  A() { self.put(1); self.put(2); }
  msgsrv put(int n) { last = n; self.put(n); }
}
main { A a():(); }
"""
    result = verified(tmp_path, text, "--language", "core")
    assert (result["semantics"], result["states"], result["transitions"]) == ("core", 3, 3)
    (tmp_path / "t.rebeca").write_text(WALK)
    refused = rebsync("verify", "t.rebeca", "--language", "core", cwd=tmp_path)
    assert refused.status == 2
    assert "RS926" in refused.err


# --- views -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("delay", "options", "view"),
    [("", (), "ftts"), ("delay(1);", (), "tts"), ("", ("--semantics", "tts"), "tts")],
)
def test_the_view_follows_the_model(
    tmp_path: Path, delay: str, options: tuple[str, ...], view: str
) -> None:
    text = WALK.replace("place = place + by;", f"place = place + by; {delay}")
    result = verified(tmp_path, text, "--allow", "deadlock", *options)
    assert result["semantics"] == view
    assert result["caveats"] == []


def test_an_explicit_floating_view_of_delays_warns(tmp_path: Path) -> None:
    text = WALK.replace("place = place + by;", "place = place + by; delay(1);")
    result = verified(tmp_path, text, "--allow", "deadlock", "--semantics", "ftts")
    assert any("delay" in caveat for caveat in result["caveats"])


# --- bounds ------------------------------------------------------------------------------------


@pytest.mark.parametrize("engine", ["interpreted", "compiled", "auto"])
@pytest.mark.parametrize(
    "bound", [("--max-states", "500"), ("--max-time", "300ms"), ("--until", "40")]
)
def test_bounds_end_undetermined(tmp_path: Path, engine: str, bound: tuple[str, str]) -> None:
    result = verified(tmp_path, ENDLESS, "--engine", engine, *bound)
    assert (result["status"], result["verdict"]) == (4, "undetermined")
    assert "bound" in result["reason"]
    if bound[0] == "--until":
        assert (result["states"], result["transitions"]) == (41, 40)


def test_what_was_found_before_the_bound_is_told(tmp_path: Path) -> None:
    properties = "Assertion { Low: counter.count < 10; High: counter.count < 100000000; }"
    result = verified(tmp_path, ENDLESS, "--max-states", "50", properties=properties)
    assert result["status"] == 3
    assert result["properties"] == {"Low": "violated", "High": "undetermined"}


@pytest.mark.parametrize("engine", ["interpreted", "compiled"])
def test_ctrl_c_ends_with_what_is_known(tmp_path: Path, engine: str) -> None:
    (tmp_path / "m.rebeca").write_text(ENDLESS)
    command = [sys.executable, "-m", "rebsync", "verify", "m.rebeca", "--format", "json"]
    process = subprocess.Popen(
        [*command, "--engine", engine],
        cwd=tmp_path,
        env=environment(),
        stdout=subprocess.PIPE,
        text=True,
    )
    time.sleep(2.5)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=20)
    assert process.returncode == 4
    result = json.loads(out)
    assert (result["verdict"], result["reason"]) == ("undetermined", "it was interrupted")
    assert result["states"] > 0


def test_a_body_that_does_not_end(tmp_path: Path) -> None:
    text = WALK.replace("place = place + by;", "place = f(1);").replace(
        "msgsrv go", "int f(int n) { return f(n) + 1; } msgsrv go"
    )
    result = verified(tmp_path, text)
    assert result["status"] == 4
    assert "Walker.f" in result["reason"]


@pytest.mark.parametrize("option", [("--memory", "0"), ("--max-time", "soon"), ("--until", "-1")])
def test_bounds_that_are_none(tmp_path: Path, option: tuple[str, str]) -> None:
    (tmp_path / "m.rebeca").write_text(WALK)
    assert rebsync("verify", "m.rebeca", *option, cwd=tmp_path).status == 2


# --- engines -----------------------------------------------------------------------------------


def test_a_bound_without_bounds(tmp_path: Path) -> None:
    result = verified(tmp_path, WALK, "--memory", "9" * 400, "--max-time", "9" * 400)
    assert result["status"] == 3


def test_a_property_file_that_cannot_be_read_is_not_passed_over(tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text(WALK)
    (tmp_path / "m.property").symlink_to("gone.property")
    done = rebsync("verify", "m.rebeca", cwd=tmp_path)
    assert (done.status, done.out) == (2, "")
    assert "m.property: RS801" in done.err
    done = rebsync("verify", "m.rebeca", "--property", "", cwd=tmp_path)
    assert done.status == 2


def test_properties_are_no_model(tmp_path: Path) -> None:
    (tmp_path / "m.property").write_text("property { }")
    refused = rebsync("verify", "m.property", cwd=tmp_path)
    assert refused.status == 2
    assert "--property" in refused.err


def test_two_threads_tell_what_one_tells(tmp_path: Path) -> None:
    laps = (ROOT / "bench" / "models" / "laps.rebeca").read_text().replace("laps = 3", "laps = 2")
    known = "--engine", "auto", "--no-reduce", "--threads"
    one, two = (verified(tmp_path, laps, *known, threads) for threads in ("1", "2"))
    differs = {key for key in one if one[key] != two[key]}
    assert all("second" in key or "memory" in key for key in differs)
    assert one["states"] == 115_030


def test_without_a_compiler(tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text(ENDLESS)
    nothing = {"PATH": str(tmp_path), "REBSYNC_CACHE": str(tmp_path / "cache"), "CC": ""}
    asked = rebsync("verify", "m.rebeca", "--engine", "compiled", cwd=tmp_path, env=nothing)
    assert asked.status == 2
    assert "RS931" in asked.err
    # a bound of states, as a busy machine leaves nothing of a second before it looks for a compiler
    options = ("--format", "json", "--max-states", "60000")
    auto = rebsync("verify", "m.rebeca", *options, cwd=tmp_path, env=nothing)
    result = json.loads(auto.out)
    assert (auto.status, result["engine"]) == (4, "interpreted")
    assert any("compiler" in caveat for caveat in result["caveats"])


def test_symmetry_is_refused_where_nothing_can_be_exchanged(tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text(ENDLESS)
    refused = rebsync("verify", "m.rebeca", "--symmetry", cwd=tmp_path)
    assert refused.status == 2
    assert "RS932" in refused.err
    drawn = rebsync("verify", "m.rebeca", "--symmetry", "--states", "s.dot", cwd=tmp_path)
    assert drawn.status == 2
    assert "--states and --export" in drawn.err


def test_engines_agree_on_the_examples() -> None:
    model = str(EXAMPLES / "experiment3_unsafe" / "experiment3_unsafe.rebeca")
    results = []
    for engine in ("interpreted", "compiled"):
        done = rebsync("verify", model, "--engine", engine, "--format", "json", cwd=ROOT)
        result = json.loads(done.out)
        assert result.pop("engine") == engine
        for figure in [name for name in result if "second" in name]:
            result.pop(figure)
        result.pop("peak_memory_bytes")
        results.append(result)
    assert results[0] == results[1]


# --- runs --------------------------------------------------------------------------------------


def test_a_run_can_be_made_again(tmp_path: Path) -> None:
    model = str(EXAMPLES / "experiment2_unsafe" / "experiment2_unsafe.rebeca")
    first = rebsync("verify", model, "--format", "json", "-o", "r.json", cwd=tmp_path)
    assert first.status == 3
    name = "Collision_Avoidance"
    options = ("--replay", "r.json", "--violation", name, "--format", "json")
    again = rebsync("verify", model, *options, cwd=tmp_path)
    recorded = json.loads((tmp_path / "r.json").read_text())
    trace = next(v["trace"] for v in recorded["violations"] if v["name"] == name)
    assert json.loads(again.out)["trace"] == trace


def test_a_run_of_another_model(tmp_path: Path) -> None:
    model = str(EXAMPLES / "experiment2_unsafe" / "experiment2_unsafe.rebeca")
    other = str(EXAMPLES / "experiment2" / "experiment2.rebeca")
    rebsync("verify", model, "--format", "json", "-o", "r.json", cwd=tmp_path)
    options = ("--replay", "r.json", "--violation", "Collision_Avoidance")
    refused = rebsync("verify", other, *options, cwd=tmp_path)
    assert refused.status == 2
    assert "RS924" in refused.err


def test_a_run_that_does_not_repeat_as_it_says(tmp_path: Path) -> None:
    run = verified(tmp_path, ENDLESS, "--max-states", "3", properties="Assertion { a: false; }")
    recorded = run["violations"][0]
    for loop in (0, 9, 10**400):
        (tmp_path / "r.json").write_text(json.dumps({**recorded, "loop": loop}))
        done = rebsync("verify", "m.rebeca", "--replay", "r.json", cwd=tmp_path)
        assert (done.status, done.out) == (2, "")
        assert "RS924" in done.err
    ticks = verified(tmp_path, ENDLESS.replace("count++; ", ""), properties="LTL { a: F(false); }")
    (tmp_path / "r.json").write_text(json.dumps(ticks))
    assert ticks["violations"][0]["loop"] is not None
    assert rebsync("verify", "m.rebeca", "--replay", "r.json", cwd=tmp_path).status == 0


@pytest.mark.parametrize("command", ["verify", "simulate"])
def test_nothing_that_is_read_is_overwritten(tmp_path: Path, command: str) -> None:
    (tmp_path / "m.rebeca").write_text(WALK)
    (tmp_path / "m.property").write_text("property { Assertion { a: true; } }")
    for name in ("m.rebeca", "m.property"):
        kept = (tmp_path / name).read_text()
        done = rebsync(command, "m.rebeca", "-o", f"./{name}", cwd=tmp_path)
        assert (done.status, (tmp_path / name).read_text()) == (2, kept)
        assert "RS802" in done.err


def test_a_replay_writes_no_more_than_its_run(tmp_path: Path) -> None:
    (tmp_path / "r.json").write_text(json.dumps(verified(tmp_path, WALK)))
    kept = (tmp_path / "r.json").read_text()
    for options in (("-o", "r.json"), ("--states", "s.dot"), ("--export", "rmc-xml")):
        done = rebsync("verify", "m.rebeca", "--replay", "r.json", *options, cwd=tmp_path)
        assert (done.status, done.out) == (2, "")
    assert (tmp_path / "r.json").read_text() == kept
    done = rebsync("verify", "m.rebeca", "--states", "r.json", "-o", "r.json", cwd=tmp_path)
    assert done.status == 2
    assert (tmp_path / "r.json").read_text() == kept
    assert rebsync("verify", "m.rebeca", "--replay", "", cwd=tmp_path).status == 2


@pytest.mark.parametrize("style", ["svg", "html"])
def test_pictures(tmp_path: Path, style: str) -> None:
    model = str(EXAMPLES / "experiment2_unsafe" / "experiment2_unsafe.rebeca")
    done = rebsync("verify", model, "--format", style, "-o", f"out.{style}", cwd=tmp_path)
    assert (done.status, done.out) == (3, "")
    assert "robot1" in (tmp_path / f"out.{style}").read_text()


@pytest.mark.parametrize("suffix", ["dot", "svg", "json"])
def test_state_spaces(tmp_path: Path, suffix: str) -> None:
    (tmp_path / "m.rebeca").write_text(WALK)
    name = f"space.{suffix}"
    options = ("--states", name, "--allow", "deadlock")
    done = rebsync("verify", "m.rebeca", *options, cwd=tmp_path)
    assert done.status == 0, done.err
    text = (tmp_path / name).read_text()
    if suffix == "json":
        space = json.loads(text)
        assert (len(space["states"]), len(space["edges"])) == (7, 7)
    else:
        assert "walker" in text


_ENDLESS = "A() { self.go(); } msgsrv go() { while (true) { x = 1; } }"
_WRONG_AT_ONCE = "A() { assertion(x > 0); } msgsrv go() { x = 1; }"


@pytest.mark.parametrize(
    ("suffix", "body", "rebecs", "status"),
    [
        ("json", _ENDLESS, "A a():();", 4),  # which takes seconds to find out
        *((suffix, _WRONG_AT_ONCE, "A a():();", 3) for suffix in ("dot", "svg", "json")),
        *((suffix, "A() { x = 1; } msgsrv go() {}", "", 3) for suffix in ("dot", "svg", "json")),
    ],
)
def test_odd_state_spaces(tmp_path: Path, suffix: str, body: str, rebecs: str, status: int) -> None:
    """Without steps, or without states at all."""
    text = f"reactiveclass A(3) {{ statevars {{ int x; }} {body} }} main {{ {rebecs} }}"
    (tmp_path / "m.rebeca").write_text(text)
    done = rebsync("verify", "m.rebeca", "--states", f"s.{suffix}", cwd=tmp_path)
    assert done.status == status, done.err
    assert (tmp_path / f"s.{suffix}").read_text()


@pytest.mark.parametrize("type_", ["int[100000][100000]", "byte[60000]"])
def test_too_large_to_check(tmp_path: Path, type_: str) -> None:
    variables = f"statevars {{ {type_} x; {type_} y; }}"
    text = f"reactiveclass A(3) {{ {variables} A() {{}} }} main {{ A a():(); }}"
    (tmp_path / "m.rebeca").write_text(text)
    done = rebsync("verify", "m.rebeca", cwd=tmp_path)
    assert (done.status, done.out) == (2, "")
    assert "RS927" in done.err


def test_the_format_of_rmc(tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text(WALK)
    done = rebsync("verify", "m.rebeca", "--export", "rmc-xml", cwd=tmp_path)
    assert done.status == 0
    assert done.out.count("<state ") == 7
    assert done.out.count("<transition ") == 7


# --- bad input ---------------------------------------------------------------------------------


def test_mistakes_are_told_with_their_places(tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text(WALK.replace("place + by", "plase + by"))
    done = rebsync("verify", "m.rebeca", cwd=tmp_path)
    assert (done.status, done.out) == (2, "")
    assert "m.rebeca:7:" in done.err
    (tmp_path / "m.rebeca").write_text(WALK)
    (tmp_path / "m.property").write_text("property { Assertion { P: walker.plac > 1; } }")
    done = rebsync("verify", "m.rebeca", cwd=tmp_path)
    assert done.status == 2
    assert "m.property:1:" in done.err


def test_a_class_without_instances_is_no_obstacle(tmp_path: Path) -> None:
    idle = "reactiveclass Idle(1) { msgsrv m() { self.m(); } }\n\nreactiveclass Walker(3)"
    text = WALK.replace("reactiveclass Walker(3)", idle)
    assert verified(tmp_path, text, "--allow", "deadlock")["verdict"] == "satisfied"


def test_a_directory_stands_for_its_models(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["examples", str(tmp_path), "hello", "experiment3"])
    (tmp_path / "broken.rebeca").write_text("reactiveclass A(2) {", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    capsys.readouterr()
    assert main(["verify", ".", "--allow", "deadlock"]) == 2
    shown = capsys.readouterr()
    assert re.findall(r"^\S+: satisfied$", shown.out, re.MULTILINE) == [
        "experiment3/experiment3.rebeca: satisfied",
        "hello/hello.rebeca: satisfied",
    ]
    assert shown.err.startswith("broken.rebeca:1:")
    assert main(["verify", ".", "--format", "json"]) == 2
    assert "3 models are below .: name one of them" in capsys.readouterr().err


def test_code_beside_models_is_in_no_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("hello", "experiment3"):
        main(["examples", str(tmp_path / "all"), name])
        for path in tmp_path.glob(f"all/{name}/{name}.*"):
            path.rename(tmp_path / path.name)
    (tmp_path / "tool.py").write_text("print(1)\n", encoding="utf-8")
    (tmp_path / "gone.rebeca").symlink_to(tmp_path / "nowhere.rebeca")
    monkeypatch.chdir(tmp_path)
    capsys.readouterr()
    assert main(["verify", ".", "--allow", "deadlock"]) == 2  # of the link
    shown = capsys.readouterr()
    assert re.findall(r"^\S+: satisfied$", shown.out, re.MULTILINE) == [
        "experiment3.rebeca: satisfied",
        "hello.rebeca: satisfied",
    ]
    assert shown.err.startswith("tool.py: in no package")
    assert "gone.rebeca" in shown.err
    assert main(["verify", ".", "--environment", "free"]) == 2
    assert "RS802 several property files" in capsys.readouterr().err


def test_properties_are_picked_by_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["examples", str(tmp_path), "experiment3_unsafe"])
    model = str(tmp_path / "experiment3_unsafe/experiment3_unsafe.rebeca")
    assert main(["verify", model, "--allow", "deadlock", "--property-name", "Safety"]) == 3
    assert "Goal_Not_Passed" not in capsys.readouterr().out
    assert main(["verify", model, "--property-name", "Goal_Not_Passed"]) == 0
    assert "Safety" not in capsys.readouterr().out
    assert main(["verify", model, "--property-name", "Safty"]) == 2
    assert 'RS929 no property is called "Safty"\nhint: did you mean "Safety"?' in (
        capsys.readouterr().err
    )


def test_states_are_reduced_unless_all_are_wanted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """And not where something is asked that not every reduction keeps."""
    (tmp_path / "fleet.rebeca").write_text(FLEET.replace("% 3); }\n}", "% 2); }\n}"))

    def states(*options: str) -> tuple[int, list[str]]:
        assert main(["verify", str(tmp_path / "fleet.rebeca"), "--format", "json", *options]) == 0
        found = json.loads(capsys.readouterr().out)
        return found["states"], found["caveats"]

    assert states() == (1443, [ONCE])
    assert states("--no-reduce") == states("--measure", "a.done") == (22240, [])
    reduced, caveats = states("--symmetry")
    assert (reduced, caveats) == (1443, [ONCE.partition("; --no-reduce")[0]])
