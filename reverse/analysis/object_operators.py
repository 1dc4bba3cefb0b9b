"""Which objects of a program of Python lack the method that an operator or a call needs."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import Key, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import ImplicitCall, Operator
from rebsync.reverse.ir.walk import walk

# Bases of libraries whose objects have no operators, and do not say what attributes they have.
_PLAIN_BASES = frozenset({"builtins.object", "enum.Enum", "abc.ABC"})
_HOOKS = frozenset({"__getattr__", "__getattribute__"})
_GROWING = ("append", "appendleft", "add")


class ObjectOperators:
    """The objects of one program."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins
        self._program = origins.graph.program

    def lacks(self, value: e.Expression, function: str, call: Operator | ImplicitCall) -> bool:
        """Whether a value may be an object whose class, and no other, answers a call."""
        if self._origins.graph.implicit((call,)):
            return False  # the other operand's class may
        return any(map(self._is_plain, self._origins.own_classes(value, function)))

    def has_lacking_elements(self, container: e.Expression, function: str, call: Operator) -> bool:
        """Whether a container may hold such objects."""
        if self._origins.graph.implicit((call,)):
            return False
        held = self._elements(container, function)
        classes = (c for around, v in held for c in self._origins.own_classes(v, around))
        return any(map(self._is_plain, classes))

    def lacks_attribute(self, of: str, name: str) -> bool:
        """Whether a class itself has no such attribute, nor anything that may make it one."""
        known = [self._program.classes[c] for c in self._line(of) if c in self._program.classes]
        names = {n for c in known for n, _ in c.methods}
        names |= {each.name for c in known for each in c.properties}
        names |= {each.name for c in known for each in c.fields}
        return self._is_plain(of) and name not in names and _HOOKS.isdisjoint(names)

    def _line(self, name: str) -> list[str]:
        return [name, *self._origins.graph.bases(name)]

    def _is_plain(self, name: str) -> bool:
        """Whether all is known of a class: no decorator or unknown base adds to it."""
        classes = self._program.classes
        line = self._line(name)
        known = [classes[c] for c in line if c in classes]
        are_plain = all(c.complete and None not in c.bases for c in known)
        return are_plain and all(c in classes or c in _PLAIN_BASES for c in line)

    def _elements(
        self, container: e.Expression, function: str
    ) -> Iterator[tuple[str, e.Expression]]:
        """What a container is made with, and what is put into it under the same name."""
        key = key_of(container, function)
        stored = self._origins.graph.stores.of(key) if key is not None else [(function, container)]
        for around, value in stored:
            if isinstance(value, e.Build):
                yield from ((around, v) for v in value.elements if not isinstance(v, e.Spread))
        if key is not None:
            yield from self._put.get(key, ())

    @cached_property
    def _put(self) -> dict[Key, list[tuple[str, e.Expression]]]:
        """What is put into containers, by their names."""
        found: dict[Key, list[tuple[str, e.Expression]]] = {}
        for name in self._program.functions:
            for node in walk(self._program.function(name)):
                match node:
                    case s.Call(_, s.MethodCallee(of, method), (argument,)) if method in _GROWING:
                        key = key_of(of, name)
                        if key is not None:
                            found.setdefault(key, []).append((name, argument.value))
                    case _:
                        pass
        return found
