"""The page of a graph in a real browser: search, groups, code lines, zoom."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.checker.show.browser import Browser
from tests.cli.run import rebsync

HERE = Path(__file__).parent
BOXES = "return [...document.querySelectorAll('#canvas .near[data-box]')].map((b) => "
NAMES = BOXES + "b.querySelector('text').textContent)"
LIST = "return [...document.querySelectorAll('#list details')].map((d) => d.dataset.group)"
SELECTED = "return document.getElementById('selected').innerText"
VIEW = "return document.getElementById('canvas').getAttribute('viewBox')"


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("page") / "graph.html"
    launch = str(HERE / "robot/robot/launch/robot.launch.py")
    arguments = ("--launch", launch, "--format", "html", "-o", str(target))
    assert rebsync("graph", "robot", *arguments, cwd=HERE).status == 1
    return target


def test_a_click_shows_the_lines_of_code(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    number = chromium.run(
        "return [...document.querySelectorAll('#canvas [data-box]')]"
        ".find((b) => b.querySelector('text').textContent === '/base/driver').dataset.box"
    )
    chromium.click(f"#canvas [data-box='{number}'] rect")
    shown = chromium.run(SELECTED)
    assert "driver.cpp:9" in shown
    assert 'speed_ = create_subscription<geometry_msgs::msg::Twist>("cmd_vel", 1' in shown
    assert set(chromium.run(NAMES)) == {
        "/base/driver",
        "/laser",
        "/cmd_vel",
        "/base/driver/stop",
        "?",
    }
    chromium.click("#findings button")
    assert "RS991" in chromium.run(SELECTED)


def test_search_groups_and_zoom(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    assert chromium.run(LIST) == ["names", "robot", "rviz2", "tools"]
    before = chromium.run(VIEW)
    chromium.press("/", *"laserscan")
    assert chromium.run(NAMES) == ["/laser"]
    chromium.run(
        "const s = document.getElementById('grouping'); s.value = 'namespace';"
        "s.dispatchEvent(new Event('change'))"
    )
    assert "/base" in chromium.run(LIST)
    chromium.run(
        "document.getElementById('canvas').dispatchEvent(new WheelEvent('wheel', "
        "{deltaY: -200, clientX: 900, clientY: 500, cancelable: true}))"
    )
    assert chromium.run(VIEW) != before
    assert chromium.run("return performance.getEntriesByType('resource').length") == 0


def test_what_is_too_small_to_read_begins_at_its_left(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    chromium.resize(500, 500)
    chromium.open(page)
    try:
        x, _, width, _ = map(float, chromium.run(VIEW).split())
        pixels = chromium.run("return document.getElementById('canvas').clientWidth")
        assert (x, round(width / pixels, 3)) == (0, 1.4)
        chromium.press("0")
        assert float(chromium.run(VIEW).split()[2]) > width
    finally:
        chromium.resize(1700, 1000)
