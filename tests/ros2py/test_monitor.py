"""The monitor of a package of rclpy, played with the package: what it says on /diagnostics."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.forward.monitor_cases import CASES, MODEL, Case, statuses_in
from tests.ros2py.playing import play

_CONFIG = Config(target="ros2-py", monitor=True)


@pytest.mark.parametrize("case", CASES, ids=lambda c: c.name)
def test_the_monitor_says_what_is_wrong(case: Case, tmp_path: Path) -> None:
    package = written(generated(MODEL, "patrol", _CONFIG), tmp_path, "patrol", _CONFIG)
    case.edit_python(package / "patrol" / "patrol")
    recording = play(package, 16, beside=("monitor",))
    case.check(statuses_in(m.fields for m in recording.heard("/diagnostics")))
