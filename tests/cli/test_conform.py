"""`rebsync conform`: exit statuses, formats, and recordings that cannot be read or compared."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path
from xml.etree import ElementTree

import jsonschema  # type: ignore[import-untyped]
import pytest

from tests.cli.run import ROOT, rebsync

BAGS = ROOT / "tests" / "conform" / "recordings"
BAG = BAGS / "running_example-cpp.bag"
MODEL = str(ROOT / "examples" / "running_example")
SCHEMA = json.loads((ROOT / "docs" / "conform.schema.json").read_text(encoding="utf-8"))


def log(path: Path, *changes: tuple[int, str, object]) -> Path:
    """The steps of a real run as a log, with some fields changed: step, field, value."""
    from tests.conform.test_recordings import of_bag, steps

    observable = of_bag(BAG).observable
    lines = []
    for number, step in enumerate(steps(BAG)):
        data: dict[str, object] = {
            name: getattr(step, name) for name in ("server", "arguments", "arrival", "start", "now")
        }
        for slot in observable.program.rebecs[step.rebec].state:
            cells = list(step.cells[slot.offset : slot.offset + slot.size])
            data[slot.name] = cells if slot.type.dimensions else cells[0]
        data |= {field: value for at, field, value in changes if at == number}
        topic = f"/{observable.nodes[step.rebec]}/state"
        lines.append(json.dumps({"topic": topic, "stamp": step.stamp, "data": data}))
    path.write_text("".join(f"{line}\n" for line in lines))
    return path


def robots_step() -> int:
    """A step of a robot in the middle of the run."""
    from tests.conform.test_recordings import steps

    return next(n for n, step in enumerate(steps(BAG)) if n > 55 and step.rebec == 1)


def assert_is_server(place: re.Match[str] | None, function: str) -> None:
    """The place in the code is the first line of a function."""
    assert place is not None
    lines = Path(place[1]).read_text(encoding="utf-8").splitlines()
    assert lines[int(place[2]) - 1].startswith(function)


def test_a_good_run_conforms(tmp_path: Path) -> None:
    done = rebsync("conform", MODEL, str(BAG), cwd=tmp_path)
    assert done.status == 0, done.err
    assert done.out.splitlines()[0].endswith("running_example.rebeca: conforms, 114 steps")


def test_a_log_is_read_as_a_bag_is(tmp_path: Path) -> None:
    done = rebsync("conform", MODEL, str(log(tmp_path / "run.jsonl")), cwd=tmp_path)
    assert done.status == 0, done.out
    assert "conforms, 114 steps" in done.out


def test_what_deviates_is_told_in_every_format(tmp_path: Path) -> None:
    at = robots_step()
    path = str(log(tmp_path / "run.jsonl", (at, "data", 7)))
    text = rebsync("conform", MODEL, path, cwd=tmp_path)
    assert text.status == 1
    assert "wrong state: " in text.out
    assert "data = 7, not" in text.out
    assert f"{path}, message {at + 1}" in text.out
    assert "  allowed: " in text.out
    assert_is_server(re.search("  code: (.*):(.*)\n", text.out), "void R1::")
    found = rebsync("conform", MODEL, path, "--format", "json", cwd=tmp_path)
    assert found.status == 1
    answer = json.loads(found.out)
    jsonschema.validate(answer, SCHEMA)
    assert answer["deviation"]["kind"] == "wrong state"
    assert answer["deviation"]["number"] == at + 1
    assert answer["deviation"]["code"]["path"].endswith("src/r1.cpp")
    sarif = json.loads(rebsync("conform", MODEL, path, "--format", "sarif", cwd=tmp_path).out)
    assert sarif["runs"][0]["results"][0]["ruleId"] == "RS980"
    github = rebsync("conform", MODEL, path, "--format", "github", cwd=tmp_path).out
    assert github.startswith("::error file=")
    junit = ElementTree.fromstring(
        rebsync("conform", MODEL, path, "--format", "junit", cwd=tmp_path).out
    )
    assert junit.find("testsuite") is not None
    assert [c.get("type") for c in junit.iter("failure")] == ["deviates"]


@pytest.mark.parametrize("name", ["running_example-cpp", "inheritance-py"])
def test_answers_fit_the_schema(name: str, tmp_path: Path) -> None:
    model = {"running_example-cpp": MODEL}.get(
        name, str(ROOT / "tests/forward/cases/inheritance.rebeca")
    )
    done = rebsync("conform", model, str(BAGS / f"{name}.bag"), "--format", "json", cwd=tmp_path)
    jsonschema.validate(json.loads(done.out), SCHEMA)


def test_a_run_that_breaks_a_property_is_a_violation(tmp_path: Path) -> None:
    model = str(ROOT / "examples" / "experiment2_unsafe")
    done = rebsync("conform", model, str(BAGS / "experiment2_unsafe-cpp.bag"), cwd=tmp_path)
    assert done.status == 3
    assert "conforms, 33 steps" in done.out
    assert "Collision_Avoidance: violated (at 4)" in done.out


def test_a_run_in_which_the_model_breaks_a_rule_is_a_violation(tmp_path: Path) -> None:
    model = str(ROOT / "tests" / "forward" / "cases" / "inheritance.rebeca")
    done = rebsync("conform", model, str(BAGS / "inheritance-cpp.bag"), cwd=tmp_path)
    assert done.status == 3
    assert "model failure: a message goes to nobody in Station.arrived" in done.out


def test_the_page_shows_both_runs_and_the_deviation(tmp_path: Path) -> None:
    path = str(log(tmp_path / "run.jsonl", (robots_step(), "data", 7)))
    done = rebsync("conform", MODEL, path, "--page", "page.html", cwd=tmp_path)
    assert done.status == 1
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert page.count("<svg") >= 3
    assert "Recorded" in page
    assert "A run of the model that fits" in page
    assert "data = 7, not" in page
    assert "Time error" in page
    assert "://" not in page.replace("http://www.w3.org/2000/svg", "")


def test_the_page_shows_rebecs_of_which_nothing_was_recorded(tmp_path: Path) -> None:
    path = log(tmp_path / "run.jsonl")
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    path.write_text("".join(line for line in lines if "robot1" not in line))
    done = rebsync("conform", MODEL, str(path), "--page", "page.html", cwd=tmp_path)
    assert done.status == 4, done.err
    assert "robot1" in (tmp_path / "page.html").read_text(encoding="utf-8")


def test_the_end_of_a_run_conforms_from_where_it_begins(tmp_path: Path) -> None:
    path = log(tmp_path / "run.jsonl")
    path.write_text("".join(path.read_text().splitlines(keepends=True)[50:]))
    done = rebsync("conform", MODEL, str(path), cwd=tmp_path)
    assert done.status == 0, done.out
    assert "the recording begins in the middle" in done.out


def test_parts_of_a_run_are_merged(tmp_path: Path) -> None:
    path = log(tmp_path / "run.jsonl")
    lines = path.read_text().splitlines(keepends=True)
    parts = [tmp_path / "a.jsonl", tmp_path / "b.jsonl", tmp_path / "c.jsonl"]
    for part, chosen in zip(parts, (lines[:60], lines[40:90], lines[85:]), strict=True):
        part.write_text("".join(chosen))
    done = rebsync("conform", MODEL, *map(str, reversed(parts)), cwd=tmp_path)
    assert done.status == 0, done.out
    assert "conforms, 114 steps" in done.out


def test_nothing_that_was_served_is_no_conformance(tmp_path: Path) -> None:
    for content in ("", '{"topic": "/other", "stamp": 1, "data": {}}\n'):
        (tmp_path / "run.jsonl").write_text(content)
        done = rebsync("conform", MODEL, "run.jsonl", cwd=tmp_path)
        assert done.status == 4
        assert "nothing that the nodes served is in the recording" in done.out


def damaged(path: Path, how: str) -> None:
    """A bag that is not as it should be."""
    data = BAG.read_bytes()
    match how:
        case "cut off":
            path.write_bytes(data[: len(data) * 2 // 3])
        case "empty":
            path.write_bytes(b"")
        case "text":
            path.write_text("no bag\n")
        case "flipped":
            middle = len(data) // 2
            path.write_bytes(data[:middle] + bytes(200) + data[middle + 200 :])


@pytest.mark.parametrize("how", ["cut off", "empty", "text", "flipped"])
@pytest.mark.parametrize("ending", [".bag", ".mcap", ".db3"])
def test_what_is_no_bag_cannot_be_read(how: str, ending: str, tmp_path: Path) -> None:
    damaged(tmp_path / f"run{ending}", how)
    done = rebsync("conform", MODEL, f"run{ending}", cwd=tmp_path)
    assert done.status == 2
    assert "RS98" in done.err
    assert "Traceback" not in done.err


@pytest.mark.parametrize("ending", [".bag", ".mcap"])
def test_how_to_mend_what_a_killed_recorder_leaves_is_told(ending: str, tmp_path: Path) -> None:
    from tests.conform.bagging import Storage, write_bag
    from tests.conform.test_recordings import of_bag, steps

    storage: Storage = "mcap" if ending == ".mcap" else "ros1"
    path = write_bag(tmp_path / f"run{ending}", of_bag(BAG).observable, steps(BAG), storage)
    if path.is_dir():
        path = next(path.glob("*.mcap"))
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) * 5 // 8])
    done = rebsync("conform", MODEL, str(path), cwd=tmp_path)
    assert done.status == 2, done.out
    assert "RS982" in done.err
    assert ("mcap recover" if ending == ".mcap" else "rosbag reindex") in done.err


@pytest.mark.parametrize("wrong", [False, True], ids=["true", "wrong state"])
def test_what_is_cut_off_is_compared_until_there(wrong: bool, tmp_path: Path) -> None:
    path = log(tmp_path / "run.jsonl", *([(robots_step(), "data", 7)] if wrong else []))
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) * 5 // 8])
    done = rebsync("conform", MODEL, str(path), "--format", "json", cwd=tmp_path)
    answer = json.loads(done.out)
    if wrong:
        assert (done.status, answer["deviation"]["kind"]) == (1, "wrong state")
        return
    assert (done.status, answer["verdict"]) == (4, "undetermined")
    assert 10 < answer["compared"] <= 114
    assert re.match(r"it fits so far, and .* cannot be read after line \d+: ", answer["reason"])


def test_of_several_files_nothing_counts_after_the_end_of_one(tmp_path: Path) -> None:
    path = log(tmp_path / "run.jsonl")
    lines = path.read_text().splitlines(keepends=True)
    own = [line for line in lines if "robot1" in line]
    others = [line for line in lines if "robot1" not in line]
    path.write_text("".join(own)[: -len(own[-1]) * 3 // 2])
    (tmp_path / "others.jsonl").write_text("".join(others))
    done = rebsync("conform", MODEL, "run.jsonl", "others.jsonl", cwd=tmp_path)
    assert done.status == 4, done.out
    assert "it fits so far, and run.jsonl cannot be read after line" in done.out


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("no json", "RS982"),
        ("[1]", "RS982"),
        ('{"topic": "/robot1/state", "stamp": "now", "data": {}}', "RS982"),
        ('{"topic": "/robot1/state", "stamp": 1, "data": 3}', "RS982"),
        ('{"topic": "/robot1/state", "stamp": 1, "data": {"server": "P1"}}', "RS983"),
    ],
)
def test_lines_that_are_no_messages_are_told(line: str, code: str, tmp_path: Path) -> None:
    (tmp_path / "run.jsonl").write_text(line + "\n")
    done = rebsync("conform", MODEL, "run.jsonl", cwd=tmp_path)
    assert done.status == 2
    assert code in done.err
    assert "line 1: " in done.err


def test_a_recording_of_another_model_is_told(tmp_path: Path) -> None:
    done = rebsync("conform", str(ROOT / "examples" / "experiment2"), str(BAG), cwd=tmp_path)
    assert done.status == 2
    assert "RS983" in done.err


def test_two_namespaces_need_a_choice(tmp_path: Path) -> None:
    path = log(tmp_path / "run.jsonl")
    text = path.read_text()
    both = [text.replace('"/', '"/a/'), text.replace('"/', '"/b/')]
    path.write_text("".join(both))
    done = rebsync("conform", MODEL, "run.jsonl", cwd=tmp_path)
    assert done.status == 2
    assert "--namespace" in done.err
    done = rebsync("conform", MODEL, "run.jsonl", "--namespace", "/b", cwd=tmp_path)
    assert done.status == 0, done.out


def test_a_recording_is_not_overwritten(tmp_path: Path) -> None:
    shutil.copy(BAG, tmp_path / "run.bag")
    done = rebsync("conform", MODEL, "run.bag", "-o", "run.bag", cwd=tmp_path)
    assert done.status == 2
    assert (tmp_path / "run.bag").read_bytes() == BAG.read_bytes()


# --- packages that people wrote

PEOPLE = str(BAGS.parent / "packages" / "thermostat")
TOPICS = BAGS / "thermostat.jsonl"


def test_topics_of_a_package_that_people_wrote(tmp_path: Path) -> None:
    done = rebsync("conform", PEOPLE, str(TOPICS), cwd=tmp_path)
    assert (done.status, done.out) == (0, f"{PEOPLE}: conforms, 60 steps\n"), done.err
    lines = TOPICS.read_text(encoding="utf-8").splitlines()
    at = next(n for n, line in enumerate(lines) if '"/heat"' in line and n > 30)
    faulty = tmp_path / "faulty.jsonl"
    faulty.write_text("".join(f"{line}\n" for line in [*lines[:at], *lines[at + 1 :]]))
    done = rebsync("conform", PEOPLE, str(faulty), "--from-start", "--format", "json", cwd=tmp_path)
    assert done.status == 1, done.out
    answer = json.loads(done.out)
    jsonschema.validate(answer, SCHEMA)
    assert answer["deviation"]["kind"] == "lost message"
    assert answer["deviation"]["rebec"] == "thermostat"
    assert answer["deviation"]["code"]["path"].endswith("src/thermostat.py")
    done = rebsync("conform", PEOPLE, str(faulty), "--format", "github", cwd=tmp_path)
    assert done.status == 1, done.out  # whatever the nodes did before
    assert re.match(r"::error file=.*/src/thermostat.py,line=\d+,", done.out), done.out


def test_of_several_packages_that_people_wrote_one_is_to_be_named(tmp_path: Path) -> None:
    both = [str(BAGS.parent / "packages" / name) for name in ("thermostat", "counter")]
    for path in both:
        shutil.copytree(path, tmp_path / "ws" / Path(path).name)
    done = rebsync("conform", "ws", str(TOPICS), cwd=tmp_path)
    assert done.status == 2
    assert "RS802 several packages are here" in done.err
    assert "name one of them: ws/counter, ws/thermostat" in done.err
    assert rebsync("conform", "ws/thermostat", str(TOPICS), cwd=tmp_path).status == 0


def test_properties_times_and_page_of_topics(tmp_path: Path) -> None:
    (tmp_path / "some.property").write_text(
        "property { Assertion { Weak: heater.out_power_data < 4; Same: heater.power >= 0; } }"
    )
    options = ("--property", "some.property", "--times", "--page", "page.html")
    done = rebsync("conform", PEOPLE, str(TOPICS), *options, cwd=tmp_path)
    assert done.status == 3, done.err
    assert "Weak: violated (at 8696)" in done.out
    assert "Same: undetermined (no topic shows heater.power)" in done.out
    assert re.search(r"heater +tick +period +/power +28 +0\.997 +1\.000", done.out)
    assert "thermostat  measured  delay   /heat      31" in done.out
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "A run of the model that fits" in page
    assert "/power(0)" in page
    done = rebsync("conform", PEOPLE, str(TOPICS), *options, "--format", "json", cwd=tmp_path)
    jsonschema.validate(json.loads(done.out), SCHEMA)


@pytest.mark.parametrize(
    ("model", "options", "said"),
    [
        (PEOPLE, ("--calibrate",), "--calibrate is for models"),
        (PEOPLE, ("--namespace", "a"), "--namespace is for models"),
        (MODEL, ("--from-start",), "--from-start is for packages"),
        (MODEL, ("--slack", "1"), "--slack is for packages"),
    ],
)
def test_options_that_do_not_go_with_a_subject(
    model: str, options: tuple[str, ...], said: str, tmp_path: Path
) -> None:
    recording = TOPICS if model == PEOPLE else BAG
    done = rebsync("conform", model, str(recording), *options, cwd=tmp_path)
    assert done.status == 2
    assert said in done.err


def test_states_bound_the_width_of_the_search(tmp_path: Path) -> None:
    done = rebsync("conform", PEOPLE, str(TOPICS), "--max-states", "1", cwd=tmp_path)
    assert done.status == 4
    assert "more than 1 states of heater are possible" in done.out
    model = tmp_path / "wide.rebeca"
    model.write_text(WIDE)
    steps = [("constructor", 0), ("begin", 0), ("end", 2)]
    data = ({"server": s, "arguments": "", "arrival": t, "start": t, "now": t} for s, t in steps)
    lines = (json.dumps({"topic": "/a/state", "stamp": d["now"], "data": d}) for d in data)
    path = tmp_path / "run.jsonl"
    path.write_text("".join(f"{line}\n" for line in lines))
    assert rebsync("conform", str(model), str(path), cwd=tmp_path).status == 0
    done = rebsync("conform", str(model), str(path), "--max-states", "1", cwd=tmp_path)
    assert done.status == 4
    assert "more than 1 states of the model are possible" in done.out


WIDE = """reactiveclass A(3) {
  A() { self.begin(); }
  msgsrv begin() { self.end() after(?(2, 3)); }
  msgsrv end() {}
}
main { A a():(); }
"""


@pytest.mark.parametrize("status", [0, 1])
def test_a_log_whose_messages_are_not_in_the_order_of_stamps(status: int, tmp_path: Path) -> None:
    """Programs that put logs together write them so; players go by stamps."""
    path = log(tmp_path / "run.jsonl", *([(robots_step(), "data", 7)] if status else []))
    lines = path.read_text().splitlines(keepends=True)
    stamps = [json.loads(line)["stamp"] for line in lines]
    half = next(n for n, stamp in enumerate(stamps) if n > 50 and stamp > stamps[n - 1] + 0.5)
    path.write_text("".join([*lines[half:], *lines[:half]]))
    done = rebsync("conform", MODEL, str(path), cwd=tmp_path)
    assert done.status == status, done.out
    assert "compared in that" in done.out
    assert ("wrong state: robot" in done.out) is (status == 1)
