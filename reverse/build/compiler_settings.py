"""What the build tells the compiler and linker of C++ beside the sources: macros, headers, flags.

Each command that is carried out is looked at, whatever target it is for: what one of them gets may
hold of all sources. What sets macros and cannot be read is `odd`.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import field

from rebsync.records import dataclass
from rebsync.reverse.build.build_files import BuildMacro
from rebsync.reverse.build.cmake_targets import Invocation, Maker
from rebsync.reverse.build.cmake_values import Unset, known
from rebsync.reverse.files.packages import HEADERS
from rebsync.reverse.syntax.cpp_conditions import DECIDED
from rebsync.reverse.unknowns import Open, Text, Unknown

# Commands whose words are for other programs, or for people.
_OTHERS = frozenset(
    {
        *("add_custom_command", "add_custom_target", "add_test", "execute_process", "message"),
        *("find_package", "find_program", "pkg_check_modules"),
    }
)
_DEFINING = frozenset({"target_compile_definitions", "add_compile_definitions"})
_PROPERTY = re.compile(r"(?:INTERFACE_)?COMPILE_DEFINITIONS(?:_\w+)?")
_OPTION = re.compile(r"""(?<![^\s"';:,])[-/]D\s*([A-Za-z_]\w*)(\([^)]*\))?(?:=(\S*))?""")
_DEFINITION = re.compile(r"(?:[-/]D)?([A-Za-z_]\w*)(\([^)]*\))?(?:=(.*))?", re.DOTALL)
_GENERATED = re.compile(r"([A-Za-z_]\w*)(?:=[^<>]*)?>")  # `$<$<CONFIG:Debug>:NAME=2>`
_NAMED = re.compile(r"(?:[-/]D)?([A-Za-z_]\w*)=")
_DIRECTIVE = re.compile(
    r"^[ \t]*#[ \t]*(cmake)?define(?:01)?[ \t]+(\w+)(\([^)]*\))?([^\n]*)", re.MULTILINE
)
# Flags of GCC that say what types, literals and symbols are, or what stands before each file.
_FLAG = re.compile(
    r"""(?<![^\s"';:,])(?:-f(?:no-)?(?:(?:un)?signed-(?:char|bitfields)|short-(?:enums|wchar)"""
    r"""|pack-struct\S*|single-precision-constant|(?:exec|input)-charset\S*|instrument-functions"""
    r"""|plugin\S*)|-U\s*\w+|-(?:include|imacros|include-pch)(?=[\s;"]|$)"""
    r"""|-Wl,\S*(?:wrap|defsym)\S*)"""
)
_HEADERS = tuple(sorted(HEADERS))
_WRITING = frozenset({"add_custom_command", "configure_file", "file"})
_JOINED = frozenset({"UNITY_BUILD", "CMAKE_UNITY_BUILD", "PRECOMPILE_HEADERS"})
_PRECOMPILED = "target_precompile_headers"
_NOT_READ = "the macros that this sets for code of C++"


@dataclass(slots=True)
class CompilerSettings:
    """Macros, what is odd, and by name the headers that commands write."""

    macros: dict[BuildMacro, None] = field(default_factory=dict)
    odd: list[Unknown] = field(default_factory=list)
    written: dict[str, Unknown] = field(default_factory=dict)

    def read(self, call: Invocation, maker: Maker) -> None:
        """Takes in what a command says to compilers."""
        name = call.command.name
        if name in _WRITING:
            self._written(call, maker)
        if name in _OTHERS:
            return
        if name == _PRECOMPILED and not all(w.startswith("<") for w in _headers(call.words)):
            self._odd(call, "headers of the package stand before each file")
        if not _JOINED.isdisjoint(call.words):
            self._odd(call, "other files stand before each file")
        self._options(call)
        self._definitions(call, _defining(call))

    def _odd(self, call: Invocation, why: str, what: str = _NOT_READ) -> None:
        self.odd.append(Unknown(what, why, call.source, call.command.span))

    def _options(self, call: Invocation) -> None:
        """`-D`, and flags that change what code means; also in what is open, as it is written."""
        whole = any(isinstance(w, Open) for w in call.words)
        texts = known(call.words)
        written = [call.source.slice(call.command.span)] if whole else []
        for text in texts:
            for found in _OPTION.finditer(text):
                self._define(call, found[1], found[2], "1" if found[3] is None else found[3])
        for text in written:
            for found in _OPTION.finditer(text):
                self._define(call, found[1], found[2], None)
        for text in (*texts, *written):
            if (flag := _FLAG.search(text)) is not None:
                self._odd(call, f"`{flag[0]}` changes what code means", "a flag of the compiler")

    def _definitions(self, call: Invocation, words: Sequence[Text]) -> None:
        """The words of `target_compile_definitions`, or of the property that it sets."""
        for word in words:
            if isinstance(word, str):
                for each in word.split(";"):
                    if (found := _DEFINITION.fullmatch(each)) is not None:
                        text = "1" if found[3] is None else found[3]
                        self._define(call, found[1], found[2], text)
            else:
                written = [a.text for a in call.command.arguments if "$" in a.text]
                names = [n for text in written for n in _names_in(text)]
                if not names and not isinstance(word, Unset):  # others' are for their headers
                    self._odd(call, word.why)
                for name in names:
                    self._define(call, name, None, None)

    def _define(
        self, call: Invocation, name: str, parameters: str | None, text: str | None
    ) -> None:
        if name in DECIDED:
            self._odd(call, f"`{name}` is a macro of the compiler")
        if text is not None and ("\\" in text or "$" in text):
            text = None
        self.macros.setdefault(BuildMacro(name, parameters or "", text))

    # --- headers that are written -----------------------------------------------------------------

    def _written(self, call: Invocation, maker: Maker) -> None:
        """The headers that a command writes: what they define is only known of templates."""
        words = call.words
        if call.command.name == "configure_file" and len(words) > 1:
            path = call.variables.path(words[0]) if isinstance(words[0], str) else words[0]
            template = maker.folder.load(path) if isinstance(path, str) else None
            if template is not None:
                for found in _DIRECTIVE.finditer(template.text):
                    is_plain = found[1] is None and not {"@", "$"} & set(found[4])
                    text = found[4].strip() if is_plain else None
                    self.macros.setdefault(BuildMacro(found[2], found[3] or "", text))
        for text in (*known(words), *(a.text for a in call.command.arguments)):
            if text.endswith(_HEADERS):
                unknown = Unknown(
                    "what this header says", "the build writes it", call.source, call.command.span
                )
                self.written.setdefault(posixpath.basename(text), unknown)


def _headers(words: Iterable[Text]) -> list[str]:
    """What `target_precompile_headers` names; what is open is as if it were the package's."""
    rest = [*words][1:]
    return ["" if isinstance(w, Open) else w for w in rest if w not in _VISIBLE]


_VISIBLE = frozenset({"PRIVATE", "PUBLIC", "INTERFACE"})


def _defining(call: Invocation) -> list[Text]:
    """The words of a command that are names of macros, with or without a value."""
    words = call.words
    if call.command.name in _DEFINING:
        first = call.command.name.startswith("target")
        return [w for w in words[first:] if w not in _VISIBLE]
    at = next((i for i, w in enumerate(words) if isinstance(w, str) and _PROPERTY.fullmatch(w)), -1)
    if at < 0 or call.command.name.startswith("get_"):
        return []
    is_list = call.command.name == "set_property"
    return words[at + 1 :] if is_list else words[at + 1 : at + 2]


def _names_in(text: str) -> Iterator[str]:
    """The macros that a word may define, of which only the text is known."""
    if "$<" in text:
        yield from _GENERATED.findall(text)
    elif (found := _NAMED.match(text)) is not None:
        yield found[1]
