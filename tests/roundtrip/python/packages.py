"""Packages of examples in the dialects of Python, as tests write and edit them."""

from __future__ import annotations

from pathlib import Path

from rebsync.cli import main
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.verdict.check import check
from rebsync.roundtrip.verdict.result import CheckResult
from rebsync.source import Source
from rebsync.static import analyse

EXAMPLES = Path(__file__).parents[3] / "examples"
MODELS = {path.stem: path for path in sorted(EXAMPLES.glob("*/*.rebeca"))}
MIXED = "mixed"


def classes_without_ancestors(name: str, text: str | None = None) -> list[str]:
    """The classes of an example if none has an ancestor, so that each can have its own language.

    `text` is that of the model of another name.
    """
    given = MODELS[name].read_text(encoding="utf-8") if text is None else text
    classes = analyse(parse_model(Source(name, given)).model).classes
    return [] if any(i.ancestors for i in classes.values()) else list(classes)


def made(name: str, target: str, folder: Path, text: str | None = None) -> Path:
    """The folder of an example's package, generated beside a copy of its model.

    In a mixed one the first class is in Python, and all others are in C++.
    """
    settings = f'package = "{name}"\ntarget = "{target}"\n'
    if target == MIXED:
        first = classes_without_ancestors(name, text)[0]
        settings = f'package = "{name}"\ntarget = "ros1-cpp"\n[targets]\n{first} = "ros1-py"\n'
    (folder / "rebsync.toml").write_text(settings, encoding="utf-8")
    model = folder / f"{name}.rebeca"
    model.write_text(text or MODELS[name].read_text(encoding="utf-8"), encoding="utf-8")
    assert main(["generate", str(model), "-o", str(folder)]) == 0
    return folder / name


def checked(root: Path) -> CheckResult:
    """The verdict on a package."""
    (package,) = find([str(root)])
    return check(package)


def told(found: CheckResult) -> list[str]:
    """The messages of all that was found."""
    return [d.message for f in found.findings for d in f.diagnostics]


def python_of(root: Path) -> list[Path]:
    """The files of Python of a package, scripts without a suffix among them."""
    return [
        path
        for path in sorted(root.rglob("*"))
        if path.is_file()
        and ".rebsync" not in path.parts
        and (path.suffix == ".py" or path.parent.name == "scripts")
    ]
