"""What a program of Python puts into containers, whatever it calls them there.

A container is known by the name under which it was first stored, its site: what is put into it
under another name is put into that. What is put into an unknown container may be put into any.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property

from rebsync.records import dataclass
from rebsync.reverse.analysis.python.type_queries import TypeQueries
from rebsync.reverse.analysis.python.value_types import (
    ANY_KEY,
    ANY_TYPE,
    CHANGING,
    NO_TYPES,
    ContainerType,
    OwnType,
    ValueType,
    ValueTypes,
    at_index,
    elements_of,
    inside,
    joined_items,
    limited,
    merged,
    sited,
    values_of,
    written,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.program import Program
from rebsync.reverse.ir.walk import Node, walk

_LIST, _QUEUE, _SET, _MAPPING = OwnType.LIST, OwnType.QUEUE, OwnType.SET, OwnType.MAPPING
# By the name of each method that puts something into its object: what that may be.
_METHODS = {
    **dict.fromkeys(("append", "extend", "insert"), (_LIST, _QUEUE)),
    **dict.fromkeys(("appendleft", "extendleft"), (_QUEUE,)),
    **dict.fromkeys(("add", "symmetric_difference_update"), (_SET,)),
    **{"update": (_SET, _MAPPING), "setdefault": (_MAPPING,)},
    **{"__setitem__": (_LIST, _QUEUE, _MAPPING), "__iadd__": (_LIST, _QUEUE)},
    "__ior__": (_SET, _MAPPING),
}
_LAST = frozenset({"append", "appendleft", "add", "insert", "setdefault", "__setitem__"})
_KEYED = frozenset({"setdefault", "__setitem__"})
# Functions that put their second argument into the first.
_PUTTING = frozenset(
    {f"heapq.{n}" for n in ("heappush", "heappushpop", "heapreplace")}
    | {f"bisect.{n}" for n in ("insort", "insort_left", "insort_right")}
)
_ADDING = frozenset({Operator.ADD, Operator.BIT_OR, Operator.BIT_XOR})
_UNBOUND = {f"builtins.{t}.{n}": n for t in ("list", "set", "dict") for n in _METHODS} | {
    f"collections.deque.{n}": n for n in _METHODS
}


@dataclass(frozen=True, slots=True)
class Put:
    """A value, or any, that a function puts into a container of some types.

    It is put under a key, or (`is_all`) its elements are.
    """

    function: str
    container: e.Expression
    owns: tuple[OwnType, ...] = CHANGING
    value: e.Expression | None = None
    key: e.Expression | None = None
    is_all: bool = False


class ContainerStores:
    """The containers of one program; `types` are those of the values in it."""

    def __init__(self, program: Program, types: TypeQueries, depth: int) -> None:
        self._program = program
        self._types = types
        self._depth = depth

    @cached_property
    def _puts(self) -> list[Put]:
        program = self._program
        return [
            put
            for n in program.functions
            for node in walk(program.function(n))
            for put in _put(node, n)
        ]

    def contents(self, before: ValueTypes) -> ValueTypes:
        """What is put into containers, each time as one of its site, with what was known before."""
        found = {type_.sites: type_ for type_ in before if isinstance(type_, ContainerType)}
        for number, put in enumerate(self._puts):
            into = set[tuple[object, OwnType]]()
            for type_ in self._types.of(put.container, put.function):
                if type_ is None:
                    into |= {(own, own) for own in put.owns}
                elif isinstance(type_, ContainerType) and type_.own in CHANGING:
                    into |= {(site, type_.own) for site in type_.sites}
            for site, own in into:
                sites = frozenset((site,))
                more = replace(self._content(put, number, own), sites=sites)
                known = found.get(sites)
                both = frozenset((more,) if known is None else (more, known))
                found[sites] = next(iter(merged(limited(both, self._depth))))  # type: ignore[assignment]
        return frozenset(found.values())

    def _content(self, put: Put, number: int, own: OwnType) -> ContainerType:
        """A container of nothing but what is put into one of a type."""
        if put.value is None:
            return ContainerType(own, ANY_TYPE, ANY_TYPE, None, frozenset(((ANY_KEY, ANY_TYPE),)))
        found = self.filled(number, self._types.element(put.value, put.function))
        if own is not _MAPPING:
            return ContainerType(own, elements_of(found) if put.is_all else found, NO_TYPES)
        if put.key is not None:
            keys = self._types.element(put.key, put.function)
            return ContainerType(own, keys, found, None, frozenset(written(put.key, found)))
        mappings = frozenset(t for t in found if isinstance(t, ContainerType) and t.own is own)
        pairs = elements_of(found - mappings)
        keys = elements_of(mappings) | at_index(pairs, 0)
        values = values_of(mappings) | at_index(pairs, 1)
        return ContainerType(own, keys, values, None, frozenset(((ANY_KEY, values),)))

    def filled(self, name: object, types: ValueTypes) -> ValueTypes:
        """Types of what is stored under a name, with what is put into that anywhere."""
        if not any(isinstance(type_, ContainerType) for type_ in types):
            return types
        known = self._types.contents()
        held = {t.sites: t for t in known if isinstance(t, ContainerType)}
        return self._filled(sited(types, name), held)

    def _filled(
        self, types: ValueTypes, held: dict[frozenset[object], ContainerType]
    ) -> ValueTypes:
        return frozenset(self._with_content(type_, held) for type_ in types)

    def _with_content(
        self, type_: ValueType | None, held: dict[frozenset[object], ContainerType]
    ) -> ValueType | None:
        if not isinstance(type_, ContainerType):
            return type_
        type_ = inside(type_, lambda types: self._filled(types, held))
        if type_.own not in CHANGING:
            return type_
        for site in (*type_.sites, type_.own):
            more = held.get(frozenset((site,)))
            if more is not None and more.own is type_.own:
                elements, values = type_.elements | more.elements, type_.values | more.values
                items = joined_items(type_.items, more.items)
                type_ = replace(type_, elements=elements, values=values, items=items)
        return type_


def _put(node: Node, function: str) -> Iterator[Put]:
    match node:
        case s.Insert(container, value, key):
            yield Put(function, container, CHANGING, value, key)
        case s.Assign(e.Index(container, e.Slice()), value):
            yield Put(function, container, (_LIST,), value, is_all=True)
        case s.Assign(e.Index(container, index), value):
            yield Put(function, container, _METHODS["__setitem__"], value, index)
        case s.CompoundAssign(e.Index(container, index) as element, operator, value):
            if not isinstance(index, e.Slice):  # where one is missing, a counter gets it
                computed = e.Binary(operator, element, value)
                yield Put(function, container, _METHODS["__setitem__"], computed, index)
        case s.Call(_, s.MethodCallee(container, method)) if method in _METHODS:
            yield from _of_method(function, container, method, node.arguments)
        case s.Call(_, s.LibraryCallee(name), (container, *rest)) if name in _UNBOUND:
            yield from _of_method(function, container.value, _UNBOUND[name], tuple(rest))
        case s.Call(_, s.LibraryCallee(name), (container, argument, *_)) if name in _PUTTING:
            yield Put(function, container.value, (_LIST,), argument.value)
        case e.Attribute(container, method) if method in _METHODS:  # which may be called later
            yield Put(function, container, _METHODS[method])
        case _:
            pass
    match node:
        case s.CompoundAssign(container, operator, value) if operator in _ADDING:
            yield Put(function, container, CHANGING, value, is_all=True)
        case _:
            pass


def _of_method(
    function: str, container: e.Expression, method: str, arguments: tuple[s.CallArgument, ...]
) -> Iterator[Put]:
    """What a call of a method puts into its object."""
    owns = _METHODS[method]
    plain = [a.value for a in arguments if a.name is None]
    if any(a.stars for a in arguments):
        yield Put(function, container, owns)
    elif method == "update":
        yield from (Put(function, container, owns, value, is_all=True) for value in plain)
        named = ((e.Literal(a.name), a.value) for a in arguments if a.name is not None)
        yield from (Put(function, container, (_MAPPING,), value, key) for key, value in named)
    elif plain:
        key = plain[0] if method in _KEYED else None
        yield Put(function, container, owns, plain[-1], key, is_all=method not in _LAST)
