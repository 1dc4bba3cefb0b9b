"""What all tests share."""

from __future__ import annotations

import gc
import os
import signal
from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings

# Drawing a model takes longer than hypothesis expects of one example.
_SLOW = (HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example)
settings.register_profile("quick", max_examples=30, deadline=None, suppress_health_check=_SLOW)
settings.register_profile(
    "few", max_examples=4, deadline=None, derandomize=True, suppress_health_check=_SLOW
)
settings.register_profile("fewer", max_examples=18, deadline=None, suppress_health_check=_SLOW)
settings.register_profile("long", max_examples=1000, deadline=None, suppress_health_check=_SLOW)
settings.load_profile(os.environ.get("REBSYNC_HYPOTHESIS", "quick"))

# What runs real systems or compilers is begun first, or else it is waited for at the end; so are
# files that alone take minutes.
_LONG = (
    *("ros1/", "ros2/", "ros2py/", "forward/test_compiles", "hooks/"),
    *("reverse/native/", "roundtrip/edits/", "roundtrip/faults/", "roundtrip/test_mutations"),
    *("roundtrip/test_sync", "test_readme"),
)


def pytest_configure() -> None:
    """A shell's `&` starts tests that ignore some signals."""
    heed_signals()


def heed_signals() -> None:
    """Has signals end what they end at a terminal; a process ignores what the one above it does."""
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        if signal.getsignal(number) == signal.SIG_IGN:
            signal.signal(number, signal.SIG_DFL)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Puts the files that take long before all others."""
    items.sort(key=lambda item: not item.nodeid.removeprefix("tests/").startswith(_LONG))


def pytest_collection_finish() -> None:
    """Has garbage collections pass over the tests themselves, which take a quarter of the time."""
    gc.collect()
    gc.freeze()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Tells how true recorded runs of real nodes are to their models."""
    reports = (r for found in terminalreporter.stats.values() for r in found)
    properties = (p for r in reports for p in getattr(r, "user_properties", ()))
    runs = {tuple(value) for name, value in properties if name == "fidelity"}
    if runs:
        from tests.ros1.fidelity import summary_lines

        terminalreporter.section("fidelity of recorded runs")
        for line in summary_lines(list(runs)):
            terminalreporter.write_line(line)


@pytest.fixture(autouse=True)
def signals_heeded() -> Iterator[None]:
    """A node that was played here ignores signals at its end; what comes next heeds them again."""
    heed_signals()
    yield
    heed_signals()


@pytest.fixture(autouse=True)
def nothing_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """What one test has been refused as a cache is not told in the next."""
    monkeypatch.setattr("rebsync.cache._refused", {})
