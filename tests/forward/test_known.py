"""Known rebecs that are only sent to have no member; both forms say the same model."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from rebsync import model as m
from rebsync.config import TARGETS, Config
from rebsync.forward import view as views
from rebsync.forward.generate import generate
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse
from tests.reverse.laws import assert_says

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

CASES = tomllib.loads((Path(__file__).parent / "known.toml").read_text(encoding="utf-8"))


def _model(case: dict[str, Any]) -> m.Model:
    parsed = parse_model(Source("known.rebeca", case["model"]))
    assert parsed.model is not None and not parsed.diagnostics
    return replace(parsed.model, classes=tuple(sorted(parsed.model.classes, key=_name)))


def _name(declaration: m.ReactiveClass | m.Interface) -> str:
    return declaration.name


@pytest.mark.parametrize("name", CASES)
def test_which_are_members(name: str) -> None:
    model = _model(CASES[name])
    package, _ = views.view(model, analyse(model), Config(), "known")
    held = [k.path for c in package.classes for k in c.values_known]
    assert sorted(held) == CASES[name]["held"]


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("members", ["some", "all"])
def test_the_model_comes_back(
    name: str, target: str, members: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With members for all, as packages had them that were generated before."""
    if members == "all":
        monkeypatch.setattr(views, "_tell_class", lambda *_: False)
    model = _model(CASES[name])
    files = generate(model, (), analyse(model), Config(target=target), "known")
    assert_says(files, model)
