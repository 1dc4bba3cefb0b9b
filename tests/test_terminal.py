"""What is printed, patched and carried: controls as escapes, everything else as it is."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest

from rebsync.config import config_of_record
from rebsync.grammars.parser import parse_model
from rebsync.long_numbers import MOST_DIGITS, long_number
from rebsync.patches import patch
from rebsync.source import Source
from rebsync.terminal import json_text, one_line, printable, without_commands
from tests.cli.run import ROOT, rebsync

_NODE = """#include <ros/ros.h>
#include <std_msgs/Int32.h>
void heard(const std_msgs::Int32& m) { ROS_ASSERT_MSG(m.data < 3, "a\x1b[2Jb"); }
"""


# Formats of writing systems, and what looks like nothing: each could hide a part of a line.
_UNSEEN = "\u0890\U000110bd\U000110cd\U00013430\u034f\u115f\u1160\u17b4\u3164\uffa0\ufe0f\U000e0100"


@pytest.mark.parametrize("character", _UNSEEN)
def test_what_nobody_sees_is_an_escape(character: str) -> None:
    assert one_line(f"a{character}b").isascii()


def test_lines() -> None:
    assert (
        one_line("a\x1b\n\u202e\udcff\U000e0001é\u00a0")
        == r"a\x1b\n\u202e\xff\U000e0001é" + "\u00a0"
    )
    assert printable("a\x9b\n\tb\r") == "a\\x9b\n\tb\\r"
    assert without_commands("x\n  ::add-mask::y\n") == "x\n  \\x3a:add-mask::y\n"
    assert without_commands("::ros::init ##[group]") == r"\x3a:ros::init #\x23[group]"
    assert without_commands("a::b ## c") == "a::b ## c"
    assert json.loads(json_text("\x9b\u202e##[é")) == "\x9b\u202e##[é"
    assert json_text("\x9b\u202eé") == '"\\u009b\\u202eé"'


def test_a_patch_is_what_git_applies(tmp_path: Path) -> None:
    name = 'a\t"b\\\n\x1bé.txt'
    old, new = "one\x0c\x85\u2028two\nthree\r\nfour", "one\x0c\x85\u2028two\nthree\r\nfive\n"
    (tmp_path / name).write_bytes(old.encode())
    text = patch(old, new, f"a/{name}", f"b/{name}")
    subprocess.run(["git", "apply", "-"], input=text.encode(), cwd=tmp_path, check=True)
    assert (tmp_path / name).read_bytes() == new.encode()


@pytest.mark.parametrize(("text", "found"), [("\u202e", True), ("\x1b", True), ("\u200d\t", False)])
@pytest.mark.parametrize("place", ['msgsrv m() { assertion(true, "HERE"); }', "// HERE\n"])
def test_controls_in_models_are_mistakes(text: str, found: bool, place: str) -> None:
    whole = f"reactiveclass A(2) {{ {place.replace('HERE', text)} }} main {{ A a():(); }}"
    codes = {d.code for d in parse_model(Source("m", whole)).diagnostics}
    assert codes == ({"RS114"} if found else set())


def test_controls_in_code_are_listed_and_carried_as_escapes(tmp_path: Path) -> None:
    (tmp_path / "n.cpp").write_text(_NODE)
    done = rebsync("extract", "n.cpp", cwd=tmp_path)
    assert "RS942" in done.err and "U+001B" in done.err
    assert "\x1b" not in done.out + done.err


@pytest.mark.parametrize(
    "line",
    [
        *('description = "a\\u0007"', 'license = "a\\u001b"', 'license = "a\\nb"'),
        *('description = "a\\uFFFE"', 'maintainers = [{ name = "a\\u0000", email = "a@b.c" }]'),
        *('copyright = "2026 a\\u001b"', 'copyright = "2026 a\\nb"'),
        *('maintainers = [{ name = "a", email = "<a>@b.c" }]', 'description = "\\u202e"'),
    ],
)
def test_controls_in_settings_are_mistakes(line: str, tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text((ROOT / "examples/hello/hello.rebeca").read_text())
    (tmp_path / "rebsync.toml").write_text(line)
    done = rebsync("generate", "m.rebeca", cwd=tmp_path)
    assert (done.status, "RS809" in done.err) == (2, True), done


@pytest.mark.parametrize("target", ["ros1-cpp", "ros1-py", "ros2-cpp", "ros2-py"])
def test_markup_in_a_description_stands_as_it_is(target: str, tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text((ROOT / "examples/hello/hello.rebeca").read_text())
    text = "<img src=x onerror=y> ![p](http://x) & ]]> <script>"
    (tmp_path / "rebsync.toml").write_text(f"description = '{text}'\n")
    assert rebsync("generate", "m.rebeca", "--target", target, cwd=tmp_path).status == 0
    readmes = list(tmp_path.rglob("README.md"))
    assert readmes
    for path in readmes:
        if "img src" in path.read_text():
            assert "<img" not in path.read_text() and "![p]" not in path.read_text()
    for path in tmp_path.rglob("package.xml"):
        assert text in (ElementTree.parse(path).getroot().findtext("description") or "")


def test_recorded_settings_are_no_less_checked() -> None:
    assert config_of_record({"description": "fine", "sensors": [], "targets": []}) is not None
    for options in ({"description": "\x1b"}, {"sensors": ["x"]}, {"seed": 2**70}, {"target": 1}):
        assert config_of_record(options) is None


def test_long_numbers_are_found_wherever_they_stand() -> None:
    number = "9" * (MOST_DIGITS + 1)
    for before in (0, 1, 4_999, 5_000, 123_456):
        span = long_number(" " * before + number + ";")
        assert span is not None and (span.start, span.end) == (before, before + len(number))
    assert long_number("9" * MOST_DIGITS) is None
    assert long_number("ab" * MOST_DIGITS) is None
    assert long_number("0x" + "ab" * MOST_DIGITS) is not None
