"""Ways to write whole files, or stretches of lines, otherwise."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from tests.roundtrip.mutations.package import Edit, Kind, Maker, Mutant, Package

SOURCES = (".h", ".cpp")
TEXTS = (".cpp", ".h", ".launch", ".launch.py", ".yaml", ".txt", ".msg")
MARKER = re.compile(r"[ \t]*(?://|#|<!--)\s*rebsync: (?!annotation|env|user|end)[^\n]*")


def rewritten(suffixes: tuple[str, ...], rewrite: Callable[[str], str]) -> Maker:
    """Whole files written anew, one after the other."""

    def make(package: Package) -> Iterator[Mutant]:
        own = tuple(package.suffix(suffix) for suffix in suffixes)
        for path, text in sorted(package.files.items()):
            if path.endswith(own):
                yield Mutant({path: rewrite(text)}, path)

    return make


def all_files(rewrite: Callable[[str], str]) -> Maker:
    """All texts of the package written anew at once."""

    def make(package: Package) -> Iterator[Mutant]:
        yield Mutant({path: rewrite(text) for path, text in package.files.items()}, "everywhere")

    return make


def swapped_lines(pattern: str, suffix: str) -> Maker:
    """Two lines that match, one after the other, in the other order."""
    lines = re.compile(rf"^({pattern}\n)({pattern}\n)", re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for path in package.paths(suffix):
            for found in lines.finditer(package.files[path]):
                yield Edit(path, *found.span(), found[2] + found[1])

    return make


def without_markers(package: Package) -> Iterator[Mutant]:
    """No marker at all, all over the package."""
    own = (*(package.suffix(s) for s in SOURCES), ".launch", ".py")
    files: dict[str, str | None] = {
        path: MARKER.sub("", text) for path, text in package.files.items() if path.endswith(own)
    }
    yield Mutant(files, "everywhere")


def without_one_marker(package: Package) -> Iterator[Edit]:
    """One marker after the other left out."""
    for path in (*package.sources, *([] if package.is_python else package.paths(".h"))):
        for found in MARKER.finditer(package.files[path]):
            yield Edit(path, *found.span(), "")


def gone(suffix: str) -> Maker:
    """A file that is no longer there."""

    def make(package: Package) -> Iterator[Mutant]:
        for path in package.paths(suffix):
            yield Mutant({path: None}, path)

    return make


KINDS = (
    Kind("spaces at ends of lines", rewritten(TEXTS, lambda t: t.replace("\n", "  \n"))),
    Kind("CRLF", all_files(lambda t: t.replace("\n", "\r\n"))),
    Kind("CRLF in one file", rewritten(TEXTS, lambda t: t.replace("\n", "\r\n"))),
    Kind("no newline at the end", rewritten(TEXTS, lambda t: t.rstrip("\n"))),
    Kind("markers removed", without_markers),
    Kind("one marker removed", without_one_marker),
)
