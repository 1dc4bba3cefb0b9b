"""`rebsync check` as a user meets it: verdicts, formats, exit status, and what can be wrong."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from xml.etree import ElementTree

import pytest
from jsonschema import validate  # type: ignore[import-untyped]

from rebsync.checker.conclusion import CYCLE_CAVEAT
from rebsync.cli import main
from rebsync.cli.check import FORMATS
from rebsync.reverse.files import parallel
from tests.cli.run import ROOT, environment, rebsync
from tests.test_report import SCHEMA as SARIF

MODEL = """\
env int e = 2;

@Robot
reactiveclass Robot(3) {
  knownrebecs {
    Robot other;
  }
  statevars {
    int x;
    boolean on;
  }

  Robot(int x0) {
    x = x0;
    self.look();
  }

  msgsrv look() {
    x = (x + 1) % 4;
    self.look() after(e);
    other.go(x);
  }

  msgsrv go(int n) {
    delay(1);
    on = n > 3;
  }
}

main {
  Robot robot1(robot2):(1);
  Robot robot2(robot1):(2);
}
"""
PROPERTY = """\
property {
  define {
    small = robot1.x < 4;
  }
  Assertion {
    Stays_Small: small;
  }
}
"""
SOURCE = "patrol/src/robot.cpp"
UNSAFE = r" \|\| \(next_r[12]_\[0\] == x && next_r[12]_\[1\] == y\)"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A fresh package beside its model, and a cache with the grammars."""
    folder = tmp_path_factory.mktemp("made")
    (folder / "patrol.rebeca").write_text(MODEL)
    (folder / "patrol.property").write_text(PROPERTY)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("REBSYNC_CACHE", str(folder / ".cache"))
        assert main(["generate", str(folder / "patrol.rebeca"), "-o", str(folder)]) == 0
    return folder


