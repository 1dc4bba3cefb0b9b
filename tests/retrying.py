"""A test of a recording that is tried again judges another one.

Recordings are kept for a module, as they take long: without this, what failed once would be asked
of the same recording again. Conftests of such tests import the hook.
"""

from __future__ import annotations

import pytest


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Have all that is kept for a module made anew for a test that is tried again."""
    if getattr(item, "execution_count", 1) == 1 or not isinstance(item, pytest.Function):
        return
    for fixtures in item._fixtureinfo.name2fixturedefs.values():
        for fixture in fixtures:
            if fixture.scope == "module":
                fixture.finish(item._request)  # type: ignore[arg-type]
