"""Nothing is taken out of the model while a launch file that may say it is not read as a whole."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.cli.status import Status

MODEL = """env int step = 1;
env int spare = 5;

reactiveclass Beacon(2) {
  statevars {
    int n;
  }

  Beacon(int start) {
    n = start;
    self.tick();
  }

  msgsrv tick() {
    n = (n + step) % 4;
    self.tick() after(2);
  }
}

main {
  Beacon one():(1);
  Beacon two():(2);
}
"""
NODE = re.compile(
    r" *(?:#|<!--) rebsync: rebec two[\s\S]*?(?=^ {8}\]|^ {12}# rebsync|^</launch>)", re.M
)
ROS2 = ("ros2-cpp", "ros2-py")


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / ".cache"))


def made(dialect: str, folder: Path) -> tuple[Path, Path]:
    """The model, and the launch file of its package."""
    model = folder / "beacons.rebeca"
    model.write_text(MODEL, encoding="utf-8")
    assert main(["generate", str(model), "--target", dialect, "-o", str(folder)]) == 0
    found = (p for p in folder.rglob("*.launch*") if ".rebsync" not in p.parts)
    return model, next(p for p in found if p.is_file())


def is_left(model: Path, folder: Path) -> bool:
    """Whether check and sync say that they do not know, and sync leaves the model."""
    assert main(["check", str(folder)]) == int(Status.UNDETERMINED)
    assert main(["sync", str(folder)]) == int(Status.UNDETERMINED)
    return model.read_text(encoding="utf-8") == MODEL


_LOOP = """    more = []
    for name in names():
        more.append(Node(package="beacons", executable="beacon_node", name=name))
    return LaunchDescription(
        more
        + ["""
INSTEAD = {
    "loop": ("", _LOOP),
    "comprehension": (
        "            *[Node(package='beacons', executable='beacon_node', name=n) for n in many],\n",
        "",
    ),
    "function": ("            OpaqueFunction(function=beacons),\n", ""),
    "include": (
        "            IncludeLaunchDescription([FindPackageShare('other'), '/x.launch.py']),\n",
        "",
    ),
}


@pytest.mark.parametrize("way", INSTEAD)
@pytest.mark.parametrize("dialect", ROS2)
def test_a_rebec_stays_where_python_starts_nodes_in_its_own_way(
    dialect: str, way: str, tmp_path: Path
) -> None:
    model, launch = made(dialect, tmp_path)
    node, opening = INSTEAD[way]
    text, count = NODE.subn(node.replace("\\", r"\\"), launch.read_text(encoding="utf-8"))
    assert count == 1
    if opening:
        text = text.replace("    return LaunchDescription(\n        [", opening)
    launch.write_text(text, encoding="utf-8")
    assert is_left(model, tmp_path)


@pytest.mark.parametrize("dialect", ["ros1-cpp", "ros1-py"])
def test_a_rebec_stays_where_another_package_may_start_it(dialect: str, tmp_path: Path) -> None:
    model, launch = made(dialect, tmp_path)
    node = '  <include file="$(find other)/launch/x.launch"/>\n'
    text, count = NODE.subn(node, launch.read_text(encoding="utf-8"))
    assert count == 1
    launch.write_text(text, encoding="utf-8")
    assert is_left(model, tmp_path)


@pytest.mark.parametrize("dialect", ["ros1-cpp", "ros2-cpp", "ros1-py", "ros2-py"])
def test_a_rebec_that_is_only_taken_out_goes(dialect: str, tmp_path: Path) -> None:
    model, launch = made(dialect, tmp_path)
    text, count = NODE.subn("", launch.read_text(encoding="utf-8"))
    text = text.replace('["one", "two"]', '["one"]').replace("[one, two]", "[one]")
    assert count == 1
    launch.write_text(text, encoding="utf-8")
    assert main(["sync", str(tmp_path)]) == int(Status.CLEAN)
    assert "Beacon two" not in model.read_text(encoding="utf-8")


@pytest.mark.parametrize("dialect", ["ros1-cpp", "ros2-cpp", "ros1-py", "ros2-py"])
def test_a_constant_stays_where_the_parameter_file_is_not_read(
    dialect: str, tmp_path: Path
) -> None:
    model, _ = made(dialect, tmp_path)
    found = (p for p in tmp_path.rglob("params.yaml") if ".rebsync" not in p.parts)
    for path in found:
        text = path.read_text(encoding="utf-8")
        path.write_text(text.replace("spare: 5", "spare: !include spare.yaml"), encoding="utf-8")
    assert is_left(model, tmp_path)


@pytest.mark.parametrize("dialect", ROS2)
def test_an_argument_stays_that_the_launch_file_computes(dialect: str, tmp_path: Path) -> None:
    model, launch = made(dialect, tmp_path)
    text = launch.read_text(encoding="utf-8")
    assert '"start": 2' in text
    launch.write_text(text.replace('"start": 2', '"start": starts()[1]'), encoding="utf-8")
    assert is_left(model, tmp_path)
