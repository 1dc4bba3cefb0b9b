"""Code that a grammar takes and no compiler does, in generated packages: `check` answers."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.cli.status import Status

_HELLO = Path(__file__).parents[2] / "examples" / "hello" / "hello.rebeca"
_BODY = "  drive_.move(1, 0);\n"
_FILE = "namespace hello {\n"
_ANSWERS = (Status.FINDINGS, Status.UNDETERMINED)


def _checked(target: str, name: str, anchor: str, code: str, directory: Path) -> int:
    """What `check` says of a package in which the code stands after an anchor."""
    arguments = ["generate", str(_HELLO), "-o", str(directory), "--target", target]
    assert main(arguments) == Status.CLEAN
    (file,) = (p for p in directory.rglob(name) if ".rebsync" not in p.parts)
    text = file.read_text()
    assert anchor in text
    file.write_text(text.replace(anchor, f"{anchor}{code}\n"))
    return main(["check", str(directory / "hello")])


@pytest.mark.parametrize("target", ["ros1-cpp", "ros2-cpp"])
@pytest.mark.parametrize(
    ("anchor", "code"),
    [
        (_FILE, "operator int(float);"),
        (_BODY, "  explicit Walker(int);"),
        (_BODY, "  steps_ = 08;"),
        (_BODY, "  auto&& [a, b] = std::make_tuple(steps_);"),
    ],
)
def test_of_cpp(target: str, anchor: str, code: str, tmp_path: Path) -> None:
    assert _checked(target, "walker.cpp", anchor, code, tmp_path) in _ANSWERS


@pytest.mark.parametrize("target", ["ros1-cpp", "ros2-cpp"])
def test_of_members(target: str, tmp_path: Path) -> None:
    suffix = "h" if target == "ros1-cpp" else "hpp"
    code = "  double table_[4] = {0xabc00ull, 08, 1.5dd, 0x1.8p1};"
    assert _checked(target, f"walker.{suffix}", " private:\n", code, tmp_path) in (0, *_ANSWERS)


@pytest.mark.parametrize("target", ["ros1-py", "ros2-py"])
@pytest.mark.parametrize(
    "code", ["n = 1j", "n = 1.5J", "x = y: int", "for i in range():\n            self._steps = 1"]
)
def test_of_python(target: str, code: str, tmp_path: Path) -> None:
    anchor = "        self._drive.move(1, 0)\n"
    assert _checked(target, "walker.py", anchor, f"        {code}", tmp_path) in _ANSWERS
