"""The bench of what generated nodes cost, with few round trips: both kinds of nodes play."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

_BENCH = Path(__file__).parents[2] / "bench" / "overhead.py"
_LINE = r"^ros1-py +\d+ \(\d+-\d+\) +\d+ \(\d+-\d+\) +\d+\.\d\d \(\d+\.\d\d-\d+\.\d\d\)"


@pytest.mark.timeout(1800)  # it builds a package
def test_it_prints_a_ratio() -> None:
    command = [sys.executable, str(_BENCH), "ros1-py", "--pairs", "1", "--seconds", "1"]
    printed = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    assert re.search(_LINE, printed, re.MULTILINE), printed
