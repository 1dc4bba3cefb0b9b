"""What may be typed at a place: members behind a dot, names in scope, keywords, annotations."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from rebsync import model as m
from rebsync.grammars.formulas import OPERATORS
from rebsync.grammars.lexer import keywords, rebeca_grammar
from rebsync.lsp.document import Document, ModelDocument, PropertyDocument
from rebsync.lsp.outline import parameters
from rebsync.static import Analysis, ClassInfo
from rebsync.static.annotations import KNOWN_ANNOTATIONS
from rebsync.static.scope import CLOCK, FUNCTIONS
from rebsync.static.types import PRIMITIVES

_BEFORE = re.compile(r"(?:(?P<target>[\w$]+)\s*\.\s*|(?P<at>@\s*))?[\w$]*\Z")
_Kind = lsp.CompletionItemKind


def completion(document: Document, position: lsp.Position) -> list[lsp.CompletionItem]:
    """What may be typed at a place, each name once."""
    at = document.layout.to_text(document.offset(position))
    before = _BEFORE.search(document.source.text[max(0, at - 200) : at])
    target = before["target"] if before is not None else None
    match document:
        case ModelDocument() if before is not None and before["at"]:
            found = _named(KNOWN_ANNOTATIONS, _Kind.Property)
        case ModelDocument():
            found = _in_model(document, document.offset(position), target)
        case PropertyDocument():
            found = _in_properties(document, target)
    return list({item.label: item for item in found}.values())


def _in_model(
    document: ModelDocument, offset: int, target: str | None
) -> Iterator[lsp.CompletionItem]:
    analysis = document.analysis
    owner = _class_at(analysis, offset)
    if target is not None:
        yield from _members(analysis, owner, target)
        return
    yield from _named(sorted(keywords(rebeca_grammar())), _Kind.Keyword)
    yield from _named(analysis.env, _Kind.Constant)
    yield from _named((*analysis.classes, *PRIMITIVES), _Kind.Class)
    if owner is None:
        main = analysis.model.main
        yield from _named((r.name for r in (main.rebecs if main else ())), _Kind.Variable)
        return
    yield from _locals(owner, offset)
    for variable in owner.variables.values():
        yield _item(variable.name, _Kind.Field, str(variable.type))
    yield from _callables(owner)
    yield from _named(("sender", *CLOCK), _Kind.Variable)
    yield from _named(FUNCTIONS, _Kind.Function)


def _class_at(analysis: Analysis, offset: int) -> ClassInfo | None:
    for info in analysis.classes.values():
        if info.declaration.span.start <= offset <= info.declaration.span.end:
            return info
    return None


def _members(
    analysis: Analysis, owner: ClassInfo | None, target: str
) -> Iterator[lsp.CompletionItem]:
    """What may stand behind the dot of `target.`: own members, or the servers of a rebec."""
    if owner is None:
        return
    if target in ("self", "super"):
        yield from (_item(v.name, _Kind.Field, str(v.type)) for v in owner.variables.values())
        yield from _callables(owner)
        return
    variable = owner.variables.get(target)
    type_ = variable.type if variable is not None else None
    info = analysis.classes.get(type_.name) if type_ is not None else None
    for server in info.servers if info is not None else ():
        yield _item(server.name, _Kind.Event, parameters(server.declaration))


def _callables(owner: ClassInfo) -> Iterator[lsp.CompletionItem]:
    for server in owner.servers:
        yield _item(server.name, _Kind.Event, parameters(server.declaration))
    for method in owner.methods:
        yield _item(method.name, _Kind.Method, parameters(method.declaration))


def _locals(owner: ClassInfo, offset: int) -> Iterator[lsp.CompletionItem]:
    """Parameters of the body around a place, and locals that are declared before it."""
    for member in m.children(owner.declaration):
        if not isinstance(member, m.Constructor | m.MessageServer | m.Method):
            continue
        if not member.span.start <= offset <= member.span.end:
            continue
        for node in m.walk(member):
            if isinstance(node, m.Parameter):
                yield _item(node.name, _Kind.Variable, str(node.type))
            elif isinstance(node, m.Declaration) and node.span.end <= offset:
                for declarator in node.declarators:
                    yield _item(declarator.name, _Kind.Variable, str(node.type))


def _in_properties(document: PropertyDocument, target: str | None) -> Iterator[lsp.CompletionItem]:
    model = document.model
    analysis = model.analysis if model is not None else None
    main = analysis.model.main if analysis is not None else None
    rebecs = {rebec.name: rebec.type for rebec in (main.rebecs if main is not None else ())}
    if target is not None:
        info = analysis.classes.get(rebecs[target].name) if analysis and target in rebecs else None
        for variable in info.state if info is not None else ():
            yield _item(variable.name, _Kind.Field, str(variable.type))
        return
    for name, type_ in rebecs.items():
        yield _item(name, _Kind.Variable, str(type_))
    yield from _named(analysis.env if analysis is not None else (), _Kind.Constant)
    yield from _named((d.name for d in document.parsed.properties.defines), _Kind.Constant)
    operators = (name for names in OPERATORS.values() for name in names)
    yield from _named(operators, _Kind.Function)
    yield from _named(("property", "define", *OPERATORS, "true", "false"), _Kind.Keyword)


def _named(names: Iterable[str], kind: _Kind) -> Iterator[lsp.CompletionItem]:
    yield from (_item(name, kind) for name in names)


def _item(name: str, kind: _Kind, detail: str | None = None) -> lsp.CompletionItem:
    return lsp.CompletionItem(name, kind=kind, detail=detail)
