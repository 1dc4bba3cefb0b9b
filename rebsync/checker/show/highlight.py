"""The colours of words in the text of a model or of properties: by their spelling alone."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rebsync.checker.show.markup import Markup, element, escaped

_WORDS = (
    "abstract|after|break|case|continue|deadline|default|delay|else|env|extends|false|for|if"
    "|implements|instanceof|interface|knownrebecs|main|method|msgsrv|new|null|priority"
    "|reactiveclass|return|self|sender|statevars|super|switch|true|while"
    "|property|define|Assertion|LTL|TCTL"
)
_TYPES = "boolean|byte|short|int|long|float|double|void"
_TOKENS = re.compile(
    rf"""
    (?P<comment> //[^\n]* | /\*.*?(?:\*/|\Z) )
  | (?P<string> "(?:[^"\\\n]|\\.)*" )
  | (?P<note> @[A-Za-z_]\w* )
  | (?P<number> \b[0-9][\w.]* )
  | (?P<word> \b(?:{_WORDS})\b )
  | (?P<type> \b(?:{_TYPES})\b )
    """,
    re.DOTALL | re.VERBOSE,
)


def highlighted(text: str) -> list[Markup]:
    """The lines of a text, with its comments, words of the language, numbers and texts marked.

    The lines are those of `str.splitlines`; a comment over several lines is marked in each.
    """
    lines: list[list[str]] = [[]]
    for kind, piece in _pieces(text):
        for part in piece.splitlines(keepends=True):
            whole = part.splitlines()[0]
            if whole:
                shown = element("span", whole, class_=f"tok-{kind}") if kind else escaped(whole)
                lines[-1].append(shown)
            if whole != part:
                lines.append([])
    if text and not lines[-1]:
        lines.pop()
    return [Markup("".join(line)) for line in lines] if text else []


def _pieces(text: str) -> Iterator[tuple[str, str]]:
    """The text in pieces with their kinds; an empty kind for what has no colour."""
    at = 0
    for found in _TOKENS.finditer(text):
        if found.start() > at:
            yield "", text[at : found.start()]
        assert found.lastgroup is not None
        yield found.lastgroup, found[0]
        at = found.end()
    if at < len(text):
        yield "", text[at:]
