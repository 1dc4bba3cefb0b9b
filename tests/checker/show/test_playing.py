"""A run that one can play with: what else could happen, plots, colours, and what is in view."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from rebsync.checker.branching import branchings, run_along
from rebsync.checker.lowering import lower
from rebsync.checker.problem import Options
from rebsync.checker.show.page import result_page, trace_page
from rebsync.checker.show.page_run import RunDetails
from rebsync.checker.telling import Teller
from rebsync.checker.verify import verify
from rebsync.checker.views import view_of
from rebsync.cli.problem import read_problem
from rebsync.cli.run_details import details_in, live_in
from rebsync.cli.serving import Live, LiveServer, Refused
from tests.checker.movement.moving import EXAMPLES, analysed
from tests.checker.show.browser import Browser
from tests.checker.show.runs import crossing, result, violation
from tests.checker.show.test_page import LEAST_CONTRAST, PROPERTIES, SOURCE

UNSAFE = ("experiment1_unsafe", "experiment2_unsafe", "experiment3_unsafe")
MODEL = """\
// A walker that may fall, and a watcher.
reactiveclass Walker(3) {
  knownrebecs { Watcher watcher; }
  statevars { int place; boolean tired; }
  Walker() { self.go(); }
  msgsrv go() {
    place = place + ?(1, 2, 30);
    tired = place > 1;
    assertion(place < 30, "it fell");
    watcher.seen(place);
    self.go() after(2);
  }
}
reactiveclass Watcher(3) {
  statevars { int last; }
  Watcher() { }
  msgsrv seen(int at) { last = at; /* no more
  than this */ }
}
main { Walker walker(watcher):(); Watcher watcher():(); }
"""
SHOWN = """
    const text = (part) => part.textContent;
    return [...document.querySelectorAll('.possible h3')].map((title) => {
        const told = [];
        let at = title;
        while ((at = at.nextElementSibling) && at.tagName !== 'H3') {
            if (at.tagName === 'OL') {
                told.push(...[...at.children].map((item) => [
                    text(item.querySelector('summary')).trim(),
                    [...item.querySelectorAll('ul li')].map(text),
                    item.className, Boolean(item.querySelector('button'))]));
            } else if (!at.querySelector('code')) told.push(text(at));
        }
        return [text(title), told];
    });
"""


def page_of(ordinals: list[int]) -> str:
    """The page of a run of MODEL."""
    problem = analysed(MODEL)
    program, _ = lower(problem.analysis)
    teller = Teller(view_of(program, "tts"), problem.source)
    trace = run_along(teller, ordinals)
    details = RunDetails(branches=lambda each: branchings(teller, each))
    return trace_page(trace, problem.source, details)


@pytest.fixture
def page(tmp_path: Path) -> Path:
    """Three times the walker goes on, and the watcher sees it; time passes in between."""
    path = tmp_path / "page.html"
    path.write_text(page_of([0, 1, 0, 0, 0, 0, 0, 2]), encoding="utf-8")
    return path


def test_at_each_step_it_shows_what_else_could_happen(chromium: Browser, page: Path) -> None:
    chromium.open(page, "#v1-s1")
    fell = 'walker.go() from walker, chooses 30an assertion fails in Walker.go: "it fell"'
    assert chromium.run(SHOWN) == [
        [
            "Instead of step 1",
            [
                [
                    "walker.go() from walker, chooses 1",
                    [
                        "walker.place: 0 -> 1",
                        "sends watcher.seen(1)",
                        "sends walker.go() at 2",
                    ],
                    "",
                    False,
                ],
                [fell, ["changes nothing"], "", False],
            ],
        ],
        [
            "After step 1",
            [["watcher.seen(2) from walker", ["watcher.last: 0 -> 2"], "taken", False]],
        ],
    ]


def test_where_the_run_fails_nothing_comes_after(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    ((title, told),) = chromium.run(SHOWN)
    assert title == "Instead of step 7"
    assert [what for what, *_ in told] == [f"walker.go() from walker, chooses {n}" for n in "12"]


def test_a_run_that_nobody_can_branch_has_no_panel(chromium: Browser, page: Path) -> None:
    page.write_text(trace_page(crossing(), SOURCE), encoding="utf-8")
    chromium.open(page)
    assert chromium.run("return document.getElementById('branches')") is None


# --- stepping without movement -----------------------------------------------------------------


def test_buttons_step_and_play_without_robots(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    clock = "return document.querySelector('.clock').textContent"
    seen = []
    for act in ("first", "forward", "forward", "forward", "back", "last"):
        chromium.click(f"[data-act={act}]")
        seen.append(chromium.run(clock))
    assert seen == [
        f"time {time}, step {step} of 7"
        for time, step in ((0, 0), (0, 1), (0, 2), (0, 3), (0, 2), (4, 7))
    ]
    assert chromium.run("return document.querySelector('.states tr.on').dataset.step") == "7"


# --- plots -------------------------------------------------------------------------------------

PLOTS = """
    return [...document.querySelectorAll('.plotted tbody tr')].map((row) => [
        row.querySelector('th').textContent,
        row.querySelector('.value').textContent,
        row.querySelector('.value').classList.contains('changed'),
        row.querySelector('path').getAttribute('d'),
        Number(row.querySelector('.cursor').getAttribute('x1')),
    ]);
