"""Parameter files: YAML, as `rosparam` reads it, to values by name with the place of each.

A mapping inside another becomes a part of the name (`mailbox/slack`). PyYAML's scanner and its
rules for scalars are used, none of its constructors for objects. What the parameter server cannot
hold (null, a date, an integer beyond 32 bits) is open.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import TypeAlias, TypeVar

import yaml

from rebsync.records import dataclass
from rebsync.reverse.launch.arithmetic import evaluate
from rebsync.reverse.unknowns import Open, Unknown
from rebsync.source import Source, Span

ParameterValue: TypeAlias = "bool | int | float | str | tuple[ParameterValue, ...] | Struct"

_Stored = TypeVar("_Stored", bound=object)
YAML = "the YAML"  # what is not known where a text is none
_MOST = 100_000
_RESOLVED = "tag:yaml.org,2002:"
_SCALARS = frozenset(_RESOLVED + name for name in ("bool", "float", "int", "str"))
_MERGE = _RESOLVED + "merge"
_ANGLE = re.compile(r"(deg|rad)\([^)]*\)\Z")


@dataclass(frozen=True, slots=True)
class Struct:
    """A mapping inside a list; the entries are in the order of the file."""

    entries: tuple[tuple[str, ParameterValue], ...]


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter: its name, its value or why it is open, and the place that gives the value."""

    name: str
    value: ParameterValue | Open
    source: Source
    span: Span


@dataclass(frozen=True, slots=True)
class Parameters:
    """The parameters of a text, each name once, the last value; a lone value has the name ``.

    Each parameter with an open value also has its Unknown. `replaced`: what a later entry of the
    same name takes the place of.
    """

    entries: tuple[Parameter, ...]
    unknowns: tuple[Unknown, ...]
    replaced: tuple[Parameter, ...] = ()


def _same(span: Span) -> Span:
    return span


def read_parameters(
    source: Source, text: str | None = None, place: Callable[[Span], Span] = _same
) -> Parameters:
    """The parameters of a file, or of a `text` in it whose ranges `place` finds in the source."""
    reader = _Reader(source, place)
    try:
        root = _composed(source.text if text is None else text)
        if root is not None:
            reader.flatten("", root)
    except yaml.YAMLError as error:
        reader.mistake(error)
    except (_TooLarge, RecursionError):
        reader.unknown(YAML, "it is nested too deeply, or too large, to be read", Span(0, 0))
    return Parameters(
        tuple(reader.entries.values()), tuple(reader.unknowns), tuple(reader.replaced)
    )


@lru_cache(maxsize=8)
def _composed(text: str) -> yaml.Node | None:
    """The tree of a text; kept for a while, as many nodes of a launch file load the same one."""
    return yaml.compose(text, Loader=yaml.SafeLoader)


def storable(value: _Stored) -> _Stored | Open:
    """The value, or why the parameter server cannot hold it: XML-RPC has integers of 32 bits."""
    if isinstance(value, int) and not -(1 << 31) <= value < 1 << 31:
        return Open("the parameter server holds integers of 32 bits only")
    return value


class _TooLarge(Exception):
    """Aliases make the text stand for more values than are read."""


