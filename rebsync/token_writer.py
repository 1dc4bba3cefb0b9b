"""Takes tokens in order and keeps comments and empty lines where they belong."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

from rebsync.lines import Lines, Token, shown
from rebsync.spacing import is_comment

OPENING = frozenset("([{")
CLOSING = frozenset(")]}")


class Gap(Enum):
    """Whether an empty line comes before the next line."""

    NEVER = "never"
    KEEP = "keep"
    ALWAYS = "always"


class TokenWriter:
    """A cursor over the tokens that writes what it passes."""

    def __init__(self, tokens: Sequence[Token]) -> None:
        self._all = tokens
        self._code = [i for i, token in enumerate(tokens) if not is_comment(token.text)]
        self._choices = _choices(tokens, self._code)
        self._next = 0  # into _code
        self._seen = 0  # into _all
        self._lines = Lines()
        self.gap = Gap.NEVER

    # --- looking

    def peek(self, ahead: int = 0) -> str:
        """The text of a token to come; empty after the last."""
        at = self._next + ahead
        return self._all[self._code[at]].text if at < len(self._code) else ""

    def peek_past_annotations(self) -> str:
        """The text of the token that follows annotations to come."""
        at = 0
        while self.peek(at) == "@":
            at += 2
            if self.peek(at) == "(":
                at = self._past_brackets(at)
        return self.peek(at)

    def at_conditional(self) -> bool:
        """Whether the token to come is the `?` of `c ? a : b`."""
        return self.peek() == "?" and self._code[self._next] not in self._choices

    def comment_ahead(self) -> bool:
        """Whether a comment comes before the next token."""
        return self._next < len(self._code) and self._code[self._next] > self._seen

    def _past_brackets(self, at: int) -> int:
        depth = 0
        while text := self.peek(at):
            at += 1
            depth += (text in OPENING) - (text in CLOSING)
            if depth <= 0:
                break
        return at

    # --- writing

    def take(self) -> str:
        """Write the next token, and the comments before it."""
        self.comments()
        index = self._code[self._next]
        text = self._all[index].text
        if self._lines.empty:
            self._open_line()
        self._lines.add(text, index in self._choices)
        self._next += 1
        self._seen = index + 1
        return text

    def brackets(self) -> None:
        """Write the bracketed group to come, or one token."""
        depth = 0
        while text := self.peek():
            self.take()
            depth += (text in OPENING) - (text in CLOSING)
            if depth <= 0:
                return

    def until(self, *ends: str) -> str:
        """Write up to and with one of `ends` outside of brackets; gives which one it was."""
        while text := self.peek():
            if text in OPENING and text not in ends:
                self.brackets()
                continue
            self.take()
            if text in ends or text == "}":
                return text
        return ""

    def annotation(self) -> None:
        """Write one annotation."""
        self.take()
        self.take()
        if self.peek() == "(":
            self.brackets()
        self._lines.begin_operand()

    def end(self) -> None:
        """End the line."""
        if not self._lines.empty:
            self._lines.end()

    def indent(self, levels: int) -> None:
        """Move what follows to the right, or back."""
        self._lines.indent += levels

    def text(self) -> str:
        """All that has been written, with the comments at the end."""
        self.end()
        self.comments(closing=True)
        return "".join(line + "\n" for line in self._lines.done)

    def row(self) -> str:
        """All tokens on one line."""
        while self.peek():
            self.take()
        return self._lines.row()

    # --- comments and empty lines

    def comments(self, closing: bool = False) -> None:
        """Write the comments before the next token; `closing` keeps them off its line."""
        stop = self._stop()
        while self._seen < stop:
            self._comment(closing)
            self._seen += 1

    def _stop(self) -> int:
        return self._code[self._next] if self._next < len(self._code) else len(self._all)

    def _comment(self, closing: bool) -> None:
        comment = self._all[self._seen]
        text = shown(comment.text)
        beside = self._seen > 0 and self._all[self._seen - 1].end_line == comment.line
        joined = not closing and self._joins_next(comment)
        if self._lines.empty:
            if beside and not joined:
                self._lines.trail(text)
                return
            self._open_line()
            if joined:
                self._lines.add(text)
            else:
                self._lines.comment(text, comment.column)
            return
        alone = not beside and not joined
        if alone:
            self._lines.break_line()
        self._lines.add(text)
        if alone:
            self._lines.break_line()

    def _joins_next(self, comment: Token) -> bool:
        stop = self._stop()
        return stop < len(self._all) and self._all[stop].line == comment.end_line

    def _open_line(self) -> None:
        match self.gap:
            case Gap.ALWAYS:
                wanted = self._is_far(self._seen) or not self._gap_ahead()
            case Gap.KEEP:
                wanted = self._is_far(self._seen)
            case Gap.NEVER:
                wanted = False
        if wanted:
            self._lines.blank()
        self.gap = Gap.KEEP

    def _gap_ahead(self) -> bool:
        """Whether an empty line follows one of the comments before the next token."""
        return any(self._is_far(i) for i in range(self._seen, self._stop() + 1))

    def _is_far(self, index: int) -> bool:
        if not 0 < index < len(self._all):
            return False
        return self._all[index].line - self._all[index - 1].end_line > 1


def _choices(tokens: Sequence[Token], code: Sequence[int]) -> frozenset[int]:
    """The `?` of choices: those before a parenthesis that holds a comma of its own."""
    found = set()
    opened: list[int] = []
    for place, index in enumerate(code):
        text = tokens[index].text
        if text in OPENING:
            opened.append(place)
        elif text in CLOSING and opened:
            opened.pop()
        elif text == "," and opened and opened[-1]:
            before = code[opened[-1] - 1]
            if tokens[before].text == "?" and tokens[code[opened[-1]]].text == "(":
                found.add(before)
    return frozenset(found)
