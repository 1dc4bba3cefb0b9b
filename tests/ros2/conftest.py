"""What the ROS 2 tests share: real tools of ROS 2 that Debian has, and a stub of rclcpp."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.ros2.building import interfaces, make_messages, missing_rosidl

_HERE = Path(__file__).parent


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what needs the tools; skip it, loudly, where they are not, except in CI."""
    reason = missing_rosidl()
    for item in items:
        fixtures = set(getattr(item, "fixturenames", ()))
        if _HERE not in item.path.parents or "headers" not in fixtures:
            continue
        item.add_marker(pytest.mark.ros2tools)
        # The first test of a module compiles its packages, beside others that do so.
        item.add_marker(pytest.mark.timeout(900))
        if reason is not None and os.environ.get("CI") != "true":
            item.add_marker(pytest.mark.skip(reason=reason))


@pytest.fixture(scope="session")
def headers(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where message headers are; those of other packages are there already."""
    reason = missing_rosidl()
    if reason is not None:
        pytest.fail(reason)
    out = tmp_path_factory.mktemp("headers")
    make_messages(interfaces(), out)
    return out
