"""The page of a comparison in a real browser, with and without its script."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from rebsync.roundtrip.diff.compare import compare
from rebsync.roundtrip.diff.page import sides_page
from rebsync.roundtrip.package.revisions import read_side
from tests.checker.show.browser import Browser
from tests.consoles import ROOT

EXAMPLE = ROOT / "examples" / "experiment1"
MARKED = """
    const on = [...document.querySelectorAll('tr.on')];
    const inView = (line) => {
        const boxes = [line, line.closest('section')].map((e) => e.getBoundingClientRect());
        const [a, b] = boxes;
        return a.top >= b.top && a.bottom <= b.bottom;
    };
    return {
        row: [...document.querySelectorAll('li.on')].map((row) => row.id),
        lines: on.map((line) => line.querySelector('code').textContent.trim()),
        visible: on.every(inView),
        address: location.hash,
    }
"""


def page_text(folder: Path) -> str:
    """The page of a model and code with a guard changed, a send removed and a call unread."""
    package = folder / "experiment1"
    shutil.copytree(EXAMPLE / "experiment1", package)
    code = package / "src" / "r_1.cpp"
    text = code.read_text(encoding="utf-8")
    for old, new in (
        ("this->current_segment_ < 10", "this->current_segment_ < 8"),
        ("    sendSelfWaitForCharge();\n", ""),
        ("void R_1::moveForward() {\n", "void R_1::moveForward() {\n  f(&e11_);  // <b>\n"),
    ):
        assert old in text
        text = text.replace(old, new)
    code.write_text(text, encoding="utf-8")
    sides = [read_side(str(path)).given for path in (EXAMPLE / "experiment1.rebeca", package)]
    return sides_page(compare(sides[0], sides[1]), sides[0], sides[1])


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page in a file."""
    folder = tmp_path_factory.mktemp("page")
    path = folder / "page.html"
    path.write_text(page_text(folder), encoding="utf-8")
    return path


def marked(chromium: Browser) -> dict[str, Any]:
    found: dict[str, Any] = chromium.run(MARKED)
    return found


def test_it_opens_at_the_first_difference(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    found = marked(chromium)
    assert found["row"] == ["d1"]
    assert found["lines"] == [
        "if (self.direct_moving == true && self.current_segment < 10) {",
        "if (this->direct_moving_ == true && this->current_segment_ < 8) {",
    ]
    assert found["visible"]


def test_keys_and_clicks_select(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    chromium.press("j")
    found = marked(chromium)
    assert (found["row"], found["address"]) == (["d2"], "#d2")
    assert found["lines"][0] == "self.waitForCharge();"
    chromium.press("k", "k")
    assert marked(chromium)["row"] == ["d1"]
    chromium.click("#d3 strong")
    found = marked(chromium)
    assert found["row"] == ["d3"]
    assert found["lines"] == ["msgsrv moveForward() {", "f(&e11_);  // <b>"]
    assert found["visible"]


def test_an_address_selects(chromium: Browser, page: Path) -> None:
    chromium.open(page, "#d2")
    assert marked(chromium)["row"] == ["d2"]


def test_lines_are_marked_where_they_differ(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    script = """
        return [...document.querySelectorAll('tr[class]')]
            .map((row) => row.id[0] + ' ' + row.className.replace(' on', ''))
    """
    assert chromium.run(script) == [
        "L changed",
        "L removed",
        "L undetermined",
        "R changed",
        "R undetermined",
    ]


def test_nothing_is_cut_off_on_a_narrow_screen(chromium: Browser, page: Path) -> None:
    chromium.resize(600, 900)
    try:
        chromium.open(page)
        wide = "return document.documentElement.scrollWidth <= innerWidth"
        assert chromium.run(wide)
    finally:
        chromium.resize(1700, 1000)


def test_without_scripts_links_lead_to_the_lines(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    targets = re.findall(r'href="#([LR]\d+-\d+)"', text)
    assert len(targets) == 6
    assert all(text.count(f'id="{target}"') == 1 for target in targets)


def test_it_needs_nothing_but_itself(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert "<b>" not in text
    assert "default-src &#39;none&#39;" in text
    assert not re.search(r'(?:src|href)="(?!#)', text)
