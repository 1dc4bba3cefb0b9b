"""The definitions of a property file, and which of them a predicate computes only once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import field

from rebsync import properties as p
from rebsync.model import Binary, Index, IntLiteral, Member, Name, Paren, Type, children
from rebsync.records import dataclass

_PARTIAL = ("/", "%")


@dataclass
class Defines:
    """The definitions by their names; `types` are those that are known so far."""

    values: dict[str, p.Formula]
    types: dict[str, Type] = field(default_factory=dict)
    _total: dict[str, bool] = field(default_factory=dict)

    def shared(self, formula: p.Formula) -> list[str]:
        """The definitions that a formula uses more than once, those that others use first.

        Only those that have a value in every state: it does not matter if they are computed where
        the formula would not have come to them. So a formula is as long as what is written.
        """
        uses = Counter(self._named(formula))
        order = list[str]()
        waiting = [(name, False) for name in uses]
        seen = set[str]()
        while waiting:
            name, done = waiting.pop()
            if done:
                order.append(name)
            elif name not in seen:
                seen.add(name)
                below = Counter(self._named(self.values[name]))
                uses += below
                waiting.append((name, True))
                waiting += [(each, False) for each in below]
        return [name for name in order if uses[name] > 1 and self._is_total(name)]

    def _named(self, formula: p.Formula) -> Iterator[str]:
        """The definitions that stand in a formula, each as often as it stands there."""
        return (name for name in values_named(formula) if name in self.values)

    def _is_total(self, name: str) -> bool:
        """Whether a definition has a value in every state: no division, no computed index."""
        if name not in self._total:
            own = self.values[name]
            self._total[name] = not any(map(_may_fail, nodes(own))) and all(
                self._is_total(each) for each in set(self._named(own))
            )
        return self._total[name]


def _may_fail(node: p.Formula) -> bool:
    match node:
        case Binary(operator):
            return operator in _PARTIAL
        case Index(_, index):
            while isinstance(index, Paren):
                index = index.inner
            return not isinstance(index, IntLiteral)
        case _:
            return False


def values_named(formula: p.Formula) -> Iterator[str]:
    """The names that stand for values in a formula, each as often as it stands there.

    In `r.x` the name `r` is that of a rebec, though a definition may be called so too.
    """
    waiting = [formula]
    while waiting:
        match waiting.pop():
            case Name(name):
                yield name
            case Member(Name()):
                pass
            case node:
                waiting += children(node)  # type: ignore[arg-type]  # as below


def nodes(formula: p.Formula) -> Iterator[p.Formula]:
    """All nodes of a formula without temporal operators."""
    waiting = [formula]
    while waiting:
        node = waiting.pop()
        yield node
        waiting += children(node)  # type: ignore[arg-type]  # formulas have fields as nodes have
