"""Every example lints clean, is in canonical layout, and its committed package is current."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.cli import main
from tests.regenerate import EXAMPLES, models

NAMES = [m.stem for m in models()]


def texts(folder: Path) -> dict[str, str]:
    return {
        p.relative_to(folder).as_posix(): p.read_text(encoding="utf-8")
        for p in sorted(folder.rglob("*"))
        if p.is_file()
    }


@pytest.mark.parametrize("name", NAMES)
def test_the_committed_package_is_a_fresh_generation(name: str, tmp_path: Path) -> None:
    assert main(["generate", str(EXAMPLES / name / f"{name}.rebeca"), "-o", str(tmp_path)]) == 0
    committed, fresh = texts(EXAMPLES / name / name), texts(tmp_path / name)
    assert set(committed) == set(fresh), "run tests/regenerate.py"
    assert committed == fresh, "run tests/regenerate.py"


@pytest.mark.parametrize("name", NAMES)
def test_the_model_is_clean(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lint", str(EXAMPLES / name)]) == 0, capsys.readouterr().out


@pytest.mark.parametrize("name", NAMES)
def test_the_model_is_in_canonical_layout(name: str) -> None:
    assert main(["fmt", "--check", str(EXAMPLES / name / f"{name}.rebeca")]) == 0


def test_all_examples_are_here() -> None:
    assert NAMES == [
        "experiment1",
        "experiment1_unsafe",
        "experiment2",
        "experiment2_unsafe",
        "experiment3",
        "experiment3_unsafe",
        "hello",
        "running_example",
        "warehouse",
    ]
    for name in NAMES:
        for file in (f"{name}.property", "rebsync.toml", "README.md"):
            assert (EXAMPLES / name / file).is_file(), f"{name}/{file}"
