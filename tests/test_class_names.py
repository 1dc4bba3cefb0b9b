"""A name of a class means one thing: in reverse and roundtrip few stand in two modules."""

from __future__ import annotations

import ast
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[1]
MOST = 19  # fewer are welcome
# The intermediate form stands beside the readers that it is to replace, with the textbook's names.
ROOMS = ("reverse", "roundtrip", "rebsync/conform", "rebsync/calibration")
FORM = ROOT / "reverse/ir"


def _classes(path: Path) -> set[str]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return {node.name for node in ast.walk(tree) if isinstance(node, ast.ClassDef)}


def test_few_class_names_stand_in_two_modules() -> None:
    paths = [path for room in ROOMS for path in (ROOT / room).rglob("*.py")]
    others = (path for path in paths if FORM not in path.parents)
    count = Counter(name for path in others for name in _classes(path))
    shared = sorted(name for name, modules in count.items() if modules > 1)
    assert len(shared) <= MOST, shared
