"""Small repairs of a token sequence, each with the diagnostic that explains it."""

from __future__ import annotations

from collections.abc import Iterator

from lark import Lark, Token
from lark.lexer import PatternStr

from rebsync.diagnostics import Diagnostic, Edit, closest
from rebsync.grammars.lexer import retyped, token_span
from rebsync.records import dataclass
from rebsync.source import Span

_INSERTABLE = (("SEMICOLON", ";"), ("RPAR", ")"), ("RBRACE", "}"), ("LBRACE", "{"), ("LPAR", "("))
_MORE_INSERTABLE = (("RSQB", "]"), ("COLON", ":"), ("COMMA", ","))
_READABLE = {"ID": "a name", "TYPE_ID": "a type", "INT": "a number", "$END": "the end of the file"}
_EXPRESSION_STARTS = frozenset({"STRING", "FLOAT", "TRUE", "SELF"})


@dataclass(frozen=True, slots=True)
class Repair:
    """Read `tokens` in place of the next `consumed` tokens.

    `convincing` is how many tokens behind it must then be read for the repair to be taken.
    """

    tokens: tuple[Token, ...]
    consumed: int
    diagnostic: Diagnostic
    convincing: int = 3


def literal_of(grammar: Lark, terminal: str) -> str | None:
    """The text of a keyword or sign; None for terminals of many texts."""
    if terminal in ("$END", "TYPE_ID", "CAST", "CHOICE"):
        return None
    pattern = grammar.get_terminal(terminal).pattern
    return str(pattern.value) if isinstance(pattern, PatternStr) else None


def expected(grammar: Lark, accepted: set[str]) -> str | None:
    """A hint of what may stand here, where it is short enough to help."""
    if accepted >= _EXPRESSION_STARTS:
        return "expected an expression"
    words = []
    for terminal in sorted(accepted - {"CAST", "CHOICE"}):
        text = literal_of(grammar, terminal)
        words.append(_READABLE.get(terminal) or (f"`{text}`" if text else None))
    known = [w for w in words if w]
    if not known or len(known) > 6:
        return None
    return "expected " + (", ".join(known[:-1]) + " or " if len(known) > 1 else "") + known[-1]


def candidates(
    grammar: Lark, tokens: list[Token], i: int, token: Token, accepted: set[str]
) -> Iterator[Repair]:
    """The repairs to try at a token that is not accepted, likeliest first."""
    yield from _misspelled_keyword(grammar, token, accepted)
    yield from _other_kind(token, accepted)
    yield from _untyped_parameter(tokens, i, token, accepted)
    before = tokens[i - 1] if i else None
    for terminal, text in (*_INSERTABLE, *_MORE_INSERTABLE):
        if terminal in accepted:
            yield _insertion(before, token, terminal, text)
    if token.type != "$END":
        yield _deletion(grammar, token, accepted)


def _misspelled_keyword(grammar: Lark, token: Token, accepted: set[str]) -> Iterator[Repair]:
    if token.type not in ("ID", "TYPE_ID"):
        return
    keywords = {text: t for t in accepted if (text := literal_of(grammar, t)) and text.isalpha()}
    word = closest(token, keywords)
    if word is None:
        return
    span = token_span(token)
    yield Repair(
        (retyped(token, keywords[word], word),),
        1,
        Diagnostic(
            "RS104",
            span,
            f'"{token}" is not a keyword',
            f'did you mean "{word}"?',
            edits=(Edit(span, word),),
        ),
    )


def _other_kind(token: Token, accepted: set[str]) -> Iterator[Repair]:
    """A keyword where a name is due; or a name taken for a type since the next mistake follows."""
    span = token_span(token)
    name = next((t for t in ("ID", "TYPE_ID") if t in accepted), None)
    if name is None or token.type == "$END":
        return
    if token.type in ("ID", "TYPE_ID"):
        diagnostic = Diagnostic("RS101", span, f"unexpected `{token}`")
        yield Repair((retyped(token, name),), 1, diagnostic)
    elif token.isidentifier():
        diagnostic = Diagnostic(
            "RS101", span, f'"{token}" is a keyword and cannot be a name', "choose another name"
        )
        yield Repair((retyped(token, name),), 1, diagnostic)


def _untyped_parameter(
    tokens: list[Token], i: int, token: Token, accepted: set[str]
) -> Iterator[Repair]:
    if token.type != "ID" or "TYPE_ID" not in accepted or i + 1 >= len(tokens) or i == 0:
        return
    if tokens[i + 1].type not in ("COMMA", "RPAR") or tokens[i - 1].type not in ("COMMA", "LPAR"):
        return
    yield Repair(
        (retyped(token, "TYPE_ID", "int"), token),
        1,
        Diagnostic(
            "RS108",
            token_span(token),
            f'the parameter "{token}" has no type',
            f"write its type before it, such as `int {token}`",
        ),
        convincing=1,
    )


def _insertion(before: Token | None, token: Token, terminal: str, text: str) -> Repair:
    place = token_span(before).end if before is not None else 0
    code = "RS106" if text in "{}" else "RS105"
    where = f"`{token}`" if token.type != "$END" else "the end of the file"
    diagnostic = Diagnostic(
        code,
        Span(place, place + 1),
        f"`{text}` is missing before {where}",
        edits=(Edit(Span(place, place), text),) if text in ";" else (),
    )
    return Repair((Token(terminal, text, place),), 0, diagnostic)


def _deletion(grammar: Lark, token: Token, accepted: set[str]) -> Repair:
    if token.type == "RBRACE":
        diagnostic = Diagnostic("RS106", token_span(token), "a `}` too many")
    else:
        hint = expected(grammar, accepted)
        diagnostic = Diagnostic("RS101", token_span(token), f"unexpected `{token}`", hint)
    return Repair((), 1, diagnostic)
