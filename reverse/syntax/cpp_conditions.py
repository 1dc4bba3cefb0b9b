"""`#if` and the like: which alternatives a compiler of ROS nodes takes, as far as that is known.

Known are numbers, macros that the same file defines before, what holds of every compiler on Linux,
and the version of ROS 1 that rebsync reads (Noetic). The build may define anything else.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from rebsync.records import dataclass
from rebsync.reverse.files.compiled_text import LINE_COMMENT
from rebsync.reverse.libraries.cpp import versions
from rebsync.reverse.syntax.cpp_numerals import whole_number

_KNOWN: dict[str, int | None] = {
    **dict.fromkeys(("__linux__", "__linux", "linux", "__unix__", "__unix", "unix", "__GNUC__")),
    **{"true": 1, "false": 0},
}
# Of the standards that a build may ask for: what differs between them is not known.
_CPLUSPLUS = "__cplusplus"
_STANDARDS = (201402, 201703, 202002, 202302)
_UNDEFINED = frozenset(
    {
        *("_WIN32", "WIN32", "_WIN64", "WIN64", "_MSC_VER", "__MINGW32__", "__CYGWIN__", "_DEBUG"),
        *("__APPLE__", "__MACH__", "__ANDROID__", "__QNX__", "__FreeBSD__", "__BORLANDC__"),
    }
)
# The macros of which the compiler and the machine decide.
DECIDED = _UNDEFINED | _KNOWN.keys() | {_CPLUSPLUS}
_DIRECTIVE = re.compile(
    r"[ \t]*#[ \t]*(?P<word>if|ifdef|ifndef|elif|else|endif|define|undef)\b"
    r"(?P<rest>[^\n\\]*(?:\\(?:\r?\n)?[^\n\\]*)*)"
)
# What is not closed ends with the text, as otherwise it would be looked for again and again. What
# goes on for long is taken at once, not one character after the other.
_HIDDEN = re.compile(
    rf"""{LINE_COMMENT}|/\*[^*]*(?:\*+(?!/)[^*]*)*(?:\*/|\Z)"""
    r"""|"[^"\\\n]*(?:\\.[^"\\\n]*)*"?|'(?:[^'\\\n]|\\.)'""",
    re.DOTALL,
)
_TOKEN = re.compile(r"\s*(\d[\w']*|\w+|&&|\|\||[=!<>]=|[-+!<>(),*/%])")


@dataclass(frozen=True, slots=True)
class Alternative:
    """One alternative: its text lies between two directives. `taken`: None if it is not known."""

    start: int
    end: int
    taken: bool | None


@dataclass(frozen=True, slots=True)
class IfSection:
    """`#if` to `#endif`: the places of its directives, and its alternatives in their order."""

    condition: str
    directives: tuple[tuple[int, int], ...]
    branches: tuple[Alternative, ...]
    is_guard: bool

    @property
    def decided(self) -> bool:
        """Whether it is known which alternative is taken, or that none is."""
        return all(b.taken is not None for b in self.branches)


@lru_cache(maxsize=1)  # a text is read, and what of it is not read is then listed
def alternatives(text: str) -> tuple[str, tuple[IfSection, ...]]:
    """A text as `blank` gives it, and its conditionals."""
    plain = blank(text)
    return plain, tuple(conditionals(plain))


def blank(text: str) -> str:
    """The same text with blanks for comments and texts in quotes; line ends stay."""
    return _HIDDEN.sub(_blanks, text)


def _blanks(match: re.Match[str]) -> str:
    hidden = match[0]
    if "\n" not in hidden:
        return " " * len(hidden)
    return "\n".join([" " * len(line) for line in hidden.split("\n")])


def conditionals(text: str) -> list[IfSection]:
    """All in a text of which comments are blank, inner ones before those around them."""
    reader = _DirectiveReader()
    for match in _directives(text):
        reader.directive(match)
    return reader.found


def _directives(text: str, start: int = 0) -> Iterator[re.Match[str]]:
    """All from a place on, each with the blanks before it on its line.

    To look for `#` alone is much quicker than to look at each line; only the first of a line can
    begin a directive.
    """
    at = text.find("#", start)
    while at >= 0:
        line = text.rfind("\n", start, at) + 1 or start
        found = _DIRECTIVE.match(text, line) if line == 0 or text[line - 1] == "\n" else None
        if found is not None:
            yield found
        start = found.end() if found is not None else text.find("\n", at)
        at = text.find("#", start) if start >= 0 else -1


@dataclass(slots=True)
class _OpenConditional:
    """A conditional of which the end has not been read yet."""

    condition: str
    directives: list[tuple[int, int]]
    branches: list[Alternative]
    taken: bool | None
    before: bool | None  # whether one of the earlier alternatives is taken
    guards: bool


