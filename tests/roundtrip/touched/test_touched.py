"""Whatever model a package was made from, remarks in its files leave it in step.

Here are a few packages; `python -m tests.roundtrip.touched` takes all, and formatters too.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.printing import print_model
from tests.roundtrip.touched.__main__ import of_mixed, tried
from tests.roundtrip.touched.forms import SPREAD, TOUCHED
from tests.roundtrip.touched.packages import DIALECTS, ROOT, Case, case_of
from tests.strategies import models

HARD = Path("tests/forward/cases")
# Those that were out of step once, beside one dialect for each of the hard cases.
KNOWN = (
    ("tests/forward/cases/templates.rebeca", "ros1-cpp"),
    ("tests/forward/cases/annotations.rebeca", "ros1-cpp"),
    ("tests/forward/cases/annotations.rebeca", "ros2-cpp"),
    ("tests/roundtrip/differences/cases/elements.right.rebeca", "ros1-cpp"),
    ("tests/forward/cases/names.rebeca", "mixed-others"),
    ("tests/forward/cases/names.rebeca", "ros1-cpp"),
    ("tests/new/cases/fleet.rebeca", "mixed"),
    ("tests/new/cases/fleet.rebeca", "mixed-others"),
    ("tests/roundtrip/touched/timers.rebeca", "mixed-others"),
)


def taken() -> Iterator[tuple[str, str]]:
    """A few models, each with a dialect."""
    yield from KNOWN
    for number, path in enumerate(sorted((ROOT / HARD).glob("*.rebeca"))):
        case = case_of(path)
        if case is not None:
            yield case.name, case.targets()[number % len(case.targets())]


FEW = settings(max_examples=max(6, settings().max_examples // 5))  # each is written and read


@pytest.mark.parametrize(("name", "target"), dict.fromkeys(taken()))
def test_touched_packages_are_in_step(name: str, target: str) -> None:
    case = case_of(ROOT / name)
    assert case is not None
    assert tried((case, target, (TOUCHED,))) == ([], 1)


@pytest.mark.parametrize(
    ("name", "target"), [("inheritance", "ros1-cpp"), ("interfaces", "ros2-cpp")]
)
def test_layout_of_names_and_literals_does_not_matter(name: str, target: str) -> None:
    case = case_of(ROOT / HARD / f"{name}.rebeca")
    assert case is not None
    assert tried((case, target, (SPREAD,))) == ([], 1)


@FEW
@given(models(), st.sampled_from(DIALECTS))
def test_touched_packages_of_drawn_models_are_in_step(model: m.Model, target: str) -> None:
    case = Case("drawn", print_model(model), model)
    assert tried((case, target, (TOUCHED,))) == ([], 1)


@FEW
@given(of_mixed())
def test_touched_packages_of_two_languages_are_in_step(case: Case) -> None:
    assert tried((case, "mixed", (TOUCHED,))) == ([], 1)
