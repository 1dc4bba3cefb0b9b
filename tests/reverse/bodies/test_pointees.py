"""Which code may change a message that a pointer leads to (`pointees.toml`)."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from rebsync.reverse.bodies.effects.cpp_pointees import is_changed
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.source import Source

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_BODIES = tomllib.loads(Path(__file__).with_name("pointees.toml").read_text(encoding="utf-8"))
_CODE = """
void raise(int& value) {{ value = 9; }}
void look(int value) {{ use(value); }}
int asked() {{ {} }}
"""


@pytest.mark.parametrize(
    ("body", "changes"),
    [(body, kind == "changed") for kind, bodies in _BODIES.items() for body in bodies],
)
def test_what_may_change_is_told_from_what_reads(body: str, changes: bool) -> None:
    code = Code.of([parse(Source("a.cpp", _CODE.format(body)))])
    functions = [f for all_of in code.definitions.values() for f in all_of]
    assert is_changed(["data", "pose.x"], functions) == changes
