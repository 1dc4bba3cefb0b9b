"""No module of the package needs itself, not even for a type; so each stands on others only."""

from __future__ import annotations

import ast
from pathlib import Path

ROOT = Path(__file__).parents[1]
TOPS = {"rebsync": "", "forward": "rebsync.", "grammars": "rebsync.", "reverse": "rebsync."}
TOPS |= {"roundtrip": "rebsync."}


def _files() -> dict[str, Path]:
    """All modules by their names as they are imported; links to the other folders do not count."""
    found: dict[str, Path] = {}
    for top, parent in TOPS.items():
        for path in (ROOT / top).rglob("*.py"):
            relative = path.relative_to(ROOT)
            if top == "rebsync" and relative.parts[1] in TOPS:
                continue
            name = relative.with_suffix("").as_posix().replace("/", ".").removesuffix(".__init__")
            found[f"{parent}{name}"] = path
    return found


def _imports(path: Path, modules: dict[str, Path]) -> set[str]:
    """The modules that one imports, wherever in it."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        match node:
            case ast.ImportFrom(module=str(module), names=names):
                inner = {f"{module}.{name.name}" for name in names}
                found |= {name if name in modules else module for name in inner}
            case ast.Import(names=names):
                found |= {name.name for name in names}
            case _:
                pass
    return found & modules.keys()


def test_no_module_needs_itself() -> None:
    modules = _files()
    assert len(modules) > 600
    left = {name: _imports(path, modules) for name, path in modules.items()}
    while free := {name for name, needed in left.items() if not needed & left.keys()}:
        left = {name: needed for name, needed in left.items() if name not in free}
    assert sorted(left) == [], "these need each other, or stand on such"
