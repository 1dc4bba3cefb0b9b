"""`rebsync check` tells of code that does not parse the mistake, and no nonsense beside it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.test_check import SOURCE, Check, check, made, package, replace

__all__ = ["check", "made", "package"]  # fixtures

DELAY = "  mailbox_.delay(1);"
ADVERTISE = 'advertise<RobotGo>("other/go")'


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        (DELAY, "  mailbox_.delay(1)", 43),
        ("  x_ = x0;", "  x_ = x0", 29),
        ("sendSelfLook(after(e_));", "sendSelfLook(after(e_))", 36),
        (DELAY, f"  if (n > 1) {{\n{DELAY}", 79),
    ],
)
def test_only_the_mistake_is_told(check: Check, old: str, new: str, line: int) -> None:
    replace(SOURCE, old, new)
    status, shown = check()
    assert status == 4
    first, *others = shown.splitlines()
    assert first == "patrol: undetermined: not all of the code can be told in a model"
    assert any(each.startswith(f"{SOURCE}:{line}:") and "RS941" in each for each in others)
    told = [each for each in others if each.endswith("[code]") or "RS956" in each]
    assert told == []


def test_a_mistake_where_a_publisher_is_made_is_told(check: Check) -> None:
    """What it leads to may be told beside it: that nobody publishes there."""
    replace(SOURCE, f"{ADVERTISE};", ADVERTISE)
    status, shown = check()
    assert status == 4
    assert f"{SOURCE}:17:" in shown
    assert "[code]" not in shown


def test_what_differs_elsewhere_is_told(check: Check) -> None:
    replace(SOURCE, DELAY, "  mailbox_.delay(1)")
    replace(SOURCE, "% 4", "% 5")
    model = Path("patrol.rebeca")
    model.write_text(model.read_text().replace("delay(1);", "delay(3);"))
    status, shown = check()
    assert status == 4
    told = [each for each in shown.splitlines() if each.endswith(("[code]", "[model]"))]
    assert [("Robot.look" in each, each.endswith("[code]")) for each in told] == [
        (True, True),
        (False, False),
    ]


def test_what_parses_is_told_in_full(check: Check) -> None:
    replace("patrol/include/patrol/robot.h", "int32_t x_", "uint64_t x_")
    status, shown = check()
    assert status == 4
    assert "statevar Robot.x: removed  [code]" in shown
