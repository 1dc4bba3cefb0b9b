"""The graph of a small workspace in every format, as the command prints it."""

from __future__ import annotations

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import jsonschema  # type: ignore[import-untyped]
import pytest

from tests.cli.run import rebsync
from tests.rosgraph.commands import graph

HERE = Path(__file__).parent
Capture = pytest.CaptureFixture[str]
LAUNCH = "robot/robot/launch/robot.launch.py"
SCHEMA = json.loads((HERE.parents[1] / "docs" / "graph.schema.json").read_text(encoding="utf-8"))
CODE = (HERE / "robot" / "code.txt").read_text(encoding="utf-8")
LAUNCHED = (HERE / "robot" / "launch.txt").read_text(encoding="utf-8")


@pytest.fixture(autouse=True)
def _here(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(HERE)


def test_the_graph_of_all_code() -> None:
    done = rebsync("graph", "robot", cwd=HERE)
    assert (done.out, done.err, done.status) == (CODE, "", 0)


def test_the_graph_of_a_launch_file_with_findings(capfd: Capture) -> None:
    done = graph(capfd, "robot", "--launch", LAUNCH)
    assert done.out == LAUNCHED
    found = re.findall(r"^(\S+:\d+):\d+: (RS\d+)", done.err, re.MULTILINE)
    assert found == [
        ("robot/robot/src/driver.cpp:11", "RS998"),
        ("robot/robot/src/planner.cpp:9", "RS991"),
        ("robot/tools/tools/console.py:11", "RS997"),
    ]
    assert done.status == 1
    assert graph(capfd, "robot", "--launch", "robot/launch/robot.launch.py").out == LAUNCHED


def test_json_is_as_its_schema_says(capfd: Capture) -> None:
    done = graph(capfd, "robot", "--launch", LAUNCH, "--format", "json")
    given = json.loads(done.out)
    jsonschema.validate(given, SCHEMA)
    scan = next(w for w in given["wires"] if w["place"]["line"] == 9 and w["role"] == "publisher")
    assert given["boxes"][scan["to"]]["name"] == "/laser"
    assert scan["qos"]["reliability"] == "best_effort"
    assert scan["place"]["text"].startswith("scan_ = create_publisher")
    assert {f["code"] for f in given["findings"]} == {"RS991", "RS997", "RS998"}


def test_dot_and_mermaid_declare_what_they_join(capfd: Capture) -> None:
    dot = graph(capfd, "robot", "--format", "dot").out
    boxes = set(re.findall(r'^ +("[^"]*") \[label', dot, re.MULTILINE))
    joined = re.findall(r'^ +("[^"]*") -> ("[^"]*")', dot, re.MULTILINE)
    assert len(boxes) == 8 and len(joined) == 9
    assert {name for pair in joined for name in pair} <= boxes
    mermaid = graph(capfd, "robot", "--format", "mermaid").out
    named = set(re.findall(r"^ +(b\d+)[\[({]", mermaid, re.MULTILINE))
    arrows = re.findall(r"^ +(b\d+) -\.?->? ?(b\d+)", mermaid, re.MULTILINE)
    assert len(named) == 8 and len(arrows) == 9
    assert {name for pair in arrows for name in pair} <= named


def test_svg_has_every_box_and_wire(capfd: Capture) -> None:
    root = ElementTree.fromstring(graph(capfd, "robot", "--format", "svg").out)
    drawn = [e for e in root.iter() if e.get("data-box") is not None]
    wires = [e for e in root.iter() if "wire" in (e.get("class") or "").split()]
    assert len(drawn) == 8 and len(wires) == 9


def test_sarif_and_annotations_have_the_findings(capfd: Capture) -> None:
    sarif = json.loads(graph(capfd, "robot", "--launch", LAUNCH, "--format", "sarif").out)
    results = sarif["runs"][0]["results"]
    assert [(r["ruleId"], r["level"]) for r in results] == [
        ("RS998", "note"),
        ("RS991", "warning"),
        ("RS997", "note"),
    ]
    lines = graph(capfd, "robot", "--launch", LAUNCH, "--format", "github").out.splitlines()
    assert lines[1].startswith("::warning file=robot/robot/src/planner.cpp,line=9,col=13,")


def test_a_launch_file_that_is_not_read(capfd: Capture, tmp_path: Path) -> None:
    done = graph(capfd, "robot", "--launch", "other.launch.py")
    assert done.status == 2 and "RS801" in done.err
    assert graph(capfd, str(tmp_path)).status == 2
