"""The browser that the tests of pages share."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from tests.checker.show.browser import Browser, browser, missing_browser


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what needs the browser; skip it, loudly, where there is none, except in CI."""
    reason = missing_browser()
    for item in items:
        if "chromium" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.browser)
            if reason is not None and os.environ.get("CI") != "true":
                item.add_marker(pytest.mark.skip(reason=reason))


@pytest.fixture(scope="module")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """A running Chromium."""
    reason = missing_browser()
    if reason is not None:
        pytest.fail(reason)
    with browser(tmp_path_factory.mktemp("profile"), "--window-size=1700,1000") as started:
        yield started
