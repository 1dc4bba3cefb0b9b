"""A test of a recording that is tried again judges another one."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

_ROOT = Path(__file__).parent.parent
_TESTS = """
from itertools import count

import pytest

_NUMBERS = count(1)


@pytest.fixture(scope="session")
def launcher():
    return next(_NUMBERS)


@pytest.fixture(scope="module", params=["cpp", "py"])
def recording(request, launcher):
    assert launcher == 1
    return request.param, next(_NUMBERS)


@pytest.fixture(scope="module")
def path(recording):
    return recording


@pytest.mark.flaky(reruns=1)
def test_of_what_the_first_recording_lacks(recording, path):
    assert path == recording
    assert recording in {("cpp", 3), ("py", 5)}


@pytest.mark.flaky(reruns=1)
def test_of_the_same_recording(path):
    assert path in {("cpp", 3), ("py", 5)}
"""


def test_who_is_tried_again_gets_another_recording(tmp_path: Path) -> None:
    (tmp_path / "conftest.py").write_text("from tests.retrying import pytest_runtest_setup\n")
    (tmp_path / "test_once.py").write_text(_TESTS)
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tmp_path)]
    environment = {**os.environ, "PYTHONPATH": str(_ROOT)}
    done = subprocess.run(command, env=environment, cwd=tmp_path, capture_output=True, text=True)
    assert "4 passed, 2 rerun" in done.stdout, done.stdout
