"""The interface between the parts of the evaluator of Python, and their state."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator
from dataclasses import field as with_default
from itertools import product
from types import UnionType

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import Place, Resolved, Unresolved
from rebsync.reverse.python.values.py_worth import (
    MOST,
    Class,
    External,
    Instance,
    Items,
    Module,
    Table,
    Value,
    Ways,
    joined,
    resolved,
)
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_tree import named

_Key = tuple[str, int]
# What may have a name that others read: of all other objects it is known that they do not.
_SHARED = Module | Class | Instance | Unresolved


@dataclass(eq=False, slots=True)
class PyEvaluator(ABC):
    """The values of expressions in some files; what was found is kept."""

    code: PyCode
    kept: dict[_Key, Ways] = with_default(default_factory=dict)
    under_way: set[_Key] = with_default(default_factory=set)
    cycles: list[set[_Key]] = with_default(default_factory=list)
    steps: int = 0
    stores: dict[str, list[tuple[Binding, Scope]]] | None = None
    holders: dict[str, Ways] = with_default(default_factory=dict)

    def value(self, node: Node, scope: Scope) -> Resolved:
        """The value of an expression as it stands in a graph."""
        return resolved(self.ways(node, scope), self.unknown("it is computed", node, scope))

    def text(self, node: Node, scope: Scope) -> str | None:
        """The text of an expression if it is always the same."""
        match self.ways(node, scope):
            case (str() as text,):
                return text
            case _:
                return None

    def unknown(self, why: str, node: Node, scope: Scope) -> Unresolved:
        return Unresolved(why, Place(scope.py.source, scope.py.span(node)))

    def join(self, parts: list[Ways], node: Node, scope: Scope) -> Ways:
        """Texts one behind the other, in all ways."""
        none = (self.unknown("the text is put together of what is not known", node, scope),)
        filled = [p or none for p in parts]
        count = 1
        for part in filled:
            count *= len(part)
        if count > MOST:
            return none
        return tuple(joined(chosen, lambda: none[0]) for chosen in product(*filled))

    def is_stored(self, name: str, kinds: type | UnionType = _SHARED) -> bool:
        """Whether something is stored under a name in such an object that is no method's own."""
        if self.stores is None:
            self.stores = {}
            for scope in (*self.code.scopes.values(), *self.code.modules.values()):
                for (_, stored), bindings in scope.stores.items():
                    self.stores.setdefault(stored, []).extend((b, scope) for b in bindings)
        if name not in self.holders:
            stores = self.stores.get(name, ())
            # Until it is known what they store in, it may be anything.
            self.holders[name] = tuple(self.unknown("this", b.node, s) for b, s in stores[:1])
            self.holders[name] = tuple(w for b, scope in stores for w in self._holder(b, scope))
        return any(isinstance(way, kinds) for way in self.holders[name])

    def _holder(self, binding: Binding, scope: Scope) -> Ways:
        """The object in whose attribute a statement stores."""
        left = binding.node.child_by_field_name("left")
        holder = left.child_by_field_name("object") if left is not None else None
        found = self.ways(holder, scope) if holder is not None else ()
        return found or (self.unknown("what this stores in", binding.node, scope),)

    @abstractmethod
    def bound(self, binding: Binding, name: str, scope: Scope) -> Ways:
        """What a binding of a name in a scope gives."""

    @abstractmethod
    def ways(self, node: Node, scope: Scope) -> Ways:
        """All that an expression may be worth.

        What depends on itself adds nothing to its own value; what was found on such a way holds
        for that way only, and is not kept.
        """

    @abstractmethod
    def operated(
        self, operator: str, left: Ways, right: Ways, node: Node, scope: Scope
    ) -> Iterable[Value]:
        """An operation on all that its operands may be."""


def each_of(values: PyEvaluator, node: Node, scope: Scope) -> list[Ways]:
    """What a loop goes through, one round after the other."""
    rounds: list[Ways] = []
    for value in values.ways(node, scope):
        match value:
            case Items(each):
                rounds += each
            case Table(pairs):
                rounds += [key for key, _ in pairs]
            case Unresolved():
                rounds.append((Unresolved(value.why, value.place),))
            case _:
                rounds.append((values.unknown("a loop over what is not known", node, scope),))
    return rounds


def lineage(
    values: PyEvaluator, owner: Scope, seen: tuple[Scope, ...] = ()
) -> list[Scope | External]:
    """A class and those above it in the order in which Python looks attributes up (C3: Barrett et
    al., A Monotonic Superclass Linearization for Dylan); of those not in the files the names."""
    if owner in seen:
        return []
    above: list[list[Scope | External]] = []
    bases = owner.node.child_by_field_name("superclasses")
    for base in named(bases) if bases is not None else []:
        if base.type == "keyword_argument":
            continue
        for value in values.ways(base, owner.parent or owner):
            if isinstance(value, Class):
                above.append(lineage(values, value.scope, (*seen, owner)))
            elif isinstance(value, External):
                above.append([value])
    return [owner, *_merged([*above, [line[0] for line in above if line]])]


def _merged(lines: list[list[Scope | External]]) -> Iterator[Scope | External]:
    """The classes of several lines in an order that is that of each; else those of the first."""
    while lines := [line for line in lines if line]:
        later = [each for line in lines for each in line[1:]]
        first = next((line[0] for line in lines if line[0] not in later), lines[0][0])
        yield first
        lines = [[each for each in line if each != first] for line in lines]
