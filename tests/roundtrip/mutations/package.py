"""A generated package as texts, with the parts of it that mutations are made in."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from pathlib import Path
from typing import TypeAlias

from rebsync.cli.generate import package_files
from rebsync.config import parse_config
from rebsync.files import read_source
from tests.reverse.test_laws import EXAMPLES, package_of
from tests.roundtrip.mutations.parts import (
    BODIES,
    Member,
    Part,
    class_in,
    members_in,
    parts_in,
    sends_in,
)

__all__ = [
    "BODIES",
    "BY_NAME",
    "DIALECTS",
    "Edit",
    "Kind",
    "Made",
    "Maker",
    "Member",
    "Mutant",
    "Package",
    "Part",
    "Texts",
    "anywhere",
    "at_end",
    "at_start",
    "generated",
    "in_files",
    "kinds_in",
    "within",
]

DIALECTS = ("ros1-cpp", "ros2-cpp", "ros1-py", "ros2-py")
BY_NAME = {example.name: example for example in EXAMPLES}

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|<!--.*?-->", re.DOTALL)
_PY_COMMENT = re.compile(r'#[^\n]*|""".*?"""', re.DOTALL)
_STRING = re.compile(r'"[^"\n]*"')


@cache
def generated(example: str, dialect: str) -> Mapping[str, str]:
    """All files of the package of an example in a dialect, what is in `.rebsync` included."""
    folder = BY_NAME[example]
    config = replace(parse_config(read_source(str(folder / "rebsync.toml"))), target=dialect)
    source = read_source(str(folder / f"{example}.rebeca"))
    return package_files(source, config, str(folder))[1]


@dataclass(frozen=True)
class Edit:
    """A text put in place of a stretch of a file; `element` is what changes by it, if known."""

    path: str
    start: int
    end: int
    text: str
    element: str = ""


@dataclass(frozen=True)
class Mutant:
    """The changed files (None: there no longer), the place, and elements that may be reported."""

    files: Mapping[str, str | None]
    place: str
    elements: tuple[str, ...] = ()


Made: TypeAlias = "Edit | Mutant | Sequence[Edit]"
Maker: TypeAlias = "Callable[[Package], Iterator[Made]]"


@dataclass(frozen=True)
class Kind:
    """A kind of change and how it is made, wherever it can be."""

    name: str
    make: Maker

    def mutants(self, package: Package) -> Iterator[Mutant]:
        """A mutant for each place, but for those that change nothing."""
        for made in self.make(package):
            mutant = made if isinstance(made, Mutant) else package.mutant(made)
            if any(package.files.get(path) != text for path, text in mutant.files.items()):
                yield mutant


@dataclass
class Package:
    """The package of an example in a dialect."""

    name: str
    dialect: str = "ros1-cpp"
    files: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.dialect == "ros1-cpp":
            self.files = package_of(BY_NAME[self.name])
        else:
            files = generated(self.name, self.dialect)
            self.files = {p: t for p, t in files.items() if not p.startswith(".rebsync/")}

    @property
    def example(self) -> Path:
        """The folder of the model."""
        return BY_NAME[self.name]

    @property
    def is_python(self) -> bool:
        """Whether the nodes are in Python."""
        return self.dialect.endswith("py")

    def suffix(self, of_ros1: str) -> str:
        """How names of files end here that end so in C++ for ROS 1."""
        return f"{of_ros1}pp" if of_ros1.endswith(".h") and self.dialect == "ros2-cpp" else of_ros1

    def paths(self, suffix: str) -> list[str]:
        """The files with an end of their names, as in C++ for ROS 1."""
        return sorted(path for path in self.files if path.endswith(self.suffix(suffix)))

    @cached_property
    def sources(self) -> list[str]:
        """The files that functions of classes are in."""
        return self.paths(".py" if self.is_python else ".cpp")

    @cached_property
    def parts(self) -> list[Part]:
        """All functions that generated classes consist of."""
        return [part for path in self.sources for part in parts_in(path, self.files[path])]

    @cached_property
    def members(self) -> list[Member]:
        """All state variables, as they are declared."""
        paths = self.sources if self.is_python else self.paths(".h")
        return [member for path in paths for member in members_in(path, self.files[path])]

    def members_of(self, owner: str) -> list[Member]:
        """Those of a class."""
        return [member for member in self.members if member.element.startswith(f"{owner}.")]

    @cached_property
    def sends(self) -> dict[tuple[str, str], tuple[str, ...]]:
        """The types of the parameters of each sending function, by its class and name."""
        return {key: types for p in self.sources for key, types in sends_in(p, self.files[p])}

    @cached_property
    def classes(self) -> list[str]:
        """The names of the reactive classes."""
        return sorted({part.owner for part in self.parts if part.kind == "constructor"})

    @cached_property
    def owners(self) -> dict[str, str]:
        """The reactive classes by their sources and headers, and servers by their messages."""
        found = {part.path: part.owner for part in self.parts}
        for path in (*self.paths(".h"), *self.sources):
            declared = class_in(path, self.files[path])
            if declared is not None:
                found[path] = declared
        servers = {p.element for p in self.parts if p.kind == "msgsrv"}
        plain = {re.sub(r"\W|_", "", s).lower(): s for s in servers}
        for path in self.paths(".msg"):
            name = path.rpartition("/")[2].removesuffix(".msg").lower()
            if name in plain:
                found[path] = plain[name]
        return found

    def is_script(self, path: str) -> bool:
        """Whether a file is in Python, whatever its name ends with."""
        return path.endswith(".py") or (self.is_python and "scripts/" in path)

    def code(self, path: str, *, strings: bool = True) -> str:
        """A text with its comments, and if wanted what strings say, made blank."""
        comment = _PY_COMMENT if self.is_script(path) else _COMMENT
        text = comment.sub(_blank, self.files[path])
        return text if strings else _STRING.sub(_blank, text)

    def mutant(self, made: Edit | Sequence[Edit]) -> Mutant:
        """The package with edits made."""
        edits = (made,) if isinstance(made, Edit) else tuple(made)
        files: dict[str, str | None] = {}
        for edit in sorted(edits, key=lambda e: -e.start):
            text = files.get(edit.path) or self.files[edit.path]
            files[edit.path] = text[: edit.start] + edit.text + text[edit.end :]
        first = edits[0]
        elements = tuple(dict.fromkeys(e.element for e in edits if e.element))
        return Mutant(files, self.place(first.path, first.start), elements)

    def place(self, path: str, offset: int) -> str:
        """A place as people write it."""
        return f"{path}:{self.files[path].count(chr(10), 0, offset) + 1}"


def _blank(found: re.Match[str]) -> str:
    return re.sub(r"[^\n]", " ", found[0])


# --- makers -------------------------------------------------------------------------------------

Texts: TypeAlias = "str | Callable[[Package, Part, re.Match[str]], str | None]"


def within(pattern: str, text: Texts, *kinds: str, strings: bool = False) -> Maker:
    """Puts a text in place of each match in functions of some kinds (default: the model's bodies).

    The text is a template as of `re.sub`, or made from the match (None: not here).
    """
    compiled = re.compile(pattern, re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for part in package.parts:
            if part.kind not in (kinds or BODIES):
                continue
            code = package.code(part.path, strings=strings)
            for found in compiled.finditer(code, part.start, part.end):
                yield from _replaced(package, part, found, text)

    return make


def _replaced(package: Package, part: Part, found: re.Match[str], text: Texts) -> Iterator[Edit]:
    whole = found.re.match(package.files[part.path], found.start(), part.end)
    if whole is None or whole.end() != found.end():
        whole = found
    new = whole.expand(text) if isinstance(text, str) else text(package, part, whole)
    if new is not None:
        element = part.element if part.kind in BODIES else part.owner
        yield Edit(part.path, found.start(), found.end(), new, element)


def in_files(suffix: str, pattern: str, text: str, *, comments: bool = False) -> Maker:
    """The same in all files with an end of their names; in comments too if wanted.

    `NAME` in the text stands for the package's.
    """
    compiled = re.compile(pattern, re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for path in package.paths(suffix):
            code = package.files[path] if comments else package.code(path)
            for found in compiled.finditer(code):
                new = found.expand(text).replace("NAME", package.name)
                yield Edit(path, *found.span(), new, package.owners.get(path, ""))

    return make


def kinds_in(
    suffix: str, rows: Mapping[str, tuple[str, str]], *, comments: bool = False
) -> tuple[Kind, ...]:
    """Kinds of changes in such files by their names, each a pattern and the text in its place."""
    return tuple(Kind(n, in_files(suffix, *row, comments=comments)) for n, row in rows.items())


def at_start(text: str, *kinds: str) -> Maker:
    """Puts a text before the first statement of functions."""

    def make(package: Package) -> Iterator[Edit]:
        for part in package.parts:
            if part.kind in kinds:
                yield Edit(part.path, part.start, part.start, text, part.element)

    return make


def at_end(text: str, *kinds: str) -> Maker:
    """Puts a text after the last statement of functions."""

    def make(package: Package) -> Iterator[Edit]:
        for part in package.parts:
            if part.kind in kinds:
                yield Edit(part.path, part.end, part.end, text, part.element)

    return make


def anywhere(make: Maker) -> Maker:
    """Edits whose change may be told at any element, as where a rebec gets another argument."""

    def made(package: Package) -> Iterator[Made]:
        for each in make(package):
            yield replace(each, element="") if isinstance(each, Edit) else each

    return made
