"""Services and actions of nodes on the stub of rclcpp, with a life cycle and without."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.recording import Recording
from tests.ros2.asking import Answer, Ask
from tests.ros2.building import build_driver, make_messages
from tests.ros2.running import run_asked
from tests.ros2.serving import (
    MODEL,
    Serve,
    test_goals_are_messages,
    test_replies_are_responses,
    test_what_is_asked_of_an_inactive_rebec_waits,
    test_what_is_open_at_cleanup_is_answered,
    test_what_is_open_when_a_node_ends_is_answered,
    test_who_finds_no_room_is_told_at_once,
)

__all__ = [
    "test_goals_are_messages",
    "test_replies_are_responses",
    "test_what_is_asked_of_an_inactive_rebec_waits",
    "test_what_is_open_at_cleanup_is_answered",
    "test_what_is_open_when_a_node_ends_is_answered",
    "test_who_finds_no_room_is_told_at_once",
]


@pytest.fixture(scope="module")
def built(
    headers: Path, tmp_path_factory: pytest.TempPathFactory
) -> Callable[[bool], tuple[Path, Path]]:
    """The package, with a life cycle or without, and its driver."""

    @cache
    def build(lifecycle: bool) -> tuple[Path, Path]:
        directory = tmp_path_factory.mktemp("services")
        config = Config(target="ros2-cpp", lifecycle=lifecycle)
        files = generated(MODEL.read_text("utf-8"), "services", config)
        package = written(files, directory, "services", config)
        make_messages([package], headers)
        return package, build_driver(package, headers, directory / "build")

    return build


@pytest.fixture
def serve(built: Callable[[bool], tuple[Path, Path]], tmp_path: Path) -> Serve:
    def run(
        asks: Sequence[Ask],
        until: float,
        changes: Mapping[str, Sequence[tuple[float, str]]] | None = None,
        ends: Mapping[str, float] | None = None,
    ) -> tuple[Recording, tuple[Answer, ...]]:
        package, driver = built(changes is not None)
        end = min([until, *(ends or {}).values()])  # all nodes are one program
        return run_asked(package, driver, tmp_path, end, asks, changes=changes)

    return run
