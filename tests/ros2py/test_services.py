"""Services and actions of nodes of rclpy in one process, with a life cycle and without."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.recording import Recording
from tests.ros2.asking import Answer, Ask
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
from tests.ros2py.playing import play_asked

__all__ = [
    "test_goals_are_messages",
    "test_replies_are_responses",
    "test_what_is_asked_of_an_inactive_rebec_waits",
    "test_what_is_open_at_cleanup_is_answered",
    "test_what_is_open_when_a_node_ends_is_answered",
    "test_who_finds_no_room_is_told_at_once",
]


@pytest.fixture
def serve(tmp_path: Path) -> Serve:
    def run(
        asks: Sequence[Ask],
        until: float,
        changes: Mapping[str, Sequence[tuple[float, str]]] | None = None,
        ends: Mapping[str, float] | None = None,
    ) -> tuple[Recording, tuple[Answer, ...]]:
        config = Config(target="ros2-py", lifecycle=changes is not None)
        files = generated(MODEL.read_text("utf-8"), "services", config)
        package = written(files, tmp_path, "services", config)
        return play_asked(package, until, asks, changes, ends)

    return run
