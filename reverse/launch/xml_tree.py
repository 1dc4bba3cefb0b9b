"""XML as a tree that keeps the place of each part in the text.

Entity declarations are refused: nothing in ROS needs them, and they can make a small file huge.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Mapping
from dataclasses import field
from typing import TypeAlias
from xml.parsers import expat

from rebsync.records import dataclass
from rebsync.reverse.unknowns import Unknown
from rebsync.source import Source, Span

_DEEPEST = 60
_BELOW = 2  # how deep a tag is that stands directly below the root
_TAG = re.compile(r"<(?:[^\"'>]|\"[^\"]*\"|'[^']*')*>")
_ATTRIBUTE = re.compile(r"([^\s=/\"'<>]+)\s*=\s*(?:\"([^\"]*)\"|'([^']*)')")


@dataclass(frozen=True, slots=True)
class XmlAttribute:
    """The value of an attribute, and its place between the quotes."""

    value: str
    span: Span


@dataclass(frozen=True, slots=True)
class Comment:
    """What stands between `<!--` and `-->`."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class XmlElement:
    """A tag with what it holds.

    `span` is the place of the opening tag. `text` joins the pieces of text directly inside;
    `pieces` says for each the offset in `text` where it begins and that in the source.
    """

    name: str
    attributes: Mapping[str, XmlAttribute]
    children: tuple[Child, ...]
    text: str
    pieces: tuple[tuple[int, int], ...]
    span: Span

    def elements(self) -> tuple[XmlElement, ...]:
        """The tags directly inside."""
        return tuple(c for c in self.children if isinstance(c, XmlElement))

    def get(self, name: str) -> str | None:
        """The value of an attribute, or None."""
        attribute = self.attributes.get(name)
        return attribute.value if attribute else None

    def place_of(self, attribute: str) -> Span:
        """The place of an attribute, or of the tag where it has none."""
        return self.attributes[attribute].span if attribute in self.attributes else self.span

    def place_in_text(self, span: Span) -> Span:
        """Where in the source a range of `text` stands."""
        return Span(self._offset(span.start), self._offset(span.end))

    def _offset(self, offset: int) -> int:
        at = bisect_right(self.pieces, offset, key=lambda piece: piece[0]) - 1
        if at < 0:
            return self.span.end
        begin, place = self.pieces[at]
        return place + offset - begin


Child: TypeAlias = "XmlElement | Comment"


class _Refused(Exception):
    """A part of XML that is not read; the text says which."""


@dataclass(slots=True)
class _Open:
    name: str
    attributes: dict[str, XmlAttribute]
    span: Span
    children: list[Child] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)
    pieces: list[tuple[int, int]] = field(default_factory=list)
    length: int = 0

    def closed(self) -> XmlElement:
        text = "".join(self.texts)
        return XmlElement(
            self.name, self.attributes, tuple(self.children), text, tuple(self.pieces), self.span
        )


def read_xml(source: Source) -> XmlElement | Unknown:
    """The root of the tree, or what makes the text no XML that is read."""
    builder = _Builder(source)
    try:
        builder.parser.Parse(source.text.encode("utf-8", "surrogatepass"), True)
    except expat.ExpatError as error:
        why = expat.ErrorString(error.code) or "no XML"
        # an empty text has its mistake before the beginning
        start = builder.offset(max(builder.parser.ErrorByteIndex, 0))
    except _Refused as refused:
        why, start = str(refused), builder.here()
    else:
        if builder.root is not None:
            return builder.root
        why, start = "no element found", 0
    end = min(start + 1, len(source.text))
    return Unknown("the XML of the file", why, source, Span(start, end))


def text_below(source: Source, name: str) -> str | None:
    """The text of the first tag of a name directly below the root; empty where no XML is read.

    It is what `read_xml` would say, without the tree; None where there are tags in the text.
    """
    finder = _Finder(name)
    try:
        finder.parser.Parse(source.text.encode("utf-8", "surrogatepass"), True)
    except (expat.ExpatError, _Refused):
        return ""
    return "".join(finder.texts) if not finder.has_tags else None


class _Builder:
    def __init__(self, source: Source) -> None:
        self.root: XmlElement | None = None
        self._source = source
        self._open: list[_Open] = []
        self._starts = _byte_offsets(source.text)
        self.parser = expat.ParserCreate("utf-8")
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text
        self.parser.CommentHandler = self._comment
        _refuse_entities(self.parser)

    def offset(self, byte: int) -> int:
        """The offset in characters of an offset in bytes."""
        return byte if self._starts is None else bisect_right(self._starts, byte) - 1

    def here(self) -> int:
        return self.offset(self.parser.CurrentByteIndex)

    def _start(self, name: str, values: dict[str, str]) -> None:
        if len(self._open) >= _DEEPEST:
            raise _Refused(f"tags nested more than {_DEEPEST} deep are not read")
        start = self.here()
        tag = _TAG.match(self._source.text, start)
        span = Span(start, tag.end() if tag else start + 1 + len(name))
        places = {
            match[1]: Span(*match.span(2 if match[2] is not None else 3))
            for match in _ATTRIBUTE.finditer(self._source.text, start + 1 + len(name), span.end)
        }
        attributes = {k: XmlAttribute(v, places.get(k, span)) for k, v in values.items()}
        self._open.append(_Open(name, attributes, span))

    def _end(self, name: str) -> None:
        element = self._open.pop().closed()
        if self._open:
            self._open[-1].children.append(element)
        else:
            self.root = element

    def _text(self, text: str) -> None:
        inside = self._open[-1]
        inside.pieces.append((inside.length, self.here()))
        inside.texts.append(text)
        inside.length += len(text)

    def _comment(self, text: str) -> None:
        if self._open:
            start = self.here()
            span = Span(start, start + len(text) + len("<!---->"))
            self._open[-1].children.append(Comment(text, span))


class _Finder:
    """Collects the text of one tag."""

    def __init__(self, name: str) -> None:
        self.texts: list[str] = []
        self._name = name
        self._depth = 0
        self._inside = self._found = self.has_tags = False
        self.parser = expat.ParserCreate("utf-8")
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        _refuse_entities(self.parser)

    def _start(self, name: str, _: dict[str, str]) -> None:
        if self._depth >= _DEEPEST:
            raise _Refused(f"tags nested more than {_DEEPEST} deep are not read")
        self._depth += 1
        if self._depth == _BELOW and name == self._name and not self._found:
            self._found = self._inside = True
            self.parser.CharacterDataHandler = self.texts.append
        elif self._inside:
            self.has_tags = True

    def _end(self, _: str) -> None:
        if self._inside and self._depth == _BELOW:
            self._inside = False
            self.parser.CharacterDataHandler = None
        self._depth -= 1


def _refuse_entities(parser: expat.XMLParserType) -> None:
    parser.EntityDeclHandler = _refusal("the declaration of an entity is not read")
    parser.SkippedEntityHandler = _refusal("the entity is not declared in the file")


def _refusal(why: str) -> Callable[..., None]:
    def handler(*_: object) -> None:
        raise _Refused(why)

    return handler


def _byte_offsets(text: str) -> list[int] | None:
    """The offset in UTF-8 of each character and of the end, or None where they are the same."""
    if text.isascii():
        return None
    starts, at = [], 0
    for char in text:
        starts.append(at)
        at += 1 + (char > "\x7f") + (char > "\u07ff") + (char > "\uffff")
    starts.append(at)
    return starts
