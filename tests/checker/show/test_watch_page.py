"""The live page of `rebsync watch` in a real browser: it shows what is new by itself."""

from __future__ import annotations

import json
from pathlib import Path

from rebsync.cli import watch
from tests.checker.show.browser import Browser

_SHOWN = "return document.getElementById('part').src.split('/').pop() + ' ' + "
_BUTTONS = "[...document.querySelectorAll('nav button')].map((b) => b.textContent).join(', ')"


def tell(folder: Path, version: int, **states: str) -> None:
    """Writes what the parts of the page are."""
    told = [{"title": n, "file": f"{n}.html", "state": s} for n, s in states.items()]
    for part in told:
        part["version"] = str(version)
    (folder / "parts.js").write_text(f"show({json.dumps(told)});\n", encoding="utf-8")


def waits_for(browser: Browser, wanted: str) -> None:
    """Looks until the page shows something."""
    browser.until(lambda each: each.run(_SHOWN + _BUTTONS), lambda shown: shown == wanted)


def test_the_page_follows(chromium: Browser, tmp_path: Path) -> None:
    shell = Path(watch.__file__).with_name("watch.html")
    (tmp_path / "index.html").write_bytes(shell.read_bytes())
    tell(tmp_path, 1, run="violated", drift="findings")
    for name in ("run", "drift"):
        (tmp_path / f"{name}.html").write_text(f"<p>{name}</p>\n", encoding="utf-8")
    chromium.open(tmp_path / "index.html")
    waits_for(chromium, "run.html?1 run (violated), drift (findings)")
    chromium.click("nav button:last-child")
    waits_for(chromium, "drift.html?1 run (violated), drift (findings)")
    tell(tmp_path, 2, run="all is well", drift="all is well")
    waits_for(chromium, "drift.html?2 run (all is well), drift (all is well)")
    tell(tmp_path, 2, run="all is well")
    waits_for(chromium, "run.html?2 run (all is well)")


def test_the_page_keeps_what_has_not_changed(chromium: Browser, tmp_path: Path) -> None:
    shell = Path(watch.__file__).with_name("watch.html")
    (tmp_path / "index.html").write_bytes(shell.read_bytes())
    tell(tmp_path, 1, run="violated", drift="findings")
    chromium.open(tmp_path / "index.html")
    waits_for(chromium, "run.html?1 run (violated), drift (findings)")
    chromium.run("window.button = document.querySelector('nav button'); window.button.focus()")
    chromium.run("window.asked = 0; const s = show; show = (p) => { s(p); window.asked += 1; }")
    chromium.until(lambda each: each.run("return window.asked"), lambda asked: asked >= 2)
    assert chromium.run("return window.button === document.activeElement")
