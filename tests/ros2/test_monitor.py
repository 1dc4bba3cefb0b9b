"""The monitor of a package of rclcpp, run with the package on the stub: what it says."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.forward.monitor_cases import CASES, MODEL, Case, statuses_in
from tests.ros2.building import build_driver, make_messages
from tests.ros2.running import run

_CONFIG = Config(target="ros2-cpp", monitor=True)
_CASES = [c for c in CASES if c.name in ("as generated", "wrong argument")]


@pytest.mark.parametrize("case", _CASES, ids=lambda c: c.name)
def test_the_monitor_says_what_is_wrong(case: Case, headers: Path, tmp_path: Path) -> None:
    package = written(generated(MODEL, "patrol", _CONFIG), tmp_path, "patrol", _CONFIG)
    case.edit_cpp(package / "src")
    make_messages([package], headers)
    driver = build_driver(package, headers, tmp_path / "build")
    recording = run(package, driver, tmp_path, 16, beside=("monitor",))
    case.check(statuses_in(m.fields for m in recording.heard("/diagnostics")))
