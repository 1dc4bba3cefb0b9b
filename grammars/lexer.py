"""Text to tokens, and what a token means when its neighbours decide it.

A name becomes TYPE_ID where it is a type, "(" becomes CAST, "?" becomes CHOICE: see the head of
timed_rebeca.lark. Each of these is one pass over the tokens, so lexing stays linear.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import field
from functools import cache
from importlib.resources import files
from itertools import zip_longest

from lark import Lark, Token

from rebsync.diagnostics import Diagnostic, Edit, closest
from rebsync.grammars.amount import too_large
from rebsync.grammars.tables import load
from rebsync.grammars.tree import TreeBuilder
from rebsync.records import dataclass
from rebsync.source import Span
from rebsync.terminal import controls_in_text, with_escapes

_TRIVIA = frozenset({"COMMENT", "OPEN_COMMENT", "OPEN_STRING", "ILLEGAL"})
_TEXTS = frozenset({"COMMENT", "STRING"})
_BEFORE_CAST = frozenset({"ID", "TYPE_ID", "IF", "WHILE", "SWITCH", "FOR", "AFTER", "DEADLINE"})
_OPERANDS = frozenset(
    {
        *("ID", "INT", "FLOAT", "STRING", "CHAR", "TRUE", "FALSE", "NULL"),
        *("SELF", "SUPER", "NEW", "LPAR", "CHOICE"),
    }
)
_SIGNS = frozenset({"-", "+", "~"})
_NUMBERS = frozenset({"byte", "short", "int", "float", "double"})
_OPERAND_ENDS = (_OPERANDS - {"LPAR", "NEW", "CHOICE"}) | {"RPAR", "RSQB", "INC", "DEC"}
_NO_ARGUMENTS = frozenset({"ϕ", "φ", "∅"})
_SECTIONS = ("knownrebecs", "statevars", "main")
_BEFORE_NAMED_BRACE = frozenset({"INTERFACE", "EXTENDS", "IMPLEMENTS", "COMMA", "RECORD", "DOT"})
_SERVER_WORDS = ("msgsrv",)
_OPENED, _CLOSED = frozenset("([{"), frozenset(")]}")
MAX_NESTING = 100
MAX_CHAIN = 200


@dataclass(frozen=True, slots=True)
class Lexed:
    """The tokens of a text: `tokens` for the parser, `comments` in order of place."""

    tokens: list[Token]
    comments: tuple[Token, ...]
    diagnostics: tuple[Diagnostic, ...]

    @property
    def hopeless(self) -> bool:
        """Whether parsing would only add follow-up mistakes: another language, or too much."""
        return any(d.code in ("RS111", "RS113", "RS115") for d in self.diagnostics)

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


def keywords(grammar: Lark) -> frozenset[str]:
    """The words that a grammar reserves."""
    words = (terminal.pattern.value for terminal in grammar.terminals)
    return frozenset(word for word in words if word.isalpha() and word.isascii())


def token_span(token: Token) -> Span:
    """The place of a token."""
    start = token.start_pos or 0
    return Span(start, start + len(token))


def lex(text: str, start: int = 0) -> Lexed:
    """All tokens of a text; what belongs to no token becomes a diagnostic.

    Places count from `start`, where the text is a part of a larger one.
    """
    if (mistake := too_large(text)) is not None:
        return Lexed([], (), (mistake,))
    everything = list(_not_too_deep(rebeca_grammar().lex(text)))
    for token in everything if start else ():
        token.start_pos = (token.start_pos or 0) + start
    scan = _Scan([t for t in everything if t.type not in _TRIVIA])
    for token in everything:
        if token.type in _TRIVIA and token.type != "COMMENT":
            scan.diagnostics.append(_illegal(token))
    scan.diagnostics += controls(everything)
    scan.run()
    comments = tuple(t for t in everything if t.type in ("COMMENT", "OPEN_COMMENT"))
    return Lexed(scan.tokens, comments, tuple(scan.diagnostics))


def controls(tokens: Iterable[Token]) -> list[Diagnostic]:
    """Characters in texts and comments that terminals and editors obey instead of showing them."""
    found = []
    for token in tokens:
        if token.type in _TEXTS and (control := controls_in_text(token)) is not None:
            at = (token.start_pos or 0) + control.start()
            what = "text" if token.type == "STRING" else "comment"
            message = f"a {what} holds the control character U+{ord(control[0]):04X}"
            hint = f"write {with_escapes(control[0])} instead" if what == "text" else None
            found.append(Diagnostic("RS114", Span(at, at + 1), message, hint))
    return found


def _not_too_deep(tokens: Iterable[Token]) -> Iterator[Token]:
    """The tokens up to the first bracket that nests too deeply: the rest is not read anyway."""
    depth = 0
    for token in tokens:
        yield token
        if token in _OPENED:
            depth += 1
            if depth > MAX_NESTING:
                return
        elif token in _CLOSED:
            depth = max(depth - 1, 0)


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
        self._refuse_other_languages()
        self._refuse_literals()
        self._mend_section_names()
        self._mend_server_keywords()
        self._drop_empty_set_signs()
        self._mend_angle_choices()
        self._mark_choices()
        self._measure_chains()
        self._mark_types_and_casts()

    def _refuse_other_languages(self) -> None:
        """Hybrid and Probabilistic Rebeca are told from a mistake by their first words."""
        for i in range(len(self.tokens) - 3):
            one, two, three, four = self.tokens[i : i + 4]
            if one == "physicalclass" and two.type == "ID":
                self._refuse(one, f'"{one}" belongs to Hybrid Rebeca', "RS113")
            elif one == "pAlt" and two == "{":
                self._refuse(one, f'"{one}" belongs to Probabilistic Rebeca', "RS113")
            elif one == "?" and two == "(" and three.type == "FLOAT" and four == ":":
                self._refuse(three, "probabilities belong to Probabilistic Rebeca", "RS113")

    def _refuse_literals(self) -> None:
        for token in self.tokens:
            if token.type == "CHAR":
                self._refuse(token, "character literals are not part of Timed Rebeca")
            elif token.type == "INT" and token[-1] in "lL":
                self._refuse(token, "there are no long literals; an int has 32 bits")

    def _refuse(self, token: Token, why: str, code: str = "RS110") -> None:
        hint = "rebsync reads Timed Rebeca" if code == "RS113" else None
        self.diagnostics.append(Diagnostic(code, token_span(token), why, hint))

    def _mend_server_keywords(self) -> None:
        """`msgserv m(...)` reads like a method that returns a `msgserv`."""
        names = {
            str(after)
            for token, after in zip(self.tokens, self.tokens[1:], strict=False)
            if token.type in ("REACTIVECLASS", "INTERFACE")
        }
        for i in range(1, len(self.tokens) - 2):
            token, name, bracket = self.tokens[i : i + 3]
            if token.type != "ID" or name.type != "ID" or bracket != "(" or str(token) in names:
                continue
            if self.tokens[i - 1].type in ("LBRACE", "RBRACE", "RPAR", "ABSTRACT") and closest(
                token, _SERVER_WORDS
            ):
                self._misspelled(i, "msgsrv", "a keyword")

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
            self._misspelled(i, word, "a section of a model")

    def _misspelled(self, i: int, word: str, what: str) -> None:
        token, span = self.tokens[i], token_span(self.tokens[i])
        self.tokens[i] = retyped(token, word.upper(), word)
        message, hint = f'"{token}" is not {what}', f'did you mean "{word}"?'
        edits = (Edit(span, word),)
        self.diagnostics.append(Diagnostic("RS104", span, message, hint, edits=edits))

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
        end = 0
        for i in range(len(tokens) - 1):
            if tokens[i] != "?" or tokens[i + 1] != "<":
                continue
            end = max(end, i + 2)
            while end < len(tokens) and tokens[end] not in (">", ";", "}"):
                end += 1
            if end == len(tokens):
                return
            if tokens[end] != ">":
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
        """`?(` is a choice where no operand comes before it, or where a comma is in it."""
        opened: list[int] = []
        for i, token in enumerate(self.tokens):
            match token.type:
                case "QMARK" if i and self.tokens[i - 1].type not in _OPERAND_ENDS:
                    if self.tokens[i + 1 : i + 2] == ["("]:
                        self.tokens[i] = retyped(token, "CHOICE")
                case "LPAR" | "LSQB" | "LBRACE":
                    opened.append(i)
                    if len(opened) == MAX_NESTING + 1:
                        self._too_deep(
                            token, f"brackets are nested deeper than {MAX_NESTING} levels"
                        )
                case "RPAR" | "RSQB" | "RBRACE":
                    if opened:
                        opened.pop()
                case "COMMA" if opened:
                    at = opened[-1] - 1
                    if at >= 0 and self.tokens[at] == "?" and self.tokens[at + 1] == "(":
                        self.tokens[at] = retyped(self.tokens[at], "CHOICE")

    def _measure_chains(self) -> None:
        """Operators, statements in statements, and `else` upon `else` nest without braces."""
        operators = heads = brackets = 0
        branches = [0]
        for token, after in zip_longest(self.tokens, self.tokens[1:]):
            match token.type:
                case "ELSE" if after is not None and after.type != "LBRACE":
                    branches[-1] += 1
                    if branches[-1] == MAX_CHAIN + 1:
                        self._too_deep(token, f"there are more than {MAX_CHAIN} `else` in a row")
                case "BINARY" | "PLUS" | "MINUS" | "QMARK" | "EQUAL" | "BANG" | "TILDE":
                    operators += 1
                    if operators == MAX_CHAIN + 1:
                        message = f"there are more than {MAX_CHAIN} operators in one expression"
                        self._too_deep(token, message)
                case "IF" | "WHILE" | "FOR":
                    heads += 1
                    if heads == MAX_NESTING + 1:
                        message = f"statements are nested deeper than {MAX_NESTING} levels"
                        self._too_deep(token, message)
                case "LPAR" | "CAST":
                    brackets += 1
                case "RPAR":
                    brackets = max(brackets - 1, 0)
                case "LBRACE":
                    branches.append(0)
                    operators = heads = brackets = 0
                case "SEMICOLON" | "RBRACE" | "COMMA":
                    operators = 0
                    if not brackets or token.type == "RBRACE":
                        heads = brackets = 0
                    if token.type == "RBRACE" and len(branches) > 1:
                        branches.pop()
                    if after is None or after.type != "ELSE":
                        branches[-1] = 0

    def _too_deep(self, token: Token, message: str) -> None:
        hint = "split it up, or move a part into a method"
        self.diagnostics.append(Diagnostic("RS111", token_span(token), message, hint))

    def _mark_types_and_casts(self) -> None:
        tokens = self.tokens
        for i, token in enumerate(tokens):
            if token.type != "ID" or (i and tokens[i - 1] == "@"):
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
            and (
                tokens[end + 1].type in _OPERANDS
                or (tokens[end + 1] in _SIGNS and tokens[name] in _NUMBERS)
            )
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