class _Reader:
    def __init__(self, source: Source, place: Callable[[Span], Span]) -> None:
        self.entries: dict[str, Parameter] = {}
        self.replaced: list[Parameter] = []
        self.unknowns: list[Unknown] = []
        self._source = source
        self._place = place
        self._left = _MOST
        self._inside: set[int] = set()
        self._constructor = yaml.constructor.SafeConstructor()

    def unknown(self, what: str, why: str, span: Span) -> None:
        self.unknowns.append(Unknown(what, why, self._source, self._place(span)))

    def mistake(self, error: yaml.YAMLError) -> None:
        mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
        at = mark.index if mark is not None else getattr(error, "position", 0) or 0
        why = getattr(error, "problem", None) or getattr(error, "reason", None) or str(error)
        self.unknown(YAML, why, Span(at, at))

    def flatten(self, name: str, node: yaml.Node) -> None:
        """Sets the parameters that a node stands for under a name."""
        if not isinstance(node, yaml.MappingNode):
            self._set(name, node, self._value(node))
            return
        with_node = self._enter(node)
        for key, value in self._pairs(node):
            word = self._key(key)
            if isinstance(word, Open):
                self.unknown("a parameter", word.why, yaml_span(key))
            else:
                self.flatten(word if not name or word.startswith("/") else f"{name}/{word}", value)
        self._inside.discard(with_node)

    def _set(self, name: str, node: yaml.Node, value: ParameterValue | Open) -> None:
        if isinstance(value, Open):
            self.unknown(
                f"the parameter `{name}`" if name else "the value", value.why, yaml_span(node)
            )
        if (before := self.entries.pop(name, None)) is not None:
            self.replaced.append(before)
        self.entries[name] = Parameter(name, value, self._source, self._place(yaml_span(node)))

    def _enter(self, node: yaml.Node) -> int:
        self._left -= 1
        if self._left < 0 or id(node) in self._inside:
            raise _TooLarge
        self._inside.add(id(node))
        return id(node)

    def _pairs(self, node: yaml.MappingNode) -> Iterator[tuple[yaml.Node, yaml.Node]]:
        """The entries of a mapping; what `<<` merges comes first, so that others override it."""
        for key, value in node.value:
            if key.tag == _MERGE:
                several = isinstance(value, yaml.SequenceNode)
                for merged in reversed(value.value) if several else (value,):
                    if not isinstance(merged, yaml.MappingNode):
                        self.unknown("what `<<` merges", "it is no mapping", yaml_span(merged))
                        continue
                    entered = self._enter(merged)
                    yield from self._pairs(merged)
                    self._inside.discard(entered)
        yield from ((key, value) for key, value in node.value if key.tag != _MERGE)

    def _key(self, node: yaml.Node) -> str | Open:
        if not isinstance(node, yaml.ScalarNode) or node.tag != _RESOLVED + "str":
            return Open("its name is not a text; put it in quotes")
        name: str = node.value
        if not name or name.startswith("~"):
            return Open("its name is empty" if not name else "a private name has no node here")
        return name

    def _value(self, node: yaml.Node) -> ParameterValue | Open:
        match node:
            case yaml.ScalarNode():
                self._left -= 1
                return self._scalar(node)
            case yaml.SequenceNode():
                entered = self._enter(node)
                values = [self._value(item) for item in node.value]
                self._inside.discard(entered)
                return _first_open(values) or tuple(v for v in values if not isinstance(v, Open))
            case yaml.MappingNode():
                return self._struct(node)
            case _:
                return Open("this is no value of YAML")

    def _struct(self, node: yaml.MappingNode) -> Struct | Open:
        entered = self._enter(node)
        entries: dict[str, ParameterValue] = {}
        found: Open | None = None
        for key, item in self._pairs(node):
            word, value = self._key(key), self._value(item)
            if isinstance(word, Open) or isinstance(value, Open):
                found = found or _first_open([word, value])
            else:
                entries[word] = value
        self._inside.discard(entered)
        return found or Struct(tuple(entries.items()))

    def _scalar(self, node: yaml.ScalarNode) -> ParameterValue | Open:
        if self._left < 0:
            raise _TooLarge
        kind = _angle(node)
        if kind:
            return _radians(kind, node.value)
        if node.tag == _RESOLVED + "null":
            return Open("null is no value of a parameter")
        if node.tag not in _SCALARS:
            return Open(f"a value of the kind `{node.tag.rpartition(':')[2]}` is not read")
        try:
            value: ParameterValue = self._constructor.construct_object(node)
        except (yaml.YAMLError, ValueError, LookupError) as error:
            return Open(f"`{node.value}` has no value: {error}")
        return storable(value)


def _first_open(values: list[ParameterValue | Open]) -> Open | None:
    return next((v for v in values if isinstance(v, Open)), None)


def yaml_span(node: yaml.Node) -> Span:
    """The place of a node in its text."""
    return Span(node.start_mark.index, node.end_mark.index)


def _angle(node: yaml.ScalarNode) -> str | None:
    """`deg` or `rad` for the angles that `rosparam` knows, by tag or as plain `rad(pi/2)`."""
    if node.tag in ("!degrees", "!radians"):
        return "deg" if node.tag == "!degrees" else "rad"
    match = _ANGLE.match(node.value) if node.tag == _RESOLVED + "str" else None
    return match[1] if match and node.style is None else None


def _radians(kind: str, text: str) -> float | Open:
    inner = text.strip()
    if inner.startswith(f"{kind}("):
        inner = inner[4:-1]
    value = evaluate(inner, {}, {})
    if isinstance(value, (Open, str)):
        return value if isinstance(value, Open) else Open(f"`{text}` is no angle")
    return float(value) * (math.pi / 180.0 if kind == "deg" else 1.0)
