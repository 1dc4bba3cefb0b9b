"""What is out of all proportion, or goes away under a command, ends in a mistake with a code."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.run import ROOT, environment, rebsync

_MODEL = """reactiveclass Robot(QUEUE) {
    statevars { int x; int[SIZE] a; }
    Robot() { self.go(); }
    msgsrv go() { x = VALUE; self.go() after(TIME); }
}
main { Robot r():(); }
"""
_SOUND = {"QUEUE": "3", "SIZE": "2", "VALUE": "1", "TIME": "1"}
_LONG = ["9" * 4301, "9" * 10_001, "0x" + "f" * 10_001, "1" + "0" * 400]
_CPP = """#include <ros/ros.h>
#include <std_msgs/Int32.h>
ros::Publisher pub;
void tick(const ros::TimerEvent&) { std_msgs::Int32 m; m.data = NUMBER; pub.publish(m); }
void heard(const std_msgs::Int32& m) { ros::Duration(NUMBER).sleep(); }
int main(int argc, char** argv) {
  ros::init(argc, argv, "n");
  ros::NodeHandle n;
  pub = n.advertise<std_msgs::Int32>("out", NUMBER);
  ros::Subscriber s = n.subscribe("in", 3, heard);
  ros::Timer t = n.createTimer(ros::Duration(NUMBER), tick);
  ros::spin();
}
"""
_PYTHON = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32
class Node:
    def __init__(self):
        self.count = NUMBER
        self.pub = rospy.Publisher("out", Int32, queue_size=NUMBER)
        rospy.Subscriber("in", Int32, self.heard)
        rospy.Timer(rospy.Duration(NUMBER), self.tick)
    def tick(self, event):
        self.count += NUMBER
        self.pub.publish(Int32(NUMBER))
    def heard(self, msg):
        rospy.sleep(NUMBER)
rospy.init_node("n")
Node()
rospy.spin()
"""


@pytest.mark.parametrize("place", sorted(_SOUND))
@pytest.mark.parametrize("number", _LONG, ids=["4301", "10001", "hexadecimal", "401"])
def test_long_numbers_in_models(place: str, number: str, tmp_path: Path) -> None:
    text = _MODEL
    for name, value in {**_SOUND, place: number}.items():
        text = text.replace(name, value)
    (tmp_path / "m.rebeca").write_text(text)
    done = rebsync("verify", "m.rebeca", "--max-states", "9", cwd=tmp_path)
    assert done.status == 2, done
    assert "m.rebeca:" in done.err
    assert ("RS830" in done.err) == (len(number) > 10_000)


