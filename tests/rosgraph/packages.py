"""Packages of test cases: nodes in one client library, around the lines that a case gives."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
LIBRARIES = ("roscpp", "rospy", "rclcpp", "rclpy")
ROS_1 = ("roscpp", "rospy")
_MANIFEST = '<package format="2"><name>{}</name><version>0.0.0</version></package>\n'


def write_case(folder: Path, case: Mapping[str, Any], library: str) -> None:
    """The files of a case in one library: its nodes by packages, launch and parameter files."""
    for name, bodies in case["nodes"].items():
        package, _, node = name.rpartition("/")
        write_node(folder / (package or "demo"), node, bodies[library], library)
    ros = "ros1" if library in ROS_1 else "ros2"
    for path, text in case.get("files", {}).get(ros, {}).items():
        target = folder / "demo" / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")


def write_node(package: Path, name: str, body: str, library: str) -> None:
    """One node, with what builds it: a program of its own name."""
    template = next(HERE.glob(f"templates/{library}.*.in"))
    suffix = Path(template.stem).suffix
    source = package / ("src" if suffix == ".cpp" else "scripts") / f"{name}{suffix}"
    source.parent.mkdir(parents=True, exist_ok=True)
    source.write_text(_filled(template.read_text(encoding="utf-8"), name, body), encoding="utf-8")
    (package / "package.xml").write_text(_MANIFEST.format(package.name), encoding="utf-8")
    build = package / "CMakeLists.txt"
    text = build.read_text(encoding="utf-8") if build.exists() else f"project({package.name})\n"
    if suffix == ".cpp":
        build.write_text(f"{text}add_executable({name} src/{name}.cpp)\n", encoding="utf-8")
    else:
        source.chmod(0o755)


def _filled(template: str, name: str, body: str) -> str:
    lines = []
    for line in template.splitlines():
        if line.strip() == "BODY":
            indent = line[: len(line) - len(line.lstrip())]
            lines.append(textwrap.indent(textwrap.dedent(body).strip() or "pass;", indent))
        else:
            lines.append(line)
    class_ = "".join(part.title() for part in name.split("_"))
    return "\n".join(lines).replace("NAME", name).replace("CLASS", class_) + "\n"
