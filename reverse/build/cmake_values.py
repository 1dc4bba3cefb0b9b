"""Variables of CMake and what arguments stand for once they are replaced.

Paths of the package begin with `ROOT`, which stands for the folder of its CMakeLists.txt.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import field

from rebsync.records import dataclass
from rebsync.reverse.build.cmake_text import Argument, Quote
from rebsync.reverse.unknowns import Open, Text

ROOT = "/<package>"
_LONGEST = 1 << 16
_MOST_WORDS = 10_000
_REFERENCE = re.compile(r"\$(ENV|CACHE)?\{([^${}]*)\}")
_ESCAPE = re.compile(r"\\(.)", re.DOTALL)
_WORKED_OUT = frozenset("$;\\")  # what stands for something else, or splits words
_ESCAPED = {"n": "\n", "t": "\t", "r": "\r"}
_ROOTS = frozenset(
    {
        *("CMAKE_SOURCE_DIR", "PROJECT_SOURCE_DIR"),
        *("CMAKE_CURRENT_SOURCE_DIR", "CMAKE_CURRENT_LIST_DIR"),
    }
)


@dataclass(frozen=True, slots=True)
class Unset(Open):
    """A variable that nothing in the package sets: it is empty, or a package found sets it."""


@dataclass(slots=True)
class CmakeVariables:
    """The variables at one point of a file, and the folder of the file within the package.

    A value is a list of words, each of which may be open. `exported` are those that the scope
    sets for the one around it.
    """

    folder: str = ""
    values: dict[str, tuple[Text, ...]] = field(default_factory=dict)
    exported: dict[str, tuple[Text, ...]] = field(default_factory=dict)

    def copy(self, folder: str | None = None) -> CmakeVariables:
        """The same values, in the same folder or another."""
        return CmakeVariables(self.folder if folder is None else folder, dict(self.values))

    def get(self, name: str) -> tuple[Text, ...]:
        """The words of a variable."""
        if name in self.values:
            return self.values[name]
        if name in _ROOTS:
            inside = name.startswith("CMAKE_CURRENT")
            return (posixpath.join(ROOT, self.folder).rstrip("/") if inside else ROOT,)
        return (Unset(f"`${{{name}}}` is not set in the package"),)

    def set(self, name: str, words: Sequence[Text]) -> None:
        """Gives a variable a value; beyond a length it is open."""
        too_many = len(words) > _MOST_WORDS
        self.values[name] = (Open("a list of this length is not read"),) if too_many else (*words,)

    def blur(self, names: Iterable[str], why: str) -> None:
        """Makes these variables open, as far as they have a value."""
        for name in names:
            if name in self.values:
                self.values[name] = (Open(why),)

    # --- arguments --------------------------------------------------------------------------------

    def words(self, arguments: Sequence[Argument]) -> list[Text]:
        """The arguments with variables replaced, and lists split into their words."""
        found: list[Text] = []
        for argument in arguments:
            if argument.text and _WORKED_OUT.isdisjoint(argument.text):
                found.append(argument.text)
                continue
            whole = _REFERENCE.fullmatch(argument.text)
            if argument.quote is not Quote.NONE:
                found.append(self.text(argument))
            elif whole and not whole[1]:
                found += _split(self.get(whole[2]))
            else:
                found += _split([self.text(argument)])
        return found

    def text(self, argument: Argument) -> Text:
        """One argument with variables replaced."""
        text = argument.text
        if argument.quote is Quote.BRACKET:
            return text
        if "$<" in text:
            return Open(f"`{text}` is worked out only when the package is built")
        # `${a_${b}}`: from the inside out; what a value holds is not replaced again
        for _ in range(text.count("{")):
            opens: list[Open] = []
            text = _REFERENCE.sub(lambda match: self._value(match, opens), text)  # noqa: B023
            if opens:
                return opens[0]
            if len(text) > _LONGEST:
                return Open("a text of this length is not worked out")
        return _ESCAPE.sub(lambda m: _ESCAPED.get(m[1], m[1]), text)

    def _value(self, match: re.Match[str], opens: list[Open]) -> str:
        if match[1]:
            opens.append(Open(f"`{match[0]}` is not in the package"))
            return ""
        words = self.get(match[2])
        opens += [word for word in words if isinstance(word, Open)]
        return ";".join(known(words))

    def path(self, word: str) -> Text:
        """A path as it is written, relative to the package."""
        joined = posixpath.normpath(posixpath.join(ROOT, self.folder, word))
        if joined == ROOT:
            return ""
        if not joined.startswith(f"{ROOT}/"):
            return Open(f"`{word}` is outside of the package")
        return joined[len(ROOT) + 1 :]


def known(words: Iterable[Text]) -> list[str]:
    """The words that are no open ones."""
    return [word for word in words if not isinstance(word, Open)]


def _split(words: Iterable[Text]) -> Iterator[Text]:
    for word in words:
        if isinstance(word, Open):
            yield word
        else:
            yield from (part for part in word.split(";") if part)


def sections(words: Sequence[Text], keywords: Iterable[str]) -> dict[str, list[Text]]:
    """The words by the keyword that they follow; those before the first follow ``."""
    found: dict[str, list[Text]] = {"": []}
    heads = frozenset(keywords)
    section = found[""]
    for word in words:
        if isinstance(word, str) and word in heads:
            section = found.setdefault(word, [])
        else:
            section.append(word)
    return found
