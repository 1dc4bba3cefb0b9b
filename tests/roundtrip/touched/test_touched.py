"""Whatever model a package was made from, remarks in its files leave it in step.

Here are a few packages; `python -m tests.roundtrip.touched` takes all, and formatters too.
"""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.printing import print_model
from tests.roundtrip.touched.__main__ import tried
from tests.roundtrip.touched.forms import TOUCHED
from tests.roundtrip.touched.packages import TESTS, Case, case_of
from tests.strategies import models

CASES = [
    case
    for path in sorted((TESTS / "forward" / "cases").glob("*.rebeca"))
    if (case := case_of(path)) is not None
]
# Those that were out of step once, beside one dialect for each model.
KNOWN = (
    ("annotations", "ros1-cpp"),
    ("annotations", "ros2-cpp"),
)
TAKEN = sorted(
    {(case.stem, case.targets()[i % len(case.targets())]) for i, case in enumerate(CASES)}
    | {*KNOWN}
)
FEW = settings(max_examples=max(6, settings().max_examples // 5))  # each is written and read


@pytest.mark.parametrize(("name", "target"), TAKEN)
def test_touched_packages_are_in_step(name: str, target: str) -> None:
    (case,) = (case for case in CASES if case.stem == name)
    assert tried((case, target, (TOUCHED,))) == ([], 1)


@FEW
@given(models(), st.data())
def test_touched_packages_of_drawn_models_are_in_step(model: m.Model, data: st.DataObject) -> None:
    case = Case("drawn", print_model(model), model)
    target = data.draw(st.sampled_from(case.targets()))
    assert tried((case, target, (TOUCHED,))) == ([], 1)
