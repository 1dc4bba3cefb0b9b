"""The outline of a document, and what of it folds."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Protocol

from lsprotocol import types as lsp

from rebsync import model as m
from rebsync.lsp.document import Document, ModelDocument, PropertyDocument, Text
from rebsync.source import Span

_FOLDED = re.compile(
    r'(?P<comment>/\*.*?(?:\*/|\Z)|(?://[^\n]*\n[ \t]*)+)|"(?:[^"\\\n]|\\.)*"|[{}]', re.DOTALL
)


class _Named(Protocol):
    """A declaration."""

    @property
    def name(self) -> str: ...

    @property
    def span(self) -> Span: ...

    @property
    def name_span(self) -> Span: ...


def outline(document: Document) -> list[lsp.DocumentSymbol]:
    """Classes with their members, `env` constants and rebecs; or properties and definitions."""
    match document:
        case ModelDocument():
            model = document.parts.whole.model
            heads = [h.declaration for h in model.heads if isinstance(h, m.Env)]
            found = [s for h in heads for s in _variables(document, h, lsp.SymbolKind.Constant)]
            found += [_class(document, each) for each in model.classes]
            return found + ([_main(document, model.main)] if model.main is not None else [])
        case PropertyDocument():
            properties = document.parsed.properties
            kinds = ("Assertion", properties.assertions), ("LTL", properties.ltl)
            found = [
                _symbol(document, define, lsp.SymbolKind.Constant, "define")
                for define in properties.defines
            ]
            for kind, entries in (*kinds, ("TCTL", properties.tctl)):
                found += [_symbol(document, e, lsp.SymbolKind.Property, kind) for e in entries]
            return sorted(found, key=lambda s: (s.range.start.line, s.range.start.character))


def _class(document: Text, of: m.ReactiveClass | m.Interface) -> lsp.DocumentSymbol:
    if isinstance(of, m.Interface):
        inner = [_callable(document, s) for s in of.servers]
        return _symbol(document, of, lsp.SymbolKind.Interface, "interface", inner)
    inner = [symbol for member in of.members for symbol in _member(document, member)]
    return _symbol(document, of, lsp.SymbolKind.Class, f"queue {of.queue_length}", inner)


def _member(document: Text, member: m.ClassMember) -> Iterator[lsp.DocumentSymbol]:
    match member:
        case m.KnownRebecs(declarations):
            for each in declarations:
                yield from _variables(document, each, lsp.SymbolKind.Object)
        case m.StateVars(declarations):
            for each in declarations:
                yield from _variables(document, each, lsp.SymbolKind.Field)
        case m.Constructor() | m.MessageServer() | m.Method():
            yield _callable(document, member)


def _callable(document: Text, of: m.Constructor | m.MessageServer | m.Method) -> lsp.DocumentSymbol:
    kinds = {m.Constructor: lsp.SymbolKind.Constructor, m.MessageServer: lsp.SymbolKind.Event}
    kind = kinds.get(type(of), lsp.SymbolKind.Method)
    return _symbol(document, of, kind, parameters(of))


def parameters(of: m.Constructor | m.MessageServer | m.Method) -> str:
    """The parameters of a declaration as they are written."""
    return f"({', '.join(f'{p.type} {p.name}' for p in of.parameters)})"


def _variables(
    document: Text, of: m.Declaration, kind: lsp.SymbolKind
) -> Iterator[lsp.DocumentSymbol]:
    for declarator in of.declarators:
        yield _symbol(document, declarator, kind, str(of.type))


def _main(document: Text, main: m.Main) -> lsp.DocumentSymbol:
    rebecs = [
        _symbol(document, rebec, lsp.SymbolKind.Object, str(rebec.type)) for rebec in main.rebecs
    ]
    name = Span(main.span.start, main.span.start + len("main"))
    places = document.range(main.span), document.range(name)
    return lsp.DocumentSymbol("main", lsp.SymbolKind.Namespace, *places, children=rebecs)


def _symbol(
    document: Text,
    of: _Named,
    kind: lsp.SymbolKind,
    detail: str,
    children: list[lsp.DocumentSymbol] | None = None,
) -> lsp.DocumentSymbol:
    name = of.name_span
    is_around = of.span.start <= name.start and name.end <= of.span.end
    places = document.range(of.span if is_around else name), document.range(name)
    return lsp.DocumentSymbol(of.name or "?", kind, *places, detail=detail, children=children)


def folding(document: Text) -> list[lsp.FoldingRange]:
    """Blocks, comments of several lines, and runs of line comments; whether or not it parses."""
    opened: list[int] = []
    found = []
    text = document.source.text
    for sign in _FOLDED.finditer(text):
        if sign["comment"]:
            end = sign.start() + len(sign[0].rstrip())
            found.append(_fold(document, sign.start(), end, lsp.FoldingRangeKind.Comment))
        elif sign[0] == "{":
            opened.append(sign.start())
        elif sign[0] == "}" and opened:
            found.append(_fold(document, opened.pop(), sign.start(), lsp.FoldingRangeKind.Region))
    return [fold for fold in found if fold.end_line > fold.start_line]


def _fold(document: Text, start: int, end: int, kind: lsp.FoldingRangeKind) -> lsp.FoldingRange:
    first, last = (document.source.position(at).line - 1 for at in (start, end))
    is_block = kind is lsp.FoldingRangeKind.Region
    return lsp.FoldingRange(first, last - 1 if is_block else last, kind=kind)
