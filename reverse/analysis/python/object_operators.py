"""Which objects of a program of Python lack the method that an operator or a call needs."""

from __future__ import annotations

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.python.class_decorators import ClassDecorators
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir.operators import ImplicitCall, Operator

# Bases of libraries whose objects have no operators, and do not say what attributes they have.
_PLAIN_BASES = frozenset({"builtins.object", "enum.Enum", "abc.ABC"})
# Methods that each class has.
_COMMON = frozenset({"__init__", "__repr__", "__str__", "__eq__", "__ne__", "__hash__"})
_HOOKS = frozenset({"__getattr__", "__getattribute__"})


class ObjectOperators:
    """The objects of one program."""

    def __init__(self, origins: Origins, decorators: ClassDecorators) -> None:
        self._origins = origins
        self._decorators = decorators
        self._program = origins.graph.program

    def lacks(self, value: e.Expression, function: str, call: Operator | ImplicitCall) -> bool:
        """Whether a value may be an object whose class, and no other, answers a call."""
        classes = self._origins.own_classes(value, function)
        return any(self.class_lacks(name, call) for name in classes)

    def class_lacks(self, name: str, call: Operator | ImplicitCall) -> bool:
        """Whether objects of a class do not answer a call."""
        if self._origins.graph.implicit((call,)) or self._decorators.answers(name, call):
            return False  # the other operand's class may
        return self.is_plain(name)

    def is_bare(self, name: str) -> bool:
        """Whether objects of a class answer nothing at all that no text calls."""
        line = [self._program.classes[c] for c in self._line(name) if c in self._program.classes]
        special = {n for c in line for n, _ in c.methods if n.startswith("__")}
        return self.is_plain(name) and special <= _COMMON

    def lacks_attribute(self, of: str, name: str) -> bool:
        """Whether a class itself has no such attribute, nor anything that may make it one."""
        known = [self._program.classes[c] for c in self._line(of) if c in self._program.classes]
        names = {n for c in known for n, _ in c.methods}
        names |= {each.name for c in known for each in c.properties}
        names |= {each.name for c in known for each in c.fields}
        return self.is_plain(of) and name not in names and _HOOKS.isdisjoint(names)

    def _line(self, name: str) -> list[str]:
        return [name, *self._origins.graph.bases(name)]

    def is_plain(self, name: str) -> bool:
        """Whether all is known of a class: no decorator or unknown base adds to it."""
        classes = self._program.classes
        line = self._line(name)
        known = [classes[c] for c in line if c in classes]
        are_plain = all(self._decorators.is_plain(c) and None not in c.bases for c in known)
        return are_plain and all(c in classes or c in _PLAIN_BASES for c in line)
