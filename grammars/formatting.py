"""The canonical layout of a text."""

from __future__ import annotations

from heapq import merge

from rebsync.grammars.lexer import lex
from rebsync.layout import Token, layout_model
from rebsync.source import Source


def format_text(text: str) -> str:
    """A model that parses without errors, laid out; comments and the kind of line end are kept."""
    laid_out = layout_model(source_tokens(text.replace("\r\n", "\n").replace("\r", "\n")))
    return laid_out.replace("\n", "\r\n") if _uses_crlf(text) else laid_out


def source_tokens(text: str) -> list[Token]:
    """The tokens and comments of a text, in order, with their places."""
    source = Source("", text)
    lexed = lex(text)
    tokens = []
    for token in merge(lexed.tokens, lexed.comments, key=lambda t: t.start_pos or 0):
        place = source.position(token.start_pos or 0)
        tokens.append(Token(str(token), place.line, place.column))
    return tokens


def _uses_crlf(text: str) -> bool:
    end = text.find("\n")
    return end > 0 and text[end - 1] == "\r"