"""


def test_variables_are_plotted_over_time(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    assert chromium.run(PLOTS) == [
        ["walker.place", "3", False, "M0,28H0V12H500V4H1000", 1000],
        ["walker.tired", "true", False, "M0,28H0V4H1000", 1000],
        ["watcher.last", "3", False, "M0,28H0V12H500V4H1000", 1000],
    ]
    chromium.open(page, "#v1-s4")
    assert [(name, value, new, x) for name, value, new, _, x in chromium.run(PLOTS)] == [
        ("walker.place", "3", True, 500),
        ("walker.tired", "true", False, 500),
        ("watcher.last", "2", False, 500),
    ]


def test_a_click_in_a_plot_goes_to_its_time(chromium: Browser, page: Path) -> None:
    chromium.open(page, "#v1-s0")
    chromium.click(".plotted svg")  # its middle
    assert chromium.run("return document.querySelector('.states tr.on').dataset.step") == "6"


def test_without_time_steps_are_the_axis(chromium: Browser, page: Path) -> None:
    page.write_text(page_of([0, 1, 0]), encoding="utf-8")
    chromium.open(page, "#v1-s1")
    assert [(name, x) for name, _, _, _, x in chromium.run(PLOTS)] == [
        ("walker.place", 500),
        ("walker.tired", 500),
        ("watcher.last", 500),
    ]
    chromium.click(".plotted svg")
    assert chromium.run("return document.querySelector('.clock').textContent") == "step 1 of 2"


# --- the text of the model ---------------------------------------------------------------------


def test_the_model_has_colours(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    marked = """
        const marks = [...document.querySelectorAll('#source span')];
        return marks.map((part) => [part.className.slice(4), part.textContent]);
    """
    found = [tuple(each) for each in chromium.run(marked)]
    assert found[0] == ("comment", "// A walker that may fall, and a watcher.")
    assert {("word", "msgsrv"), ("type", "boolean"), ("number", "30"), ("string", '"it fell"')} <= (
        set(found)
    )
    assert ("comment", "/* no more") in found
    assert ("comment", "  than this */") in found
    colours = chromium.run(
        "return new Set([...document.querySelectorAll('#source span')]"
        ".map((part) => getComputedStyle(part).color)).size"
    )
    assert colours >= 5
    lines = chromium.run(
        "return [...document.querySelectorAll('#source code')].map((l) => l.textContent)"
    )
    assert [line.rstrip() for line in lines] == MODEL.splitlines()


def test_colours_and_panels_can_be_read(chromium: Browser, page: Path) -> None:
    for scheme in ("light", "dark"):
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        emulated = {"cmd": "Emulation.setEmulatedMedia", "params": {"features": features}}
        chromium.command("POST", "goog/cdp/execute", emulated)
        chromium.open(page, "#v1-s1")
        chromium.run("document.querySelectorAll('.branches details').forEach((d) => d.open = true)")
        assert chromium.run(LEAST_CONTRAST) >= 4.5, scheme


# --- what is in view ---------------------------------------------------------------------------

IN_VIEW = """
    const inside = (part, pane) => {
        const [here, there] = [part, pane].map((each) => each.getBoundingClientRect());
        const head = pane.querySelector('thead').getBoundingClientRect();
        const end = Math.min(there.bottom, innerHeight);
        return here.left >= there.left - 1 && here.right <= there.right + 1
            && here.top >= head.bottom - 1 && here.bottom <= end + 1;
    };
    const row = document.querySelector('.run.on .states tr.on');
    const pane = row.closest('.pane');
    const hit = (part) => {
        const box = part.getBoundingClientRect();
        const found = document.elementFromPoint(box.left + box.width / 2, box.top + 8);
        return part.contains(found);
    };
    const texts = ['.at', '.when', '.what'].map((name) => row.querySelector(name));
    return {
        row: row.dataset.step,
        shown: texts.every((part) => inside(part, pane) && hit(part)),
        heads: [...pane.querySelectorAll('thead .at, thead .when')].every(hit),
        wide: document.documentElement.scrollWidth - innerWidth,
        scrolled: [scrollX, scrollY],
    };
