"""The graph of generated packages: all names are known, and all dialects tell the same.

`python -m tests.rosgraph.test_generated` writes down what is told of the example.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from rebsync.config import TARGETS
from rebsync.diagnostics import Severity
from rebsync.reverse.files.reading import packages
from rebsync.rosgraph.analysis import analysed
from rebsync.rosgraph.graph import UNKNOWN, NodeEnd
from rebsync.rosgraph.reading import read_package
from tests.cli.run import rebsync

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
MODEL = ROOT / "examples" / "warehouse" / "warehouse.rebeca"
OFFERING = ROOT / "tests" / "forward" / "cases" / "actions.rebeca"
EXPECTED = HERE / "generated.txt"
# A publisher that somebody adds to a class: where, before what, and the call.
ADDED = {
    "ros1-cpp": (
        "carrier.cpp",
        "  state_pub_ =",
        '  lamp_pub_ = node.advertise<std_msgs::Bool>("lamp", 1);\n',
    ),
    "ros2-py": (
        "carrier.py",
        "        self._state_pub =",
        '        self._lamp = self.create_publisher(Bool, "~/lamp", 1)\n',
    ),
}


def _told(folder: Path, target: str) -> list[str]:
    """What each node of the package that is generated asks for."""
    done = rebsync("generate", str(MODEL), "--target", target, "-o", str(folder), cwd=folder)
    assert done.status == 0, done.err
    return _graph(folder)


def _graph(folder: Path) -> list[str]:
    read = list(packages([str(folder)]))
    (launch,) = (str(p) for p in folder.rglob("warehouse.launch*") if ".rebsync" not in p.parts)
    found = analysed([read_package(each) for each in read], "", launch)
    assert {f.severity for f in found.findings} <= {Severity.NOTE}
    return sorted(_line(n.name, end) for n in found.graph.nodes for end in n.ends)


def _line(node: str, end: NodeEnd) -> str:
    types = " or ".join(end.types).replace("_interfaces/", "/")
    return f"{node} {end.end.role.value} {end.name or UNKNOWN} [{types}]"


@pytest.mark.parametrize("target", TARGETS)
def test_a_generated_package(target: str, tmp_path: Path) -> None:
    expected = EXPECTED.read_text(encoding="utf-8").splitlines()
    told = _told(tmp_path, target)
    assert [e for e in told if " /clock " not in e] == expected  # rospy alone hears of the clock


@pytest.mark.parametrize("target", ADDED)
def test_what_people_add(target: str, tmp_path: Path) -> None:
    before = _told(tmp_path, target)
    name, place, call = ADDED[target]
    (path,) = (p for p in tmp_path.rglob(name) if ".rebsync" not in p.parts)
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace(place, call + place), encoding="utf-8")
    added = [line.split(" [")[0] for line in _graph(tmp_path) if line not in before]
    assert added == [f"/carrier{i} publisher /carrier{i}/lamp" for i in (1, 2, 3, 4)]


@pytest.mark.parametrize("target", ["ros1-cpp", "ros2-py"])
def test_services_and_actions(target: str, tmp_path: Path) -> None:
    rebsync("generate", str(OFFERING), "--target", target, "-o", str(tmp_path), cwd=tmp_path)
    read = [read_package(each) for each in packages([str(tmp_path)])]
    found = [end for node in analysed(read, "").graph.nodes for end in node.ends]
    assert {(e.end.role.value, e.name) for e in found if "server" in e.end.role.value} == {
        ("server", "/robot/tell"),
        ("action server", "/robot/port/go"),
        ("action server", "/robot/later"),
        ("action server", "/robot/note"),
        ("action server", "/control_bridge/control/begin"),
    }
    assert all(end.types for end in found if end.end.role.value != "subscription")


if __name__ == "__main__":
    with TemporaryDirectory() as folder:
        EXPECTED.write_text("\n".join(_told(Path(folder), "ros1-cpp")) + "\n", encoding="utf-8")
