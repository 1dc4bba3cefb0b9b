"""Hard cases of the language as nodes of a real ROS 2."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.forward.compiling import CASES, case_config, case_files, written
from tests.ros1.recording import Recording
from tests.ros1.run import Clock
from tests.ros1.test_hard_cases import (
    PlayCase,
    test_inheritance,
    test_interfaces,
    test_overloads,
    test_rebecs_as_values,
)
from tests.ros2real.conftest import DIALECTS, Play

__all__ = ["test_inheritance", "test_interfaces", "test_overloads", "test_rebecs_as_values"]


@pytest.fixture(params=DIALECTS)
def play_case(request: pytest.FixtureRequest, play_real: Play, tmp_path: Path) -> PlayCase:
    """Runs a case by its name."""
    dialect = str(request.param)

    def played(name: str) -> Recording:
        case = CASES / f"{name}.rebeca"
        folder = written(case_files(case, dialect), tmp_path, name, case_config(case))
        return play_real(folder, dialect, Clock(until=12, quiet=5))

    return played
