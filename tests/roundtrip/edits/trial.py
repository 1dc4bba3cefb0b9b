"""An edit of generated code by hand on its way: extract, check, sync, and a change of the model."""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rebsync.cli import main
from rebsync.diagnostics import Diagnostic
from rebsync.roundtrip.diff.difference import explain
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.verdict.check import check
from rebsync.source import Source
from tests.reverse.test_edits import EDITS, LISTED
from tests.roundtrip.mutations.harness import written
from tests.roundtrip.mutations.package import Package
from tests.roundtrip.python import packages

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

HERE = Path(__file__).parent
FILES = (
    *("python.toml", "rclcpp.toml", "cpp.toml", "mixed.toml"),
    *("harmless.toml", "library.toml", "forms.toml", "posts.toml", "shown.toml"),
    *("messages.toml", "natural.toml", "natural_python.toml"),
    *("natural_rclpy.toml", "natural_sensors.toml", "joined.toml", "months.toml"),
    *("early.toml", "compiled_python.toml", "compiled_cpp.toml", "sensors.toml"),
    *("helpers_python.toml", "helpers_cpp.toml", "builds.toml", "spelt_python.toml"),
    *("gate_cpp.toml", "gate_python.toml", "gate2_cpp.toml", "gate2_python.toml"),
    *("gate3_cpp.toml", "gate3_python.toml", "reviewed.toml"),
    *("gate4_cpp.toml", "gate4_python.toml", "gate5_cpp.toml", "gate5_python.toml"),
    *("gate6_python.toml", "gate6_cpp.toml", "gate7_cpp.toml", "gate7_python.toml"),
    *("gate8_cpp.toml", "gate8_python.toml", "gate9_cpp.toml", "gate9_python.toml"),
    *("gate10_cpp.toml", "gate10_python.toml", "gate11_cpp.toml", "gate11_python.toml"),
    *("gate12_cpp.toml", "gate12_python.toml", "gate13_cpp.toml", "gate13_python.toml"),
    *("looked_up.toml", "told_python.toml", "imports.toml", "captures.toml"),
    *("results.toml", "surroundings.toml", "undefined.toml", "needless_python.toml"),
    *("gate15b_python.toml", "gate15_cpp.toml", "gate15_python.toml"),
    *("gate16_cpp.toml", "gate16_python.toml"),
    *("gate17_cpp.toml", "gate17_python.toml", "hidden_cpp.toml"),
)
MIXED = Path(__file__).parents[2] / "reverse" / "mixed_cases"

# A later change of the model of each example, in code that few of the edits touch.
LATER = {
    "hello": ("delay(2)", "delay(3)"),
    "experiment1": ("delay(e12)", "delay(e12 + 1)"),
    "experiment1_unsafe": ("delay(e12)", "delay(e12 + 1)"),
    "experiment3": ("after(2)", "after(3)"),
    "experiment3_unsafe": ("after(2)", "after(3)"),
    "running_example": ("delay(e11)", "delay(e11 + 1)"),
    "experiment2": (
        "stopped = true;\n    pos[0] = init_x;",
        "stopped = false;\n    pos[0] = init_x;",
    ),
    "experiment2_unsafe": (
        "stopped = true;\n    pos[0] = init_x;",
        "stopped = false;\n    pos[0] = init_x;",
    ),
    "warehouse": ("loaded = !loaded;", "loaded = !loaded;\n    bay = bay + 4;"),
    "numbers": ("half = d / 2;", "half = d / 3;"),
    "overloads": ("asked = n;", "asked = n + 1;"),
}


@dataclass(frozen=True)
class Case:
    """An edit in a dialect: what of the code is put in place of what, and what is to be said."""

    name: str
    dialect: str
    data: dict[str, Any] = field(hash=False)

    def __str__(self) -> str:
        return f"{self.name}-{self.dialect}"

    @property
    def example(self) -> str:
        """The example whose package is edited."""
        return str(self.data["example"])

    @property
    def listed(self) -> list[str]:
        """Texts that the findings begin with, if no model can show the edit."""
        return [str(text) for text in self._of("listed")]

    @property
    def elsewhere(self) -> list[str]:
        """Texts that the findings begin with, if messages get elsewhere than in any model."""
        return [str(text) for text in self._of("elsewhere")]

    def edits(self) -> list[list[str]]:
        """End of the path, text, text in its place."""
        return self._of("code")

    def added(self) -> list[list[str]]:
        """Files that are new: path, text."""
        return self._of("added")

    def _of(self, key: str) -> list[Any]:
        generation, language = self.dialect.split("-")
        keys = [key, f"{key}-{generation}", f"{key}-{language}", f"{key}-{self.dialect}"]
        return [each for k in keys for each in self.data.get(k, ())]


