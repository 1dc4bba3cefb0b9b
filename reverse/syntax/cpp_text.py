"""The text of a C++ file as a parser that knows no macros can read it; places stay the same.

Blanks stand for what a preprocessor would take away, and for words that say nothing about what
code does: attributes, export macros, the extensions of Qt and CUDA.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from rebsync.reverse.syntax.cpp_conditions import IfSection, alternatives
from rebsync.reverse.syntax.cpp_words import Plain

# Patterns start with plain text where they can: this is what makes searching quick.
# `class FOO_EXPORT Foo {`: without the macro's definition the parser takes Foo for a variable.
_EXPORTS = {
    word.encode(): re.compile(
        rf"({word}\s+)[A-Z][A-Z0-9_]*(?=\s+(?!final\b)[A-Za-z_]\w*\s*(?:final\s*)?(?:[{{]|:[^:]))"
    )
    for word in ("class", "struct")
}
# `FOO_DEPRECATED const char* f();`, at the start of a line, where a declaration goes on.
_GOES_ON = (
    r"[ \t]+(?:const|virtual|static|inline|explicit|void|bool|int|unsigned|long|float|double|char"
    r"|auto|std::\w+)\b"
)
_ATTRIBUTE = re.compile(rf"(\n[ \t]*)[A-Z][A-Z0-9]*_[A-Z0-9_]+(?={_GOES_ON})")
# From the last `_` of one, wherever it stands: quicker than to look at each line. None may begin in
# another, or a long one would be gone through again and again.
_MAY_BE_ATTRIBUTE = re.compile(rf"_(?<=[A-Z0-9_]_)[A-Z0-9]*{_GOES_ON}")
_LOWER = b"abcdefghijklmnopqrstuvwxyz"
_OF_CUDA = frozenset(
    f"__{word}__".encode()
    for word in ("device", "host", "global", "shared", "constant", "forceinline")
)
_LAUNCH = re.compile(r"<<<[^;{}<]{1,300}?>>>")
# The formats of <cinttypes>, between texts: `"%" PRId64`.
_FORMAT = re.compile(r"\bPRI[diouxX](?:8|16|32|64|MAX|PTR)\b")
_CONDITION = re.compile(r"#[ \t]*if")
_GUARD = re.compile(r"ndef[ \t]+(\w+)\s*#[ \t]*define[ \t]+\1\b")
_NO_LINE_END = re.compile(r"[^\r\n]")
_PAIRS = {"(": ")", "[": "]", "{": "}"}
_BRACKETS = re.compile(r"[][(){}]")


def _blank(match: re.Match[str]) -> str:
    return _NO_LINE_END.sub(" ", match[0])


def _keep_first(match: re.Match[str]) -> str:
    return match[1] + " " * (len(match[0]) - len(match[1]))


def _public(match: re.Match[str]) -> str:
    return match[1] + "public".ljust(len(match[2])) + match[3]


# The words of which one must be in a text before a search is worth while, the search, and what
# stands for what it finds.
_BY_WORD: tuple[tuple[frozenset[bytes], re.Pattern[str], Callable[[re.Match[str]], str]], ...] = (
    *((frozenset({word}), pattern, _keep_first) for word, pattern in _EXPORTS.items()),
    (_OF_CUDA, re.compile(r"__(?:device|host|global|shared|constant|forceinline)__"), _blank),
    (
        frozenset({b"slots"}),
        re.compile(r"(\b(?:public|protected|private)\s+)slots(?=\s*:)"),
        _keep_first,
    ),
    (frozenset({b"signals"}), re.compile(r"(\n[ \t]*)(signals)([ \t]*:)(?!:)"), _public),
    (frozenset({b"emit"}), re.compile(r"(\n[ \t]*)emit(?=[ \t]+\w+\s*\()"), _keep_first),
)
# The same with what must be in one of the words.
_BY_PART: tuple[tuple[bytes, re.Pattern[str], Callable[[re.Match[str]], str]], ...] = (
    (b"Q_", re.compile(r"Q_(?:OBJECT|GADGET|INVOKABLE|EMIT)\b"), _blank),
    (b"Q_SLOTS", re.compile(r"(\b(?:public|protected|private)\s+)Q_SLOTS(?=\s*:)"), _keep_first),
    (b"Q_SIGNALS", re.compile(r"()(Q_SIGNALS)([ \t]*:)"), _public),
    (b"SIGNAL", re.compile(r"(SIGNAL\s*\()[^()]*\([^()]*\)(?=\s*\))"), _keep_first),
    (b"SLOT", re.compile(r"(SLOT\s*\()[^()]*\([^()]*\)(?=\s*\))"), _keep_first),
    (b"PRI", _FORMAT, _blank),
    # What says who may see a member, before its declaration, on a line of its own or not.
    *(
        (
            ending.encode(),
            re.compile(rf"(\n[ \t]*)[A-Z][A-Z0-9_]*{ending}(?=\s+[~A-Za-z_])"),
            _keep_first,
        )
        for ending in ("_PUBLIC", "_EXPORT", "_LOCAL")
    ),
    (b"EIGEN_MAKE", re.compile(r"EIGEN_MAKE_ALIGNED_OPERATOR_NEW\b;?"), _blank),
)


def readable(text: str, plain: Plain) -> str:
    """The text with blanks for what the parser would stumble over; as long as the text.

    Its words tell quickly what need not be looked for.
    """
    for any_of, pattern, instead in _BY_WORD:
        if not plain.words.isdisjoint(any_of):
            text = pattern.sub(instead, text)
    if "<<<" in text:
        text = _LAUNCH.sub(_blank, text)
    capitals = b" ".join(plain.words).translate(None, _LOWER)
    for piece, pattern, instead in _BY_PART:
        if piece in capitals:
            text = pattern.sub(instead, text)
    if _MAY_BE_ATTRIBUTE.search(text):
        text = _ATTRIBUTE.sub(_keep_first, text)
    return with_one_alternative(text)


def with_one_alternative(text: str) -> str:
    """The text with blanks for the parts that no compiler sees, or that cannot be read together."""
    return _without(text, dropped(text)) if has_alternatives(text) else text


def has_alternatives(text: str) -> bool:
    """Whether there is any `#if` but for the guard of a header."""
    first = _CONDITION.search(text)
    if first is not None and _GUARD.match(text, first.end()):
        first = _CONDITION.search(text, first.end())
    return first is not None


def dropped(text: str) -> list[tuple[int, int]]:
    """The parts of a text that no compiler sees, or that cannot be read with the others."""
    plain, every = alternatives(text)
    found: list[tuple[int, int]] = []
    for each in every:
        if each.is_guard:
            continue
        if each.decided:
            found += each.directives
            found += [(b.start, b.end) for b in each.branches if not b.taken]
        elif is_split(plain, each):
            found += each.directives
            read = read_branch(each)
            found += [(b.start, b.end) for i, b in enumerate(each.branches) if i != read]
    return found


def is_split(plain: str, conditional: IfSection) -> bool:
    """Whether an alternative is no whole piece of code: it opens or closes more than it may."""
    return not all(_balanced(plain[b.start : b.end]) for b in conditional.branches)


def read_branch(conditional: IfSection) -> int | None:
    """Which alternative is read, if only one can be: that of macros that nobody defines."""
    if conditional.condition.startswith("#ifndef"):
        return 0
    return len(conditional.branches) - 1 if len(conditional.branches) > 1 else None


def _balanced(text: str) -> bool:
    waiting: list[str] = []
    for bracket in _BRACKETS.findall(text):
        if bracket in _PAIRS:
            waiting.append(_PAIRS[bracket])
        elif not waiting or waiting.pop() != bracket:
            return False
    return not waiting


def _without(text: str, parts: Iterable[tuple[int, int]]) -> str:
    """The text with blanks for some parts, which may overlap."""
    pieces: list[str] = []
    at = 0
    for start, end in sorted(parts):
        if end > at:
            start = max(start, at)
            pieces += [text[at:start], _NO_LINE_END.sub(" ", text[start:end])]
            at = end
    return "".join([*pieces, text[at:]])
