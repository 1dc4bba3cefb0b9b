"""Definitions, references and hover texts: what is at a place of a document."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from rebsync import model as m
from rebsync import properties as p
from rebsync.lsp.document import Document, ModelDocument, PropertyDocument
from rebsync.lsp.occurrences import Entity, Occurrence
from rebsync.lsp.outline import parameters
from rebsync.lsp.words import remark_of, word_at
from rebsync.source import Span
from rebsync.static import Analysis
from rebsync.static.symbols import BuiltinFunctionSymbol, BuiltinSymbol

_BUILTINS = {
    "now": "the time in the model",
    "sender": "the rebec that sent the message",
    "self": "this rebec",
    "currentMessageArrival": "when the message arrived",
    "currentMessageDeadline": "when the message would have been too late",
    "currentMessageWaitingTime": "how long the message waited",
    "delay": "lets time pass in this rebec",
    "assertion": "a condition that must hold whenever this place is reached",
    "pow": "the first to the power of the second",
    "sqrt": "the square root",
}


def entity_at(document: Document, position: lsp.Position) -> Occurrence | None:
    """The name at a place, or right before it."""
    offset = document.offset(position)
    found = (o for o in document.occurrences if o.span.start <= offset <= o.span.end)
    return max(found, key=lambda o: o.span.start, default=None)


def documents_of(document: Document, properties: Iterable[PropertyDocument]) -> list[Document]:
    """The document, its model, and the property files of this: wherever a name may be used."""
    model = document if isinstance(document, ModelDocument) else document.model
    every: list[Document] = [document] if model is None else [model, *properties]
    return every if document in every else [*every, document]


def definitions(documents: Iterable[Document], entity: Entity) -> list[lsp.Location]:
    """Where it is declared."""
    return [_location(d, o) for d, o in places(documents, entity) if o.declares is not None]


def references(
    documents: Iterable[Document], entity: Entity, with_declaration: bool
) -> list[lsp.Location]:
    """Where it is used."""
    return [
        _location(document, each)
        for document, each in places(documents, entity)
        if with_declaration or each.declares is None
    ]


def places(documents: Iterable[Document], entity: Entity) -> Iterator[tuple[Document, Occurrence]]:
    """Its occurrences, each with its document."""
    for document in documents:
        for each in document.occurrences:
            if each.entity == entity:
                yield document, each


def _location(document: Document, of: Occurrence) -> lsp.Location:
    return lsp.Location(document.uri, document.range(of.span))


# --- hover ---------------------------------------------------------------------------------------


def hover(document: Document, position: lsp.Position) -> lsp.Hover | None:
    """What the name at a place is."""
    found = entity_at(document, position)
    if found is None:
        return _hover_of_builtin(document, position) or _hover_of_word(document, position)
    analysis = _analysis(document)
    of, declared = _declared(found, document)
    lines = ["```rebeca", _declaration(declared, found.entity, analysis), "```"]
    if found.entity.owner and found.entity.kind != "local":
        lines.append(f"of `{found.entity.owner}`")
    if found.entity.kind != "local":
        start = of.layout.to_text(declared.span.start)
        if remark := remark_of(of.source.text, start):
            lines += ["", remark]
    return _told("\n".join(lines), document.range(found.span))


def _hover_of_builtin(document: Document, position: lsp.Position) -> lsp.Hover | None:
    if not isinstance(document, ModelDocument):
        return None
    offset = document.offset(position)
    for node in m.walk(document.parts.whole.model):
        symbol = document.analysis.symbol_of(node)
        if isinstance(symbol, BuiltinSymbol | BuiltinFunctionSymbol) and symbol.name in _BUILTINS:
            span = node.name_span if isinstance(node, m.Call) else node.span
            if span.start <= offset <= span.end:
                text = f"```rebeca\n{symbol.type} {symbol.name}\n```\n{_BUILTINS[symbol.name]}"
                return _told(text, document.range(span))
    return None


def _hover_of_word(document: Document, position: lsp.Position) -> lsp.Hover | None:
    if not isinstance(document, ModelDocument):
        return None
    found = word_at(document.source.text, document.layout.to_text(document.offset(position)))
    if found is None:
        return None
    start, end, meaning = found
    return _told(meaning, document.text_range(Span(start, end)))


def _told(text: str, place: lsp.Range) -> lsp.Hover:
    return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, text), place)


def _analysis(document: Document) -> Analysis | None:
    if isinstance(document, ModelDocument):
        return document.analysis
    return document.model.analysis if document.model is not None else None


def _declared(found: Occurrence, document: Document) -> tuple[Document, Occurrence]:
    """The declaration of what is found in a document, or else that again."""
    model = document if isinstance(document, ModelDocument) else document.model
    documents = documents_of(document, ()) if model is None else [document, model]
    every = places(documents, found.entity)
    return next(((d, o) for d, o in every if o.declares is not None), (document, found))


def _declaration(declared: Occurrence, entity: Entity, analysis: Analysis | None) -> str:
    match declared.declares:
        case m.MessageServer() as server:
            return f"msgsrv {server.name}{parameters(server)}"
        case m.Method() as method:
            return f"{method.type} {method.name}{parameters(method)}"
        case m.ReactiveClass() as class_:
            return f"reactiveclass {class_.name}({class_.queue_length})"
        case m.Interface() as interface:
            return f"interface {interface.name}"
        case p.Define() | p.Property():
            return f"{entity.kind} {entity.name}"
        case m.Rebec() as rebec:
            return f"rebec {rebec.type} {rebec.name}"
    return _variable(declared, entity, analysis)


def _variable(declared: Occurrence, entity: Entity, analysis: Analysis | None) -> str:
    if analysis is None:
        return f"{entity.kind} {entity.name}"
    if entity.kind == "env":
        constant = analysis.env[entity.name]
        value = "" if constant.value is None else f" = {str(constant.value).lower()}"
        return f"env {constant.type} {entity.name}{value}"
    info = analysis.classes.get(entity.owner)
    symbol = info.variables.get(entity.name) if info is not None else None
    symbol = symbol or analysis.symbol_of(declared.declares)  # type: ignore[assignment]
    kind = {"local": "", "statevar": "statevar ", "knownrebec": "knownrebec "}[entity.kind]
    type_ = getattr(symbol, "type", None)
    return f"{kind}{type_ or '?'} {entity.name}"