class _DirectiveReader:
    """Reads directives in their order, and remembers what is defined."""

    def __init__(self) -> None:
        self.found: list[IfSection] = []
        self.open: list[_OpenConditional] = []
        self.values: dict[str, int | None] = {**_KNOWN, _CPLUSPLUS: _STANDARDS[0]}
        self.undefined = set(_UNDEFINED)

    def directive(self, match: re.Match[str]) -> None:
        word, rest = match["word"], match["rest"]
        place = match.start(), match.end()
        if word in ("if", "ifdef", "ifndef"):
            taken = self._holds(word, rest)
            guards = word == "ifndef" and taken is None and _defines(match)
            taken = True if guards else taken
            shown = f"#{word} {' '.join(rest.split())}"
            self.open.append(_OpenConditional(shown, [place], [], taken, taken, guards))
        elif word in ("elif", "else") and self.open:
            self._alternative(word, rest, place)
        elif word == "endif" and self.open:
            self._close(place)
        elif word in ("define", "undef"):
            self._define(word, rest)

    def _alternative(self, word: str, rest: str, place: tuple[int, int]) -> None:
        top = self.open[-1]
        self._end_branch(top, place)
        holds = True if word == "else" else self._holds("if", rest)
        top.taken = _and(_not(top.before), holds)
        top.before = _or(top.before, holds)

    def _end_branch(self, top: _OpenConditional, place: tuple[int, int]) -> None:
        top.branches.append(Alternative(top.directives[-1][1], place[0], top.taken))
        top.directives.append(place)

    def _close(self, place: tuple[int, int]) -> None:
        top = self.open.pop()
        self._end_branch(top, place)
        branches = tuple(top.branches)
        self.found.append(IfSection(top.condition, tuple(top.directives), branches, top.guards))

    def _define(self, word: str, rest: str) -> None:
        name, _, value = rest.strip().partition(" ")
        if not name.isidentifier() or any(o.taken is False for o in self.open):
            return
        if word == "undef" or any(o.taken is None for o in self.open):
            self.values.pop(name, None)
            self.undefined.discard(name)
            if word == "undef" and all(o.taken for o in self.open):
                self.undefined.add(name)
        else:
            self.undefined.discard(name)
            self.values[name] = whole_number(value)

    def _holds(self, word: str, rest: str) -> bool | None:
        if word == "if":
            return self._condition(rest)
        defined = self.is_defined(rest.strip())
        return _not(defined) if word == "ifndef" else defined

    def _condition(self, text: str) -> bool | None:
        """Whether a condition holds, if it does in each standard or in none."""
        found = set[bool | None]()
        for standard in _STANDARDS if _CPLUSPLUS in text else _STANDARDS[:1]:
            self.values[_CPLUSPLUS] = standard
            found.add(_truth(_Condition(text, self).value()))
        return found.pop() if len(found) == 1 else None

    def is_defined(self, name: str) -> bool | None:
        if name in self.values:
            return True
        return False if name in self.undefined else None


def _defines(ifndef: re.Match[str]) -> bool:
    """Whether it is the guard of a header, or of a macro: the next directive defines its name.

    The first directive of a file is a guard as well where these names differ by mistake.
    """
    following = next(_directives(ifndef.string, ifndef.end()), None)
    if following is None or following["word"] != "define":
        return False
    names = following["rest"].split()
    if names[:1] == ifndef["rest"].split()[:1]:
        return True
    first = next(_directives(ifndef.string), None)
    return len(names) == 1 and first is not None and first.start() == ifndef.start()


# --- conditions ---------------------------------------------------------------------------------


class _Condition:
    """The value of a condition; None if it is not known, or if it is none that can be read."""

    def __init__(self, text: str, reader: _DirectiveReader) -> None:
        text = " ".join(text.replace("\\", " ").split())
        self.tokens: list[str] = _TOKEN.findall(text)
        self.whole = "".join(self.tokens) == text.replace(" ", "")
        self.reader = reader
        self.at = 0

    def value(self) -> int | None:
        if not self.whole or len(self.tokens) > 200:
            return None
        found = self._or()
        return found if self.at == len(self.tokens) else None

    def _take(self, *wanted: str) -> str | None:
        if self.at < len(self.tokens) and (not wanted or self.tokens[self.at] in wanted):
            self.at += 1
            return self.tokens[self.at - 1]
        return None

    def _or(self) -> int | None:
        found = self._and()
        while self._take("||"):
            found = _int(_or(_truth(found), _truth(self._and())))
        return found

    def _and(self) -> int | None:
        found = self._comparison()
        while self._take("&&"):
            found = _int(_and(_truth(found), _truth(self._comparison())))
        return found

    def _comparison(self) -> int | None:
        left = self._operand()
        while operator := self._take("==", "!=", "<", ">", "<=", ">="):
            right = self._operand()
            left = None if left is None or right is None else int(_compare(operator, left, right))
        return left

    def _operand(self) -> int | None:
        token = self._take()
        if token == "!":
            return _int(_not(_truth(self._operand())))
        if token == "(":
            found = self._or()
            return found if self._take(")") else None
        if token == "defined":
            bracket = self._take("(")
            name = self._take() or ""
            if bracket:
                self._take(")")
            return _int(self.reader.is_defined(name))
        if token is None or not (token.isidentifier() or token[0].isdigit()):
            return None
        return self._called(token) if self._take("(") else self._plain(token)

    def _plain(self, token: str) -> int | None:
        if token[0].isdigit():
            return whole_number(token)
        if token in self.reader.values:
            return self.reader.values[token]
        return 0 if token in self.reader.undefined else None

    def _called(self, name: str) -> int | None:
        """A macro with arguments: known is the one that asks for the version of ROS."""
        arguments: list[int | None] = []
        while not self._take(")"):
            if self.at >= len(self.tokens):
                return None
            arguments.append(self._or())
            self._take(",") or self._take("+", "-", "*", "/", "%")
        newest = versions().get(name)
        if newest is None or None in arguments:
            return None
        return int(tuple(a for a in arguments if a is not None) <= newest)


def _compare(operator: str, left: int, right: int) -> bool:
    return {
        "==": left == right,
        "!=": left != right,
        "<": left < right,
        ">": left > right,
        "<=": left <= right,
        ">=": left >= right,
    }[operator]


def _int(value: bool | None) -> int | None:
    return None if value is None else int(value)


def _truth(value: int | None) -> bool | None:
    return None if value is None else value != 0


def _not(value: bool | None) -> bool | None:
    return None if value is None else not value


def _and(left: bool | None, right: bool | None) -> bool | None:
    if left is False or right is False:
        return False
    return None if left is None or right is None else True


def _or(left: bool | None, right: bool | None) -> bool | None:
    return _not(_and(_not(left), _not(right)))
