"""Calls in C++ that may run what was not read: kinds of calls in each place of a node."""

from __future__ import annotations

import re
import sys
from pathlib import Path

from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.recovery import extract
from rebsync.source import Source

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

HERE = Path(__file__).parent
CALLS = HERE / "calls.toml"
PROGRAMS = HERE / "programs.toml"
LIBRARIES = ("roscpp", "rclcpp")
_PLACE = re.compile(r"CALL +// (\w+)")


def rows(path: Path) -> dict[str, dict[str, str]]:
    """The rows of a table by their names, each with what it needs around it."""
    return tomllib.loads(path.read_text(encoding="utf-8"))


def program(row: dict[str, str]) -> Source:
    """A program that makes a node, with what a row has in its places."""
    text = (HERE / "program.txt").read_text(encoding="utf-8")
    for place in ("extra", "members", "started", "after"):
        text = text.replace(place.upper(), row.get(place, ""))
    return Source("node.cpp", text)


def node(library: str, row: dict[str, str], call: str) -> Source:
    """A node that makes a call in all places, each on a line that ends with the place's name."""
    text = (HERE / f"{library}.txt").read_text(encoding="utf-8")
    given = row.get("initialiser", "")
    before = " : " if library == "roscpp" else ", "
    text = text.replace("EXTRA", row.get("extra", "")).replace("MEMBERS", row.get("members", ""))
    text = text.replace("PARAMETER", row.get("parameter", ""))
    text = text.replace("INITIALISER", f"{before}{given}" if given else "")
    return Source("node.cpp", text.replace("CALL ", f"{call} "))


def unreadable(source: Source) -> list[Finding]:
    """What is listed as unreadable."""
    found = extract({source.path: source}).findings
    return [f for f in found if f.grade is Grade.UNREADABLE]


def places(source: Source) -> dict[str, list[str]]:
    """The reasons that are listed for each place, which the comment of its line names."""
    found: dict[str, list[str]] = {}
    lines = source.text.splitlines()
    for finding in unreadable(source):
        line = lines[source.position(finding.span.start).line - 1]
        found.setdefault(line.rpartition("// ")[2], []).append(finding.why)
    return found


def all_places(library: str) -> list[str]:
    """The names of the places of a node."""
    return _PLACE.findall((HERE / f"{library}.txt").read_text(encoding="utf-8"))
