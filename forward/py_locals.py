"""What the local variables of a body are called in Python, which has one scope a function."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from dataclasses import field
from itertools import chain, count

from rebsync import model as m
from rebsync.forward.py_loops import counting
from rebsync.records import dataclass
from rebsync.static import Analysis


@dataclass(slots=True)
class LocalNames:
    """The names of the locals of a body, by the ids of their declarators.

    Blocks that are not within one another have one name for alike variables: `repeated` has the
    declarators whose name got its type from a declarator further up.
    """

    hoisted: Collection[int]
    analysis: Analysis
    carried: Callable[[str], str]
    types: dict[str, m.Type | None]
    names: dict[int, str] = field(default_factory=dict)
    repeated: set[int] = field(default_factory=set)

    def within(self, node: m.Node, alive: set[str]) -> None:
        """Names the locals of a node; `alive` has the names of the scope, and gets more."""
        match node:
            case m.Block() | m.If() | m.While() | m.Switch():
                self._inside(node, set(alive))
            case m.For():
                self._for(node, alive)
            case m.Local(declaration):
                self._declared(declaration, alive)
            case _:
                self._inside(node, alive)

    def _inside(self, node: m.Node, alive: set[str]) -> None:
        for inner in m.children(node):
            self.within(inner, alive)

    def _for(self, loop: m.For, alive: set[str]) -> None:
        """A loop. What it declares lives on behind it if its head does not name that."""
        inside = set(alive)
        counter = counting(loop, self.analysis)
        if counter is not None:
            self._name(counter, m.Type("int"), inside, is_typed=False)
        elif isinstance(loop.initial, m.Declaration):
            self._declared(loop.initial, inside)
            if not _is_of_loop(loop, loop.initial):
                alive |= inside
        self.within(loop.body, inside)

    def _declared(self, declaration: m.Declaration, alive: set[str]) -> None:
        for declarator in declaration.declarators:
            self._name(declarator, declaration.type, alive)

    def _name(
        self, declarator: m.Declarator, type_: m.Type, alive: set[str], is_typed: bool = True
    ) -> None:
        plain, is_hoisted = self.carried(declarator.name), id(declarator) in self.hoisted
        is_alike = declarator.initial is not None and not type_.dimensions and not is_hoisted
        for name in chain([plain], (f"{plain}__{number}" for number in count(2))):
            is_again = is_alike and name not in alive and self.types.get(name) == type_
            if name not in self.types or is_again:
                break
        if is_again and is_typed:
            self.repeated.add(id(declarator))
        self.names[id(declarator)] = name
        self.types[name] = None if is_hoisted else type_
        alive.add(name)


def local_names(
    block: m.Block,
    parameters: Iterable[str],
    hoisted: Collection[int],
    analysis: Analysis,
    carried: Callable[[str], str],
) -> LocalNames:
    """The names of the locals of a body.

    `parameters` are those of the function in Python, `hoisted` the declarators that stand before a
    `switch`, `carried` the name in Python of a name of the model.
    """
    taken = list(parameters)
    found = LocalNames(hoisted, analysis, carried, dict.fromkeys(taken))
    found.within(block, set(taken))
    return found


def _is_of_loop(loop: m.For, declaration: m.Declaration) -> bool:
    """Whether a loop names its variable in its head, by which the two are told to belong."""
    head = [e for e in (loop.condition, *loop.updates) if e is not None]
    used = {n.name for e in head for n in m.walk(e) if isinstance(n, m.Name)}
    return len(declaration.declarators) == 1 and declaration.declarators[0].name in used
