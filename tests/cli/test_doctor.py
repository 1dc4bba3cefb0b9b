"""`rebsync doctor` tells what is there and what is not."""

from __future__ import annotations

from pathlib import Path

from rebsync.cli.doctor import TOOLS
from tests.cli.run import rebsync


def test_what_is_missing_is_told_with_how_to_get_it(tmp_path: Path) -> None:
    out = rebsync("doctor", cwd=tmp_path, env={"PATH": str(tmp_path), "ROS_DISTRO": ""}).out
    assert out.startswith("ROS: none is sourced\n")
    for tools in TOOLS.values():
        for tool in tools:
            (line,) = (each for each in out.split("\n") if each.endswith(tool.purpose))
            assert line.startswith(f"  {tool.names[0]} ")
            assert tool.is_module or f"not found: {tool.install} " in line


def test_what_is_there_is_told_with_its_place(tmp_path: Path) -> None:
    program = tmp_path / "gcc"
    program.write_text("#!/bin/sh\n", encoding="utf-8")
    program.chmod(0o755)
    out = rebsync("doctor", cwd=tmp_path, env={"PATH": str(tmp_path), "ROS_DISTRO": "jazzy"}).out
    assert out.startswith("ROS: jazzy is sourced\n")
    assert f"  cc           {program}" in out
    assert "  pygls        pygls " in out
