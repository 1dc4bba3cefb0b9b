"""A node closed to a system: another one sends its inputs, a third keeps what it published last."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

from rebsync.checker.exploration import Limits
from rebsync.checker.problem import Options, Problem
from rebsync.checker.verify import verify
from rebsync.files import read_source
from rebsync.grammars.parser import parse_model
from rebsync.grammars.properties import parse_properties
from rebsync.printing import print_model
from rebsync.property_check import check_properties
from rebsync.reverse.findings import Grade
from rebsync.reverse.recovery import extract
from rebsync.source import Source
from rebsync.static import Analysis, analyse
from tests.reverse.native import ros1, ros2
from tests.reverse.native.ros1 import Input

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

CASES = Path(__file__).parent / "cases"
PROPERTY = """property {{
  define {{ shown = (sink.last == {value}); }}
  Assertion {{ Never: !shown; }}
}}
"""

# The files of nodes, and how the lines of their verdicts are named.
LIBRARIES = {"node.py": "py", "node.cpp": "cpp", "rclpy.py": "rclpy", "rclcpp.cpp": "rclcpp"}
_NEVER = 77777


@dataclass(frozen=True)
class Case:
    """A node in one language: what it gets, a value that its run shows, and one that none shows.

    `verdict` is what is said of the claim that nobody gets the value that is shown.
    """

    folder: Path
    node: str
    inputs: tuple[Input, ...]
    shows: int
    never: int
    verdict: str

    @property
    def name(self) -> str:
        return f"{self.folder.name}-{self.language}"

    @property
    def language(self) -> str:
        return LIBRARIES[self.node]


def cases() -> list[Case]:
    """All cases, in each language that they are written in."""
    return [
        _case(folder, node)
        for folder in sorted(CASES.iterdir())
        for node in LIBRARIES
        if (folder / node).exists()
    ]


def _case(folder: Path, node: str) -> Case:
    found = tomllib.loads((folder / "case.toml").read_text(encoding="utf-8"))
    inputs = tuple((str(topic), int(value)) for topic, value in found.get("inputs", ()))
    verdict = found.get("verdict", {}).get(LIBRARIES[node], "")
    return Case(folder, node, inputs, found["shows"], found.get("never", _NEVER), verdict)


def package(case: Case) -> dict[str, str]:
    """The files of a ROS package with the node and those around it."""
    node = (case.folder / case.node).read_text(encoding="utf-8")
    if case.node in ("rclpy.py", "rclcpp.cpp"):
        return ros2.package(case.node, node, case.inputs)
    return ros1.package(case.node, node, case.inputs)


def verdicts(case: Case, folder: Path) -> tuple[str, str]:
    """What is said of "the sink never gets this": of what a run shows, and of what none shows.

    The model is printed and read again, as a user would verify it. Where places are listed as
    unreadable, or the model lacks what the property is about, the verdict is "undetermined".
    """
    files = {path: Source(path, text) for path, text in package(case).items()}
    found = extract(files)
    model = folder / "model.rebeca"
    model.write_text(print_model(found.model), encoding="utf-8")
    if any(f.grade is Grade.UNREADABLE for f in found.findings):
        return "undetermined", "undetermined"
    source = read_source(str(model))
    read = parse_model(source)
    assert read.ok, read.diagnostics
    analysis = analyse(read.model)
    assert not analysis.errors, analysis.errors
    return _verdict(source, analysis, case.shows), _verdict(source, analysis, case.never)


def _verdict(source: Source, analysis: Analysis, value: int) -> str:
    """The verdict of the property that the sink never gets a value."""
    stated = parse_properties(Source("case.property", PROPERTY.format(value=value)))
    if check_properties(stated.properties, analysis):
        return "undetermined"
    problem = Problem(source, analysis, stated.properties)
    options = Options(limits=Limits(states=20_000), allowed=frozenset({"deadlock"}))
    return verify(problem, options).verdict
