"""Incremental parsing: classes, interfaces, `main` and heads of a model are parsed one by one.

Each part has a range of offsets of its own, with room to grow (`STRIDE`), so that what an edit does
not touch keeps its tree, places included. `Layout` maps these offsets to those of the text.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from rebsync.diagnostics import Diagnostic
from rebsync.grammars.amount import too_large
from rebsync.grammars.parser import Parsed, misplaced_parts, parse_model
from rebsync.model import Model
from rebsync.records import dataclass
from rebsync.source import NOWHERE, Source, Span

STRIDE = 1 << 32
_SIGN = re.compile(
    r'//[^\n]*|/\*.*?(?:\*/|\Z)|"(?:[^"\\\n]|\\.)*"|[{};]'
    r"|(?<![A-Za-z_$])(?:reactiveclass|interface|main)\b",
    re.DOTALL,
)
_SEPARATE = frozenset(("RS111", "RS113", "RS115"))  # what is wrong with a text as a whole


@dataclass(frozen=True, slots=True)
class Layout:
    """Where parts are: part `i` has the offsets from `i * STRIDE`, and begins at `starts[i]`."""

    starts: tuple[int, ...] = (0,)

    def to_text(self, offset: int) -> int:
        """The offset in the text of an offset in the trees."""
        part = min(offset // STRIDE, len(self.starts) - 1)
        return self.starts[part] + offset - part * STRIDE

    def to_tree(self, offset: int) -> int:
        """The offset in the trees of an offset in the text."""
        part = bisect_right(self.starts, offset) - 1
        return part * STRIDE + offset - self.starts[part]


@dataclass(frozen=True, slots=True)
class ParsedParts:
    """A model with the trees of its parts."""

    whole: Parsed
    layout: Layout = Layout()
    parts: tuple[Parsed, ...] = ()


def parse_parts(source: Source, before: ParsedParts | None) -> ParsedParts:
    """Parses a model; of `before` those parts are taken over whose text is the same."""
    texts = _split(source.text)
    if texts is None or too_large(source.text) is not None:
        return ParsedParts(parse_model(source))
    known = before.parts if before is not None else ()
    parts = []
    for i, text in enumerate(texts):
        is_known = i < len(known) and known[i].source.text == text
        part = known[i] if is_known else parse_model(Source(source.path, text), i * STRIDE)
        if any(d.code in _SEPARATE for d in part.diagnostics):
            return ParsedParts(parse_model(source))
        parts.append(part)
    starts = [0]
    for text in texts[:-1]:
        starts.append(starts[-1] + len(text))
    return ParsedParts(_joined(source, parts), Layout(tuple(starts)), tuple(parts))


def _split(text: str) -> list[str] | None:
    """The text in parts, each up to its last brace or semicolon; None where braces do not match."""
    ends, depth = [0], 0
    for sign in _SIGN.finditer(text):
        match sign[0]:
            case "{":
                depth += 1
            case "}":
                depth -= 1
                if depth < 0:
                    return None
            case "reactiveclass" | "interface" | "main" if depth:
                return None
        if depth == 0 and sign[0] in "};":
            ends.append(sign.end())
    if depth:
        return None
    ends = [*ends[:-1], len(text)] if len(ends) > 1 else [0, len(text)]
    return [text[start:end] for start, end in pairwise(ends)]


def _joined(source: Source, parts: Sequence[Parsed]) -> Parsed:
    models = [part.model for part in parts]
    spans = [m.span for m in models if m.heads or m.classes or m.main]
    model = Model(
        tuple(h for m in models for h in m.heads),
        tuple(c for m in models for c in m.classes),
        next((m.main for m in models if m.main), None),
        spans[0].to(spans[-1]) if spans else Span(0, 0),
    )
    found = [d for part in parts for d in part.diagnostics] + misplaced_parts(model)
    found.sort(key=lambda d: (d.span.start, d.code))
    return Parsed(source, model, tuple(c for part in parts for c in part.comments), tuple(found))


def in_text(found: Diagnostic, layout: Layout) -> Diagnostic:
    """A finding on the trees of parts with the places of the text."""

    def span(of: Span) -> Span:
        return of if of is NOWHERE else Span(layout.to_text(of.start), layout.to_text(of.end))

    return replace(
        found,
        span=span(found.span),
        edits=tuple(replace(edit, span=span(edit.span)) for edit in found.edits),
        related=tuple((span(place), remark) for place, remark in found.related),
    )
