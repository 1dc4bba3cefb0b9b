"""Sensors that hear messages of other packages, on a real ROS 2."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rebsync.config import Config, SensorBinding
from tests.forward.compiling import generated, written
from tests.ros1.run import Clock
from tests.ros2real.conftest import DIALECTS, Play
from tests.ros2real.workspace import has_package

_SCANNER = Path(__file__).parent / "nodes" / "scanner.py"
_MODEL = """
@Robot reactiveclass Eye(9) {
  statevars { int ray; boolean pressed; int level; double far; int rounds; }
  Eye() { self.drawn(); self.laser() after(4); self.bumper() after(4); self.battery() after(4); }
  @Sensor msgsrv laser() { ray = ?(0, 1, 2); rounds += 1; self.laser() after(2); }
  @Sensor msgsrv bumper() { pressed = ?(false, true); self.bumper() after(2); }
  @Sensor msgsrv battery() { level = ?(10, 40); self.battery() after(2); }
  @Sensor msgsrv drawn() { far = ?(0.5, 1.5); self.drawn() after(2); }
}
main { Eye e():(); }
"""
_RANGES = {
    "ros2-cpp": "msg.ranges.empty() ? 0 : msg.ranges.front() < 1.0F ? 1 : 2",
    "ros2-py": "0 if len(msg.ranges) == 0 else 1 if msg.ranges[0] < 1.0 else 2",
}


@pytest.mark.parametrize("dialect", DIALECTS)
def test_sensors_hear_other_packages(dialect: str, play_real: Play, tmp_path: Path) -> None:
    if not has_package("sensor_msgs"):
        pytest.skip("no sensor_msgs")
    sensors = (
        SensorBinding("Eye.laser", "/scan", "sensor_msgs/LaserScan", _RANGES[dialect]),
        SensorBinding("Eye.bumper", "bumper", "std_msgs/Bool", "msg.data"),
        SensorBinding("Eye.battery", "battery", "std_msgs/Int32", "msg.data"),
    )
    config = replace(Config(target=dialect), sensors=sensors)
    package = written(generated(_MODEL, "eyes", config), tmp_path, "eyes", config)
    played = play_real(package, dialect, Clock(until=20, quiet=15, rate=4.0), [_SCANNER])
    final = played.final("e")
    assert (final["ray"], final["pressed"], final["level"]) == (1, True, 40)
    assert final["far"] in (0.5, 1.5)  # a stand-in draws it: nothing else publishes
    assert final["rounds"] > 4
    reports = [r for r in played.reports() if r.kind != "late"]
    assert reports == []
