"""Text to tokens, and what a token means when its neighbours decide it.

A name becomes TYPE_ID where it is a type, "(" becomes CAST, "?" becomes CHOICE: see the head of
timed_rebeca.lark. Each of these is one pass over the tokens, so lexing stays linear.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files

from lark import Lark, Token

from rebsync.diagnostics import Diagnostic, Edit, closest
from rebsync.grammars.tables import load
from rebsync.grammars.tree import TreeBuilder
from rebsync.source import Span

_TRIVIA = frozenset({"COMMENT", "OPEN_COMMENT", "OPEN_STRING", "ILLEGAL"})
_BEFORE_CAST = frozenset({"ID", "TYPE_ID", "IF", "WHILE", "SWITCH", "FOR", "AFTER", "DEADLINE"})
_OPERANDS = frozenset(
    {
        *("ID", "INT", "FLOAT", "STRING", "CHAR", "TRUE", "FALSE", "NULL"),
        *("SELF", "SUPER", "NEW", "LPAR", "CHOICE"),
    }
)
_NO_ARGUMENTS = frozenset({"ϕ", "φ", "∅"})
_SECTIONS = ("knownrebecs", "statevars", "main")
_BEFORE_NAMED_BRACE = frozenset({"INTERFACE", "EXTENDS", "IMPLEMENTS", "COMMA", "RECORD", "DOT"})
MAX_NESTING = 200


@dataclass(frozen=True, slots=True)
class Lexed:
    """The tokens of a text: `tokens` for the parser, `comments` in order of place."""

    tokens: list[Token]
    comments: tuple[Token, ...]
    diagnostics: tuple[Diagnostic, ...]

    @property
    def everything(self) -> list[Token]:
        """Tokens and comments together, in order of place."""
        return sorted((*self.tokens, *self.comments), key=lambda t: t.start_pos or 0)


@cache
def rebeca_grammar() -> Lark:
    """The compiled grammar of Timed Rebeca; reducing a rule builds its tree node."""
    text = files("rebsync.grammars").joinpath("timed_rebeca.lark").read_text(encoding="utf-8")
    return load(
        text, start=["model", "statement", "expression", "trivia"], transformer=TreeBuilder()
    )


def token_span(token: Token) -> Span:
    """The place of a token."""
    start = token.start_pos or 0
    return Span(start, start + len(token))


def lex(text: str) -> Lexed:
    """All tokens of a text; what belongs to no token becomes a diagnostic."""
    everything = list(rebeca_grammar().lex(text))
    scan = _Scan([t for t in everything if t.type not in _TRIVIA])
    for token in everything:
        if token.type in _TRIVIA and token.type != "COMMENT":
            scan.diagnostics.append(_illegal(token))
    scan.run()
    comments = tuple(t for t in everything if t.type in ("COMMENT", "OPEN_COMMENT"))
    return Lexed(scan.tokens, comments, tuple(scan.diagnostics))


def _illegal(token: Token) -> Diagnostic:
    span = token_span(token)
    match token.type:
        case "OPEN_COMMENT":
            return Diagnostic("RS103", Span(span.start, span.start + 2), "this comment never ends")
        case "OPEN_STRING":
            return Diagnostic("RS103", span, "this string does not end on its line")
        case _:
            return Diagnostic("RS102", span, f'the character "{token}" is not part of the language')


def retyped(token: Token, kind: str, text: str | None = None) -> Token:
    """The same token under another type (and text)."""
    return Token(kind, str(token) if text is None else text, token.start_pos)


@dataclass(slots=True)
class _Scan:
    """One walk over the tokens that gives each its final type."""

    tokens: list[Token]
    diagnostics: list[Diagnostic] = field(default_factory=list)

    def run(self) -> None:
        self._refuse_literals()
        self._mend_section_names()
        self._drop_empty_set_signs()
        self._mend_angle_choices()
        self._mark_choices()
        self._mark_types_and_casts()

    def _refuse_literals(self) -> None:
        for token in self.tokens:
            if token.type == "CHAR":
                self._refuse(token, "character literals are not part of Timed Rebeca")
            elif token.type == "INT" and token[-1] in "lL":
                self._refuse(token, "there are no long literals; an int has 32 bits")

    def _refuse(self, token: Token, why: str) -> None:
        self.diagnostics.append(Diagnostic("RS110", token_span(token), why))

    def _mend_section_names(self) -> None:
        """A name right before `{` is a misspelled section: nothing else stands there."""
        for i in range(1, len(self.tokens) - 1):
            token = self.tokens[i]
            if token.type != "ID" or self.tokens[i + 1] != "{":
                continue
            if self.tokens[i - 1].type in _BEFORE_NAMED_BRACE:
                continue
            word = closest(token, _SECTIONS)
            if word is None:
                continue
            span = token_span(token)
            self.tokens[i] = retyped(token, word.upper(), word)
            self.diagnostics.append(
                Diagnostic(
                    "RS104",
                    span,
                    f'"{token}" is not a section of a model',
                    f'did you mean "{word}"?',
                    edits=(Edit(span, word),),
                )
            )

    def _drop_empty_set_signs(self) -> None:
        """`(ϕ)`, the thesis's sign for no arguments, is `()`."""
        tokens = self.tokens
        for i in range(len(tokens) - 2, 0, -1):
            if tokens[i] in _NO_ARGUMENTS and tokens[i - 1] == "(" and tokens[i + 1] == ")":
                span = token_span(tokens.pop(i))
                self.diagnostics.append(
                    Diagnostic(
                        "RS101", span, "an empty list is written `()`", edits=(Edit(span, ""),)
                    )
                )

    def _mend_angle_choices(self) -> None:
        """`?<a, b>` of the thesis stands for `?(a, b)`."""
        tokens = self.tokens
        for i in range(len(tokens) - 1):
            if tokens[i] != "?" or tokens[i + 1] != "<":
                continue
            end = next((j for j in range(i + 2, len(tokens)) if tokens[j] in (">", ";", "}")), None)
            if end is None or tokens[end] != ">":
                continue
            opening, closing = token_span(tokens[i + 1]), token_span(tokens[end])
            tokens[i + 1] = retyped(tokens[i + 1], "LPAR", "(")
            tokens[end] = retyped(tokens[end], "RPAR", ")")
            self.diagnostics.append(
                Diagnostic(
                    "RS107",
                    opening.to(closing),
                    "a nondeterministic expression takes parentheses",
                    "write `?(a, b)`",
                    edits=(Edit(opening, "("), Edit(closing, ")")),
                )
            )

    def _mark_choices(self) -> None:
        """`?` before a parenthesis that holds a comma is a choice, else the `?` of `?:`."""
        opened: list[int] = []
        for i, token in enumerate(self.tokens):
            match token.type:
                case "LPAR" | "LSQB" | "LBRACE":
                    opened.append(i)
                    if len(opened) == MAX_NESTING + 1:
                        self._too_deep(token)
                case "RPAR" | "RSQB" | "RBRACE":
                    if opened:
                        opened.pop()
                case "COMMA" if opened:
                    at = opened[-1] - 1
                    if at >= 0 and self.tokens[at] == "?" and self.tokens[at + 1] == "(":
                        self.tokens[at] = retyped(self.tokens[at], "CHOICE")

    def _too_deep(self, token: Token) -> None:
        self.diagnostics.append(
            Diagnostic(
                "RS111",
                token_span(token),
                f"brackets are nested deeper than {MAX_NESTING} levels",
                "split the expression or move a part into a method",
            )
        )

    def _mark_types_and_casts(self) -> None:
        tokens = self.tokens
        for i, token in enumerate(tokens):
            if token.type != "ID":
                continue
            end = self._after_dimensions(i)
            if end >= len(tokens):
                continue
            if tokens[end].type == "ID" or self._is_keyword_as_name(end):
                tokens[i] = retyped(token, "TYPE_ID")
            elif self._is_cast(i, end):
                tokens[i - 1] = retyped(tokens[i - 1], "CAST")
                tokens[i] = retyped(token, "TYPE_ID")

    def _is_keyword_as_name(self, i: int) -> bool:
        """`int after;`: a keyword where a declared name is due; the parser will say so."""
        token = self.tokens[i]
        if not token.isidentifier() or token.type in ("ID", "INSTANCEOF"):
            return False
        return i + 1 < len(self.tokens) and self.tokens[i + 1] in (";", "=", ",", ")")

    def _is_cast(self, name: int, end: int) -> bool:
        tokens = self.tokens
        return (
            name > 0
            and tokens[name - 1] == "("
            and tokens[end] == ")"
            and end + 1 < len(tokens)
            and tokens[end + 1].type in _OPERANDS
            and (name < 2 or tokens[name - 2].type not in _BEFORE_CAST)
        )

    def _after_dimensions(self, name: int) -> int:
        """The index of the token that follows a name and its literal dimensions."""
        tokens, i = self.tokens, name + 1
        while (
            i + 2 < len(tokens)
            and tokens[i] == "["
            and tokens[i + 1].type == "INT"
            and tokens[i + 2] == "]"
        ):
            i += 3
        return i