"""


@pytest.mark.parametrize("width", [800, 1000, 1200, 1400, 1600])
@pytest.mark.parametrize("name", UNSAFE)
def test_it_opens_on_the_violation_with_step_and_time_in_view(
    chromium: Browser, tmp_path: Path, name: str, width: int
) -> None:
    problem = read_problem(str(EXAMPLES / name / f"{name}.rebeca"), None)
    found = verify(problem, Options())
    path = tmp_path / "page.html"
    details = details_in(problem, found.semantics)
    text = result_page(found, problem.source, problem.property_source, details)
    path.write_text(text, encoding="utf-8")
    chromium.resize(width, 1000)
    try:
        chromium.open(path)
        shown = chromium.run(IN_VIEW)
    finally:
        chromium.resize(1700, 1000)
    assert shown == {
        "row": str(found.violations[0].trace.steps[-1].number),
        "shown": True,
        "heads": True,
        "wide": 0,
        "scrolled": [0, 0],
    }


def test_the_step_stays_in_view_when_other_parts_grow(chromium: Browser, page: Path) -> None:
    page.write_text(page_of([0, *[0] * 30]), encoding="utf-8")
    chromium.resize(800, 1100)
    try:
        chromium.open(page)
        before = chromium.run("return document.querySelector('.view-states').clientHeight")
        chromium.run("document.querySelectorAll('.branches details').forEach((d) => d.open = true)")
        painted = "requestAnimationFrame(() => requestAnimationFrame(arguments[0]))"
        chromium.command("POST", "execute/async", {"script": painted, "args": []})
        assert chromium.run("return document.querySelector('.view-states').clientHeight") < before
        assert chromium.run(IN_VIEW)["shown"]
    finally:
        chromium.resize(1700, 1000)


def test_parts_can_be_hidden_and_shown(chromium: Browser, page: Path) -> None:
    text = result_page(result(violation(crossing())), SOURCE, PROPERTIES)
    page.write_text(text, encoding="utf-8")
    visible = """
        return ['chart', 'states', 'plots', 'model'].filter(
            (name) => document.querySelector(`.view-${name}`).checkVisibility());
    """
    chromium.open(page)
    assert chromium.run(visible) == ["chart", "states", "plots", "model"]
    chromium.click("[data-view=chart]")
    assert chromium.run(visible) == ["states", "plots", "model"]
    pressed = "return document.querySelector('[data-view=chart]').getAttribute('aria-pressed')"
    assert chromium.run(pressed) == "false"
    chromium.resize(800, 1000)
    try:
        chromium.open(page)
        assert chromium.run(visible) == ["states"]
        for name in ("chart", "plots", "model"):
            chromium.click(f"[data-view={name}]")
            assert chromium.run(visible) == [name]
    finally:
        chromium.resize(1700, 1000)


# --- following ---------------------------------------------------------------------------------


@pytest.fixture
def server() -> Iterator[LiveServer]:
    """The page of the start of MODEL, served."""
    problem = analysed(MODEL)
    program, _ = lower(problem.analysis)
    trace = run_along(Teller(view_of(program, "tts"), problem.source), [0])
    live = live_in(problem, "tts", lambda details: trace_page(trace, problem.source, details))
    with LiveServer(live) as made:
        thread = threading.Thread(target=made.serve_forever, args=(0.01,))
        thread.start()
        yield made
        made.shutdown()
        thread.join()


FOLLOW = """
    const [wanted, done] = arguments;
    const button = [...document.querySelectorAll('.branches button')]
        .find((each) => each.title.includes(wanted));
    document.addEventListener('runadded', () => setTimeout(done, 50), {once: true});
    button.click();
