"""The page of a recorded run in a real browser: robots move by steps, and as time passes."""

from __future__ import annotations

import time
from pathlib import Path

from tests.checker.show.browser import Browser
from tests.cli.run import rebsync
from tests.conform.bagging import write_bag
from tests.conform.faults import wrong_state
from tests.conform.test_recordings import HERE, of_bag, steps
from tests.consoles import ROOT

BAG = HERE / "recordings" / "experiment2_unsafe-cpp.bag"
EXAMPLE = ROOT / "examples" / "experiment2_unsafe"
PLACES = """
    const robots = [...document.querySelectorAll('.movement .robot')];
    return robots.map((robot) => robot.getAttribute('transform'));
"""


def test_robots_move_up_to_the_step_that_deviates(chromium: Browser, tmp_path: Path) -> None:
    run = steps(BAG)
    at = next(n for n, s in enumerate(run) if s.server == "MoveInX" and n > 2 * len(run) // 3)
    bag = write_bag(tmp_path / "run.bag", of_bag(BAG).observable, wrong_state(run, at, 2), "ros1")
    page = tmp_path / "page.html"
    done = rebsync("conform", str(EXAMPLE), str(bag), "--page", str(page), cwd=tmp_path)
    assert done.status == 3, done.out  # robots had met before
    chromium.open(page)
    told = chromium.run("return document.querySelector('#deviation').innerText")
    assert f"pos[0] = {run[at].cells[2] + 1}, not {run[at].cells[2]}" in told
    assert chromium.run("return document.querySelector('.plot').getBoundingClientRect().height") > 0
    start = chromium.run(PLACES)
    for _ in range(14):
        chromium.click(".movement [data-act=forward]")
    stepped = chromium.run(PLACES)
    assert stepped != start
    chromium.run("document.querySelector('.movement .speed').value = '10'")
    chromium.click(".movement [data-act=play]")
    end = time.monotonic() + 20
    while chromium.run(PLACES) == stepped and time.monotonic() < end:
        time.sleep(0.05)
    assert chromium.run(PLACES) != stepped
