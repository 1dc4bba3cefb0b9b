"""What calls of Python ask of the elements of containers: an order, a sum, texts, hashes."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from rebsync.reverse.analysis.facts import Facts
from rebsync.reverse.analysis.held_values import held_by
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.python.operand_kinds import OperandKinds
from rebsync.reverse.analysis.python.operator_types import are_comparable, are_ordered, is_hashable
from rebsync.reverse.analysis.python.value_types import (
    A_NUMBER,
    A_TEXT,
    ContainerType,
    OwnType,
    ValueTypes,
    at_index,
    elements_of,
    own_type,
    union,
    values_of,
)
from rebsync.reverse.analysis.stores import CallResult
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator

_WRONG = "is of another type"
# Functions that compare the elements of what they get, or what they get, if that is several.
_SORTING = frozenset({"builtins.sorted", "builtins.max", "builtins.min"})
_HEAPS = frozenset(
    {
        *(f"heapq.{name}" for name in ("heappush", "heappushpop", "heapreplace")),
        *(f"bisect.{name}" for name in ("bisect", "bisect_left", "bisect_right", "insort")),
    }
)
_OF_HEAPS = frozenset({"heapq.heapify", "heapq.heappop"})
_CHOOSING = frozenset({"heapq.nlargest", "heapq.nsmallest"})
_SETS = frozenset({"builtins.set", "builtins.frozenset"})


class ElementErrors:
    """The containers of one function, in Python."""

    def __init__(self, notes: ProblemNotes, kinds: OperandKinds) -> None:
        self._notes = notes
        self._kinds = kinds
        self._objects = notes.counts.rules.objects
        self._decorators = notes.counts.rules.decorators

    def call(self, node: s.Call, plain: Sequence[e.Expression], facts: Facts) -> None:
        """Notes what a call asks of elements that may have it not."""
        names = {a.name for a in node.arguments}
        given = [self._kinds.types(value, facts) for value in plain]
        match node.callee:
            case s.LibraryCallee(name) if name in _SORTING and "key" in names:
                keys = (a.value for a in node.arguments if a.name == "key")
                inside = _inside(given) if len(given) == 1 else union(given)
                self._orders(node, union(self._keyed(key, inside, facts) for key in keys))
            case s.LibraryCallee(name) if name in _SORTING:
                self._orders(node, union(given) if len(given) > 1 else _inside(given))
            case s.MethodCallee(receiver, "sort") if "key" not in names:
                self._orders(node, _inside([self._kinds.types(receiver, facts)]))
            case s.LibraryCallee(name) if name in _HEAPS and len(given) == 2:
                self._orders(node, _inside(given[:1]) | given[1])
            case s.LibraryCallee(name) if name in _OF_HEAPS:
                self._orders(node, _inside(given))
            case s.LibraryCallee(name) if name in _CHOOSING and "key" not in names:
                self._orders(node, _inside(given[1:]))
            case s.LibraryCallee("heapq.merge"):
                self._orders(node, union(_inside([types]) for types in given))
            case s.LibraryCallee("builtins.sum"):
                # It begins with 0, or with what it gets.
                first = given[1] if len(given) > 1 else A_NUMBER
                self._fits(node, _inside(given), set(map(own_type, first)))
            case s.MethodCallee(receiver, "join") if self._kinds.types(receiver, facts) == A_TEXT:
                self._fits(node, _inside(given), {OwnType.TEXT})
            case s.LibraryCallee(name) if name in _SETS:
                self._hashes(node, _inside(given))
            case s.MethodCallee(receiver, "add"):
                if self._kinds.of(receiver, facts) == {OwnType.SET}:
                    self._hashes(node, union(given))
            case _:
                pass

    def _keyed(self, key: e.Expression, inside: ValueTypes, facts: Facts) -> ValueTypes:
        """The types of what a function gives for elements by which they are ordered."""
        match key:
            case e.Literal(None):
                return inside
            case e.Attribute(of, "get"):
                return values_of(self._kinds.types(of, facts))
            case e.Temporary() | e.Local():
                held = held_by(self._notes.origins, key, self._notes.function.name)
                match held:
                    case [(_, CallResult(s.Call(_, s.LibraryCallee(name), (index,))))]:
                        if name == "operator.itemgetter" and isinstance(index.value, e.Literal):
                            return at_index(inside, index.value.value)
                    case _:
                        pass
        return self._kinds.mapped(key)

    def built(self, value: e.Build | e.BuildMapping, facts: Facts) -> None:
        """Notes that a new set or mapping gets elements or keys without a hash."""
        match value:
            case e.BuildMapping(_, entries):
                keys = [entry[0] for entry in entries if not isinstance(entry, e.Spread)]
            case e.Build(t.Container(t.ContainerKind.SET), elements):
                keys = [v for v in elements if not isinstance(v, e.Spread)]
            case _:
                return
        self._hashes(value, union(self._kinds.types(key, facts) for key in keys))

    def inserted(self, node: s.Insert, facts: Facts) -> None:
        """Notes that an element that is put into a set, or its key in a mapping, has no hash."""
        is_set = OwnType.SET in self._kinds.of(node.container, facts)
        key = node.value if node.key is None and is_set else node.key
        if key is not None:
            self.is_key(node, key, facts)

    def is_key(self, node: s.Statement | e.Expression, key: e.Expression, facts: Facts) -> None:
        """Notes that the key of a mapping may have no hash."""
        self._hashes(node, self._kinds.types(key, facts))

    def _orders(self, node: s.Statement, types: ValueTypes) -> None:
        if not are_ordered(self._kinds.known(types), self._has_order):
            self._notes.fails(node, _WRONG)

    def are_comparable(self, left: ValueTypes, right: ValueTypes) -> bool:
        """Whether values of some types can be compared with those of others."""
        return are_comparable(self._kinds.known(left), self._kinds.known(right), self._has_order)

    def _has_order(self, name: str) -> bool:
        return not self._objects.class_lacks(name, Operator.LESS)

    def _hashes(self, node: s.Statement | e.Expression, types: ValueTypes) -> None:
        if not is_hashable(self._kinds.known(types), self._decorators.has_hash):
            self._notes.fails(node, _WRONG)

    def _fits(
        self, node: s.Statement, types: ValueTypes, taken: Collection[OwnType | None]
    ) -> None:
        own = frozenset(map(own_type, self._kinds.known(types)))
        if not own.issubset(taken) or None in own:
            self._notes.fails(node, _WRONG)


def _inside(given: Sequence[ValueTypes]) -> ValueTypes:
    """The types of the elements of the first of some values, None among them."""
    found = union(given[:1])
    own = (type_.elements for type_ in found if isinstance(type_, ContainerType))
    return union(own) | elements_of(frozenset(t for t in found if not isinstance(t, ContainerType)))
