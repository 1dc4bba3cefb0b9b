"""Packages with classes in C++ and in Python give the model back, whoever sends to whom."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings

from rebsync import model as m
from rebsync.config import ClassTarget, Config
from rebsync.files import read_source
from rebsync.forward.generate import generate
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.normal_form import normal
from rebsync.static import analyse
from tests.reverse.laws import assert_same, extracted, told_without_markers, without_markers
from tests.reverse.mixed import LANGUAGES, families, mixed
from tests.reverse.python.laws import assert_says, python_normal, without_chains

CASES = sorted(Path(__file__).with_name("mixed_cases").glob("*.rebeca"))


def files_of(model: m.Model, targets: tuple[ClassTarget, ...]) -> dict[str, str]:
    return generate(model, (), analyse(model), Config(targets=targets), "drawn")


def assert_says_without_markers(files: dict[str, str], model: m.Model) -> None:
    found = extracted(without_markers(files))
    assert [(f.text, f.why) for f in found.findings] == []
    told = told_without_markers(without_chains(python_normal(found.model)))
    assert_same(told, told_without_markers(without_chains(python_normal(normal(model)))))


@pytest.mark.parametrize("first", LANGUAGES)
@pytest.mark.parametrize("path", CASES, ids=lambda p: p.stem)
def test_cases_come_back(path: Path, first: str) -> None:
    """With the first family in one language, and all others in the other."""
    model = parse_model(read_source(str(path))).model
    other = LANGUAGES[1 - LANGUAGES.index(first)]
    apart = families(model)
    targets = tuple(
        ClassTarget(n, first if each == apart[0] else other) for each in apart for n in each
    )
    files = files_of(model, targets)
    assert_says(files, model)
    assert_says_without_markers(files, model)


@settings(max_examples=max(10, settings().max_examples // 2))
@given(mixed())
def test_drawn_packages_come_back(drawn: tuple[m.Model, tuple[ClassTarget, ...]]) -> None:
    """With their markers and without."""
    model, targets = drawn
    files = files_of(model, targets)
    assert_says(files, model)
    assert_says_without_markers(files, model)
