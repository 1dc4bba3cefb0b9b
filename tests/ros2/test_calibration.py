"""The stub of rclcpp does what generated packages rely on, as each real one does."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from pathlib import Path

from tests.ros2.building import HERE, build_driver

PACKAGE = HERE / "calibration"
_FACTS = PACKAGE / "facts.txt"
_SYSTEM = (
    *("node\tcalibration_node\ttold", "remap\t~/moved\telsewhere"),
    *("param\twhole\tint\t5", "param\treal\tfloat\t2.5", "param\ttruth\tbool\ttrue"),
    *("param\tname\tstr\tx y", "param\tgrid\tints\t4\t5"),
    "param\tqos_overrides./told/quality.subscription.reliability\tstr\treliable",
    "param\tqos_overrides./told/deep.publisher.history\tstr\tkeep_all",
    "param\tqos_overrides./told/deep.publisher.depth\tint\t20",
    "param\tqos_overrides./told/shallow.publisher.depth\tint\t2",
    *("param\twrong\tstr\tmany", "param\trounded\tint\t1"),
)


def expected() -> Sequence[str]:
    """What each rclcpp tells."""
    return ordered(_FACTS.read_text())


def ordered(output: str) -> Sequence[str]:
    """What was told, by what it is about; messages and timers may come one before the other."""
    lines = [line.partition("\t")[2] for line in output.splitlines() if line.startswith("fact\t")]
    return sorted(lines, key=lambda line: line.partition(":")[0])


def test_the_stub_tells_what_rclcpp_tells(headers: Path, tmp_path: Path) -> None:
    driver, system = build_driver(PACKAGE, headers, tmp_path / "build"), tmp_path / "system.txt"
    system.write_text("".join(f"{line}\n" for line in _SYSTEM))
    done = subprocess.run(
        [str(driver), str(system), "10"], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    assert ordered(done.stdout) == expected()
