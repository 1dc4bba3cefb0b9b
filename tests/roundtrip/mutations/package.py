"""A generated package as texts, with the parts of it that mutations are made in."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TypeAlias

from tests.reverse.test_laws import EXAMPLES, package_of

BY_NAME = {example.name: example for example in EXAMPLES}
BODIES = ("constructor", "msgsrv", "method")

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|<!--.*?-->", re.DOTALL)
_STRING = re.compile(r'"[^"\n]*"')
_MARKED = re.compile(
    r"^// rebsync: (constructor|msgsrv|method|send) (\S+)\n(?://[^\n]*\n)*[^\n;]*\{\n", re.MULTILINE
)
_SETUP = re.compile(r"^(\w+)::\1\([^{;]*\{", re.MULTILINE)
_RECEIVE = re.compile(r"^void (\w+)::(receive\w+)\([^{;]*\{\n", re.MULTILINE)
_MEMBER = re.compile(
    r"^  ([\w:<>, ]+?) (\w+)(?:\{\})?;\s*// rebsync: statevar (\S+)$", re.MULTILINE
)
_CLASS = re.compile(r"^// rebsync: reactiveclass (\S+)$", re.MULTILINE)
_SEND = re.compile(r"^void (\w+)::(send\w+)\(([^)]*)\) \{$", re.MULTILINE)


@dataclass(frozen=True)
class Part:
    """A function of a file: its kind, the element that it is or belongs to, and its extent."""

    kind: str
    element: str
    path: str
    start: int
    end: int

    @property
    def owner(self) -> str:
        """The class."""
        return self.element.partition(".")[0]


@dataclass(frozen=True)
class Member:
    """A state variable."""

    type: str
    name: str
    element: str


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
    """The package of an example."""

    name: str
    files: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.files = package_of(BY_NAME[self.name])

    @property
    def example(self) -> Path:
        """The folder of the model."""
        return BY_NAME[self.name]

    def paths(self, suffix: str) -> list[str]:
        """The files with an end of their names."""
        return sorted(path for path in self.files if path.endswith(suffix))

    @cached_property
    def parts(self) -> list[Part]:
        """All functions that generated classes consist of."""
        return [part for path in self.paths(".cpp") for part in self._parts(path)]

    def _parts(self, path: str) -> Iterator[Part]:
        text = self.files[path]
        for m in _MARKED.finditer(text):
            yield Part(m[1], m[2], path, m.end(), _end(text, m.end()))
        for m in _SETUP.finditer(text):
            yield Part("setup", m[1], path, m.start(), _end(text, m.end()))
        for m in _RECEIVE.finditer(text):
            yield Part("receive", f"{m[1]}.{m[2]}", path, m.end(), _end(text, m.end()))

    @cached_property
    def members(self) -> list[Member]:
        """All state variables, as the headers declare them."""
        texts = (self.files[path] for path in self.paths(".h"))
        return [Member(m[1], m[2], m[3]) for text in texts for m in _MEMBER.finditer(text)]

    def members_of(self, owner: str) -> list[Member]:
        """Those of a class."""
        return [member for member in self.members if member.element.startswith(f"{owner}.")]

    @cached_property
    def sends(self) -> dict[tuple[str, str], tuple[str, ...]]:
        """The types of the parameters of each sending function, by its class and name."""
        texts = (self.files[path] for path in self.paths(".cpp"))
        return {
            (m[1], m[2]): tuple(p.strip().rpartition(" ")[0] for p in m[3].split(",")[:-1])
            for text in texts
            for m in _SEND.finditer(text)
        }

    @cached_property
    def classes(self) -> list[str]:
        """The names of the reactive classes."""
        return sorted({part.owner for part in self.parts if part.kind == "constructor"})

    @cached_property
    def owners(self) -> dict[str, str]:
        """The reactive classes by their sources and headers, and servers by their messages."""
        found = {part.path: part.owner for part in self.parts}
        for path in self.paths(".h"):
            declared = _CLASS.search(self.files[path])
            if declared is not None:
                found[path] = declared[1]
        servers = {p.element for p in self.parts if p.kind == "msgsrv"}
        plain = {re.sub(r"\W|_", "", s).lower(): s for s in servers}
        for path in self.paths(".msg"):
            name = path.rpartition("/")[2].removesuffix(".msg").lower()
            if name in plain:
                found[path] = plain[name]
        return found

    def code(self, path: str, *, strings: bool = True) -> str:
        """A text with its comments, and if wanted what strings say, made blank."""
        text = _COMMENT.sub(_blank, self.files[path])
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


def _end(text: str, start: int) -> int:
    """The end of a function's last statement."""
    return text.index("\n}\n", start) + 1


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
