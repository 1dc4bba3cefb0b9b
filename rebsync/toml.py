"""Reading TOML with places: each value knows its line, each mistake becomes a diagnostic."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import field
from functools import lru_cache
from typing import TypeVar

from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, did_you_mean
from rebsync.records import dataclass
from rebsync.source import NOWHERE, Source, Span

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

Path = tuple[str | int, ...]
_Value = TypeVar("_Value", bound=str | int | float | bool)

_LARGEST = 10**300  # a float is not much larger
_HEADER = re.compile(r"\s*(\[\[?)\s*(.+?)\s*\]\]?\s*(?:#.*)?$")
_KEY = re.compile(r"""\s*(?=\S)((?:"[^"]*"|'[^']*'|[\w.-]|[ \t]+(?=[\w."'-]))+)[ \t]*=""")
_NAME = r"""(?:[\w-]+|"[^"\n]*"|'[^'\n]*')"""
_DEEP = re.compile(rf"(?<![\w-]){_NAME}(?:[ \t]*\.[ \t]*{_NAME}){{100}}")  # dotted names
_LONG = 1000  # characters of a line in which places are not looked for
_PART = re.compile(r""""([^"]*)"|'([^']*)'|([\w-]+)""")
_DECODE_PLACE = re.compile(r"\s*\(at line (\d+), column (\d+)\)|\s*\(at end of document\)")


@dataclass
class Table:
    """One table of a document; what is never asked for is reported as an unknown key."""

    source: Source
    path: Path
    values: Mapping[str, object]
    diagnostics: list[Diagnostic]
    _asked: set[str] = field(default_factory=set)

    @property
    def places(self) -> Mapping[Path, Span]:
        """Where tables and keys of the whole text stand."""
        return _places(self.source)

    def text(self, key: str, default: str | None = None) -> str | None:
        """The string at `key`."""
        return self._scalar(key, default, str, "a string")

    def integer(self, key: str, default: int | None = None) -> int | None:
        """The whole number at `key`."""
        return self._scalar(key, default, int, "a whole number")

    def number(self, key: str, default: float | None = None) -> float | None:
        """The number at `key`, whole or not."""
        value = self._value(key)
        if isinstance(value, int) and not isinstance(value, bool):
            return float(value) if abs(value) < _LARGEST else math.inf
        return self._scalar(key, default, float, "a number")

    def flag(self, key: str) -> bool:
        """The truth value at `key`; false where there is none."""
        return self._scalar(key, False, bool, "true or false") is True

    def strings(self, key: str) -> tuple[str, ...]:
        """The array of strings at `key`."""
        value = self._value(key)
        if value is None:
            return ()
        if isinstance(value, list) and all(isinstance(item, str) for item in value):
            return tuple(value)
        self.wrong(key, f"`{key}` must be an array of strings")
        return ()

    def raw(self, key: str) -> object:
        """The value at `key`, of whatever type; None when it is not there."""
        return self._value(key)

    def table(self, key: str) -> Table | None:
        """The table at `key`."""
        value = self._value(key)
        if value is None:
            return None
        if isinstance(value, dict):
            return self._below((key,), value)
        self.wrong(key, f"`{key}` must be a table")
        return None

    def tables(self, key: str) -> tuple[Table, ...]:
        """The array of tables at `key`."""
        value = self._value(key)
        if value is None:
            return ()
        if isinstance(value, list) and all(isinstance(item, dict) for item in value):
            return tuple(self._below((key, i), item) for i, item in enumerate(value))
        self.wrong(key, f"`{key}` must be an array of tables", f"write [[{key}]] for each")
        return ()

    def named(self) -> Iterator[tuple[str, object]]:
        """All entries of a table whose keys the user chooses."""
        self._asked.update(self.values)
        yield from self.values.items()

    def named_tables(self) -> Iterator[tuple[str, Table]]:
        """All sub-tables of a table whose keys the user chooses."""
        for key in self.values:
            table = self.table(key)
            if table is not None:
                yield key, table

    def require(self, key: str) -> None:
        """Report `key` when it is missing."""
        self._asked.add(key)
        if key not in self.values:
            name = ".".join(str(part) for part in self.path if isinstance(part, str))
            where = f" in [{name}]" if name else ""
            self.report("RS810", self.place(), f"`{key}` is missing{where}")

    def wrong(self, key: str, message: str, hint: str | None = None) -> None:
        """Report the value at `key`."""
        self.report("RS809", self.place(key), message, hint)

    def report(self, code: str, span: Span, message: str, hint: str | None = None) -> None:
        """Add one finding."""
        self.diagnostics.append(Diagnostic(code, span, message, hint))

    def place(self, key: str | None = None) -> Span:
        """Where `key` stands, or the table when the key cannot be found."""
        path: Path = self.path if key is None else (*self.path, key)
        while path and path not in self.places:
            path = path[:-1]
        return self.places.get(path, NOWHERE)

    def finish(self) -> None:
        """Report every key that was not asked for."""
        for key in self.values:
            if key not in self._asked:
                hint = did_you_mean(key, self._asked) or self._known()
                self.report("RS808", self.place(key), f"unknown key `{key}`", hint)

    def _known(self) -> str:
        """The keys that there are; in a table, that what follows its head belongs to it."""
        listed = _listed(self._asked)
        tables = [part for part in self.path if isinstance(part, str)]
        if not tables:
            return listed
        return f"{listed}; keys of no table stand above the first [{tables[0]}]"

    def _below(self, suffix: Path, values: Mapping[str, object]) -> Table:
        return Table(self.source, (*self.path, *suffix), values, self.diagnostics)

    def _value(self, key: str) -> object:
        self._asked.add(key)
        return self.values.get(key)

    def _scalar(
        self, key: str, default: _Value | None, kind: type[_Value], wanted: str
    ) -> _Value | None:
        value = self._value(key)
        if value is None:
            return default
        if isinstance(value, kind) and isinstance(value, bool) == (kind is bool):
            return value
        self.wrong(key, f"`{key}` must be {wanted}")
        return default


def read_toml(source: Source) -> Table:
    """The top table of a TOML text; a RebsyncError when it is no TOML."""
    if found := _DEEP.search(source.text):  # for which the standard library takes quadratic time
        span = Span(found.start(), found.start() + 1)
        mistake = Diagnostic("RS807", span, "this TOML is nested too deeply")
        raise RebsyncError([Findings(source, (mistake,))])
    try:
        values = tomllib.loads(source.text.replace("\r\n", "\n"))
    except tomllib.TOMLDecodeError as error:
        raise RebsyncError([Findings(source, (_decode_mistake(source, error),))]) from None
    except RecursionError:
        mistake = Diagnostic("RS807", NOWHERE, "this TOML is nested too deeply")
        raise RebsyncError([Findings(source, (mistake,))]) from None
    return Table(source, (), values, [])


def _decode_mistake(source: Source, error: Exception) -> Diagnostic:
    message = str(error)
    place = _DECODE_PLACE.search(message)
    span = Span(len(source.text), len(source.text))
    if place and place[1]:
        span = _span_at(source, int(place[1]), int(place[2]))
    text = _DECODE_PLACE.sub("", message).strip() or "a syntax error"
    return Diagnostic("RS807", span, f"this is not valid TOML: {text[0].lower()}{text[1:]}")


def _span_at(source: Source, line: int, column: int) -> Span:
    start = 0
    for _ in range(line - 1):
        start = source.text.find("\n", start) + 1
    return Span(start + column - 1, start + column)


def _listed(keys: set[str]) -> str:
    return "known keys: " + ", ".join(sorted(keys))


@lru_cache(maxsize=1)  # most texts have no mistake, and need none
def _places(source: Source) -> dict[Path, Span]:
    """The places of headers and keys, found line by line (good enough for messages)."""
    places: dict[Path, Span] = {}
    counts: dict[Path, int] = {}
    table: Path = ()
    offset = 0
    for line in source.text.splitlines(keepends=True):
        if len(line) > _LONG:
            pass
        elif header := _HEADER.match(line):
            table = _header_path(header, counts)
            places.setdefault(table, _span(offset, header, 2))
        elif key := _KEY.match(line):
            path = table
            for part in _parts(key[1]):
                path = (*path, part)
                places.setdefault(path, _span(offset, key, 1))
        offset += len(line)
    return places


def _header_path(header: re.Match[str], counts: dict[Path, int]) -> Path:
    path: Path = ()
    names = _parts(header[2])
    for depth, name in enumerate(names):
        path = (*path, name)
        if header[1] == "[[" and depth == len(names) - 1:
            counts[path] = counts.get(path, -1) + 1
        if path in counts:
            path = (*path, counts[path])
    return path


def _parts(key: str) -> list[str]:
    return ["".join(groups) for groups in _PART.findall(key)]


def _span(offset: int, match: re.Match[str], group: int) -> Span:
    return Span(offset + match.start(group), offset + match.end(group))
