"""Whether time passes in a model: where none does, nobody is told to be late."""

from __future__ import annotations

import re

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated

_MODEL = """
reactiveclass Counter(2) {{
  statevars {{ int n; }}
  Counter() {{ self.count(); }}
  msgsrv count() {{ n = n + 1; {body} }}
}}
main {{ Counter c():(); }}
"""
_SAID = re.compile(r"\b(?:kTimed|_TIMED) = (\w+)")


@pytest.mark.parametrize("target", ["ros1-cpp", "ros1-py", "ros2-cpp", "ros2-py"])
@pytest.mark.parametrize(
    ("body", "timed"),
    [
        ("self.count();", False),
        ("self.count() after(1);", True),
        ("self.count() deadline(1);", True),
        ("delay(1);", True),
    ],
)
def test_a_mailbox_knows_whether_time_passes(target: str, body: str, timed: bool) -> None:
    files = generated(_MODEL.format(body=body), "counting", Config(target=target))
    said = {found for text in files.values() for found in _SAID.findall(text)}
    assert {word.lower() for word in said} == {str(timed).lower()}
