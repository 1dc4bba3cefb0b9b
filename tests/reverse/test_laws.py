"""Extraction gives the model back: of examples, of drawn models, of code that was laid out anew."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import given

from rebsync import model as m
from rebsync.files import read_source
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.normal_form import normal
from tests.reverse.laws import (
    assert_same,
    assert_says,
    extracted,
    generated,
    told_without_markers,
    without_markers,
)
from tests.strategies import models

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").iterdir())
STYLES = (
    "{BasedOnStyle: LLVM, ColumnLimit: 60}",
    "{BasedOnStyle: GNU, PointerAlignment: Right}",
    "{BasedOnStyle: Mozilla, ColumnLimit: 40, AllowShortIfStatementsOnASingleLine: true}",
)


def package_of(example: Path) -> dict[str, str]:
    """The committed package of an example, without what is in `.rebsync`."""
    root = example / example.name
    files = (p for p in root.rglob("*") if p.is_file() and ".rebsync" not in p.parts)
    return {p.relative_to(root).as_posix(): p.read_text(encoding="utf-8") for p in files}


def model_of(example: Path) -> m.Model:
    return parse_model(read_source(str(example / f"{example.name}.rebeca"))).model


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda e: e.name)
def test_examples_come_back(example: Path) -> None:
    assert_says(package_of(example), model_of(example))


@pytest.mark.parametrize(
    "name", ["annotations", "interfaces", "env", "whiles_and_fors", "operands"]
)
def test_hard_cases_come_back(name: str) -> None:
    path = Path(__file__).parents[1] / "forward" / "cases" / f"{name}.rebeca"
    model = parse_model(read_source(str(path))).model
    assert_says(generated(model), model)


@given(models())
def test_drawn_models_come_back(model: m.Model) -> None:
    assert_says(generated(model), model)


@given(models())
def test_they_come_back_without_markers(model: m.Model) -> None:
    found = extracted(without_markers(generated(model)))
    assert [(f.text, f.why) for f in found.findings] == []
    assert_same(told_without_markers(found.model), told_without_markers(normal(model)))


@pytest.mark.skipif(shutil.which("clang-format") is None, reason="clang-format is not installed")
@pytest.mark.parametrize("style", STYLES)
def test_layout_does_not_matter(style: str) -> None:
    for example in EXAMPLES:
        files = package_of(example)
        for path, text in files.items():
            if path.endswith((".h", ".cpp")):
                files[path] = subprocess.run(
                    ["clang-format", f"--style={style}", f"--assume-filename={path}"],
                    input=text,
                    capture_output=True,
                    text=True,
                    check=True,
                ).stdout
        assert_says(files, model_of(example))
