"""Markers: comments of generated code that name the element of the model that follows them."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator, Mapping
from dataclasses import field

from rebsync.records import dataclass
from rebsync.terminal import encoded

_MARKER = re.compile(
    r"(?P<before>.*?)(?://|\#|<!--)\s*rebsync:\s*(?P<kind>[\w-]+)\s*(?P<path>.*?)\s*(?:-->)?\s*\Z"
)
_NOT_ELEMENTS = frozenset({"annotation", "end"})


@dataclass(frozen=True, slots=True)
class MarkedElement:
    """A marked piece of a generated file: its kind and path in the model, its text, its lines."""

    kind: str
    path: str
    text: str
    lines: range = field(default=range(0), compare=False)  # counted from 1, the marker's first

    @property
    def name(self) -> str:
        """The element's key in the manifest: kind and path."""
        return f"{self.kind} {self.path}"

    @property
    def digest(self) -> str:
        """A digest over the tokens of the text: layout and comments do not count."""
        return digest(" ".join(_tokens(self.text)))


def digest(text: str) -> str:
    """The digest that the manifest records for a text."""
    return hashlib.sha256(encoded(text)).hexdigest()


def elements(text: str) -> Iterator[MarkedElement]:
    """The marked elements of a generated text, in their order.

    A marker at the end of a line marks that line, one on a line of its own what follows, up to
    the line that closes it: the next line that is indented no deeper and ends a block.
    """
    lines = text.split("\n")
    for number, line in enumerate(lines):
        match = _MARKER.match(line)
        if match is None or match["kind"] in _NOT_ELEMENTS:
            continue
        before = match["before"].strip()
        block = _suite if "#" in line.partition("rebsync:")[0] else _block
        body = [before] if before else list(block(lines, number + 1))
        last = number + 1 if before else number + 1 + len(body)
        where = range(number + 1, last + 1)
        yield MarkedElement(match["kind"], match["path"], "\n".join(body), where)


def _block(lines: list[str], first: int) -> Iterator[str]:
    indent: int | None = None
    for line in map(lines.__getitem__, range(first, len(lines))):  # no copy for each element
        depth = len(line) - len(line.lstrip())
        if indent is None and line.strip() and not _MARKER.match(line):
            indent = depth
        yield line
        closes = line.strip().startswith(("}", "</", "// rebsync: end"))
        done = line.rstrip().endswith((";", "/>", "{}")) and "{" not in line.rstrip("{};")
        if indent is not None and depth <= indent and (closes or done):
            return


def _suite(lines: list[str], first: int) -> Iterator[str]:
    """The same in Python: a definition, its decorators, and what is indented below it."""
    indent, opened = None, False
    for line in map(lines.__getitem__, range(first, len(lines))):  # no copy for each element
        code, depth = line.strip(), len(line) - len(line.lstrip())
        if opened and code and depth <= (indent or 0) and code[0] not in ")]}":
            return
        if indent is None and code and not code.startswith("#"):
            indent = depth
        opened = opened or code.startswith(("def ", "class ", "Node("))
        yield line


TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|\w+|\S', re.DOTALL)


def _tokens(text: str) -> list[str]:
    return [t for t in TOKEN.findall(text) if not t.startswith(("//", "/*"))]


_USER = re.compile(
    r"^[^\n]*rebsync: user (?P<name>[^\n]*?)\s*\n(?P<body>.*?)^[^\n]*rebsync: end\b",
    re.MULTILINE | re.DOTALL,
)


def user_blocks(text: str) -> dict[str, str]:
    """The user's own code between `rebsync: user NAME` and `rebsync: end`, by name."""
    return {m["name"]: m["body"] for m in _USER.finditer(text)}


def with_user_blocks(text: str, blocks: Mapping[str, str]) -> str:
    """A text with the user's code put back where its blocks are."""

    def put(match: re.Match[str]) -> str:
        whole, start = match.group(0), match.start()
        body = blocks.get(match["name"], match["body"])
        return whole[: match.start("body") - start] + body + whole[match.end("body") - start :]

    return _USER.sub(put, text)
