"""No module of these rooms needs itself, not even for a type; so each stands on others only."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ROOMS = ("roundtrip", "grammars", "reverse/scaffold", "reverse/analysis", "reverse/build")


def _imports(path: Path) -> set[str]:
    """The names of all that a module imports, wherever in it."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        match node:
            case ast.ImportFrom(module=str(module), names=names):
                found |= {module, *(f"{module}.{name.name}" for name in names)}
            case ast.Import(names=names):
                found |= {name.name for name in names}
            case _:
                pass
    return found


def _graph(room: str) -> dict[str, set[str]]:
    files = {
        f"rebsync.{path.relative_to(ROOT).with_suffix('').as_posix().replace('/', '.')}": path
        for path in (ROOT / room).rglob("*.py")
    }
    return {name: _imports(path) & files.keys() for name, path in files.items()}


@pytest.mark.parametrize("room", ROOMS)
def test_no_module_needs_itself(room: str) -> None:
    left = _graph(room)
    assert left
    while free := {name for name, needed in left.items() if not needed & left.keys()}:
        left = {name: needed for name, needed in left.items() if name not in free}
    assert sorted(left) == [], "these need each other, or stand on such"
