"""Workspaces of several packages: what a package takes of the others."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from rebsync.printing import print_model
from rebsync.reverse.build.workspace import in_workspace
from rebsync.reverse.files.packages import listings
from rebsync.reverse.files.reading import read
from rebsync.reverse.recovery import extract

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

HERE = Path(__file__).parent
CASES = sorted(path for path in (HERE / "cases").iterdir() if path.is_dir())


def model_of(workspace: Path) -> str:
    """The models of all packages of a workspace, each below its name."""
    texts = []
    for listing in in_workspace(listings(str(workspace))):
        found = extract(read(listing).files).model
        if found.classes:
            texts.append(f"// {Path(listing.root).name}\n{print_model(found)}")
    return "\n".join(texts)


def questions() -> Iterator[tuple[str, str, str, str]]:
    """Workspace, package, question and verdict."""
    for case in CASES:
        asked = tomllib.loads((case / "questions.toml").read_text(encoding="utf-8"))
        for question, verdict in asked["questions"].items():
            yield case.name, asked["package"], question, verdict
