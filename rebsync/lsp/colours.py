"""Semantic tokens: what the names of a document are; keywords are left to the grammar."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsprotocol import types as lsp

from rebsync import model as m
from rebsync.lsp.document import Document, ModelDocument

_Type, _Modifier = lsp.SemanticTokenTypes, lsp.SemanticTokenModifiers
_TYPES = {
    "reactiveclass": _Type.Class,
    "rebec": _Type.Variable,
    "knownrebec": _Type.Variable,
    "local": _Type.Variable,
    "statevar": _Type.Property,
    "msgsrv": _Type.Method,
    "method": _Type.Method,
    "env": _Type.Variable,
    "define": _Type.Variable,
    "property": _Type.Function,
}
_CONSTANTS = ("env", "define")
# Comments and texts, in which an annotation is none.
_ANNOTATION = re.compile(r'//[^\n]*|/\*.*?(?:\*/|\Z)|"(?:[^"\\\n]|\\.)*"|(@[\w$]*)', re.DOTALL)
LEGEND = lsp.SemanticTokensLegend(
    [t.value for t in (*dict.fromkeys(_TYPES.values()), _Type.Parameter, _Type.Decorator)],
    [_Modifier.Declaration.value, _Modifier.Readonly.value],
)
_NUMBERS = {name: number for number, name in enumerate(LEGEND.token_types)}


def semantic_tokens(document: Document) -> lsp.SemanticTokens:
    """The names of a document, each by its distance from the one before, as the protocol says."""
    source = document.source
    data: list[int] = []
    line_before, before = 1, 0
    for start, (end, type_, modifiers) in sorted(_names(document).items()):
        line = source.position(start).line
        if line != line_before:
            before = source.start_of(line)
        column, length = _utf16(source.text[before:start]), _utf16(source.text[start:end])
        data += (line - line_before, column, length, _NUMBERS[type_], modifiers)
        line_before, before = line, start
    return lsp.SemanticTokens(data)


def _utf16(text: str) -> int:
    """How many units of the protocol a text has."""
    return len(text) if text.isascii() else len(text.encode("utf-16-le", "surrogatepass")) // 2


def _names(document: Document) -> dict[int, tuple[int, str, int]]:
    """By the offset in the text where a name begins: its end, its type, its modifiers as bits."""
    to_text = document.layout.to_text
    found = {start: (end, _Type.Decorator, 0) for start, end in _annotations(document)}
    parameters = {o.entity for o in document.occurrences if isinstance(o.declares, m.Parameter)}
    for each in document.occurrences:
        type_ = _Type.Parameter if each.entity in parameters else _TYPES[each.entity.kind]
        modifiers = 1 * (each.declares is not None) | 2 * (each.entity.kind in _CONSTANTS)
        found[to_text(each.span.start)] = (to_text(each.span.end), type_, modifiers)
    return {start: name for start, name in found.items() if start < name[0]}


def _annotations(document: Document) -> Iterator[tuple[int, int]]:
    """Where the annotations of a model stand, without what is in parentheses behind them."""
    if isinstance(document, ModelDocument):
        for sign in _ANNOTATION.finditer(document.source.text):
            if sign[1]:
                yield sign.span(1)
