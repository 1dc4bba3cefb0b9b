"""The cases: packages that people could have written, with questions and what is answered.

The verdicts in `questions.toml` were written before the first answer, by reading the code.
"""

from __future__ import annotations

import sys
from pathlib import Path

from rebsync.printing import print_model
from rebsync.properties import Properties
from rebsync.reverse.environment.package import closed_package, in_fitting_unit
from rebsync.reverse.files.reading import chosen

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

CASES = sorted(p for p in Path(__file__).parent.iterdir() if (p / "package").is_dir())


def closed_model(case: Path) -> tuple[str, str]:
    """The closed model of a case as text, and what is assumed, a line each."""
    read = in_fitting_unit(chosen(str(case / "package")).files)
    closed = closed_package(read, Properties(), "free")
    told = [f"assumed: {each}" for each in closed.assumptions]
    told += [f"gap: {each}" for each in closed.gaps]
    root = f"{case / 'package'}/"
    return print_model(closed.model), "".join(f"{each}\n".replace(root, "") for each in told)


def questions() -> list[tuple[str, str, str]]:
    """All questions: the name of the case, the question, the verdict."""
    found = []
    for case in CASES:
        table = tomllib.loads((case / "questions.toml").read_text(encoding="utf-8"))
        found += [(case.name, q["ask"], q["verdict"]) for q in table["question"]]
    return found