@pytest.mark.parametrize("number", [*_LONG, "1e400", "-1e400"], ids=lambda n: f"{n[:2]}-{len(n)}")
@pytest.mark.parametrize("text", [_CPP, _PYTHON], ids=["cpp", "python"])
def test_long_numbers_in_code(text: str, number: str, tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text("<package><name>p</name></package>")
    name = "n.cpp" if text is _CPP else "n.py"
    (tmp_path / name).write_text(text.replace("NUMBER", number))
    done = rebsync("extract", ".", cwd=tmp_path)
    assert done.status in (2, 4), done
    assert "RS941" in done.err or "RS943" in done.err


@pytest.mark.parametrize("number", ["9" * 4301, "9" * 10_001, "1e400", "1" + "0" * 400])
def test_long_numbers_in_other_files(number: str, tmp_path: Path) -> None:
    shutil.copy(ROOT / "examples/hello/hello.rebeca", tmp_path / "m.rebeca")
    settings = tmp_path / "rebsync.toml"
    settings.write_text(f"time_unit = {number}\n")
    done = rebsync("generate", "m.rebeca", cwd=tmp_path)
    assert done.status == 2 and "rebsync.toml" in done.err, done
    settings.unlink()
    (tmp_path / "m.property").write_text(
        f"property {{ Assertion {{ a: walker.steps < {number}; }} }}"
    )
    done = rebsync("verify", "m.rebeca", "--max-states", "9", cwd=tmp_path)
    assert done.status == (4 if number == "1e400" else 2), done  # floats may be infinite
    rebsync("generate", "m.rebeca", cwd=tmp_path)
    manifest = tmp_path / "m/.rebsync/manifest.json"
    manifest.write_text(manifest.read_text().replace('"format": 1', f'"format": {number}'))
    assert rebsync("check", "m", cwd=tmp_path).status == 2
    message = next((tmp_path / "m/msg").glob("Walker[!S]*.msg"))  # not that of the state
    message.write_text(f"int32 A={number}\nint32[{number}] b\n")
    assert rebsync("extract", "m", cwd=tmp_path).status in (0, 1, 4)


@pytest.mark.parametrize("opening", ["[", '{"a":'])
def test_a_manifest_that_nests_deep(opening: str, tmp_path: Path) -> None:
    shutil.copy(ROOT / "examples/hello/hello.rebeca", tmp_path / "m.rebeca")
    rebsync("generate", "m.rebeca", cwd=tmp_path)
    (tmp_path / "m/.rebsync/manifest.json").write_text(opening * 100_000)
    for command in (("check", "m"), ("sync", "m"), ("generate", "m.rebeca")):
        done = rebsync(*command, cwd=tmp_path)
        assert done.status in (0, 1, 2), done.err


def test_directories_that_nest_deep(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As deep as a repository can bring them; nothing else of the machine can walk them either."""
    shutil.copy(ROOT / "examples/hello/hello.rebeca", tmp_path / "m.rebeca")
    rebsync("generate", "m.rebeca", cwd=tmp_path)
    monkeypatch.chdir(tmp_path / "m/src")
    for _ in range(1_900):
        os.mkdir("d")  # noqa: PTH102
        os.chdir("d")
    try:
        commands = ("lint .", "fmt --check .", "extract m", "generate m.rebeca", "check", "sync")
        for command in commands:
            done = rebsync(*command.split(), cwd=tmp_path)
            assert done.status in (0, 2), (command, done)
            assert (done.status == 2) == ("RS111" in done.err + done.out), (command, done)
    finally:  # pytest cannot take them away
        monkeypatch.undo()
        subprocess.run(["rm", "-r", str(tmp_path / "m")], check=True)


def test_names_of_files_that_are_not_utf_8(tmp_path: Path) -> None:
    folder = os.fsencode(tmp_path) + b"/d\xff"
    os.mkdir(folder)  # noqa: PTH102
    model = folder + b"/m\xfe.rebeca"
    Path(os.fsdecode(model)).write_bytes((ROOT / "examples/hello/hello.rebeca").read_bytes())
    name = os.fsdecode(b"d\xff/m\xfe.rebeca")
    for command in (
        *(("lint", name), ("lint", name, "--format", "sarif"), ("fmt", "--check", name)),
        *(("verify", name, "--format", "json"), ("simulate", name, "--format", "html")),
        ("generate", name, "-o", os.fsdecode(b"d\xff")),
        *(("check", "."), ("check", ".", "--format", "json"), ("check", ".", "--format", "sarif")),
        *(("check", ".", "--format", "junit"), ("extract", "."), ("sync", "--dry-run", ".")),
        ("diff", name, name, "--format", "html"),
    ):
        done = rebsync(*command, cwd=tmp_path)
        assert done.status in (0, 1, 2, 3), (command, done)


def test_an_interrupt_while_modules_are_loaded(tmp_path: Path) -> None:
    (tmp_path / "click.py").write_text("raise KeyboardInterrupt\n")
    path = f"{tmp_path}:{ROOT}"
    done = rebsync("lint", "x", cwd=tmp_path, env={"PYTHONPATH": path})
    assert (done.status, done.err) == (130, "interrupted\n")


@pytest.fixture(scope="module")
def ahead(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A package, and a model that has moved since."""
    folder = tmp_path_factory.mktemp("ahead")
    text = (ROOT / "examples/hello/hello.rebeca").read_text()
    (folder / "m.rebeca").write_text(text)
    rebsync("generate", "m.rebeca", cwd=folder)
    (folder / "m.rebeca").write_text(text.replace("walk", "stroll"))
    return folder


_PRINTING = (
    *("lint m.rebeca", "lint none", "lint --none", "fmt --diff m.rebeca", "extract m", "check m"),
    *("generate m.rebeca --diff", "sync --dry-run m", "diff m.rebeca m", "verify m.rebeca"),
    *("simulate m.rebeca --seed 1", "export --for rmc m.rebeca", "generate m.rebeca --list"),
)


@pytest.mark.parametrize("command", _PRINTING)
def test_a_reader_that_goes_away(command: str, ahead: Path) -> None:
    """As `| head -0` does: standard output, and standard error with it."""
    for both in (False, True):
        reading, writing = os.pipe()
        os.close(reading)
        done = _with(command, ahead, writing, writing if both else subprocess.PIPE)
        os.close(writing)
        assert b"Traceback" not in (done.stderr or b"")
        assert b"Exception ignored" not in (done.stderr or b"")
        assert done.returncode in (0, 1, 2, 3, 141), done


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
@pytest.mark.parametrize("command", _PRINTING)
def test_a_disk_that_is_full(command: str, ahead: Path) -> None:
    for both in (False, True):
        with Path("/dev/full").open("wb") as full:
            done = _with(command, ahead, full.fileno(), full.fileno() if both else subprocess.PIPE)
        assert b"Traceback" not in (done.stderr or b"")
        assert done.returncode in (0, 1, 2, 3), done  # 0 and 3 where nothing had to be printed
        if done.stderr and b"RS805" in done.stderr:
            assert done.returncode == 2


def _with(command: str, folder: Path, out: int, err: int) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [sys.executable, "-m", "rebsync", *command.split()],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=out,
        stderr=err,
        env=environment(),
        check=False,
    )


# An administrator may read everything, but for one who has given up the right to do so.
_AS_USER = ("setpriv", "--bounding-set=-dac_override,-dac_read_search") * (os.geteuid() == 0)


@pytest.mark.parametrize(
    "name", ["m.rebeca", "m/package.xml", "m/.rebsync/manifest.json", "m/.rebsync", "m/src"]
)
def test_files_that_may_not_be_read(ahead: Path, tmp_path: Path, name: str) -> None:
    shutil.copytree(ahead, tmp_path / "t")
    path = tmp_path / "t" / name
    path.chmod(0)
    refused = 0
    for command in ("lint m.rebeca", "check m", "sync m", "extract m", "generate m.rebeca"):
        done = rebsync(*command.split(), cwd=tmp_path / "t", before=_AS_USER)
        assert done.status in (0, 1, 2, 4)
        refused += "permission denied" in done.err + done.out
    assert refused
    path.chmod(0o755)


def test_mistakes_of_its_own_are_no_drift() -> None:
    """What nobody foresaw ends as what cannot be used does, and says whose mistake it is."""
    script = (
        "import sys\n"
        "from rebsync import cli\n"
        "def failing(*_, **__): raise IndexError('nothing there')\n"
        "cli.rebsync.main = failing\n"
        "sys.exit(cli.main())\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], env=environment(), cwd=ROOT, capture_output=True, text=True
    )
    assert done.returncode == 2, done.stderr
    assert "RS817 a mistake of rebsync itself: IndexError: nothing there" in done.stderr
    assert "in failing" in done.stderr
