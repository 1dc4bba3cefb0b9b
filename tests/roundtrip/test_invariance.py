"""The same edits are the same differences, and the same model after a sync, in each dialect.

The edits are in `invariance.toml`; here all those of an example are made at once.
`python -m tests.roundtrip.test_invariance` makes each alone.
"""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from rebsync.cli import main
from rebsync.roundtrip.diff.difference import explain
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.verdict.check import check
from tests.roundtrip.mutations.harness import written
from tests.roundtrip.mutations.package import DIALECTS, Package

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

HERE = Path(__file__).parent
EDITS: dict[str, Any] = tomllib.loads((HERE / "invariance.toml").read_text(encoding="utf-8"))
EXAMPLES = sorted({edit["example"] for edit in EDITS.values()})


@pytest.mark.parametrize("example", EXAMPLES)
def test_edits_are_the_same_in_each_dialect(example: str, tmp_path: Path) -> None:
    names = [name for name, edit in EDITS.items() if edit["example"] == example]
    assert_the_same(names, tmp_path)


def assert_the_same(names: list[str], folder: Path) -> None:
    """Makes edits of one example in all dialects."""
    models = set()
    for dialect in DIALECTS:
        root = folder / dialect / EDITS[names[0]]["example"]
        made(names, dialect, root)
        wanted = sorted(line for name in names for line in EDITS[name]["told"])
        assert sorted(told(root)) == wanted, dialect
        assert main(["sync", str(root)]) == 0
        assert main(["check", str(root)]) == 0
        models.add((root / f"{root.name}.rebeca").read_text(encoding="utf-8"))
    assert len(models) == 1


def made(names: list[str], dialect: str, root: Path) -> None:
    """The package of an example in a dialect with edits, and its model."""
    package = Package(root.name, dialect)
    written(package, root)
    generation, language = dialect.split("-")
    for edit in map(EDITS.__getitem__, names):
        for key in (generation, language, dialect):
            for end, old, new in edit.get(key, ()):
                (path,) = [p for p in package.files if p.endswith(end)]
                file = root / package.name / path
                text = file.read_text(encoding="utf-8")
                assert old in text, (path, old)
                file.write_text(text.replace(old, new), encoding="utf-8")


def told(root: Path) -> list[str]:
    """The differences that `rebsync check` tells; nothing else is told."""
    (package,) = find([str(root)])
    found = check(package)
    assert [d.message for f in found.findings for d in f.diagnostics] == []
    assert found.drift is not None
    return [f"{d.element}: {explain(d)}" for d, _ in found.drift.differences]


if __name__ == "__main__":
    for each in EDITS:
        with TemporaryDirectory() as directory:
            assert_the_same([each], Path(directory))
