"""Packages whose nodes have a life cycle: read back, in step, and to the liking of linters."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.config import Config
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.normal_form import normal
from rebsync.source import Source
from tests.forward.compiling import CASES, case_config, generated, written
from tests.reverse.laws import (
    assert_same,
    assert_says,
    extracted,
    told_without_markers,
    without_markers,
)
from tests.reverse.python.laws import assert_says as assert_python_says
from tests.reverse.python.laws import python_normal
from tests.ros1.conftest import tool
from tests.ros2.launching import launched

_MODELS = {
    **{name: CASES / f"{name}.rebeca" for name in ("actions", "inheritance", "rebecs", "services")},
    "odometry": Path(__file__).parents[1] / "ros1" / "models" / "odometry.rebeca",
}
_TARGETS = ("ros2-cpp", "ros2-py")


def _config(name: str, target: str) -> Config:
    config = replace(case_config(_MODELS[name]), target=target, lifecycle=True)
    return replace(config, odometry="~odom") if name == "odometry" else config


def package(name: str, target: str) -> dict[str, str]:
    """The files; in rclpy without the package of the messages."""
    files = generated(_MODELS[name].read_text("utf-8"), name, _config(name, target))
    if target != "ros2-py":
        return files
    return {p.removeprefix(f"{name}/"): t for p, t in files.items() if p.startswith(f"{name}/")}


@pytest.mark.parametrize("target", _TARGETS)
@pytest.mark.parametrize("name", _MODELS)
def test_it_comes_back(name: str, target: str) -> None:
    says = assert_python_says if target == "ros2-py" else assert_says
    model = parse_model(Source(name, _MODELS[name].read_text("utf-8"))).model
    says(package(name, target), model)


@pytest.mark.parametrize("target", _TARGETS)
@pytest.mark.parametrize("name", _MODELS)
def test_it_comes_back_without_markers(name: str, target: str) -> None:
    found = extracted(without_markers(package(name, target)))
    assert [(f.text, f.why) for f in found.findings] == []
    model = parse_model(Source(name, _MODELS[name].read_text("utf-8"))).model
    told, wanted = found.model, normal(model)
    if target == "ros2-py":
        told, wanted = python_normal(told), python_normal(wanted)
    assert_same(told_without_markers(told), told_without_markers(wanted))


@pytest.mark.parametrize("target", _TARGETS)
def test_only_what_is_asked_for_is_another(target: str) -> None:
    """The bodies and helpers of a class are as without."""
    with_it = package("odometry", target)
    off = generated(
        _MODELS["odometry"].read_text("utf-8"),
        "odometry",
        replace(_config("odometry", target), lifecycle=False),
    )
    assert not [text for path, text in off.items() if "lifecycle" in path or "ifecycle" in text]
    path = "odometry/robot.py" if target == "ros2-py" else "src/robot.cpp"
    full = f"odometry/{path}" if target == "ros2-py" else path
    lines = set(with_it[path].splitlines()) - set(off[full].splitlines())
    assert 0 < len(lines) < 6


@pytest.fixture
def folder(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A model with its settings, and the package that is made of it."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / ".cache"))
    settings = (
        f'target = "{request.param}"\n[drive]\nodometry = "~odom"\n[ros2]\nlifecycle = true\n'
    )
    Path("rebsync.toml").write_text(settings, encoding="utf-8")
    Path("patrol.rebeca").write_text(_MODELS["odometry"].read_text("utf-8"), encoding="utf-8")
    assert main(["generate", "patrol.rebeca"]) == 0
    return tmp_path / "patrol"


@pytest.mark.parametrize("folder", _TARGETS, indirect=True)
def test_a_fresh_package_is_in_step(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for part in folder.rglob("lifecycle.*"):  # so that digests do not tell it
        if ".rebsync" not in part.parts:
            remark = "# a remark\n" if part.suffix == ".py" else "// a remark\n"
            part.write_text(part.read_text(encoding="utf-8") + remark, encoding="utf-8")
    capsys.readouterr()
    assert main(["check", "patrol"]) == 0
    assert "patrol: in step" in capsys.readouterr().out


@pytest.mark.parametrize("folder", _TARGETS, indirect=True)
def test_an_edit_of_a_body_is_read_and_taken_back(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`sync` takes an edit into the model; settings and code are what they were."""
    (path,) = (p for p in folder.rglob("robot.*") if p.suffix in (".cpp", ".py") if _is_own(p))
    text = path.read_text(encoding="utf-8")
    edited = text.replace("delay(2)", "delay(3)")
    assert edited != text
    path.write_text(edited, encoding="utf-8")
    capsys.readouterr()
    assert main(["check", "patrol"]) == 1
    assert "delay" in capsys.readouterr().out
    assert main(["sync", "patrol"]) == 0
    assert "delay(3)" in Path("patrol.rebeca").read_text(encoding="utf-8")
    assert path.read_text(encoding="utf-8") == edited
    capsys.readouterr()
    assert main(["check", "patrol"]) == 0


