"""Changes of bytes: single bytes, tokens, lines, numbers, nesting, and what terminals obey."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from random import Random

_TOKEN = re.compile(rb"[A-Za-z_$][\w$]*|\d[\w.]*|\s+|.", re.DOTALL)
_NUMBER = re.compile(rb"\d+(?:\.\d+)?(?:[eE][+-]?\d+)?")
_OPEN = (b"(", b"{", b"[", b"<", b'"', b"'", b"/*", b"${", b"<a>", b"!", b"- ", b"if (x) ", b"((")
_PAIRS = ((b"(", b")"), (b"{", b"}"), (b"[", b"]"), (b"<a>", b"</a>"), (b"{'a':", b"}"))

NUMBERS = (
    *(b"0", b"-1", b"1e400", b"1e-400", b"0.1", b"nan", b"inf", b"0x", b"08", b"1_000"),
    *(b"2147483648", b"-2147483649", b"18446744073709551616", b"4294967295", b"1e9", b"1e308"),
    *(
        b"9" * 4301,
        b"9" * 20_000,
        b"0x" + b"f" * 5000,
        b"1" + b"0" * 400 + b".5",
        b"." + b"0" * 500,
    ),
)
WORDS = (
    *(b"\x00", b"\x1b[2J", b"\x1b]0;t\x07", b"\x9b31m", b"\xc2\x9b31m", b"\r", b"\n", b"\x0c"),
    *(b"\xff", b"\xed\xa0\x80", b"\xef\xbb\xbf", b"\xe2\x80\xae", b"\xe2\x80\x8b", b"\xe2\x80\xa8"),
    *(
        b"\n::error::x",
        b"##[error]x",
        b"%0A",
        b"%s",
        b"{}",
        b"{{ x }}",
        b"{% x %}",
        b"${x}",
        b"$(x)",
    ),
    *(
        b"../",
        b"/",
        b"/dev/null",
        b"..",
        b".",
        b"~",
        b"C:\\",
        b"a b",
        b"*",
        b"?",
        b"\\",
        b"\\u001b",
    ),
    *(
        b"true",
        b"null",
        b"None",
        b"[]",
        b"{}",
        b"<!-- -->",
        b"<![CDATA[",
        b"&lt;",
        b"&#x1b;",
        b"]]>",
    ),
    *(b"*/", b"//", b"#", b'"""', b"'''", b"R(", b"#define x x", b"#include <x>", b"self", b"now"),
    *(
        b"lambda: ",
        b"await ",
        b"yield ",
        b"operator()",
        b"template <typename T> ",
        b"&a *a",
        b"!!python",
    ),
)

Mutation = Callable[[bytes, Random], bytes]


def mutate(data: bytes, random: Random, others: Sequence[bytes] = ()) -> bytes:
    """One to four changes of a text; `others` is what stretches may come from."""
    for _ in range(random.choice((1, 1, 1, 2, 2, 3, 4))):
        if others and random.random() < 0.15:
            data = _spliced(data, random.choice(others), random)
        else:
            data = random.choice(_MUTATIONS)(data, random)
    return data


def _place(data: bytes, random: Random) -> int:
    return random.randint(0, len(data))


def _flip(data: bytes, random: Random) -> bytes:
    changed = bytearray(data)
    for _ in range(random.choice((1, 1, 2, 8))):
        if changed:
            changed[random.randrange(len(changed))] = random.randrange(256)
    return bytes(changed)


def _cut(data: bytes, random: Random) -> bytes:
    start = _place(data, random)
    return data[:start] + data[start + random.choice((1, 1, 2, 5, 20, 100, len(data))) :]


def _insert(data: bytes, random: Random) -> bytes:
    at = _place(data, random)
    return data[:at] + random.choice(WORDS) + data[at:]


def _number(data: bytes, random: Random) -> bytes:
    found = list(_NUMBER.finditer(data))
    if not found:
        return _insert(data, random)
    one = random.choice(found)
    return data[: one.start()] + random.choice(NUMBERS) + data[one.end() :]


def _tokens(data: bytes, random: Random) -> bytes:
    """Tokens deleted, doubled, swapped, or put in the place of others."""
    tokens = _TOKEN.findall(data)
    if len(tokens) < 2:
        return data
    for _ in range(random.choice((1, 1, 2, 4))):
        i, j = random.randrange(len(tokens)), random.randrange(len(tokens))
        match random.randrange(5):
            case 0:
                tokens[i] = b""
            case 1:
                tokens[i] += tokens[i]
            case 2:
                tokens[i], tokens[j] = tokens[j], tokens[i]
            case 3:
                tokens[i] = tokens[j]
            case _:
                tokens[i] = random.choice(WORDS)
    return b"".join(tokens)


def _lines(data: bytes, random: Random) -> bytes:
    """A stretch of lines deleted, doubled, moved, or repeated many times."""
    lines = data.splitlines(keepends=True)
    if len(lines) < 2:
        return data
    start = random.randrange(len(lines))
    stretch = lines[start : start + random.choice((1, 1, 2, 5, 10))]
    rest = lines[:start] + lines[start + len(stretch) :]
    at = random.randint(0, len(rest))
    times = random.choice((0, 1, 2, 2, 30))
    return b"".join(rest[:at] + stretch * times + rest[at:])


def _nest(data: bytes, random: Random) -> bytes:
    """Brackets many deep, closed or not."""
    at, times = _place(data, random), random.choice((2, 50, 150, 1_500, 100_000))
    if random.random() < 0.5:
        return data[:at] + random.choice(_OPEN) * times + data[at:]
    opening, closing = random.choice(_PAIRS)
    end = min(len(data), at + random.choice((0, 1, 10)))
    times = min(times, 5_000)
    return data[:at] + opening * times + data[at:end] + closing * times + data[end:]


def _within_word(data: bytes, random: Random) -> bytes:
    """Something strange inside of a quoted text or a name."""
    quoted = [m.end() - 1 for m in re.finditer(rb'"[^"\n]*"|\'[^\'\n]*\'|\w+', data)]
    if not quoted:
        return _insert(data, random)
    at = random.choice(quoted)
    return data[:at] + random.choice(WORDS) + data[at:]


def _spliced(data: bytes, other: bytes, random: Random) -> bytes:
    at, start = _place(data, random), _place(other, random)
    length = random.choice((5, 20, 100, 500))
    end = at if random.random() < 0.5 else at + length
    return data[:at] + other[start : start + length] + data[end:]


_MUTATIONS: tuple[Mutation, ...] = (
    *(_flip, _cut, _insert, _number, _number, _tokens, _tokens, _lines, _nest, _within_word),
    _within_word,
)
