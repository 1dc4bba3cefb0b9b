"""`rebsync extract` tells of sums in edited Python that do not wrap; of fresh code it does not."""

from __future__ import annotations

import pytest

from rebsync.reverse.findings import Grade
from rebsync.roundtrip.ranges_told import unwrapped
from rebsync.source import Source
from tests.forward.compiling import CASES, case_files

FLOW = "src/control/flow.py"


def _sources(name: str, target: str) -> dict[str, Source]:
    files = case_files(CASES / f"{name}.rebeca", target)
    return {path: Source(path, text) for path, text in files.items()}


@pytest.mark.parametrize("name", ["control", "moves", "arrays", "order", "inheritance"])
@pytest.mark.parametrize("target", ["ros1-py", "ros2-py"])
def test_fresh_code_wraps(name: str, target: str) -> None:
    assert unwrapped(_sources(name, target)) == ()


def test_a_sum_that_does_not_wrap_is_told() -> None:
    files = _sources("control", "ros1-py")
    old = "self._n = int32(n__2 + self._m)"
    text = files[FLOW].text
    assert old in text
    files[FLOW] = Source(FLOW, text.replace(old, "self._n = n__2 + self._m"))
    (told,) = unwrapped(files)
    assert told.text == "n__2 + self._m"
    assert told.grade is Grade.UNREADABLE
    assert told.hint == "write int32(n__2 + self._m)"
    assert told.within.startswith("Flow.")


def test_code_of_people_is_left_alone() -> None:
    text = "class Counter:\n    def step(self):\n        self._mailbox = self.count + 1\n"
    assert unwrapped({"counter.py": Source("counter.py", text)}) == ()
