"""The text of a C++ file as a parser that knows no macros can read it; places stay the same.

Blanks stand for what a preprocessor would take away, and for words that say nothing about what
code does: attributes, export macros, the extensions of Qt and CUDA.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from rebsync.reverse.syntax.cpp_conditions import Conditional, alternatives

# Patterns start with plain text where they can: this is what makes searching quick.
# `class FOO_EXPORT Foo {`: without the macro's definition the parser takes Foo for a variable.
_EXPORTS = tuple(
    re.compile(
        rf"({word}\s+)[A-Z][A-Z0-9_]*(?=\s+(?!final\b)[A-Za-z_]\w*\s*(?:final\s*)?(?:[{{]|:[^:]))"
    )
    for word in ("class", "struct")
)
# `FOO_DEPRECATED const char* f();`, at the start of a line, where a declaration goes on.
_ATTRIBUTE = re.compile(
    r"(\n[ \t]*)[A-Z][A-Z0-9]*_[A-Z0-9_]+(?=[ \t]+(?:const|virtual|static|inline|explicit|void|bool"
    r"|int|unsigned|long|float|double|char|auto|std::\w+)\b)"
)
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


# What to look for before a search is worth while, the search, and what stands for what it finds.
_MENDS: tuple[tuple[str, re.Pattern[str], Callable[[re.Match[str]], str]], ...] = (
    ("__", re.compile(r"__(?:device|host|global|shared|constant|forceinline)__"), _blank),
    ("<<<", re.compile(r"<<<[^;{}<]{1,300}?>>>"), _blank),
    ("Q_", re.compile(r"Q_(?:OBJECT|GADGET|INVOKABLE|EMIT)\b"), _blank),
    ("slots", re.compile(r"(\b(?:public|protected|private)\s+)slots(?=\s*:)"), _keep_first),
    ("Q_SLOTS", re.compile(r"(\b(?:public|protected|private)\s+)Q_SLOTS(?=\s*:)"), _keep_first),
    ("signals", re.compile(r"(\n[ \t]*)(signals)([ \t]*:)(?!:)"), _public),
    ("Q_SIGNALS", re.compile(r"()(Q_SIGNALS)([ \t]*:)"), _public),
    ("emit", re.compile(r"(\n[ \t]*)emit(?=[ \t]+\w+\s*\()"), _keep_first),
    ("SIGNAL", re.compile(r"(SIGNAL\s*\()[^()]*\([^()]*\)(?=\s*\))"), _keep_first),
    ("SLOT", re.compile(r"(SLOT\s*\()[^()]*\([^()]*\)(?=\s*\))"), _keep_first),
    ("PRI", _FORMAT, _blank),
    # What says who may see a member, before its declaration, on a line of its own or not.
    *(
        (ending, re.compile(rf"(\n[ \t]*)[A-Z][A-Z0-9_]*{ending}(?=\s+[~A-Za-z_])"), _keep_first)
        for ending in ("_PUBLIC", "_EXPORT", "_LOCAL")
    ),
    ("EIGEN_MAKE", re.compile(r"EIGEN_MAKE_ALIGNED_OPERATOR_NEW\b;?"), _blank),
)


def readable(text: str) -> str:
    """The text with blanks for what the parser would stumble over; as long as the text."""
    for pattern in _EXPORTS:
        text = pattern.sub(_keep_first, text)
    for word, pattern, instead in _MENDS:
        if word in text:
            text = pattern.sub(instead, text)
    text = _ATTRIBUTE.sub(_keep_first, text)
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


def is_split(plain: str, conditional: Conditional) -> bool:
    """Whether an alternative is no whole piece of code: it opens or closes more than it may."""
    return not all(_balanced(plain[b.start : b.end]) for b in conditional.branches)


def read_branch(conditional: Conditional) -> int | None:
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
