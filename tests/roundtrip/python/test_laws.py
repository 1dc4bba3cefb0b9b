"""Packages of drawn models in the dialects of Python are in step as they are generated."""

from __future__ import annotations

import io
import subprocess
import sys
import tokenize
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.printing import print_model
from rebsync.roundtrip.verdict.drift import Verdict
from tests.roundtrip.python.packages import checked, made, python_of, told
from tests.strategies import models

TARGETS = ("ros1-py", "ros2-py")
# Each is written and read: to shrink what fails takes longer than a test may.
FEW = settings(
    max_examples=max(6, settings().max_examples // 5), phases=set(Phase) - {Phase.shrink}
)
EMPTY = """
reactiveclass Robot(4) {
  Robot() { self.first(); }
  @priority(3) msgsrv first() { ; }
  msgsrv second() { @priority(2); }
}
main { Robot r():(); }
"""


@pytest.fixture(autouse=True, scope="module")
def own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("REBSYNC_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


def assert_in_step(root: Path) -> None:
    """The verdict on a package of which digests do not tell it."""
    found = checked(root)
    assert told(found) == []
    assert found.drift is not None
    assert found.drift.verdict is Verdict.IN_STEP, found.drift.differences


def laid_out_anew(root: Path) -> None:
    """What a formatter with short lines makes of a package, with the other quotes."""
    paths = python_of(root)
    for path in paths:
        path.write_text(_other_quotes(path.read_text(encoding="utf-8")), encoding="utf-8")
    if find_spec("ruff") is not None:
        options = ("--isolated", "--line-length=60", "--config=format.quote-style='preserve'")
        command = (sys.executable, "-m", "ruff", "format", "--quiet", *options)
        subprocess.run((*command, *map(str, paths)), check=True)


def _other_quotes(text: str) -> str:
    """A text of Python whose strings have the other quotes, where these are in none of them."""
    lines = text.splitlines(keepends=True)
    for token in [*tokenize.generate_tokens(io.StringIO(text).readline)][::-1]:
        plain = token.string[1:-1]
        is_plain = token.string.startswith('"') and not set(plain) & set("'\"\\")
        if token.type == tokenize.STRING and is_plain:
            line, (row, start), (_, end) = lines[token.start[0] - 1], token.start, token.end
            lines[row - 1] = f"{line[:start]}'{plain}'{line[end:]}"
    return "".join(lines)


@FEW
@given(models(), st.sampled_from((*TARGETS, "ros2-cpp")))
def test_drawn_packages_are_in_step(model: m.Model, target: str) -> None:
    with TemporaryDirectory() as folder:
        root = made("drawn", target, Path(folder), print_model(model))
        for path in root.rglob("*.h"):
            path.write_text(path.read_text(encoding="utf-8") + "// a remark\n", encoding="utf-8")
        for path in python_of(root):
            path.write_text(path.read_text(encoding="utf-8") + "# a remark\n", encoding="utf-8")
        assert_in_step(root)


@FEW
@given(models(), st.sampled_from(TARGETS))
def test_layout_of_drawn_packages_does_not_matter(model: m.Model, target: str) -> None:
    with TemporaryDirectory() as folder:
        root = made("drawn", target, Path(folder), print_model(model))
        laid_out_anew(root)
        assert_in_step(root)


@pytest.mark.parametrize("target", TARGETS)
def test_annotations_of_a_server_on_one_line_are_not_of_its_statement(
    target: str, tmp_path: Path
) -> None:
    root = made("drawn", target, tmp_path, EMPTY)
    laid_out_anew(root)
    (robot,) = [p for p in python_of(root) if p.name == "robot.py"]
    assert "def first(self) -> None: ...\n" in robot.read_text(encoding="utf-8")
    assert_in_step(root)
