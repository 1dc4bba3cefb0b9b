"""Which code of a package can matter: told from its bytes, before anything is parsed.

What has a word of ROS in it matters, and so may all that includes tie to it. Where that is much,
names decide: what declares or defines a name that such code uses, and what uses a name that such
code declares. Names are compared, not looked up: a file is kept too much now and then.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cached_property

_RUNTIME = b"/mailbox.h"  # what the files of generated classes include
_MUCH = 200_000  # bytes, from which on comparing names is quicker than reading it all
_INCLUDE = re.compile(rb'#[ \t]*include[ \t]*["<](?:[^">\n]*/)?([^">\n/]+)[">]')
_NAME = re.compile(rb"(?<![\w.])(?<!->)[A-Za-z_]\w*")
# Gaps have bounds, and what is not closed ends with the text: so every search takes linear time.
_NOISE = re.compile(
    rb"""//[^\n]*|/\*[^*]*(?:\*+(?!/)[^*]*)*(?:\*/|\Z)|"[^"\\\n]*(?:\\.[^"\\\n]*)*"?"""
    rb"""|'(?:[^'\\\n]|\\.)'""",
    re.DOTALL,
)
_TYPES = re.compile(
    rb"\b(?:class|struct|union|enum)\s+(?:class\s+|struct\s+)?(?:[A-Z][A-Z0-9_]*\s+)?([A-Za-z_]\w*)"
)
_OFFERS = (
    _TYPES,
    re.compile(rb"#[ \t]*define[ \t]+(\w+)"),
    re.compile(rb"\busing\s+(\w+)\s*="),
    re.compile(rb"\btypedef\b[^;]{0,400}?\b(\w+)\s*(?:\[[^]]{0,40}\]\s*)?;"),
    re.compile(rb"[\w>&*]\s+[&*]*([A-Za-z_]\w*)\s*\("),
    re.compile(rb"^[A-Za-z_][\w:<>, \t]{0,200}?[ \t&*](\w+)\s*(?:=|;|\[|\{)", re.MULTILINE),
    re.compile(rb"\b(?:const|constexpr|extern|static)\b[^;({=]{0,200}?\b(\w+)\s*(?:=|;|\[|\{)"),
)
_ENUMERATION = re.compile(rb"\benum\b[^{;]{0,200}\{([^}]{0,20000})")
_OF_CLASS = re.compile(rb"\b(\w+)\s*(?:<[^;{}()]{0,200}>\s*)?::\s*[~\w]")
# Before the `(` of what is no function.
_WORDS_OF_CPP = frozenset(
    b"if for while switch return sizeof catch delete new throw else case operator".split()
)
_KEYWORDS = _WORDS_OF_CPP | frozenset(
    b"const static void int bool double float char auto class struct union enum public private"
    b" protected virtual inline unsigned long short typename template namespace using override"
    b" final default true false nullptr this std main T".split()
)


def relevant(code: Mapping[str, bytes], only: str | None = None) -> set[str]:
    """Those of some files of code that can matter; `only` is one that does, whatever is in it."""
    if only not in code and not any(_of_nodes(data) for data in code.values()):
        return set()
    kept = {name for name, data in code.items() if name == only or _of_ros(data)}
    if not kept or len(kept) == len(code):
        return kept
    if any(_RUNTIME in data for data in code.values()) and sum(map(len, code.values())) < _MUCH:
        return {*code}  # what runs before `main` counts, which may name nothing of all others
    tied = _tied(code, kept)
    others = sum(len(code[name]) for name in tied - kept)
    if others < _MUCH or others < sum(len(code[name]) for name in kept):
        return tied
    return _named(code, kept, tied - kept)


def _of_nodes(data: bytes) -> bool:
    from rebsync.reverse.libraries.cpp import starts  # which commands that read no code do without

    return any(word in data for word in starts())


def _of_ros(data: bytes) -> bool:
    from rebsync.reverse.libraries.cpp import marks

    return any(word in data for word in marks())


def _tied(code: Mapping[str, bytes], kept: set[str]) -> set[str]:
    """What includes tie to some files, in any direction."""
    by_name: dict[str, list[str]] = {}
    for path in code:
        by_name.setdefault(path.rpartition("/")[2], []).append(path)
    ties: dict[str, set[str]] = {path: set() for path in code}
    for path, data in code.items():
        for included in _INCLUDE.findall(data):
            for other in by_name.get(included.decode("utf-8", "replace"), ()):
                ties[path].add(other)
                ties[other].add(path)
        if b"extern" in data:  # declares what it need not include
            ties[path].update(kept)
            for other in kept:
                ties[other].add(path)
    found, waiting = set(kept), list(kept)
    while waiting:
        fresh = ties[waiting.pop()] - found
        found |= fresh
        waiting += fresh
    return found


def _named(code: Mapping[str, bytes], kept: set[str], others: set[str]) -> set[str]:
    """Some files and those of others that the names in them tie to them."""
    names = {name: _FileNames(code[name]) for name in kept | others}
    types = frozenset[bytes]().union(*(n.types for n in names.values()))
    used, made = set[bytes](), set[bytes]()
    kept, others, fresh = set(kept), set(others), set(kept)
    asking = set(kept)  # what talks to ROS, or to what does
    while fresh:
        for name in fresh:
            used |= names[name].used
        for name in fresh & asking:
            made |= names[name].offered
        users = {n for n in others if not made.isdisjoint(names[n].used)}
        fresh = users | {n for n in others if not used.isdisjoint(names[n].offers(types))}
        asking |= users
        kept |= fresh
        others -= fresh
    return kept


class _FileNames:
    """The names in a file: which it uses, and which it declares or defines."""

    def __init__(self, data: bytes) -> None:
        self.data = _NOISE.sub(b" ", data)

    @cached_property
    def used(self) -> frozenset[bytes]:
        """All names in it but those of members of something."""
        return frozenset(_NAME.findall(self.data)) - _KEYWORDS

    @cached_property
    def types(self) -> frozenset[bytes]:
        """The classes and the like that it names as such."""
        return frozenset(_TYPES.findall(self.data)) - _KEYWORDS

    @cached_property
    def offered(self) -> frozenset[bytes]:
        """What others can name because of it: types, functions, macros, constants, variables."""
        found = {name for pattern in _OFFERS for name in pattern.findall(self.data)}
        for inside in _ENUMERATION.findall(self.data):
            found.update(_NAME.findall(inside))
        return frozenset(found) - _KEYWORDS

    def offers(self, types: frozenset[bytes]) -> frozenset[bytes]:
        """The same, and the classes of which it may define a function."""
        return self.offered | (types & self._classes)

    @cached_property
    def _classes(self) -> frozenset[bytes]:
        return frozenset(_OF_CLASS.findall(self.data))
