"""The canonical layout: tokens and comments of a model become text, and none of them is lost.

Only blanks and line ends are decided here. The same engine serves `rebsync fmt`, with the tokens
of a source, and the printing of trees, with tokens that have no place.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from rebsync.lines import Token
from rebsync.token_writer import OPENING, Gap, TokenWriter

__all__ = ["Token", "layout_line", "layout_members", "layout_model", "layout_statements"]

_CLASSES = frozenset(("reactiveclass", "interface", "abstract"))
_SECTIONS = frozenset(("knownrebecs", "statevars"))

_Part: TypeAlias = Callable[[TokenWriter], None]


def layout_model(tokens: Sequence[Token]) -> str:
    """A whole model; ends with a line end unless it is empty."""
    return _laid_out(tokens, _model)


def layout_members(tokens: Sequence[Token]) -> str:
    """Members of a class, without indentation."""
    return _laid_out(tokens, _members)


def layout_statements(tokens: Sequence[Token]) -> str:
    """Statements, without indentation."""
    return _laid_out(tokens, _statements)


def layout_line(tokens: Sequence[Token]) -> str:
    """An expression or the like, on one line however long it is."""
    return TokenWriter(tokens).row()


def _laid_out(tokens: Sequence[Token], part: _Part) -> str:
    out = TokenWriter(tokens)
    while out.peek():
        part(out)
        if out.peek():
            out.take()  # a brace too many
    return out.text()


# --- models and classes ------------------------------------------------------------------------


def _model(out: TokenWriter) -> None:
    while head := out.peek_past_annotations():
        if head in _CLASSES:
            _annotation_lines(out)
            out.until("{")
            _braces(out, _members)
        elif head in ("main", "record"):
            out.until("{")
            _braces(out, _declarations)
        else:
            out.until(";")
            out.end()
        following = out.peek()
        out.gap = Gap.ALWAYS if following and following != head else Gap.KEEP
        if head in _CLASSES and following:
            out.gap = Gap.ALWAYS


def _members(out: TokenWriter) -> None:
    while out.peek() not in ("}", ""):
        bare = _member(out)
        if out.peek() not in ("}", "") and not (bare and _bare_member_ahead(out)):
            out.gap = Gap.ALWAYS


def _member(out: TokenWriter) -> bool:
    """One member; whether it was one without a body."""
    _annotation_lines(out)
    inner = _declarations if out.peek() in _SECTIONS else _statements
    if out.until("{", ";") != "{":
        out.end()
        return True
    _braces(out, inner)
    return False


def _bare_member_ahead(out: TokenWriter) -> bool:
    at = 0
    while (text := out.peek(at)) not in ("{", ";", ""):
        at += 1
    return text == ";"


def _declarations(out: TokenWriter) -> None:
    while out.peek() not in ("}", ""):
        out.until(";")
        out.end()


def _annotation_lines(out: TokenWriter) -> None:
    while out.peek() == "@":
        out.annotation()
        out.end()
        out.gap = Gap.NEVER


# --- statements --------------------------------------------------------------------------------


def _statements(out: TokenWriter) -> None:
    while out.peek() not in ("}", ""):
        _statement(out)


def _statement(out: TokenWriter) -> None:
    while out.peek() == "@":
        out.annotation()
    match out.peek():
        case "{":
            out.take()
            _braces(out, _statements)
        case "if":
            _if(out)
        case "while" | "for":
            _header(out)
            _body(out)
        case "switch":
            _header(out)
            out.until("{")
            _braces(out, _cases)
        case _:
            out.until(";")
            out.end()


def _if(out: TokenWriter) -> None:
    while True:
        _header(out)
        braced = out.peek() == "{"
        _body(out, end=False)
        if out.peek() != "else":
            break
        if not braced:
            out.end()
        out.take()
        if out.peek() != "if":
            _body(out)
            break
    out.end()


def _header(out: TokenWriter) -> None:
    out.take()
    out.brackets()


def _body(out: TokenWriter, end: bool = True) -> None:
    """The statement that a header governs; without braces it stands on a line of its own."""
    if out.peek() == "{":
        out.take()
        _braces(out, _statements, end)
        return
    out.end()
    out.gap = Gap.NEVER
    out.indent(1)
    _statement(out)
    out.indent(-1)


def _cases(out: TokenWriter) -> None:
    inside = 0
    while out.peek() not in ("}", ""):
        if out.peek_past_annotations() in ("case", "default"):
            out.indent(-inside)
            _case_label(out)
            inside = 1
            out.indent(inside)
        else:
            _statement(out)
    out.comments(closing=True)
    out.indent(-inside)


def _case_label(out: TokenWriter) -> None:
    while out.peek() == "@":
        out.annotation()
    conditionals = 0
    while (text := out.peek()) not in ("{", ";", ""):
        conditionals += out.at_conditional()
        if text in OPENING:
            out.brackets()
            continue
        out.take()
        if text == ":" and not conditionals:
            break
        conditionals -= text == ":"
    out.end()
    out.gap = Gap.NEVER


# --- braces ------------------------------------------------------------------------------------


def _braces(out: TokenWriter, inner: _Part, end: bool = True) -> None:
    """What follows an opening brace, up to and with the closing one."""
    if out.peek() == "}" and not out.comment_ahead():
        out.take()
    else:
        out.end()
        out.gap = Gap.NEVER
        out.indent(1)
        inner(out)
        out.comments(closing=True)
        out.indent(-1)
        out.gap = Gap.NEVER
        if out.peek():
            out.take()
    if end:
        out.end()
