"""Generated packages for ROS 2 in C++ read back as the models that they were made from."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given

from rebsync import model as m
from rebsync.config import Config
from rebsync.forward.generate import generate
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.normal_form import normal
from rebsync.source import Source
from rebsync.static import analyse
from tests.reverse.laws import (
    assert_same,
    assert_says,
    extracted,
    told_without_markers,
    without_markers,
)
from tests.strategies import models

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*/*.rebeca"))
_CONFIG = Config(target="ros2-cpp")


def _generated(model: m.Model) -> dict[str, str]:
    return generate(model, (), analyse(model), _CONFIG, "drawn")


def _parsed(path: Path) -> m.Model:
    return parse_model(Source(path.name, path.read_text(encoding="utf-8"))).model


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.stem)
def test_examples_come_back(path: Path) -> None:
    model = _parsed(path)
    assert_says(_generated(model), model)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.stem)
def test_examples_come_back_without_markers(path: Path) -> None:
    model = _parsed(path)
    found = extracted(without_markers(_generated(model)))
    assert [(f.text, f.why) for f in found.findings] == []
    assert_same(told_without_markers(found.model), told_without_markers(normal(model)))


@given(models())
def test_drawn_models_come_back(model: m.Model) -> None:
    assert_says(_generated(model), model)


@given(models())
def test_they_come_back_without_markers(model: m.Model) -> None:
    found = extracted(without_markers(_generated(model)))
    assert [(f.text, f.why) for f in found.findings] == []
    assert_same(told_without_markers(found.model), told_without_markers(normal(model)))


@given(models())
def test_the_same_model_gives_the_same_bytes(model: m.Model) -> None:
    assert _generated(model) == _generated(model)


@given(models())
def test_both_generations_of_ros_say_the_same_model(model: m.Model) -> None:
    in_ros1 = generate(model, (), analyse(model), Config(target="ros1-cpp"), "drawn")
    assert extracted(_generated(model)).model == extracted(in_ros1).model
