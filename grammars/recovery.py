"""LALR parsing that goes on after a mistake.

At a token that the grammar does not allow, small repairs are tried on a copy of the parser that
builds nothing; the one that lets it read furthest is taken and reported. Where none helps, the
rest of the statement or member is skipped.
"""

from __future__ import annotations

from copy import copy
from typing import cast

from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedToken

from rebsync.diagnostics import Diagnostic
from rebsync.grammars.lexer import token_span
from rebsync.grammars.repairs import candidates, expected
from rebsync.source import Span

_LOOKAHEAD = 8
_MOST_MISTAKES = 200
_OPENING = {"LBRACE": "RBRACE", "LPAR": "RPAR", "LSQB": "RSQB", "CAST": "RPAR"}
_MEMBERS = frozenset({"MSGSRV", "STATEVARS", "KNOWNREBECS"})
# lark names the helper rule of `x: item*` after the rule that it stands in
_LISTS = tuple(
    f"__{rule}_star"
    for rule in (
        *("model", "block", "switch", "reactive_class", "interface", "refused"),
        *("known_rebecs", "state_vars", "main"),
    )
)
_STARTS = _MEMBERS | {"REACTIVECLASS", "MAIN", "ENV", "INTERFACE", "ABSTRACT"}


class RecoveringParser:
    """One parse of a list of tokens; `diagnostics` holds the mistakes that were met."""

    def __init__(self, grammar: Lark, start: str, tokens: list[Token]) -> None:
        self.grammar = grammar
        self.start = start
        self.tokens = tokens
        self.diagnostics: list[Diagnostic] = []
        self._kept: list[Diagnostic] = []
        self._quiet_until = -1
        self._parser = grammar.parse_interactive("", start=start)

    def run(self) -> object:
        """The value of the start rule; None where nothing could be made of the text."""
        i = 0
        while len(self.diagnostics) < _MOST_MISTAKES:
            token = self.tokens[i] if i < len(self.tokens) else self._end()
            try:
                result = self._parser.feed_token(token)
            except UnexpectedToken:
                i = self._recover(i, token)
                continue
            if token.type == "$END":
                return result
            i += 1
        return None

    def _end(self) -> Token:
        last = self.tokens[-1] if self.tokens else None
        return Token("$END", "", (last.start_pos or 0) + len(last) if last is not None else 0)

    # --- choosing a repair ---------------------------------------------------------------------

    def _recover(self, i: int, token: Token) -> int:
        accepted = cast("set[str]", self._parser.accepts())  # type: ignore[no-untyped-call]
        if token.type == "$END" and "RBRACE" in accepted:
            return self._close(i, token)
        again = self._reopen_class(i, token)
        if again is not None:
            return again
        best, reach = None, 0
        for repair in candidates(self.grammar, self.tokens, i, token, accepted):
            read = self._trial([*repair.tokens, *self._from(i + repair.consumed)])
            if read - len(repair.tokens) > reach:
                best, reach = repair, read - len(repair.tokens)
        if best is not None and reach >= min(best.convincing, len(self._from(i))):
            self._report(i, best.diagnostic)
            for new in best.tokens:
                self._parser.feed_token(new)
            self._quiet_until = i
            return i + best.consumed
        self._report(i, self._unexpected(token, accepted))
        return self._skip(i)

    def _close(self, i: int, end: Token) -> int:
        """At the end of the file, close what is open; one report is enough for all of it."""
        place = end.start_pos or 0
        message = "`}` is missing before the end of the file"
        self._report(i, Diagnostic("RS106", Span(max(place - 1, 0), place), message))
        self._quiet_until = i
        self._parser.feed_token(Token("RBRACE", "}", place))
        return i

    def _from(self, i: int) -> list[Token]:
        rest = self.tokens[i : i + _LOOKAHEAD]
        return rest if len(rest) == _LOOKAHEAD else [*rest, self._end()]

    def _trial(self, tokens: list[Token], depth: int | None = None) -> int:
        """How many of the tokens a copy of the parser reads, its stack cut to `depth`."""
        trial = self._parser.parser_state.copy(deepcopy_values=False)
        trial.parse_conf = copy(trial.parse_conf)
        trial.parse_conf.callbacks = {}
        if depth is not None:
            del trial.state_stack[depth:], trial.value_stack[depth - 1 :]
        for count, token in enumerate(tokens):
            try:
                trial.feed_token(token, token.type == "$END")
            except UnexpectedToken:
                return count
        return len(tokens)

    def _report(self, i: int, diagnostic: Diagnostic) -> None:
        if i > self._quiet_until:
            self.diagnostics.append(diagnostic)

    def _unexpected(self, token: Token, accepted: set[str]) -> Diagnostic:
        hint = expected(self.grammar, accepted)
        if token.type == "$END":
            span = token_span(self.tokens[-1]) if self.tokens else Span(0, 0)
            return Diagnostic("RS109", span, "the file ends here too early", hint)
        return Diagnostic("RS101", token_span(token), f"unexpected `{token}`", hint)

    # --- what small repairs cannot mend --------------------------------------------------------

    def _reopen_class(self, i: int, token: Token) -> int | None:
        """Members behind the `}` of a class: one brace too many came before them."""
        if token.type not in _MEMBERS or self._depth(i) != 0:
            return None
        closing = next((k for k in range(i - 1, -1, -1) if self.tokens[k].type == "RBRACE"), None)
        if closing is None or not any(t.type == "REACTIVECLASS" for t in self.tokens[:closing]):
            return None
        self._kept.append(
            Diagnostic(
                "RS106",
                token_span(self.tokens[closing]),
                f"this `}}` ends the class, but `{token}` follows",
                "take out one `}` at or before this place",
                related=((token_span(token), "this belongs into a class"),),
            )
        )
        del self.tokens[closing]
        self.diagnostics = list(self._kept)
        self._quiet_until = -1
        self._parser = self.grammar.parse_interactive("", start=self.start)
        return 0

    def _depth(self, i: int) -> int:
        opened = sum(t.type == "LBRACE" for t in self.tokens[:i])
        return opened - sum(t.type == "RBRACE" for t in self.tokens[:i])

    def _skip(self, i: int) -> int:
        """Skip to the end of the statement or member and forget what was read of it."""
        j = self._end_of_part(i)
        state = self._parser.parser_state
        boundaries = [d for d in range(len(state.state_stack), 0, -1) if self._at_boundary(d)]
        ahead, closing = self._from(j)[:2], [Token("RBRACE", "}")]
        if j == len(self.tokens) and any(self._trial(closing, d) for d in boundaries):
            ahead = closing  # what is open at the end of the file is closed next
        fits = (d for d in boundaries if self._trial(ahead, d) == len(ahead))
        depth = next(fits, boundaries[0])
        del state.state_stack[depth:], state.value_stack[depth - 1 :]
        self._quiet_until = j if ahead is closing else j - 1
        return j

    def _at_boundary(self, depth: int) -> bool:
        """Whether a stack cut to `depth` stands between two members, statements or the like."""
        if depth == 1:
            return True
        top = self._parser.parser_state.value_stack[depth - 2]
        if isinstance(top, Token):
            return bool(top.type == "LBRACE")
        return isinstance(top, Tree) and str(top.data).startswith(_LISTS)

    def _end_of_part(self, i: int) -> int:
        closers: list[str] = []
        for j in range(i, len(self.tokens)):
            kind = self.tokens[j].type
            if kind in _STARTS and j > i:
                return j
            if kind in _OPENING:
                closers.append(_OPENING[kind])
            elif closers and kind == closers[-1]:
                closers.pop()
                if not closers and kind == "RBRACE":
                    return j + 1
            elif not closers and kind == "SEMICOLON":
                return j + 1
            elif not closers and kind == "RBRACE" and j > i:
                return j
        return len(self.tokens)
