"""Each rule in each client library: what is found, and where the rules are silent."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from rebsync.reverse.files.reading import packages
from rebsync.rosgraph.analysis import analysed
from rebsync.rosgraph.findings import GraphFinding
from rebsync.rosgraph.reading import read_package
from rebsync.rosgraph.rules_absence import is_slip
from tests.rosgraph.packages import LIBRARIES, ROS_1, write_case

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_ALL = ("RS990", "RS991", "RS994", "RS995", "RS996")
CASES = Path(__file__).parent / "cases"
Case = dict[str, Any]


def _cases() -> list[Any]:
    """Each case in each library that it has lines for."""
    found = []
    for path in sorted(CASES.glob("*.toml")):
        for case in tomllib.loads(path.read_text(encoding="utf-8"))["case"]:
            first = next(iter(case["nodes"].values()))
            for library in LIBRARIES:
                if library in first:
                    found.append(pytest.param(case, library, id=f"{case['name']}-{library}"))
    return found


@pytest.mark.parametrize(("case", "library"), _cases())
def test_rules_find_what_a_case_says(tmp_path: Path, case: Case, library: str) -> None:
    write_case(tmp_path, _launched(case, library), library)
    launch = None
    if "launch" in case:
        launch = case["launch"] + ("" if library in ROS_1 else ".py")
    read = [read_package(given) for given in packages([str(tmp_path)])]
    found = [_said(finding) for finding in analysed(read, "case", launch).findings]
    wanted = tuple(case.get("codes", _ALL))
    assert sorted(f for f in found if f.startswith(wanted)) == sorted(case["expected"])


def _said(finding: GraphFinding) -> str:
    path = Path(finding.place.source.path)
    where = path.parent.name if path.parent.name in ("launch", "config") else path.stem
    return f"{finding.code} {finding.severity.value} {where}: {finding.message}"


def _launched(case: Case, library: str) -> Case:
    """The case with names of programs in its launch files, or one that starts all nodes."""
    suffix = ".py" if library == "rospy" else ""
    ros = "ros1" if library in ROS_1 else "ros2"
    files = dict(case.get("files", {}).get(ros, {}))
    for path, text in files.items():
        files[path] = text.replace("PROGRAM", f"talker{suffix}").replace(
            "LISTENER", f"listener{suffix}"
        )
    if case.get("launch_all"):
        nodes = list(case["nodes"])
        tags = [f'<node pkg="demo" type="{n}{suffix}" name="{n}"/>' for n in nodes]
        in_python = [f'Node(package="demo", executable="{n}", name="{n}")' for n in nodes]
        if ros == "ros1":
            files["launch/all.launch"] = f"<launch>{''.join(tags)}</launch>"
        else:
            files["launch/all.launch.py"] = (
                "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
                f"def generate_launch_description():\n"
                f"    return LaunchDescription([{', '.join(in_python)}])\n"
            )
    return {**case, "files": {ros: files}}


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        ("/cmd_vel", "/cmd_vle", True),
        ("/cmd_vel", "/cmd_ve", True),
        ("/robot/scan", "/robot/Scan", True),
        ("/robot/scan", "/robot/scam", True),
        ("/scan1", "/scan2", False),
        ("/odom", "/odometry", False),
        ("/a/scan", "/b/scan", False),
        ("/left/scan", "/scan", False),
        ("/tag", "/tab", False),
    ],
)
def test_a_slip_is_one_letter_of_one_part(one: str, other: str, expected: bool) -> None:
    assert is_slip(one, other) is is_slip(other, one) is expected
