"""The page in a real browser: what a selection marks, by key and mouse; without scripts; dark."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from rebsync.checker.show.page import result_page, trace_page
from rebsync.source import Source
from tests.checker.show.browser import Browser
from tests.checker.show.runs import crossing, lasso, long_run, result, violation

SOURCE = Source("crossing.rebeca", "".join(f"line {n} of <it>\n" for n in range(1, 61)))
PROPERTIES = Source("crossing.property", "property {\n  Assertion {\n    Ends: a;\n  }\n}\n")
DOWN, END, HOME = "\ue015", "\ue010", "\ue011"
MARKED = """
    const marked = (selector) => [...document.querySelectorAll(selector)];
    const run = document.querySelector('.run.on');
    return {
        run: marked('.run.on').map((r) => r.id),
        visible: marked('.run').filter((r) => r.checkVisibility()).map((r) => r.id),
        rows: marked('.states tr.on').map((r) => r.id),
        chart: [...run.querySelectorAll('.msc .row.on')].map((r) => r.dataset.step),
        flights: [...run.querySelectorAll('.msc .flight.on')]
            .map((f) => [f.dataset.sent, f.dataset.taken || null]),
        lines: marked('.lines tr.on').map((r) => r.id),
        focus: document.activeElement.id,
        scrolled: [scrollX, scrollY],
    }
"""


def page_text() -> str:
    """A page of three violations."""
    ends = replace(violation(lasso(), "property", "Ends"), path=PROPERTIES.path, line=3)
    long = violation(long_run(6, 60), "overflow", "node3")
    return result_page(result(violation(crossing()), ends, long), SOURCE, PROPERTIES)


@pytest.fixture
def page(tmp_path: Path) -> Path:
    """The page in a file."""
    path = tmp_path / "page.html"
    path.write_text(page_text(), encoding="utf-8")
    return path


def marked(chromium: Browser) -> dict[str, Any]:
    """What is marked in the page that is open."""
    found: dict[str, Any] = chromium.run(MARKED)
    return found


def test_it_opens_at_the_end_of_the_first_run(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    found = marked(chromium)
    assert found["visible"] == found["run"] == ["v1"]
    assert found["rows"] == ["v1-s10"]
    assert found["chart"] == ["10"]
    assert found["flights"] == [["9", "10"]]
    assert found["lines"] == ["L12"]
    assert found["scrolled"] == [0, 0]


def test_keys_walk_through_steps_and_runs(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    chromium.press("k", "k")
    assert marked(chromium)["rows"] == ["v1-s8"]
    chromium.press(HOME, DOWN)
    found = marked(chromium)
    assert found["rows"] == ["v1-s1"]
    assert found["focus"] == "v1-s1"
    assert found["flights"] == [["0", "1"], ["1", "2"]]
    assert found["lines"] == ["L31"]
    assert chromium.run("return location.hash") == "#v1-s1"
    chromium.press(END, "j")
    assert marked(chromium)["rows"] == ["v1-s10"]
    chromium.press("]", "j")
    found = marked(chromium)
    assert (found["visible"], found["rows"]) == (["v2"], ["v2-s1"])
    chromium.press("[", "[")
    assert marked(chromium)["visible"] == ["v1"]


@pytest.mark.parametrize(
    ("selector", "row"),
    [
        (".run.on .msc .step[data-step='4'] .label", "v1-s4"),
        (".run.on .msc .row[data-step='7']", "v1-s7"),
        (".run.on .flight[data-taken='2'] .way", "v1-s2"),
        ("#v1-s6 .what", "v1-s6"),
        ("#L36 code", "v1-s6"),
    ],
)
def test_a_click_selects(chromium: Browser, page: Path, selector: str, row: str) -> None:
    chromium.open(page)
    chromium.click(selector)
    assert marked(chromium)["rows"] == [row]


def test_a_line_of_several_steps_goes_to_the_next_one(chromium: Browser, page: Path) -> None:
    chromium.open(page, "#v1-s0")
    rows = []
    for _ in range(4):
        chromium.click("#L12 code")
        rows += marked(chromium)["rows"]
    assert rows == ["v1-s2", "v1-s7", "v1-s10", "v1-s2"]


def test_tabs_and_addresses_select_runs(chromium: Browser, page: Path) -> None:
    chromium.open(page, "#v3-s17")
    assert marked(chromium)["rows"] == ["v3-s17"]
    chromium.click("nav a[data-run='2']")
    found = chromium.until(marked, lambda found: found["visible"] == ["v2"])
    assert (found["visible"], found["rows"]) == (["v2"], ["v2-s6"])
    assert chromium.run("return document.querySelector('nav [aria-current]').textContent") == (
        "property Ends"
    )


def test_what_is_selected_is_in_view(chromium: Browser, page: Path) -> None:
    for start in ("#v3-s0", "#v3-s30"):
        chromium.open(page, start)
        assert chromium.run(_IN_VIEW)
    for _ in range(5):
        chromium.press(*"jjjjj")
        assert chromium.run(_IN_VIEW)


def test_what_happens_in_a_step_is_not_scrolled_away(chromium: Browser, page: Path) -> None:
    page.write_text(trace_page(lasso(), SOURCE), encoding="utf-8")
    chromium.open(page, "#v1-s3")
    scrolled = "return [...document.querySelectorAll('.pane')].map((pane) => pane.scrollLeft)"
    assert set(chromium.run(scrolled)) == {0}
    assert not chromium.run("return document.body.textContent.includes('another run')")


def test_without_scripts_everything_is_visible(chromium: Browser, page: Path) -> None:
    text = re.sub(r"<script>.*?</script>", "", page_text(), flags=re.DOTALL)
    page.write_text(text, encoding="utf-8")
    chromium.open(page)
    hidden = chromium.run(
        """
        return [...document.querySelectorAll('section, tr, .msc, .pane, nav, li')]
            .filter((part) => !part.checkVisibility()).length;
        """
    )
    assert hidden == 0
    assert chromium.run("return document.querySelectorAll('.run').length") == 3


def test_what_never_ran_can_be_shown_and_hidden(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    colour = "return getComputedStyle(document.getElementById('L21')).backgroundColor"
    shown = chromium.run(colour)
    chromium.click("#coverage-shown")
    assert chromium.run(colour) == "rgba(0, 0, 0, 0)" != shown
    assert not chromium.run("return document.querySelector('#L14 small').checkVisibility()")


def test_texts_can_be_told_from_their_background(chromium: Browser, page: Path) -> None:
    for scheme in ("light", "dark"):
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        emulated = {"cmd": "Emulation.setEmulatedMedia", "params": {"features": features}}
        chromium.command("POST", "goog/cdp/execute", emulated)
        chromium.open(page)
        assert chromium.run(LEAST_CONTRAST) >= 4.5, scheme


def test_it_loads_nothing_and_breaks_nothing(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    assert chromium.run("return performance.getEntriesByType('resource').length") == 0
    assert chromium.run("return document.querySelectorAll('[id]').length") == chromium.run(
        "return new Set([...document.querySelectorAll('[id]')].map((e) => e.id)).size"
    )
    text = page.read_text(encoding="utf-8")
    assert not re.search(r"(?:src|href)=\"(?!#)|@import|url\(", text)


def test_hard_texts_stay_texts(chromium: Browser, tmp_path: Path) -> None:
    hard = "</script><script>document.title='bad'</script><img src=x onerror=alert(1)>\"'&"
    found = result(violation(crossing(), "assertion", hard))
    found = replace(found, reason=hard, caveats=(hard,), properties=((hard, "violated"),))
    page = tmp_path / "hard.html"
    page.write_text(result_page(found, Source(f"{hard}.rebeca", hard)), encoding="utf-8")
    chromium.open(page)
    assert chromium.run("return document.querySelectorAll('img, script:not([type])').length") == 1
    assert chromium.run("return document.querySelector('#L1 code').textContent") == hard


def test_a_result_without_runs_and_a_run_without_result(chromium: Browser, tmp_path: Path) -> None:
    page = tmp_path / "one.html"
    page.write_text(result_page(result(), SOURCE), encoding="utf-8")
    chromium.open(page)
    assert chromium.run("return document.querySelector('#L60').checkVisibility()")
    page.write_text(trace_page(lasso(), SOURCE), encoding="utf-8")
    chromium.open(page)
    assert marked(chromium)["rows"] == ["v1-s6"]


class _Balance(HTMLParser):
    """Collects elements that are closed in another order than they were opened."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.wrong: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in ("meta", "input", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)


