"""Packages whose drives hear odometry: read back, in step, and to the liking of linters."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.config import TARGETS, Config
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.normal_form import normal
from rebsync.source import Source
from tests.forward.compiling import generated, written
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

_TEXT = (Path(__file__).parents[1] / "ros1" / "models" / "odometry.rebeca").read_text("utf-8")
_MODEL = parse_model(Source("odometry.rebeca", _TEXT)).model
_IN_PYTHON = ("ros1-py", "ros2-py")
_IN_CPP = ("ros1-cpp", "ros2-cpp")


def package(target: str) -> dict[str, str]:
    """The files; in rclpy without the package of the messages."""
    files = generated(_TEXT, "odometry", Config(target=target, odometry="~odom"))
    if target != "ros2-py":
        return files
    return {p.removeprefix("odometry/"): t for p, t in files.items() if p.startswith("odometry/")}


@pytest.mark.parametrize("target", TARGETS)
def test_it_comes_back(target: str) -> None:
    says = assert_python_says if target in _IN_PYTHON else assert_says
    says(package(target), _MODEL)


@pytest.mark.parametrize("target", TARGETS)
def test_it_comes_back_without_markers(target: str) -> None:
    found = extracted(without_markers(package(target)))
    assert [(f.text, f.why) for f in found.findings] == []
    told, wanted = found.model, normal(_MODEL)
    if target in _IN_PYTHON:
        told, wanted = python_normal(told), python_normal(wanted)
    assert_same(told_without_markers(told), told_without_markers(wanted))


@pytest.mark.parametrize("target", TARGETS)
def test_a_fresh_package_is_in_step(
    target: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / ".cache"))
    settings = f'target = "{target}"\n[drive]\nodometry = "~odom"\n'
    Path("rebsync.toml").write_text(settings, encoding="utf-8")
    Path("patrol.rebeca").write_text(_TEXT, encoding="utf-8")
    assert main(["generate", "patrol.rebeca"]) == 0
    for drive in Path("patrol").glob("[!.]*/**/drive.*"):  # so that digests do not tell it
        remark = "# a remark\n" if drive.suffix == ".py" else "// a remark\n"
        drive.write_text(drive.read_text(encoding="utf-8") + remark, encoding="utf-8")
    capsys.readouterr()
    assert main(["check", "patrol"]) == 0
    assert "patrol: in step" in capsys.readouterr().out


@pytest.mark.parametrize("target", TARGETS)
def test_what_it_includes_it_depends_on(target: str) -> None:
    depends = package(target)["package.xml"]
    for name in ("geometry_msgs", "nav_msgs", "std_msgs"):
        assert f"<depend>{name}</depend>" in depends


@pytest.mark.skipif(find_spec("ruff") is None, reason="ruff is not installed")
@pytest.mark.parametrize("target", _IN_PYTHON)
def test_ruff_finds_nothing(target: str, tmp_path: Path) -> None:
    root = written(package(target), tmp_path, "odometry", Config())
    drive = next(root.rglob("drive.py"))
    for command in (["check"], ["format", "--check", "--line-length", "100"]):
        line = [sys.executable, "-m", "ruff", *command, "--no-cache", "--quiet", str(drive)]
        done = subprocess.run(line, capture_output=True, text=True)
        assert (done.returncode, done.stdout + done.stderr) == (0, "")


@pytest.mark.skipif(find_spec("mypy") is None, reason="mypy is not installed")
@pytest.mark.parametrize("target", _IN_PYTHON)
def test_mypy_finds_nothing(target: str, tmp_path: Path) -> None:
    root = written(package(target), tmp_path, "odometry", Config())
    source = root / "src" if target == "ros1-py" else root
    stub = "from typing import Any\ndef __getattr__(name: str) -> Any: ...\n"
    (source / "odometry" / "msg.pyi").write_text(stub)
    command = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports"]
    command += ["--no-warn-return-any", "--allow-subclassing-any", "--allow-untyped-decorators"]
    command += ["--cache-dir", str(tmp_path / "cache"), "-p", "odometry"]
    done = subprocess.run(command, cwd=source, capture_output=True, text=True)
    found = [line for line in done.stdout.splitlines() if "drive.py" in line]
    assert (found, done.stderr) == ([], "")


@pytest.mark.ros1
@pytest.mark.parametrize("target", _IN_CPP)
def test_clang_format_changes_nothing(target: str, tmp_path: Path) -> None:
    root = written(package(target), tmp_path, "odometry", Config())
    headers = sorted(root.glob("include/*/*.h*"))
    assert headers
    command = [tool("clang-format"), "--dry-run", "--Werror", *map(str, headers)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
