"""An open model or property file as a value: its text, its tree, what is known of it."""

from __future__ import annotations

from functools import cached_property
from typing import TypeAlias

from lsprotocol import types as lsp

from rebsync.diagnostics import Diagnostic, Severity
from rebsync.forward.topics import Topics
from rebsync.grammars.properties import ParsedProperties, parse_properties
from rebsync.lint import analysed, lint, model_findings, property_findings, unless_ignored
from rebsync.lsp.occurrences import Occurrence, families, of_model, of_properties
from rebsync.lsp.parts import Layout, ParsedParts, in_text, parse_parts
from rebsync.records import dataclass
from rebsync.source import Source, Span
from rebsync.static import Analysis


@dataclass(frozen=True)
class Text:
    """A text under its address, and the places of the protocol: lines from 0, UTF-16 columns."""

    uri: str
    source: Source

    @property
    def layout(self) -> Layout:
        """How offsets of the trees are offsets of the text: the same, but for parts of a model."""
        return Layout()

    def offset(self, position: lsp.Position) -> int:
        """The offset in the trees of a place; places behind a line or the text are their ends."""
        source, text = self.source, self.source.text
        last = source.position(len(text)).line
        if position.line >= last:
            return self.layout.to_tree(len(text))
        line = source.line(position.line + 1)
        encoded = line.encode("utf-16-le", "surrogatepass")[: 2 * position.character]
        column = len(encoded.decode("utf-16-le", "ignore"))
        return self.layout.to_tree(source.start_of(position.line + 1) + column)

    def position(self, offset: int) -> lsp.Position:
        """The place of an offset in the trees."""
        return self.text_position(self.layout.to_text(offset))

    def range(self, span: Span) -> lsp.Range:
        """The range of a span of the trees."""
        return lsp.Range(self.position(span.start), self.position(span.end))

    def text_position(self, offset: int) -> lsp.Position:
        """The place of an offset in the text."""
        place = self.source.position(min(offset, len(self.source.text)))
        before = self.source.line(place.line)[: place.column - 1]
        return lsp.Position(place.line - 1, len(before.encode("utf-16-le", "surrogatepass")) // 2)

    def text_range(self, span: Span) -> lsp.Range:
        """The range of a span of the text."""
        return lsp.Range(self.text_position(span.start), self.text_position(span.end))

    def slice(self, span: Span) -> str:
        """The text of a span of the trees."""
        to_text = self.layout.to_text
        return self.source.text[to_text(span.start) : to_text(span.end)]


@dataclass(frozen=True)
class ModelDocument(Text):
    """A model, as far as it can be read."""

    parts: ParsedParts
    analysis: Analysis

    @property
    def layout(self) -> Layout:
        return self.parts.layout

    @cached_property
    def findings(self) -> tuple[Diagnostic, ...]:
        """What `rebsync lint` finds, with places in the text.

        Around errors of syntax it is near to that: there the parser goes on part by part.
        """
        found = model_findings(self.parts.whole, self.analysis)
        return unless_ignored(self.source, (in_text(d, self.layout) for d in found))

    @cached_property
    def exact_findings(self) -> tuple[Diagnostic, ...]:
        """The same from the text as a whole where it has errors of syntax, which takes longer."""
        return self.findings if self.parts.whole.ok else lint(self.source).diagnostics

    @cached_property
    def occurrences(self) -> tuple[Occurrence, ...]:
        """Where names are declared and used."""
        return tuple(of_model(self.analysis))

    @cached_property
    def families(self) -> dict[tuple[str, str], str]:
        """By class and name of each server and method the class that stands for its family."""
        return families(self.analysis.classes.values())

    @cached_property
    def topics(self) -> Topics | None:
        """The topics that the generator has for servers; None where the model has errors."""
        is_wrong = any(found.severity is Severity.ERROR for found in self.findings)
        return None if is_wrong else Topics(self.parts.whole.model, self.analysis)


@dataclass(frozen=True)
class PropertyDocument(Text):
    """A property file, and its model if there is one."""

    parsed: ParsedProperties
    model: ModelDocument | None

    @cached_property
    def findings(self) -> tuple[Diagnostic, ...]:
        """What `rebsync lint` finds, with places in the text."""
        model = self.model
        whole = model.parts.whole if model is not None else None
        analysis = model.analysis if model is not None else None
        return unless_ignored(self.source, property_findings(self.parsed, whole, analysis))

    @cached_property
    def occurrences(self) -> tuple[Occurrence, ...]:
        """Where names are declared and used, those of the model included."""
        analysis = self.model.analysis if self.model is not None else None
        return tuple(of_properties(self.parsed.properties, analysis))


Document: TypeAlias = ModelDocument | PropertyDocument


def read_model(uri: str, source: Source, before: ModelDocument | None = None) -> ModelDocument:
    """The document of a model's text; `before` is that of the text before an edit."""
    parts = parse_parts(source, before.parts if before is not None else None)
    return ModelDocument(uri, source, parts, analysed(parts.whole))


def read_properties(uri: str, source: Source, model: ModelDocument | None) -> PropertyDocument:
    """The document of a property file's text, with the model beside it."""
    return PropertyDocument(uri, source, parse_properties(source), model)
