"""Locals of C++ without an initial value that may be read before they are set, and others."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from rebsync.reverse.bodies.effects.cpp_form import CppForm
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import inside, parse, text_of
from rebsync.source import Source

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_CASES = tomllib.loads(Path(__file__).with_name("unset_locals.toml").read_text("utf-8"))
_AROUND = """
void ahead(int from, int& to) { if (from < 4) to = from + 1; }
void sure(int from, int& to) { if (from < 4) { to = from + 1; } else { to = 3; } }
void more(int& to) { to = to + 1; }
void on(int c) {
  BODY
}
"""


@pytest.mark.parametrize("name", _CASES)
def test_unset_locals(name: str) -> None:
    case = _CASES[name]
    cpp = parse(Source("node.cpp", _AROUND.replace("BODY", case["body"])))
    declared = [d for n in inside(cpp.root, "declaration") for d in n.named_children[1:]]
    local = next(d for d in declared if text_of(d).partition("[")[0] == "x")
    assert CppForm(Code.of([cpp])).may_be_unset(cpp, local, "x") is case["unset"]
