"""The page of a recorded run in a real browser: how the robots moved, and its chart beside it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.checker.show.browser import Browser
from tests.checker.show.test_page import LEAST_CONTRAST
from tests.cli.test_conform_times import conform, model

__all__ = ["model"]  # a fixture

STATE = """
    const root = document.querySelector('.movement');
    return {
        time: Number(root.dataset.time),
        step: root.dataset.step,
        chart: [...document.querySelectorAll('#recorded-chart .row.on')].map((r) => r.dataset.step),
        places: [...root.querySelectorAll('.robots .place')].map((place) => place.textContent),
        button: root.querySelector('[data-act=play]').textContent,
    };
"""


@pytest.fixture
def page(model: Path) -> Path:
    """The page of the slow run."""
    assert conform(model, "slow.jsonl", "--page", "page.html").status == 0
    return model.parent / "page.html"


def test_keys_and_clicks_step_through_the_recorded_run(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    before = chromium.run(STATE)
    chromium.press("j", "j", "j")
    after = chromium.run(STATE)
    assert int(after["step"]) == int(before["step"]) + 3
    assert after["chart"] == [after["step"]]
    assert after["time"] == pytest.approx(6.8, abs=0.05)  # two bodies of 3.4
    assert after["places"] == ["(2, 1)", "(1, 0.9)"]
    chromium.press("k")
    assert chromium.run(STATE)["chart"] == [str(int(after["step"]) - 1)]
    chromium.click(f"#recorded-chart .row[data-step='{after['step']}']")
    assert chromium.run(STATE) == after
    chromium.press("p")
    assert chromium.run(STATE)["button"] == "Pause"


def test_its_texts_can_be_read_and_it_loads_nothing(chromium: Browser, page: Path) -> None:
    for scheme in ("light", "dark"):
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        emulated = {"cmd": "Emulation.setEmulatedMedia", "params": {"features": features}}
        chromium.command("POST", "goog/cdp/execute", emulated)
        chromium.open(page)
        within = LEAST_CONTRAST.replace(
            "document.query", "document.querySelector('.movement').query"
        )
        assert chromium.run(within) >= 4.5, scheme
    assert chromium.run("return performance.getEntriesByType('resource').length") == 0
