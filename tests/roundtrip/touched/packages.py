"""A package of a model in a dialect, or in two languages at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rebsync.cli import main
from rebsync.diagnostics import RebsyncError
from rebsync.grammars.parser import parse_model
from rebsync.model import Interface, Model, ReactiveClass
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.verdict.check import check
from rebsync.roundtrip.verdict.drift import Verdict
from rebsync.source import Source
from rebsync.static import analyse
from rebsync.unions import assert_never

ROOT = Path(__file__).parents[3]
# In the first mixed form the classes around the first one are in Python, in the second all others.
MIXED = ("mixed", "mixed-others")
DIALECTS = ("ros1-cpp", "ros1-py", "ros2-cpp", "ros2-py")
# What sensors see is said in the language of the node.
_SEEN = {"? 1 : 2": "and 1 or 2", "? 7 : 9": "and 7 or 9", "msg.ranges.empty()": "not msg.ranges"}
_FOLDERS = (
    *("forward/cases", "checker/models", "new/cases", "properties/cases", "printing/cases"),
    *("reverse", "roundtrip", "static/cases", "grammars/cases"),
)


@dataclass(frozen=True)
class Case:
    """A model without mistakes; `settings` are those that it needs, in TOML.

    `in_python` are the classes that are in Python where it is mixed, if that was drawn.
    """

    name: str
    text: str
    model: Model
    settings: str = ""
    in_python: frozenset[str] = frozenset()

    def targets(self) -> tuple[str, ...]:
        """The dialects, and the mixed forms that its classes allow."""
        if self.in_python:
            return MIXED[:1]
        return (*DIALECTS, *(MIXED if len(families(self.model)) > 1 else ()))


def cases() -> dict[str, Case]:
    """All models of examples and tests that can be generated from."""
    paths = sorted((ROOT / "examples").glob("*/*.rebeca"))
    for folder in _FOLDERS:
        paths += sorted((ROOT / "tests" / folder).rglob("*.rebeca"))
    found = (case_of(path) for path in paths if ".rebsync" not in path.parts)
    return {case.name: case for case in found if case is not None}


def case_of(path: Path) -> Case | None:
    """The model of a file; None for one with mistakes or with what could not be read."""
    text = path.read_text(encoding="utf-8")
    try:
        model = parse_model(Source(str(path), text)).model
    except RebsyncError:
        return None
    if model.main is None or analyse(model).errors or "@Unreadable" in text:
        return None
    sensors = path.with_name("sensors.toml")
    needed = sensors.is_file() and path.stem == "sensors"
    settings = sensors.read_text(encoding="utf-8") if needed else ""
    return Case(str(path.relative_to(ROOT)), text, model, settings)


def families(model: Model) -> list[set[str]]:
    """The classes that must be in one language: those of one line of descent."""
    found: list[set[str]] = []
    for each in model.classes:
        match each:
            case ReactiveClass():
                around = {each.name, *([each.extends] if each.extends else ()), *each.implements}
            case Interface():
                around = {each.name, *each.extends}
            case _:
                assert_never(each)
        apart = [f for f in found if not f & around]
        found = [*apart, around.union(*(f for f in found if f & around))]
    return found


def of_form(model: Model, target: str) -> set[str]:
    """The classes of a model that are in Python in a mixed form."""
    first, *others = families(model)
    return first if target == MIXED[0] else {name for family in others for name in family}


def made(case: Case, target: str, folder: Path) -> Path:
    """The folder of the package, generated beside a copy of its model."""
    lines = ['package = "touched"', f'target = "{"ros1-cpp" if target in MIXED else target}"']
    if target in MIXED:
        in_python = case.in_python or of_form(case.model, target)
        lines += ["[targets]", *(f'"{name}" = "ros1-py"' for name in sorted(in_python))]
    needed = case.settings
    if target.endswith("-py"):
        for cpp, python in _SEEN.items():
            needed = needed.replace(cpp, python)
    settings = "\n".join((*lines, needed))
    (folder / "rebsync.toml").write_text(settings, encoding="utf-8")
    model = folder / "touched.rebeca"
    model.write_text(case.text, encoding="utf-8")
    assert main(["generate", str(model), "-o", str(folder)]) == 0
    return folder


def out_of_step(root: Path) -> Sequence[str]:
    """What is told of the packages in a folder that should not be; digests alone tell nothing."""
    told: list[str] = []
    for package in find([str(root)]):
        found = check(package)
        told += [d.message for f in found.findings for d in f.diagnostics]
        if found.drift is None:
            told.append("digests alone told that this is in step")
        elif found.drift.verdict is not Verdict.IN_STEP:
            told += [found.drift.verdict.value, *map(str, found.drift.differences)]
    return told
