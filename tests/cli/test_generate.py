"""`rebsync generate` as a user meets it: files, edits, refusals, exit status."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.config import TARGETS

ROOT = Path(__file__).parents[2]
MODEL = """\
env int e = 2;

@Robot
reactiveclass Robot(3) {
  statevars {
    int x;
  }

  Robot(int x0) {
    x = x0;
    self.look();
  }

  @Sensor
  msgsrv look() {
    x = ?(0, 1);
    self.look() after(e);
  }

  msgsrv go() {
    @Move(X + 1, Y);
    delay(1);
  }
}

main {
  Robot robot1():(1);
}
"""


@pytest.fixture
def model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "patrol.rebeca"
    path.write_text(MODEL)
    return path


def generate(*arguments: str) -> int:
    return main(["generate", "patrol.rebeca", *arguments])


def tree(folder: Path) -> dict[str, str]:
    return {
        p.relative_to(folder).as_posix(): p.read_text()
        for p in sorted(folder.rglob("*"))
        if p.is_file()
    }


def test_the_package_is_whole_and_stable(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert generate() == 0
    files = tree(Path("patrol"))
    for path in (
        "package.xml",
        "CMakeLists.txt",
        "README.md",
        "launch/patrol.launch",
        "config/params.yaml",
        "msg/RobotGo.msg",
        "include/patrol/robot.h",
        "include/patrol/robot_sensors.h",
        "include/patrol/mailbox.h",
        "src/robot.cpp",
        "src/robot_node.cpp",
        "src/robot_stand_in.cpp",
        ".rebsync/manifest.json",
        ".rebsync/base.rebeca",
        ".rebsync/base/src/robot.cpp",
    ):
        assert path in files, path
    assert files[".rebsync/base.rebeca"] == MODEL
    record = json.loads(files[".rebsync/manifest.json"])
    assert record["model"]["name"] == "patrol.rebeca"
    assert "msgsrv Robot.go" in record["elements"]["src/robot.cpp"]
    assert set(record["files"]) == {p for p in files if not p.startswith(".rebsync/")}
    before = {p: p.stat().st_mtime_ns for p in Path("patrol").rglob("*") if p.is_file()}
    assert generate() == 0
    assert tree(Path("patrol")) == files
    assert {p: p.stat().st_mtime_ns for p in Path("patrol").rglob("*") if p.is_file()} == before
    assert "0 of them written" in capsys.readouterr().out


def test_listing_and_diff_write_nothing(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert generate("--list") == 0
    listed = capsys.readouterr().out.splitlines()
    assert "patrol/src/robot.cpp" in listed
    assert generate("--diff") == 1
    assert "+++ b/src/robot.cpp" in capsys.readouterr().out
    assert not Path("patrol").exists()
    assert generate() == 0
    capsys.readouterr()
    assert generate("--diff") == 0
    assert capsys.readouterr().out == ""


def test_an_edit_is_kept_while_nothing_new_is_generated(model: Path) -> None:
    generate()
    source = Path("patrol/src/robot.cpp")
    source.write_text(source.read_text() + "// mine\n")
    assert generate() == 0
    assert source.read_text().endswith("// mine\n")


def test_an_edited_file_is_not_overwritten(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    generate()
    source = Path("patrol/src/robot.cpp")
    edited = source.read_text().replace("mailbox_.delay(1)", "mailbox_.delay(2)")
    source.write_text(edited)
    model.write_text(MODEL.replace("delay(1)", "delay(3)"))
    before = tree(Path("patrol"))
    capsys.readouterr()
    assert generate() == 1
    shown = capsys.readouterr().err
    assert "patrol/src/robot.cpp: RS701" in shown
    assert "nothing was written" in shown
    assert tree(Path("patrol")) == before
    assert generate("--force") == 0
    assert "mailbox_.delay(3)" in source.read_text()
    assert Path("patrol/src/robot.cpp.orig").read_text() == edited


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_edits_elsewhere_in_a_file_are_merged(model: Path, end: str) -> None:
    generate()
    source = Path("patrol/src/robot.cpp")
    mine = f"{source.read_text()}// mine\n".replace("\n", end)
    source.write_bytes(mine.encode())
    model.write_text(MODEL.replace("delay(1)", "delay(3)"))
    assert generate() == 0
    wanted = mine.replace("mailbox_.delay(1)", "mailbox_.delay(3)")
    assert source.read_bytes() == wanted.encode() != mine.encode()
    assert generate() == 0
    assert source.read_bytes() == wanted.encode()


def test_what_is_merged_must_say_what_the_model_says(
    model: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    more = "\n    x = x + 1;" * 4
    text = MODEL.replace("delay(1);", f"int k = 1;\n    delay(k);{more}")
    model.write_text(text)
    generate()
    source = Path("patrol/src/robot.cpp")
    edited = re.sub(r"\bk\b", "pause", source.read_text())
    source.write_text(edited)
    assert main(["check"]) == 0, "it is called otherwise, no more"
    model.write_text(text.replace(more, f"{more}\n    x = k;"))
    before = tree(Path())
    capsys.readouterr()
    assert generate() == 1
    shown = capsys.readouterr().err
    assert "RS968 merged, msgsrv Robot.go of the code would not say what the model says" in shown
    assert "nothing was written" in shown
    assert tree(Path()) == before
    assert generate("--force") == 0
    assert Path(f"{source}.orig").read_text() == edited
    assert main(["check"]) == 0


def test_every_edit_that_was_forced_aside_is_kept(model: Path) -> None:
    generate()
    source = Path("patrol/src/robot.cpp")
    for time in (3, 4, 5):
        source.write_text(f"// edit {time}\n")
        model.write_text(MODEL.replace("delay(1)", f"delay({time})"))
        assert generate("--force") == 0
    kept = sorted(Path("patrol/src").glob("*.orig*"))
    assert [p.name for p in kept] == [f"robot.cpp.orig{end}" for end in ("", ".2", ".3")]
    assert [p.read_text() for p in kept] == [f"// edit {time}\n" for time in (3, 4, 5)]


def test_other_files_follow_the_model_beside_an_edit(model: Path) -> None:
    generate()
    notes = Path("patrol/README.md")
    notes.write_text("our own words\n")
    Path("patrol/src/extra.cpp").write_text("int x;\n")
    model.write_text(MODEL.replace("delay(1)", "delay(3)"))
    assert generate() == 0
    assert notes.read_text() == "our own words\n"
    assert Path("patrol/src/extra.cpp").read_text() == "int x;\n"
    assert "mailbox_.delay(3)" in Path("patrol/src/robot.cpp").read_text()


def test_user_code_survives(model: Path) -> None:
    generate()
    sensors = Path("patrol/include/patrol/robot_sensors.h")
    text = sensors.read_text().replace("return msg.x;", "return msg.x > 3 ? 1 : 0;  // mine")
    assert "// mine" in text
    sensors.write_text(text)
    model.write_text(
        MODEL.replace("class Robot(3)", "class Robot(5)").replace("?(0, 1)", "?(0, 2)")
    )
    assert generate() == 0
    assert "// mine" in sensors.read_text()
    assert "mailbox_(node, 5)" in Path("patrol/src/robot.cpp").read_text()


def test_what_is_generated_no_more_goes(model: Path) -> None:
    generate()
    Path("patrol/src/robot_stand_in.cpp").touch()
    model.write_text(MODEL.replace("@Sensor\n", ""))
    assert generate() == 0
    assert not Path("patrol/src/robot_stand_in.cpp").exists()
    assert not Path("patrol/.rebsync/base/src/robot_stand_in.cpp").exists()


def test_another_model_of_the_same_package_is_refused(
    model: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    generate()
    before = tree(Path("patrol"))
    Path("Patrol.rebeca").write_text(MODEL.replace("delay(1)", "delay(3)"))
    assert main(["generate", "Patrol.rebeca"]) == 2
    assert "RS708" in capsys.readouterr().err
    assert tree(Path("patrol")) == before
    assert main(["generate", "Patrol.rebeca", "--force"]) == 0
    assert "mailbox_.delay(3)" in Path("patrol/src/robot.cpp").read_text()


def test_a_folder_that_is_not_ours_is_respected(model: Path) -> None:
    Path("patrol").mkdir()
    Path("patrol/package.xml").write_text("<package/>\n")
    assert generate() == 1
    assert tree(Path("patrol")) == {"package.xml": "<package/>\n"}


@pytest.mark.parametrize(
    ("text", "code", "place"),
    [
        ("reactiveclass A(1) { A() { } ", "RS1", ":1:"),
        (MODEL.replace("x = x0", "y = x0"), "RS2", ":10:"),
        (MODEL.replace("x = x0;", "x = x0; new Robot():(1);"), "RS110", ":10:"),
        ("featurevar f;\n" + MODEL, "RS110", ":1:"),
        ("record R { int a; }\n" + MODEL, "RS110", ":1:"),
        ("physicalclass P(1) { }\n", "RS113", ":1:"),
        (MODEL.replace("?(0, 1)", "?(0.5: 0, 0.5: 1)"), "RS113", ":16:"),
        ("", "RS4", ":1:"),
    ],
)
def test_what_cannot_be_generated_says_so(
    model: Path, capsys: pytest.CaptureFixture[str], text: str, code: str, place: str
) -> None:
    model.write_text(text)
    assert generate() == 2
    shown = capsys.readouterr().err
    assert code in shown and f"patrol.rebeca{place}" in shown, shown
    assert not Path("patrol").exists()


def test_settings_come_from_rebsync_toml(model: Path) -> None:
    Path("rebsync.toml").write_text(
        'package = "patrol_robot"\ntime_unit = 0.5\nlicense = "MIT"\n'
        '[[maintainers]]\nname = "Ada <A&B>"\nemail = "ada@example.org"\n'
        '[sensors."Robot.look"]\ntopic = "/scan"\ntype = "sensor_msgs/LaserScan"\n'
        'seen = "msg.ranges.empty() ? 0 : 1"\n'
    )
    assert generate("-o", "deep/down") == 0
    files = tree(Path("deep/down/patrol_robot"))
    assert "time_unit: 0.5" in files["config/params.yaml"]
    assert "Ada &lt;A&amp;B&gt;" in files["package.xml"]
    assert "<depend>sensor_msgs</depend>" in files["package.xml"]
    assert "msg.ranges.empty() ? 0 : 1" in files["include/patrol_robot/robot_sensors.h"]
    assert 'to="/scan"' in files["launch/patrol_robot.launch"]
    assert "src/robot_stand_in.cpp" not in files


@pytest.mark.parametrize("target", TARGETS)
def test_the_licence_and_the_maintainer_are_asked_for_not_invented(
    model: Path, capsys: pytest.CaptureFixture[str], target: str
) -> None:
    assert generate("--target", target) == 0
    shown = capsys.readouterr().err
    assert shown.count("RS710") == 3, shown
    assert "license" in shown and "maintainers" in shown and "copyright" in shown
    for manifest in Path("patrol").glob("**/package.xml"):
        text = manifest.read_text()
        assert "<license>TODO: License declaration</license>" in text
        assert '<maintainer email="user@todo.todo">TODO: maintainer</maintainer>' in text
    Path("rebsync.toml").write_text(
        'license = "MIT"\nmaintainers = [{ name = "Ada", email = "ada@example.org" }]\n'
        'copyright = "2026 ACME Robotics"\n'
    )
    assert generate("--target", target) == 0
    assert "RS710" not in capsys.readouterr().err
    assert "TODO" not in "".join(p.read_text() for p in Path("patrol").glob("**/package.xml"))


@pytest.mark.parametrize(
    ("settings", "code"),
    [
        ('packge = "x"\n', "RS8"),
        ('package = "exp2"\n', "RS702"),
        ('package = "std_msgs"\n', "RS702"),
        ("package =\n", "RS8"),
        ('[sensors."Robot.nothing"]\ntopic = "/scan"\ntype = "std_msgs/Int32"\n', "RS707"),
    ],
)
def test_wrong_settings_are_reported(
    model: Path, capsys: pytest.CaptureFixture[str], settings: str, code: str
) -> None:
    Path("rebsync.toml").write_text(settings)
    assert generate() == 2
    assert code in capsys.readouterr().err
    assert not Path("patrol").exists()


@pytest.mark.parametrize(
    ("name", "package"),
    [
        ("exp2.rebeca", "exp2_nodes"),
        ("My Model-2.rebeca", "my_model_2"),
        ("2robots.rebeca", "model_2robots"),
        ("HTTPServer.v1.rebeca", "http_server_v1"),
        ("class.rebeca", "class_nodes"),
    ],
)
def test_package_names_are_legal(model: Path, name: str, package: str) -> None:
    shutil.copy(model, name)
    assert main(["generate", name, "-o", "out"]) == 0
    assert [p.name for p in Path("out").iterdir()] == [package]


@pytest.mark.parametrize(
    "arguments",
    [
        ["generate"],
        ["generate", "nothing.rebeca"],
        ["generate", "."],
        ["generate", "patrol.rebeca", "--target", "ros9"],
        ["generate", "patrol.rebeca", "-o", "patrol.rebeca"],
        ["generate", "patrol.rebeca", "-o", "/proc/nowhere"],
        ["generate", "binary.rebeca"],
        ["generate", "patrol.rebeca", "-o", "-"],
        ["generate", "patrol.rebeca", "-o", ""],
        ["generate", "patrol.rebeca", "--list", "--force"],
    ],
)
def test_bad_input_is_no_traceback(
    model: Path, capsys: pytest.CaptureFixture[str], arguments: list[str]
) -> None:
    Path("binary.rebeca").write_bytes(b"\xff\xfe\x00reactiveclass")
    assert main(arguments) == 2
    assert capsys.readouterr().err


def test_generation_does_not_depend_on_the_process(model: Path, tmp_path: Path) -> None:
    for seed, locale in (("1", "C"), ("77", "C.UTF-8")):
        subprocess.run(
            [sys.executable, "-m", "rebsync", "generate", str(model), "-o", str(tmp_path / seed)],
            check=True,
            capture_output=True,
            cwd="/",
            env={**os.environ, "PYTHONHASHSEED": seed, "LC_ALL": locale, "PYTHONPATH": str(ROOT)},
        )
    assert tree(tmp_path / "1") == tree(tmp_path / "77")


def test_line_ends_are_no_edit(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    generate()
    for path in Path("patrol").rglob("*"):
        if path.is_file():
            path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    before = tree(Path("patrol"))
    capsys.readouterr()
    assert generate() == 0
    assert "your edit" not in capsys.readouterr().out
    own = {n: t for n, t in tree(Path("patrol")).items() if not n.startswith(".rebsync/")}
    assert own == {n: t for n, t in before.items() if n in own}
    model.write_text(MODEL.replace("delay(1)", "delay(3)"))
    assert generate() == 0
    assert "your edit" not in capsys.readouterr().out
    text = Path("patrol/src/robot.cpp").read_bytes()
    assert b"delay(3);\r\n" in text and b"\n" not in text.replace(b"\r\n", b"")
    Path("patrol/README.md").write_bytes(b"mine\r\n")
    assert generate() == 0
    assert "kept patrol/README.md, which is not as generated\n" in capsys.readouterr().out
