"""Drawn models are well typed, so that laws may be tried on them."""

from __future__ import annotations

from hypothesis import given

from rebsync import model as m
from rebsync.diagnostics import Severity
from rebsync.printing import print_model
from rebsync.static import analyse
from tests.strategies import models


@given(models())
def test_drawn_models_have_no_errors(model: m.Model) -> None:
    errors = [d for d in analyse(model).diagnostics if d.severity is Severity.ERROR]
    assert not errors, f"{errors}\n{print_model(model)}"