"""
FOLLOWED = """
    const run = document.querySelector('.run.on');
    return {
        runs: document.querySelectorAll('.run').length,
        tabs: [...document.querySelectorAll('nav a')].map((tab) => tab.textContent),
        rows: [...run.querySelectorAll('.states tbody tr .what > div')].map((w) => w.textContent),
        row: run.querySelector('.states tr.on').id,
        wrong: [...run.querySelectorAll('.states strong')].map((w) => w.textContent),
        plots: [...run.querySelectorAll('.plotted th')].map((name) => name.textContent),
    };
"""


def followed(chromium: Browser, wanted: str) -> dict[str, Any]:
    """What is shown after a possible step is followed."""
    chromium.command("POST", "execute/async", {"script": FOLLOW, "args": [wanted]})
    found: dict[str, Any] = chromium.run(FOLLOWED)
    return found


def test_a_live_page_follows_other_steps(chromium: Browser, server: LiveServer) -> None:
    chromium.command("POST", "url", {"url": server.address})
    went = followed(chromium, "chooses 2")
    assert went == {
        "runs": 2,
        "tabs": ["Run of 1 step", "what if"],
        "rows": ["the constructors run", "walker.go() from walker"],
        "row": "v0-s1",
        "wrong": [],
        "plots": ["walker.place", "walker.tired"],
    }
    seen = followed(chromium, "watcher.seen(2)")
    assert (seen["runs"], seen["row"], len(seen["rows"])) == (2, "v0-s2", 3)
    far = followed(chromium, "by chance after step 2")
    assert far["rows"][:3] == seen["rows"]
    assert len(far["rows"]) == 13 or far["wrong"]
    chromium.press(*"kkkkkkkkkkkk")
    chromium.press("j", "j")
    # from an earlier step of what was followed
    chromium.press("k")
    fell = followed(chromium, "chooses 30")
    assert fell["rows"] == ["the constructors run", "walker.go() from walker"]
    assert fell["wrong"] == ['an assertion fails in Walker.go: "it fell"']
    chromium.press("k")
    assert (
        chromium.run("return document.querySelector('.states tr.on, .run.on tr.on').id") == "v0-s0"
    )
    turned = """
        addEventListener('hashchange', () => setTimeout(arguments[0]), {once: true});
        document.querySelector("nav [data-run='1']").click();
    """
    chromium.command("POST", "execute/async", {"script": turned, "args": []})
    assert chromium.run("return document.querySelector('.run.on').id") == "v1"


def test_where_nothing_was_found_the_start_can_be_followed(
    chromium: Browser, tmp_path: Path
) -> None:
    problem = read_problem(str(EXAMPLES / "experiment3" / "experiment3.rebeca"), None)
    found = verify(problem, Options())
    assert (found.verdict, found.violations) == ("satisfied", ())
    live = live_in(problem, "tts", lambda each: result_page(found, problem.source, None, each))
    with LiveServer(live) as server:
        thread = threading.Thread(target=server.serve_forever, args=(0.01,))
        thread.start()
        chromium.command("POST", "url", {"url": server.address})
        went = followed(chromium, "robot1")
        server.shutdown()
        thread.join()
    assert (went["tabs"], went["row"]) == (["The start", "what if"], "v0-s1")


FAILED = """
    const done = arguments[0];
    document.querySelector('.branches button').click();
    const look = () => {
        const found = document.querySelector('.failed');
        if (found) done(found.textContent);
        else setTimeout(look, 20);
    };
    look();
"""


def test_a_live_page_says_why_a_step_was_not_made(chromium: Browser, server: LiveServer) -> None:
    chromium.command("POST", "url", {"url": server.address})

    def refuse(ordinals: tuple[int, ...], by_chance: int) -> str:
        raise Refused(f"no {list(ordinals)}")

    server.live = Live(server.live.page, refuse)
    command = {"script": FAILED, "args": []}
    assert chromium.command("POST", "execute/async", command) == "no [0, 0]"
    chromium.run("document.querySelector('.failed').remove()")
    disconnect(chromium, True)
    try:
        said = chromium.command("POST", "execute/async", command)
    finally:
        disconnect(chromium, False)
    assert said == "rebsync no longer answers: start it again"


def disconnect(chromium: Browser, offline: bool) -> None:
    """Takes the browser's network away, or gives it back."""
    conditions = {
        "offline": offline,
        "latency": 0,
        "downloadThroughput": -1,
        "uploadThroughput": -1,
    }
    for name, params in (("enable", {}), ("emulateNetworkConditions", conditions)):
        emulated = {"cmd": f"Network.{name}", "params": params}
        chromium.command("POST", "goog/cdp/execute", emulated)