def cases(path: Path) -> list[Case]:
    """The cases of a file, each in all dialects that it is for."""
    table: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))
    dialects, words = table.pop("dialects"), table.pop("words", [])
    for name in table.pop("shared", ()):
        table[name] = _of_roscpp(name, words)
    return [
        Case(name, dialect, data)
        for name, data in table.items()
        for dialect in data.get("dialects", dialects)
    ]


def _of_roscpp(name: str, words: list[list[str]]) -> dict[str, Any]:
    """A case for roscpp in the words of another dialect of C++."""
    edit = EDITS[name] if name in EDITS else LISTED[name]
    code = []
    for path, old, new in edit["code"]:
        for one, other in words:
            old, new = old.replace(one, other), new.replace(one, other)
        code.append([re.sub(r"\.h$", ".hpp", path), old, new])
    listed = {"listed": ["unreadable"]} if name in LISTED else {}
    return {**edit, "code": code, **listed}


@dataclass(frozen=True)
class Trial:
    """A folder with the model of an example and its package, edited."""

    case: Case
    root: Path

    @property
    def package(self) -> Path:
        return self.root / self.case.example

    @property
    def model(self) -> Path:
        return self.root / f"{self.case.example}.rebeca"

    def edit(self) -> None:
        """Makes the edit in the files."""
        for end, old, new in self.case.edits():
            if not old:
                (self.package / end).write_text(new, encoding="utf-8")
                continue
            found = [p for p in self._files() if p.as_posix().endswith(self.ending(end))]
            assert len(found) == 1, (end, found)
            text = found[0].read_bytes().decode()  # as it is, with all its line ends
            assert old in text, (end, old)
            found[0].write_bytes(text.replace(old, new).encode())
        for path, text in self.case.added():
            (self.package / path).parent.mkdir(parents=True, exist_ok=True)
            (self.package / path).write_text(text, encoding="utf-8")

    def ending(self, end: str) -> str:
        """The end of a path, of a header as the dialect has it."""
        is_header = end.endswith(".h") and self.case.dialect == "ros2-cpp"
        return f"{end}pp" if is_header else end

    def _files(self) -> list[Path]:
        return [p for p in self.package.rglob("*") if p.is_file() and ".rebsync" not in p.parts]

    def code(self) -> dict[str, bytes]:
        """All files of the package but rebsync's own, and the page that follows the model."""
        files = (p for p in self._files() if p.name != "README.md")
        return {p.relative_to(self.package).as_posix(): p.read_bytes() for p in files}

    def wanted(self) -> str:
        """The text of the model that the edit is."""
        text = self.model.read_text(encoding="utf-8")
        for old, new, *within in self.case.data.get("model", ()):
            text = _replaced(text, old, new, *within)
        return text

    def check(self) -> tuple[str, list[str], list[str]]:
        """The verdict, the differences, and the findings."""
        (package,) = find([str(self.root)])
        found = check(package)
        texts = [f"{_line(f.source, d)} {d.message}" for f in found.findings for d in f.diagnostics]
        if found.drift is None:
            return "in step", [], texts
        told = [f"{d.element}: {explain(d)}" for d, _ in found.drift.differences]
        return found.drift.verdict.value, told, texts

    def status(self, command: str) -> int:
        """The exit status of a command on the folder."""
        return main([command, str(self.root)])


def _line(source: Source, found: Diagnostic) -> str:
    """The line of code that something is said of."""
    return source.line(source.position(found.span.start).line).strip() if source.text else ""


def made(case: Case, root: Path) -> Trial:
    """A fresh copy of a case's example with the edit; a mixed one has a model of its own."""
    if case.dialect == "ros1-mixed":
        root.mkdir()
        text = (MIXED / f"{case.example}.rebeca").read_text(encoding="utf-8")
        packages.made(case.example, packages.MIXED, root, text)
    else:
        written(Package(case.example, case.dialect), root)
    trial = Trial(case, root)
    trial.edit()
    return trial


def _replaced(text: str, old: str, new: str, within: str = "") -> str:
    if not within:
        assert old in text, old
        return text.replace(old, new)
    before, head, rest = text.partition(f"reactiveclass {within}(")
    own, end, after = rest.partition("\n}\n")
    return before + head + _replaced(own, old, new) + end + after
