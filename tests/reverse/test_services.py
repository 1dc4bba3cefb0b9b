"""Services and actions come back from what code offers, with and without markers."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync import model as m
from rebsync.config import TARGETS, Config
from rebsync.forward.generate import generate
from rebsync.grammars.parser import parse_model
from rebsync.reserved import OFFERS
from rebsync.roundtrip.diff.normal_form import normal
from rebsync.source import Source
from rebsync.static import analyse
from tests.reverse.laws import extracted, without_markers

_CASES = Path(__file__).parents[1] / "forward" / "cases"


_STARTS = (
    *("  go_service_ = ", "  go_action_ = "),
    *("        self._go_service = ", "        self._go_action = "),
)


@pytest.fixture(scope="module", params=["services", "actions"])
def model(request: pytest.FixtureRequest) -> m.Model:
    case = _CASES / f"{request.param}.rebeca"
    return parse_model(Source(case.name, case.read_text(encoding="utf-8"))).model


@pytest.fixture(scope="module", params=TARGETS)
def files(request: pytest.FixtureRequest, model: m.Model) -> dict[str, str]:
    return generate(model, (), analyse(model), Config(target=request.param), "services")


def _servers(model: m.Model) -> dict[str, tuple[tuple[m.Annotation, ...], m.Block | None]]:
    return {
        f"{c.name}.{s.name}({', '.join(str(p.type) for p in s.parameters)})": (
            tuple(a for a in s.annotations if a.name in ("Action", "Service", "Port", "priority")),
            s.body,
        )
        for c in model.classes
        if isinstance(c, m.ReactiveClass)
        for s in c.members
        if isinstance(s, m.MessageServer)
    }


@pytest.mark.parametrize("marked", [True, False], ids=["markers", "no markers"])
def test_services_come_back(files: dict[str, str], model: m.Model, marked: bool) -> None:
    found = extracted(files if marked else without_markers(files))
    assert [(f.text, f.why) for f in found.findings] == []
    assert _servers(found.model) == _servers(normal(model))


def test_what_is_no_longer_offered_is_no_service(files: dict[str, str], model: m.Model) -> None:
    """Whatever the marker says."""
    wanted = _servers(normal(model))
    key = "Robot.go(int, boolean)"
    wanted[key] = (tuple(a for a in wanted[key][0] if a.name not in OFFERS), wanted[key][1])
    found = extracted({path: _without_offer(text) for path, text in files.items()})
    assert _servers(found.model) == wanted


def _without_offer(text: str) -> str:
    """A text without the statement that offers `Robot.go`."""
    for start in _STARTS:
        if start in text:
            before, _, rest = text.partition(start)
            end = ");\n" if ";" in rest else f"\n        self._later_{start.split('_')[2][:-3]}"
            return before + (
                rest.partition(end)[2] if ";" in end else end[1:] + rest.partition(end)[2]
            )
    return text
