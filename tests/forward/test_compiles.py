"""Generated sources compile without a warning: hard cases by hand, and drawn models."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, Phase, given, seed, settings

from rebsync.config import Config
from rebsync.model import Model
from rebsync.printing import print_model
from tests.forward.compiling import (
    CASES,
    case_config,
    case_files,
    complaints,
    generated,
    precompiled,
    written,
)
from tests.ros1.test_hard_cases import NAMES as HARD
from tests.ros1.workspace import missing_ros
from tests.strategies import models

_DRAWN = 10
_ODOMETRY = Path(__file__).parents[1] / "ros1" / "models" / "odometry.rebeca"
_REASON = missing_ros()
pytestmark = [
    pytest.mark.ros1,
    pytest.mark.timeout(900),  # compiles the packages of all cases, beside others that compile
    pytest.mark.skipif(
        _REASON is not None and os.environ.get("CI") != "true", reason=_REASON or "ROS 1 is here"
    ),
]


@pytest.fixture(scope="module")
def common(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What every source begins with."""
    return precompiled(tmp_path_factory.mktemp("common"))


def test_cases(tmp_path: Path, common: Path) -> None:
    # ros1/test_hard_cases.py compiles its own with the same warnings, and runs them.
    cases = sorted(c for c in CASES.glob("*.rebeca") if c.stem not in HARD)
    packages = [written(case_files(c), tmp_path, c.stem, case_config(c)) for c in cases]
    assert complaints(packages, tmp_path, common) == []


def test_drawn_models(tmp_path: Path, common: Path) -> None:
    texts = _drawn(_DRAWN)
    config = Config()
    packages = [
        written(generated(text, f"drawn{i}"), tmp_path, f"drawn{i}", config)
        for i, text in enumerate(texts)
    ]
    assert complaints(packages, tmp_path, common) == []


def test_many_rebecs(tmp_path: Path, common: Path) -> None:
    rebecs = "".join(f"  Cell c{i}(c{(i + 1) % 60}):({i});\n" for i in range(60))
    text = (
        "reactiveclass Cell(5) { knownrebecs { Cell next; } statevars { int x; }\n"
        "  Cell(int i) { x = i; self.go(); }\n"
        "  msgsrv go() { next.go() after(x); } }\n"
        f"main {{\n{rebecs}}}\n"
    )
    files = generated(text, "ring")
    assert files["launch/ring.launch"].count('<remap from="~next/go"') == 60
    assert complaints([written(files, tmp_path, "ring", Config())], tmp_path, common) == []


def test_odometry(tmp_path: Path, common: Path) -> None:
    config = Config(odometry="~odom")
    text = _ODOMETRY.read_text(encoding="utf-8")
    package = written(generated(text, "odometry", config), tmp_path, "odometry", config)
    assert "nav_msgs" in (package / "include" / "odometry" / "drive.h").read_text()
    assert complaints([package], tmp_path, common) == []


def _drawn(count: int) -> list[str]:
    """Models, always the same."""
    found: list[str] = []

    def keep(model: Model) -> None:
        found.append(print_model(model))

    draw: Callable[[], None] = seed(7)(
        settings(
            max_examples=count,
            deadline=None,
            database=None,
            suppress_health_check=list(HealthCheck),
            phases=[Phase.generate],
        )(given(models())(keep))
    )
    draw()
    return found
