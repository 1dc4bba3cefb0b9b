"""Least fixpoints: of equations between sets, and by rounds; the cycles of a graph."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Mapping
from typing import Generic, TypeAlias, TypeVar
from weakref import WeakMethod

from rebsync.records import dataclass

T = TypeVar("T")
K = TypeVar("K", bound=Hashable)
# What an element of a set adds to another set.
Transfer: TypeAlias = Callable[[T], frozenset[T]]


@dataclass(frozen=True, slots=True)
class Equation(Generic[T]):
    """A set: elements of its own, and what elements of other sets add, by the names of these."""

    own: frozenset[T]
    uses: tuple[tuple[str, Transfer[T]], ...] = ()


class LeastFixpoint(Generic[T]):
    """The least sets that equations allow, one by a name.

    What functions do that call each other so does not depend on which of them is looked at first,
    and no chain of calls is too long. Each equation is asked for once; then only what is new in a
    set goes on to those that use it. `settled` gets the names of sets that grow no more, and gives
    more elements of some. Both are methods of who has this: they are not kept alive.
    """

    def __init__(
        self,
        equation: Callable[[str], Equation[T]],
        settled: Callable[[Collection[str]], Mapping[str, frozenset[T]]] | None = None,
    ) -> None:
        self._equation = WeakMethod(equation)
        self._settled = WeakMethod(settled) if settled is not None else None
        self._known: dict[str, frozenset[T]] = {}

    def of(self, name: str) -> frozenset[T]:
        """The set of a name."""
        if name not in self._known:
            self._solve(name)
        return self._known[name]

    def solved(self, equation: Equation[T]) -> frozenset[T]:
        """The set of an equation that is used by no other."""
        added = (transfer(x) for name, transfer in equation.uses for x in self.of(name))
        return equation.own.union(*added)

    def _solve(self, first: str) -> None:
        equation_of = self._equation()
        settled = self._settled() if self._settled is not None else None
        assert equation_of is not None
        equations: dict[str, Equation[T]] = {}
        waiting = [first]
        while waiting:
            name = waiting.pop()
            if name not in equations:
                equations[name] = equation_of(name)
                uses = (used for used, _ in equations[name].uses)
                waiting += (u for u in uses if u not in self._known)
        users: dict[str, list[tuple[str, Transfer[T]]]] = {}
        growing = list[tuple[str, frozenset[T]]]()
        for name, equation in equations.items():
            for used, transfer in equation.uses:
                users.setdefault(used, []).append((name, transfer))
            known = [u for u in equation.uses if u[0] in self._known]
            growing.append((name, self.solved(Equation(equation.own, tuple(known)))))
        found = dict.fromkeys(equations, frozenset[T]())
        _grow(found, users, growing)
        if settled is not None:
            _grow(found, users, [*settled(found.keys()).items()])
        self._known |= found


def _grow(
    found: dict[str, frozenset[T]],
    users: Mapping[str, list[tuple[str, Transfer[T]]]],
    growing: list[tuple[str, frozenset[T]]],
) -> None:
    """Adds to sets, and to those that use them what that adds."""
    while growing:
        name, more = growing.pop()
        more -= found[name]
        if more:
            found[name] |= more
            for user, transfer in users.get(name, ()):
                growing.append((user, frozenset().union(*map(transfer, more))))


class Rounds(Generic[K, T]):
    """The least fixpoint of values that are computed of each other, one by a name.

    `value` gets a name and what was found under it in the round before, of which it never gives
    less; it asks for others by `of`. In a round each name is visited once; the rounds end when
    nothing changes. It is a method of who has this, and not kept alive. `least` is what is known of
    a name that is under way.
    """

    def __init__(self, value: Callable[[K, T], T], least: T) -> None:
        self._value = WeakMethod(value)
        self._least = least
        self._known: dict[K, T] = {}
        self._found: dict[K, T] = {}
        self._visited: set[K] | None = None

    @property
    def is_under_way(self) -> bool:
        return self._visited is not None

    def of(self, name: K) -> T:
        """The value under a name: in a round, as far as it was found."""
        if name in self._known:
            return self._known[name]
        if self._visited is not None:
            return self._visit(name, self._visited)
        before: dict[K, T] | None = None
        try:
            while before != self._found:
                before = dict(self._found)
                self._visited = set()
                self._visit(name, self._visited)
            self._known |= self._found
        finally:  # this may lead deeper than it can be followed, and what was found is not all
            self._visited = None
            self._found.clear()
        return self._known[name]

    def _visit(self, name: K, visited: set[K]) -> T:
        if name not in visited:
            visited.add(name)
            value = self._value()
            assert value is not None
            self._found[name] = value(name, self._found.get(name, self._least))
        return self._found.get(name, self._least)


def in_cycles(edges: Mapping[str, Collection[str]]) -> frozenset[str]:
    """The nodes of a graph that lead to themselves (Tarjan's components, without recursion)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    path: list[str] = []  # nodes whose component is not known yet
    found: set[str] = set()
    for first in edges:
        waiting = [(first, iter(edges[first]))] if first not in index else []
        while waiting:
            node, targets = waiting[-1]
            if node not in index:
                index[node] = low[node] = len(index)
                path.append(node)
            target = next(targets, None)
            if target is None:
                waiting.pop()
                if waiting:
                    low[waiting[-1][0]] = min(low[waiting[-1][0]], low[node])
                if low[node] == index[node]:
                    component = path[path.index(node) :]
                    del path[-len(component) :]
                    if len(component) > 1 or node in edges.get(node, ()):
                        found |= set(component)
            elif target not in index:
                waiting.append((target, iter(edges.get(target, ()))))
            elif target in path:
                low[node] = min(low[node], index[target])
    return frozenset(found)