@pytest.mark.parametrize("folder", _TARGETS, indirect=True)
def test_an_edit_of_the_life_cycle_is_no_fact_of_the_model(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (part,) = (p for p in folder.rglob("lifecycle.*") if _is_own(p))
    text = part.read_text(encoding="utf-8")
    edited = text.replace("change(false)", "change(true)").replace(".suspend()", ".resume()")
    assert edited != text
    part.write_text(edited, encoding="utf-8")
    assert main(["check", "patrol"]) == 4
    assert "lifecycle" in capsys.readouterr().out


def _is_own(path: Path) -> bool:
    return ".rebsync" not in path.parts


@pytest.mark.parametrize("folder", _TARGETS, indirect=True)
def test_a_setting_that_is_turned_off_is_told(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = Path("rebsync.toml")
    settings.write_text(settings.read_text().replace("lifecycle = true", "lifecycle = false"))
    capsys.readouterr()
    main(["check", "patrol"])
    assert "`lifecycle` was true when the code was generated" in capsys.readouterr().out


@pytest.mark.parametrize("target", _TARGETS)
def test_what_it_includes_it_depends_on(target: str) -> None:
    needed = "lifecycle_msgs" if target == "ros2-py" else "rclcpp_lifecycle"
    assert f"<depend>{needed}</depend>" in package("odometry", target)["package.xml"]


@pytest.mark.parametrize("target", _TARGETS)
def test_the_launch_file_starts_it(target: str, tmp_path: Path) -> None:
    root = written(package("odometry", target), tmp_path, "odometry", Config())
    for given, wanted in (({}, True), ({"autostart": "false"}, False)):
        (node,) = (n for n in launched(root, **given) if "mailbox.rebecs" in n.parameters)
        assert node.parameters["lifecycle.autostart"] is wanted


@pytest.mark.skipif(find_spec("ruff") is None, reason="ruff is not installed")
def test_ruff_finds_nothing(tmp_path: Path) -> None:
    root = written(package("odometry", "ros2-py"), tmp_path, "odometry", Config())
    parts = [str(root / "odometry" / f"{p}.py") for p in ("drive", "lifecycle", "mailbox")]
    for command in (["check"], ["format", "--check", "--line-length", "100"]):
        line = [sys.executable, "-m", "ruff", *command, "--no-cache", "--quiet", *parts]
        done = subprocess.run(line, capture_output=True, text=True)
        assert (done.returncode, done.stdout + done.stderr) == (0, "")


@pytest.mark.skipif(find_spec("mypy") is None, reason="mypy is not installed")
def test_mypy_finds_nothing(tmp_path: Path) -> None:
    root = written(package("odometry", "ros2-py"), tmp_path, "odometry", Config())
    command = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports"]
    command += ["--no-warn-return-any", "--allow-subclassing-any", "--allow-untyped-decorators"]
    command += ["--cache-dir", str(tmp_path / "cache"), "-p", "odometry"]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True)
    assert (done.stdout.splitlines()[:-1], done.stderr) == ([], "")


@pytest.mark.ros1
def test_clang_format_changes_nothing(tmp_path: Path) -> None:
    root = written(package("odometry", "ros2-cpp"), tmp_path, "odometry", Config())
    sources = sorted([*root.glob("include/*/*.hpp"), *root.glob("src/*.cpp")])
    command = [tool("clang-format"), "--dry-run", "--Werror", *map(str, sources)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
