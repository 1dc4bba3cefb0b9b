"""Where compilers of C++ take a text otherwise than the readers, or a linker what it defines.

"Phases of translation" in the standard: lines that end with a backslash are joined before there
are tokens, trigraphs stand for other characters, and `\\u00e9` in a name is the character itself.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.syntax.cpp_conditions import blank
from rebsync.reverse.syntax.cpp_tree import Cpp
from rebsync.source import Source, Span

_HINT = "write it on one line, without the backslash"
# By why a place is listed: what it is. The first two count in comments as well.
_JOINING = {
    # What `compiled_text.spliced` leaves: it would part a token there.
    "compilers join this line and the next": re.compile(r"\\[ \t\v\f]+\r?\n"),
    "compilers that know trigraphs join this line and the next": re.compile(
        r"\?\?/[ \t\v\f]*\r?\n"
    ),
}
_IN_CODE = {
    "this makes one token of what stands on two lines": re.compile(
        r"[^\s;,(){}\[\]\\]\\\r?\n(?=\S)"
    ),
    "a character of a name is written by its number": re.compile(r"\\[uUN]"),
}
_REFERRING = {
    "variables of a type by this name are other names for other variables": re.compile(
        r"\busing\s+\w+\s*=[^;(){}]*&\s*;|\btypedef\s[^;(){}]*&\s*\w+\s*;"
    ),
}
_LINKED = {
    "whether this is what runs is decided when the program is linked": re.compile(
        r"\b__attribute__\s*\(\(\s*_*(?:weak|alias|ifunc|cleanup|constructor|destructor)"
        r"|\bgnu::(?:weak|alias|ifunc|cleanup|constructor|destructor)\b|#[ \t]*pragma[ \t]+weak\b"
    ),
}


def misread(cpp: Cpp) -> Iterator[Finding]:
    """The places of a file that compilers read otherwise than the parser."""
    text = cpp.source.text
    if "\\" in text or "??/" in text:
        yield from _found(cpp.source, text, _JOINING)
    if any(pattern.search(text) for pattern in _IN_CODE.values()):
        yield from _found(cpp.source, blank(text), _IN_CODE)
    for patterns in (_LINKED, _REFERRING):
        if any(pattern.search(text) for pattern in patterns.values()):
            yield from _found(cpp.source, blank(text), patterns, "")


def _found(
    source: Source, text: str, patterns: Mapping[str, re.Pattern[str]], hint: str = _HINT
) -> Iterator[Finding]:
    for why, pattern in patterns.items():
        for match in pattern.finditer(text):
            span = Span(match.start(), match.start() + len(match[0].rstrip()))
            yield Finding(Grade.UNREADABLE, source, span, why, hint)