@pytest.fixture
def package(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of these, the current directory being the one with the model."""
    folder = tmp_path / "here"
    shutil.copytree(made, folder)
    monkeypatch.chdir(folder)
    monkeypatch.setenv("REBSYNC_CACHE", str(folder / ".cache"))
    return folder / "patrol"


@pytest.fixture
def check(package: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str]]:
    """Runs the command in-process; gives the exit status and all that is printed."""

    def run(*arguments: str) -> tuple[int, str]:
        capsys.readouterr()
        before = snapshot(package.parent)
        status = main(["check", *arguments])
        shown = capsys.readouterr()
        assert snapshot(package.parent) == before, "check writes nothing"
        return status, shown.out + shown.err

    return run


Check = Callable[..., tuple[int, str]]


def snapshot(folder: Path) -> dict[str, bytes]:
    return {
        str(p): p.read_bytes()
        for p in sorted(folder.rglob("*"))
        if p.is_file() and ".cache" not in p.parts and os.access(p, os.R_OK)
    }


def replace(path: str, old: str, new: str) -> None:
    text = Path(path).read_text()
    assert old in text, (old, text)
    Path(path).write_text(text.replace(old, new))


# --- verdicts -----------------------------------------------------------------------------------


def test_a_fresh_package_is_in_step(check: Check) -> None:
    assert check() == (0, "patrol: in step\n")
    assert check("patrol") == (0, "patrol: in step\n")
    assert check("patrol/src/robot.cpp") == (0, "patrol: in step\n")
    assert check("patrol.rebeca") == (0, "patrol: in step\n")


def test_the_model_is_ahead(check: Check) -> None:
    replace("patrol.rebeca", "delay(1)", "delay(3)")
    status, shown = check()
    assert status == 1
    assert shown.startswith("patrol: the model is ahead")
    assert "patrol.rebeca:25" in shown and "patrol/src/robot.cpp:" in shown
    assert "msgsrv Robot.go: delay changed from 1 to 3  [model]" in shown


def test_the_code_is_ahead(check: Check) -> None:
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    status, shown = check()
    assert status == 1
    assert shown.startswith("patrol: the code is ahead")
    assert "msgsrv Robot.go: delay changed from 1 to 3  [code]" in shown


def test_both_made_the_same_change(check: Check) -> None:
    replace("patrol.rebeca", "delay(1)", "delay(3)")
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    assert check() == (0, "patrol: in step\n")


def test_both_moved_apart(check: Check) -> None:
    replace("patrol.rebeca", "% 4", "% 3")
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    status, shown = check()
    assert status == 1
    assert shown.startswith("patrol: model and code both moved, apart")
    assert "msgsrv Robot.go: delay changed from 1 to 3  [code]" in shown
    look = next(line for line in shown.splitlines() if "msgsrv Robot.look" in line)
    assert look.endswith("[model]")


def test_both_changed_one_element(check: Check) -> None:
    replace("patrol.rebeca", "n > 3", "n > 5")
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    status, shown = check()
    assert status == 1
    assert shown.startswith("patrol: conflict: model and code both changed msgsrv Robot.go")
    assert shown.count("[both]") == 2


def test_a_removed_server_and_a_change_in_it_are_a_conflict(check: Check) -> None:
    replace("patrol.rebeca", "    other.go(x);\n", "")
    replace("patrol.rebeca", "  msgsrv go(int n) {\n    delay(1);\n    on = n > 3;\n  }\n", "")
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    status, shown = check()
    assert status == 1
    assert "conflict: model and code both changed msgsrv Robot.go" in shown


def test_layout_and_comments_are_no_change(check: Check) -> None:
    text = Path(SOURCE).read_text()
    Path(SOURCE).write_text(text.replace("  ", "\t").replace(" {\n", "\n{\n") + "// mine\n")
    replace("patrol.rebeca", "env int", "// the step\nenv int")
    assert check() == (0, "patrol: in step\n")


def test_depths(check: Check) -> None:
    replace("patrol.rebeca", "    x = (x + 1) % 4;", "    int y = 1;\n    x = (x + y) % 4;")
    assert main(["generate", "patrol.rebeca"]) == 0
    replace("patrol.rebeca", "int y = 1;\n    x = (x + y)", "int z = 1;\n    x = (x + z)")
    assert check()[0] == 0
    status, shown = check("--depth", "identical")
    assert (status, shown.partition(":")[0]) == (1, "patrol")


def test_what_cannot_be_read_is_undetermined(check: Check) -> None:
    replace(SOURCE, "  mailbox_.delay(1);", '  mailbox_.delay(1);\n  asm("nop");')
    status, shown = check()
    assert status == 4
    assert shown.startswith("patrol: undetermined")
    assert "RS941" in shown and "patrol/src/robot.cpp:" in shown


@pytest.mark.parametrize(
    ("path", "old", "new"),
    [
        (
            "patrol/include/patrol/mailbox.h",
            "  Startup startup_;",
            "  Startup startup_;\n  int more_;",
        ),
        ("patrol/src/robot_node.cpp", "  reception.start();\n", ""),
        ("patrol/src/robot_node.cpp", "  return 0;", "  rebec.go(4);\n  return 0;"),
        (
            "patrol/launch/patrol.launch",
            'output="screen" respawn="$(arg respawn)"',
            'output="screen" respawn="true"',
        ),
        ("patrol/launch/patrol.launch", "[robot1, robot2]", "[robot2]"),
        ("patrol/msg/RobotGo.msg", "int32", "int16"),
        ("patrol/config/params.yaml", "time_unit: 1.0", "time_unit: 2.0"),
        ("patrol/CMakeLists.txt", "  src/robot_node.cpp\n", ""),
        ("patrol/CMakeLists.txt", "OUTPUT_NAME robot_node", "OUTPUT_NAME robot"),
    ],
)
def test_run_time_code_that_was_edited_is_undetermined(
    check: Check, path: str, old: str, new: str
) -> None:
    replace(path, old, new)
    status, shown = check()
    assert status == 4
    assert f"{path}:" in shown and "RS956" in shown


@pytest.mark.parametrize(
    ("path", "old", "new", "told", "wanted"),
    [
        # What the code alone says has a server to which nothing comes: that is unreadable.
        (SOURCE, 'subscribe("go"', 'subscribe("look"', "topic changed from go to look", 4),
        (SOURCE, '>("other/go")', '>("other/went")', "changed from other/go to other/went", 1),
        (
            "patrol/launch/patrol.launch",
            'to="robot2/go"',
            'to="robot1/go"',
            "binding of other changed from robot2 to robot1",
            1,
        ),
    ],
)
def test_messages_that_get_elsewhere_are_told(
    check: Check, path: str, old: str, new: str, told: str, wanted: int
) -> None:
    replace(path, old, new)
    status, shown = check()
    assert (status, told in shown) == (wanted, True), shown


@pytest.mark.parametrize("told", ["1", "priority(other)", "1 + priority(1)"])
def test_a_priority_that_no_model_has_is_unreadable(check: Check, told: str) -> None:
    replace(SOURCE, 'Server kGo{"go", kNoPriority}', f'Server kGo{{"go", {told}}}')
    status, shown = check()
    assert status == 4
    assert f"{SOURCE}:" in shown and "RS941" in shown and "kNoPriority" in shown


def test_run_time_code_may_be_laid_out_anew(check: Check) -> None:
    for path in ("patrol/include/patrol/mailbox.h", "patrol/src/robot_node.cpp"):
        text = Path(path).read_text()
        Path(path).write_text("// ours\n" + text.replace("  ", "    ").replace("{\n", "\n{\n"))
    replace("patrol/src/robot_node.cpp", "reception.start();", 'ROS_INFO("up"); reception.start();')
    assert check() == (0, "patrol: in step\n")


def test_wiring_follows_the_model(check: Check) -> None:
    replace("patrol.rebeca", "robot1(robot2)", "robot1(robot1)")
    assert main(["generate", "patrol.rebeca"]) == 0
    assert check() == (0, "patrol: in step\n")
    replace(
        "patrol/launch/patrol.launch",
        'to="robot1/go"/>\n  </node>',
        'to="robot1/go"/>\n\n  </node>',
    )
    assert check() == (0, "patrol: in step\n")


def test_run_time_code_that_is_gone_is_undetermined(check: Check) -> None:
    Path("patrol/include/patrol/startup.h").unlink()
    status, shown = check()
    assert status == 4
    assert "patrol/include/patrol/startup.h: RS956" in shown


# --- several packages ---------------------------------------------------------------------------


def test_packages_below_a_directory_each_have_a_verdict(check: Check, package: Path) -> None:
    for name in ("b", "a"):
        shutil.copytree(package.parent, package.parent / name, ignore=lambda *_: ["a", "b"])
    replace("a/patrol/src/robot.cpp", "mailbox_.delay(1)", "mailbox_.delay(3)")
    Path("b/patrol/.rebsync/manifest.json").write_text("{")
    status, shown = check(".")
    assert status == 2
    heads = [line for line in shown.splitlines() if line.partition(":")[0].endswith("patrol")]
    assert [h.partition(": ")[2][:10] for h in heads] == ["the code i", "cannot be ", "in step"]
    assert check("a", "a/patrol", "patrol")[1].count("a/patrol: ") == 1


def test_many_packages_are_read_by_several_processes(
    check: Check, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("c", "b", "a"):
        shutil.copytree(package.parent, package.parent / name, ignore=lambda *_: ["a", "b", "c"])
    replace("a/patrol/src/robot.cpp", "mailbox_.delay(1)", "mailbox_.delay(3)")
    Path("b/patrol/.rebsync/manifest.json").write_text("{")
    Path("c/patrol.rebeca").write_text("reactiveclass {")
    (package / "launch/patrol.launch").unlink()
    monkeypatch.setattr(parallel, "processors", lambda: 1)
    wanted = check(".")
    shutil.rmtree(package.parent / ".cache/values")
    started: list[int] = []
    pool = parallel._pool
    monkeypatch.setattr(parallel, "processors", lambda: 2)
    monkeypatch.setattr(parallel, "ENOUGH", 1)

    def starting(count: int) -> ProcessPoolExecutor:
        started.append(count)
        return pool(count)

    monkeypatch.setattr(parallel, "_pool", starting)
    assert check(".") == wanted
    assert started == [2]
    assert check(".") == wanted, "from the cache"


def test_a_package_is_found_from_inside(
    check: Check, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(package / "src")
    assert check() == (0, "patrol: in step\n")
    monkeypatch.chdir(package)
    replace("src/robot.cpp", "mailbox_.delay(1)", "mailbox_.delay(3)")
    shown = check("--format", "github")[1]
    assert shown.startswith("::error file=src/robot.cpp,line=")


def test_a_model_elsewhere_is_found_again(check: Check, package: Path) -> None:
    Path("models").mkdir()
    Path("ros/src").mkdir(parents=True)
    Path("models/guard.rebeca").write_text(MODEL)
    assert main(["generate", "models/guard.rebeca", "-o", "ros/src"]) == 0
    record = json.loads(Path("ros/src/guard/.rebsync/manifest.json").read_text())
    assert record["model"]["path"] == "../../../models/guard.rebeca"
    assert check() == (0, "patrol: in step\nros/src/guard: in step\n")
    replace("models/guard.rebeca", "delay(1)", "delay(2)")
    status, shown = check(".")
    assert (status, "models/guard.rebeca:25" in shown) == (1, True)


# --- formats ------------------------------------------------------------------------------------


def test_json_has_everything(check: Check) -> None:
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    status, shown = check("--format", "json")
    data = json.loads(shown)
    (told,) = data["packages"]
    assert (status, data["version"], told["path"], told["verdict"]) == (
        1,
        1,
        "patrol",
        "code ahead",
    )
    (difference,) = told["differences"]
    assert difference["element"] == {"kind": "msgsrv", "path": "Robot.go"}
    assert (difference["moved"], difference["kind"]) == ("code", "changed")
    assert difference["left"]["region"]["startLine"] == 25
    assert difference["right"]["path"] == SOURCE


@pytest.mark.parametrize("spoil", ["", "% 6", "asm", "manifest"])
def test_json_is_as_described(check: Check, spoil: str) -> None:
    match spoil:
        case "asm":
            replace(SOURCE, "  mailbox_.delay(1);", '  asm("nop");')
        case "manifest":
            Path("patrol/.rebsync/manifest.json").write_text("")
        case _:
            replace(SOURCE, "% 4", spoil or "% 4")
    schema = json.loads((ROOT / "docs/check.schema.json").read_text(encoding="utf-8"))
    validate(json.loads(check("--verify", "--format", "json")[1]), schema)


def test_junit_has_a_case_for_each_property(check: Check) -> None:
    def cases() -> dict[str, list[str]]:
        suites = ElementTree.fromstring(check("--verify", "--format", "junit")[1])
        return {c.get("name", ""): [e.tag for e in c] for c in suites.iter("testcase")}

    assert cases() == {"in step": [], "property Stays_Small": []}
    replace(SOURCE, "% 4", "% 6")
    assert cases() == {"in step": ["failure"], "property Stays_Small": ["failure"]}
    Path("patrol/.rebsync/manifest.json").unlink()
    assert cases() == {"in step": ["error"]}


def test_sarif_points_at_the_code(check: Check) -> None:
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    status, shown = check("--format", "sarif")
    validate(json.loads(shown), SARIF)
    (run,) = json.loads(shown)["runs"]
    (result,) = run["results"]
    place = result["locations"][0]["physicalLocation"]
    assert (status, result["ruleId"]) == (1, "RS952")
    assert place["artifactLocation"]["uri"] == SOURCE
    before = result["partialFingerprints"]
    Path(SOURCE).write_text("// a line more\n" + Path(SOURCE).read_text())
    replace("patrol.rebeca", "env int", "// a line more\n\nenv int")
    (again,) = json.loads(check("--format", "sarif")[1])["runs"][0]["results"]
    assert again["partialFingerprints"] == before
    assert again["locations"] != result["locations"]


def prints(shown: str) -> set[str]:
    """The fingerprints of all results of a SARIF log."""
    results = json.loads(shown)["runs"][0]["results"]
    found = [p for r in results for p in r["partialFingerprints"].values()]
    assert len(found) == len(set(found)) == len(results)
    return set(found)


def test_fingerprints_stay_when_something_else_is_edited(check: Check) -> None:
    replace(
        SOURCE, "  mailbox_.delay(1);", '  mailbox_.delay(3);\n  small_ = false;\n  asm("nop");'
    )
    first = prints(check("--format", "sarif")[1])
    assert len(first) == 4  # assembly may change what is around its body, too
    replace(SOURCE, "  mailbox_.delay(3);", "  small_ = true;\n\n  mailbox_.delay(4);")
    replace(SOURCE, "#include", "// on top\n#include")
    assert first < prints(check("--format", "sarif")[1])


def test_github_annotates_the_line(check: Check) -> None:
    replace("patrol.rebeca", "delay(1)", "delay(3)")
    status, shown = check("--format", "github")
    assert status == 1
    assert shown.startswith("::error file=patrol.rebeca,line=25,")
    assert "title=RS951" in shown


@pytest.mark.parametrize("style", ["text", "json", "sarif", "github", "junit"])
def test_output_goes_to_a_file(check: Check, package: Path, style: str) -> None:
    out = package.parent.parent / "result"
    assert check("--format", style, "-o", str(out)) == (0, "")
    assert out.is_file()


# --- what can be wrong --------------------------------------------------------------------------


def put(path: str, text: str) -> Callable[[], object]:
    return lambda: Path(path).write_text(text)


def newer() -> None:
    replace("patrol/.rebsync/manifest.json", '"format": 1', '"format": 7')


def conflict_in(path: str, old: str) -> Callable[[], None]:
    return lambda: replace(path, old, f"<<<<<<< HEAD\n{old}\n=======\n{old}\n>>>>>>> theirs")


def unreadable_code() -> None:
    Path(SOURCE).unlink()
    Path(SOURCE).symlink_to("nowhere.cpp")


def damaged_half() -> None:
    path = Path("patrol/.rebsync/manifest.json")
    path.write_text(path.read_text()[:700])


def edited_with_its_base() -> None:
    replace("patrol/.rebsync/base/src/robot.cpp", "delay(1)", "delay(2)")
    replace(SOURCE, "delay(1)", "delay(3)")


WRONG: dict[str, tuple[Callable[[], object], int, str]] = {
    "manifest gone": (Path("patrol/.rebsync/manifest.json").unlink, 2, "manifest.json: RS961"),
    "all records gone": (lambda: shutil.rmtree("patrol/.rebsync"), 2, "RS960"),
    "manifest empty": (put("patrol/.rebsync/manifest.json", ""), 2, "manifest.json:1:1: RS962"),
    "manifest half written": (damaged_half, 2, "RS962 the manifest is damaged"),
    "manifest of the wrong kind": (put("patrol/.rebsync/manifest.json", "[]"), 2, "RS962"),
    "manifest of numbers": (put("patrol/.rebsync/manifest.json", '{"format": 1}'), 2, "RS962"),
    "manifest of a newer version": (newer, 2, "RS963 the manifest has format 7"),
    "manifest in conflict": (
        conflict_in("patrol/.rebsync/manifest.json", '  "format": 1,'),
        2,
        "manifest.json:2:1: RS966",
    ),
    "model in conflict": (
        conflict_in("patrol.rebeca", "    delay(1);"),
        2,
        "patrol.rebeca:25:1: RS966",
    ),
    "code in conflict": (conflict_in(SOURCE, "  mailbox_.delay(1);"), 2, "RS966"),
    "model gone": (Path("patrol.rebeca").unlink, 2, "patrol: RS965 the model patrol.rebeca"),
    "model broken": (put("patrol.rebeca", "reactiveclass {"), 2, "patrol.rebeca:1:"),
    "model not text": (lambda: Path("patrol.rebeca").write_bytes(b"\xff\xfe"), 2, "RS804"),
    "base of another model": (
        lambda: replace("patrol/.rebsync/base.rebeca", "delay(1)", "delay(2)"),
        1,
        "base.rebeca: RS964",
    ),
    "base gone": (Path("patrol/.rebsync/base.rebeca").unlink, 1, "base.rebeca: RS964"),
    "base damaged": (put("patrol/.rebsync/base.rebeca", "<<"), 1, "base.rebeca: RS964"),
    "base of the code edited": (
        edited_with_its_base,
        4,
        "base/src/robot.cpp: RS964 this is kept as it was generated, and has been edited",
    ),
    "code gone": (Path(SOURCE).unlink, 4, "RS941"),
    "code a dangling link": (unreadable_code, 4, "robot.cpp: RS941"),
    "all code gone": (lambda: shutil.rmtree("patrol/src"), 4, "its body is not in these files"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_said(check: Check, name: str) -> None:
    spoil, wanted, told = WRONG[name]
    spoil()
    status, shown = check()
    assert told in shown, shown
    assert status == wanted, shown


def test_without_a_base_the_verdict_is_careful(check: Check) -> None:
    Path("patrol/.rebsync/base.rebeca").unlink()
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    status, shown = check()
    assert status == 1
    assert shown.startswith("patrol: model and code differ; who moved is not known")


def test_a_model_that_moved_is_pointed_at(check: Check) -> None:
    Path("deep/down").mkdir(parents=True)
    Path("patrol.rebeca").rename("deep/down/guard.rebeca")
    status, shown = check("patrol")
    assert status == 0
    assert "RS965 its model is deep/down/guard.rebeca, which" in shown
    assert check("patrol", "--model", "deep/down/guard.rebeca") == (0, "patrol: in step\n")


def test_records_are_not_needed_where_the_model_is_named(check: Check) -> None:
    shutil.rmtree("patrol/.rebsync")
    assert check("patrol", "--model", "patrol.rebeca") == (0, "patrol: in step\n")
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    status, shown = check("patrol", "--model", "patrol.rebeca")
    assert status == 1
    assert shown.startswith("patrol: model and code differ; who moved is not known")


def test_settings_say_which_model_it_is(check: Check) -> None:
    Path("rebsync.toml").write_text("time_unit = 1.0\n")
    shutil.rmtree("patrol/.rebsync")
    for arguments in ([], ["patrol"], ["patrol.rebeca"]):
        assert check(*arguments) == (0, "patrol: in step\n")
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    assert check()[0] == 1


def test_a_model_is_named_for_one_package(check: Check, package: Path) -> None:
    shutil.copytree("patrol", "other")
    status, shown = check(".", "--model", "patrol.rebeca")
    assert (status, "--model is for one package, and here are 2" in shown) == (2, True)


def test_settings_that_changed_are_noticed(check: Check) -> None:
    Path("rebsync.toml").write_text("seed = 0\n")
    assert check() == (0, "patrol: in step\n")
    Path("rebsync.toml").write_text("seed = 0\ntime_unit = 0.5\n")
    status, shown = check()
    assert status == 1
    assert shown.startswith("patrol: the settings are ahead")
    assert "rebsync.toml:2:1: RS955 `time_unit` was 1.0" in shown
    assert main(["generate", "patrol.rebeca"]) == 0
    assert check() == (0, "patrol: in step\n")
    Path("rebsync.toml").write_text("time_unit = 0\n")
    assert check()[0] == 2


def test_a_package_may_move(check: Check, package: Path) -> None:
    Path("ros").mkdir()
    package.rename("ros/robots")
    status, shown = check("ros")
    assert status == 2 and "RS965" in shown
    Path("patrol.rebeca").rename("ros/patrol.rebeca")
    assert check("ros") == (0, "ros/robots: in step\n")


def test_line_ends_do_not_matter(check: Check, package: Path) -> None:
    for path in [*package.rglob("*"), Path("patrol.rebeca")]:
        if path.is_file():
            path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    assert check() == (0, "patrol: in step\n")
    replace("patrol/src/robot.cpp", "mailbox_.delay(1)", "mailbox_.delay(3)")
    status, shown = check()
    assert (status, "delay changed from 1 to 3" in shown) == (1, True)


def test_links_out_of_the_tree_are_not_followed(check: Check, package: Path) -> None:
    Path("patrol/src/everything").symlink_to("/")
    Path("patrol/include/patrol/robot.h").unlink()
    Path("patrol/include/patrol/robot.h").symlink_to("/etc/hostname")
    status, shown = check()
    assert status == 4
    assert "patrol/src/everything: RS941" in shown
    assert "patrol/include/patrol/robot.h: RS941" in shown


def test_links_within_the_tree_are_followed(check: Check, package: Path) -> None:
    Path("patrol/src/robot.cpp").rename("robot.cpp")
    Path("patrol/src/robot.cpp").symlink_to("../../robot.cpp")
    Path("workspace").mkdir()
    Path("workspace/patrol").symlink_to("../patrol")
    assert check("patrol") == (0, "patrol: in step\n")
    assert check("workspace/patrol") == (0, "workspace/patrol: in step\n")


def test_a_read_only_tree_can_be_checked(check: Check, package: Path) -> None:
    for path in sorted(package.parent.rglob("*")):
        if path.is_file():
            path.chmod(0o444)
    replaced = Path(SOURCE)
    replaced.chmod(0o644)
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    replaced.chmod(0o444)
    assert check()[0] == 1


@pytest.mark.parametrize(
    "arguments", [["nowhere"], ["patrol.property"], [".cache"], ["--format", "xml"], [""]]
)
def test_wrong_usage(check: Check, package: Path, arguments: list[str]) -> None:
    status, shown = check(*arguments)
    assert status == 2
    assert shown


# --- properties ---------------------------------------------------------------------------------


def test_drift_that_harms_nothing_is_told_from_drift_that_does(check: Check) -> None:
    status, shown = check("--verify")
    assert status == 0
    assert "in step, all properties hold" in shown
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(2)")
    status, shown = check("--verify")
    assert status == 1
    assert "drifted, all properties still hold" in shown
    replace(SOURCE, "% 4", "% 6")
    status, shown = check("--verify")
    assert status == 3
    assert "drifted, property Stays_Small broken" in shown
    line = next(x for x in shown.splitlines() if "robot1.look() from robot1" in x)
    assert "patrol.rebeca:18" in line and "patrol/src/robot.cpp:" in line
    bad = [x for x in shown.splitlines() if x.startswith("  > ")]
    assert [re.sub(r".*robot.cpp:\d+", "", x) for x in bad] == ["  <-- property Stays_Small"]


def test_a_long_run_is_folded_to_what_matters(check: Check) -> None:
    replace(SOURCE, "% 4", "% 60")
    replace("patrol.property", "< 4", "< 20")
    status, folded = check("--verify")
    full = check("--verify", "--full")[1]
    steps = re.compile(r"^[ >]{4} *(\d+) +\d+  ", re.MULTILINE)
    shown, every = ([int(n) for n in steps.findall(text)] for text in (folded, full))
    assert (status, every) == (3, list(range(len(every))))
    assert shown[0] == 0 and shown[-8:] == every[-8:]
    left = len(every) - len(shown)
    assert left > 20
    assert sum(map(int, re.findall(r"\.\.\.  (\d+) steps? more; --full", folded))) == left
    assert "--full" not in full


def test_a_run_that_is_wrong_twice_is_told_once(check: Check) -> None:
    replace(SOURCE, "% 4", "% 6")
    text = Path("patrol.property").read_text(encoding="utf-8")
    name = "    Stays_Small: "
    (line,) = (each for each in text.splitlines(keepends=True) if each.startswith(name))
    twice = text.replace(line, line + line.replace("Stays_Small", "As_Small"))
    Path("patrol.property").write_text(twice, encoding="utf-8")
    tables = [check("--verify", *options)[1].count("  step  time") for options in ((), ("--full",))]
    assert tables == [1, 2]
    assert "    on the run of property Stays_Small\n" in check("--verify")[1]


def test_places_of_a_run_are_those_from_here(
    check: Check, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    deep = Path("a/folder/with/a/long/name/below/the/current/directory")
    deep.mkdir(parents=True)
    for name in ("patrol.rebeca", "patrol.property", "patrol"):
        Path(name).rename(deep / name)
    replace(str(deep / SOURCE), "% 4", "% 6")
    for path in (str(deep), str(deep.absolute())):
        shown = check("--verify", path)[1]
        assert f"  {deep}/patrol.rebeca:18  {deep}/{SOURCE}:" in shown
    monkeypatch.chdir(deep / "patrol/launch")
    assert "  ../../patrol.rebeca:18  ../src/robot.cpp:" in check("--verify")[1]


def test_a_violation_is_a_finding_in_the_code(check: Check) -> None:
    replace(SOURCE, "% 4", "% 6")
    status, shown = check("--verify", "--format", "sarif")
    validate(json.loads(shown), SARIF)
    results = json.loads(shown)["runs"][0]["results"]
    assert status == 3
    found = next(r for r in results if r["ruleId"] == "RS957")
    assert "Stays_Small" in found["message"]["text"]
    assert found["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == SOURCE
    assert "time 0: robot1.look()" in found["relatedLocations"][0]["message"]["text"]
    data = json.loads(check("--verify", "--format", "json")[1])["packages"][0]["verification"]
    assert data["verdict"] == "violated"
    assert data["broken"] == ["property Stays_Small"]
    assert any(p["model"] and p["code"] for p in data["places"].values())


def test_what_a_verdict_leaves_open_is_told_in_every_form(check: Check) -> None:
    model = Path("patrol.rebeca").read_text()
    again = "    if (?(false, true)) { self.look(); return; }\n    self.look() after(e);\n"
    Path("patrol.rebeca").write_text(model.replace("    self.look() after(e);\n", again))
    shutil.rmtree("patrol")
    assert main(["generate", "patrol.rebeca"]) == 0
    told = {style: check("--verify", "--format", style) for style in FORMATS}
    assert {status for status, _ in told.values()} == {0}, told
    assert [style for style, (_, shown) in told.items() if CYCLE_CAVEAT not in shown] == []
    validate(json.loads(told["sarif"][1]), SARIF)
    (note,) = json.loads(told["sarif"][1])["runs"][0]["results"]
    assert (note["ruleId"], note["level"]) == ("RS949", "note")
    assert "::notice " in told["github"][1]
    replace("patrol.property", "< 4", "< 3")
    told = {style: check("--verify", "--format", style) for style in FORMATS}
    assert {status for status, _ in told.values()} == {3}, told
    assert [style for style, (_, shown) in told.items() if CYCLE_CAVEAT not in shown] == []


def test_nothing_holds_of_what_cannot_be_read(check: Check) -> None:
    replace(SOURCE, "  mailbox_.delay(1);", '  mailbox_.delay(1);\n  asm("nop");')
    status, shown = check("--verify")
    assert status == 4
    assert "undetermined: 2 places of the code cannot be read" in shown


def test_nothing_holds_where_messages_go_elsewhere(check: Check) -> None:
    """The model of the code has them where they went."""
    replace(SOURCE, '>("other/go")', '>("other/come")')
    status, shown = check()
    assert (status, "the code joins nodes otherwise" in shown) == (1, True), shown
    status, shown = check("--verify")
    assert status == 4
    assert "undetermined: a place is not as generated, and in no model" in shown


def test_a_search_that_is_cut_short_is_undetermined(check: Check) -> None:
    status, shown = check("--verify", "--max-states", "2")
    assert status == 4
    assert "undetermined: the bound of 2 states was reached; not finished: Stays_Small" in shown


def test_settings_allow_a_system_to_end(check: Check) -> None:
    for path in (SOURCE, "patrol.rebeca"):
        text = Path(path).read_text()
        Path(path).write_text(re.sub(r"\n.*look\(.* after\(e\);|\n.*postLook\(.*", "", text))
    ending = Path("patrol.rebeca").read_text()
    shutil.rmtree("patrol")
    assert main(["generate", "patrol.rebeca"]) == 0
    assert "look() after" not in ending
    status, shown = check("--verify")
    assert (status, "in step, deadlock" in shown) == (3, True), shown
    assert main(["verify", "patrol.rebeca"]) == 3
    Path("rebsync.toml").write_text('allow = ["deadlock"]\n')
    status, shown = check("--verify")
    assert (status, "in step, all properties hold" in shown) == (0, True), shown
    assert check() == (0, "patrol: in step\n")
    assert main(["verify", "patrol.rebeca"]) == 0
    Path("rebsync.toml").write_text('allow = ["dedlock"]\n')
    status, shown = check("--verify")
    assert (status, "RS809" in shown and 'did you mean "deadlock"' in shown) == (2, True), shown


def test_properties_that_do_not_fit_are_undetermined(check: Check) -> None:
    header = "patrol/include/patrol/robot.h"
    for path in (SOURCE, header):
        Path(path).write_text(re.sub(r"\bx_\b", "place_", Path(path).read_text()))
    status, shown = check("--verify")
    assert status == 4
    assert "the properties do not fit what the code says" in shown


def test_properties_are_picked_by_name(check: Check) -> None:
    replace("patrol.property", "Stays_Small: small;", "Stays_Small: small; Is_Off: !robot1.on;")
    replace(SOURCE, "% 4", "% 6")
    asked = ("--verify", "--property-name")
    assert re.search(r"  drifted, properties .*Is_Off.* broken\n", check("--verify")[1])
    status, shown = check(*asked, "Stays_Small")
    assert status == 3
    assert "  drifted, property Stays_Small broken\n" in shown
    assert "Is_Off" not in shown
    replace(SOURCE, "% 6", "% 4")
    status, shown = check(*asked, "Stays_Small")
    assert (status, "in step, Stays_Small holds\n" in shown) == (0, True), shown
    status, shown = check(*asked, "Stays_Smal")
    assert (status, 'RS929 no property is called "Stays_Smal"' in shown) == (2, True), shown
    status, shown = check("--property-name", "Stays_Small")
    assert (status, "--property-name picks properties for --verify" in shown) == (2, True), shown


def test_a_collision_is_shown_in_model_and_code(tmp_path: Path) -> None:
    """The drift that makes experiment 2 of the thesis unsafe."""
    example = tmp_path / "experiment2"
    shutil.copytree(ROOT / "examples/experiment2", example)
    safe = example / "experiment2/src/control_node.cpp"
    text, count = re.subn(UNSAFE, "", safe.read_text())
    assert count == 2
    safe.write_text(text)
    done = rebsync("check", "experiment2", "--verify", cwd=tmp_path)
    assert done.status == 3
    broken = "properties Collision_Avoidance, Left_Before_Entered broken; deadlock"
    assert f"drifted, {broken}" in done.out
    lines = [x for x in done.out.splitlines() if "experiment2.rebeca:" in x and ".cpp:" in x]
    assert len(lines) > 5


# --- speed --------------------------------------------------------------------------------------

_LOADED = """
import sys
from rebsync.cli import main
status = main(["check", *sys.argv[1:]])
heavy = {"lark", "tree_sitter", "jinja2", "libcst", "rebsync.model"} & set(sys.modules)
print(status, sorted(heavy))
"""


def loaded(*arguments: str) -> str:
    """The last line of a run: its status, and what it has loaded."""
    done = subprocess.run(
        [sys.executable, "-c", _LOADED, *arguments],
        capture_output=True,
        text=True,
        env=environment(),
        check=True,
    )
    return done.stdout.splitlines()[-1]


def test_nothing_is_parsed_where_nothing_has_changed(check: Check) -> None:
    assert loaded() == "0 []"


def test_what_was_read_once_is_not_read_again(check: Check) -> None:
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    first = loaded()
    assert "tree_sitter" in first and "lark" in first
    assert loaded() == "1 []"
    replace("patrol.rebeca", "delay(1)", "delay(2)")
    assert loaded() == "1 ['lark', 'rebsync.model']"
    assert loaded() == "1 []"


def test_a_damaged_cache_is_as_good_as_none(check: Check, package: Path) -> None:
    replace(SOURCE, "mailbox_.delay(1)", "mailbox_.delay(3)")
    wanted = check()
    entries = [p for p in (package.parent / ".cache/values").iterdir() if p.is_file()]
    assert len(entries) >= 2
    for number, entry in enumerate(entries):
        data = entry.read_bytes()
        entry.write_bytes([b"", data[:40], data[:-1] + b"x"][number % 3])
    assert check() == wanted
    shutil.rmtree(package.parent / ".cache/values")
    assert check() == wanted
