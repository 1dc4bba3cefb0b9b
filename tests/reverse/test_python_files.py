"""Which files are Python, and which of them can matter."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.reverse.files.python_files import is_python, is_script, may_be_script, relevant_python
from rebsync.reverse.files.reading import chosen
from rebsync.source import Source

NODE = b"import rospy\nfrom robot.arm import Arm\nrospy.init_node('n')\n"


@pytest.mark.parametrize(
    ("code", "kept"),
    [
        ({"a.py": b"import os\n"}, set()),
        ({"a.py": NODE, "b.py": b"x = 1\n"}, {"a.py"}),
        ({"a.py": NODE, "robot/arm.py": b"class Arm: pass\n"}, {"a.py", "robot/arm.py"}),
        (
            {
                "a.py": NODE,
                "robot/arm.py": b"from . import hand\n",
                "robot/hand.py": b"",
                "z.py": b"",
            },
            {"a.py", "robot/arm.py", "robot/hand.py"},
        ),
        ({"a.py": NODE, "robot/__init__.py": b"", "c.py": b""}, {"a.py", "robot/__init__.py"}),
    ],
)
def test_what_ros_code_imports_matters(code: dict[str, bytes], kept: set[str]) -> None:
    assert relevant_python(code) == kept


def test_a_file_that_is_asked_for_matters() -> None:
    assert relevant_python({"a.py": b"x = 1\n", "b.py": b""}, "a.py") == {"a.py"}


@pytest.mark.parametrize(
    ("head", "is_one"),
    [
        (b"#!/usr/bin/env python3\n", True),
        (b"#! /usr/bin/python2.7 -u\n", True),
        (b"#!/bin/sh\n# python\n", False),
        (b"python\n", False),
        (b"", False),
    ],
)
def test_the_first_line_of_a_script(head: bytes, is_one: bool) -> None:
    assert is_script(head) is is_one
    assert is_python("scripts/node", Source("scripts/node", head.decode())) is is_one


def test_names_of_scripts() -> None:
    assert may_be_script("talker_node")
    assert not may_be_script("LICENSE")
    assert not may_be_script("notes.txt")


def test_scripts_are_read_and_links_to_others_are_not(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text("<package><name>p</name></package>\n")
    (tmp_path / "talk").write_bytes(b"#!/usr/bin/env python\n" + NODE)
    (tmp_path / "notes").write_text("plain text\n")
    (tmp_path / "listen.py").write_bytes(NODE)
    (tmp_path / "listen").symlink_to("listen.py")
    assert sorted(chosen(str(tmp_path)).files) == ["listen.py", "package.xml", "talk"]