def test_every_element_is_closed() -> None:
    balance = _Balance()
    balance.feed(page_text())
    assert (balance.open, balance.wrong) == ([], [])


def test_a_page_is_the_same_each_time() -> None:
    assert page_text() == page_text()


_IN_VIEW = """
    const inside = (part) => {
        const here = part.getBoundingClientRect();
        const pane = part.closest('.pane, aside');
        const there = pane.getBoundingClientRect();
        const head = pane.querySelector('thead, .heads');
        const top = head ? head.getBoundingClientRect().bottom : there.top;
        return here.top >= top - 1 && here.bottom <= there.bottom + 1;
    };
    return ['.run.on .states tr.on', '.run.on .msc .step.on .number', '.lines tr.on']
        .map((s) => document.querySelector(s)).filter((p) => p !== null).every(inside);
"""
LEAST_CONTRAST = """
    const channel = (c) => c <= 10.31475 ? c / 3294.6 : ((c / 255 + 0.055) / 1.055) ** 2.4;
    const parse = (text) => (text.match(/[0-9.]+/g) || []).map(Number);
    const light = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
    const back = (part) => {
        for (let at = part; at; at = at.parentElement) {
            const found = parse(getComputedStyle(at).backgroundColor);
            if (found.length === 3) return found;
        }
        return [255, 255, 255];
    };
    const ratio = (one, other) => {
        const [a, b] = [light(one), light(other)].sort((x, y) => y - x);
        return (a + 0.05) / (b + 0.05);
    };
    const texts = [...document.querySelectorAll(
        'h1,h2,p,li,span,th,td,code,small,a,em,strong,b,button,select,output,label,summary')]
        .filter((part) => part.textContent.trim());
    const svg = [...document.querySelectorAll('.msc text, .board text')];
    return Math.min(
        ...texts.map((t) => ratio(parse(getComputedStyle(t).color), back(t))),
        ...svg.map((t) => ratio(parse(getComputedStyle(t).fill), back(t))),
    );
"""
