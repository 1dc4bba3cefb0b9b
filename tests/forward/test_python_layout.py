"""Generated Python is laid out as ruff does, so that who formats a package changes nothing."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.config import TARGETS, Config
from rebsync.forward.generate import generate
from rebsync.forward.runtime_package import runtime_packages
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse
from tests.reverse.python.laws import python_files
from tests.reverse.python.test_laws import EXAMPLES, model_of
from tests.strategies import models

pytestmark = pytest.mark.skipif(find_spec("ruff") is None, reason="ruff is not installed")

_WITH_PYTHON = [target for target in TARGETS if target != "ros1-cpp"]
_CASES = sorted((Path(__file__).parent / "cases").glob("*.rebeca"))


def assert_formatted(files: Mapping[str, str], folder: Path, *options: str) -> None:
    """No file of a package with an ending of Python would change, nor a script of ROS 1."""
    for path, text in files.items():
        if path.endswith((".py", "ruff.toml")) or path.startswith("scripts/"):
            place = folder / (f"{path}.py" if path.startswith("scripts/") else path)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text, encoding="utf-8")
    command = [sys.executable, "-m", "ruff", "format", "--no-cache", "--diff", *options]
    done = subprocess.run([*command, str(folder)], capture_output=True, text=True, check=False)
    assert done.stdout == ""
    assert done.returncode == 0, done.stderr


def assert_linted(folder: Path) -> None:
    """ruff finds nothing in a package by its own settings."""
    command = [sys.executable, "-m", "ruff", "check", "--no-cache", "--quiet", str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "")


@pytest.mark.parametrize("target", _WITH_PYTHON)
@pytest.mark.parametrize("monitored", [False, True])
def test_examples(target: str, monitored: bool, tmp_path: Path) -> None:
    for example in EXAMPLES:
        model = model_of(example)
        config = Config(target=target, monitor=monitored)
        files = generate(model, (), analyse(model), config, example.name)
        assert_formatted(files, tmp_path / example.name)
    assert_linted(tmp_path)


@pytest.mark.parametrize("target", _WITH_PYTHON)
@pytest.mark.parametrize("monitored", [False, True])
def test_models_of_all_the_language(target: str, monitored: bool, tmp_path: Path) -> None:
    config = Config(target=target, monitor=monitored)
    for case in _CASES:
        model = parse_model(Source(case.name, case.read_text(encoding="utf-8"))).model
        files = generate(model, (), analyse(model), config, case.stem)
        assert_formatted(files, tmp_path / case.stem)
    assert_linted(tmp_path)


@pytest.mark.parametrize("target", ["ros1-py", "ros2-py"])
def test_the_run_time_part_as_a_package(target: str, tmp_path: Path) -> None:
    assert_formatted(runtime_packages(target), tmp_path)
    assert_linted(tmp_path)


@given(models(), st.sampled_from(["ros1-py", "ros2-py"]))
def test_drawn_models(
    tmp_path_factory: pytest.TempPathFactory, model: m.Model, target: str
) -> None:
    folder = tmp_path_factory.mktemp("drawn")
    assert_formatted(python_files(model, target), folder)
    assert_linted(folder)
