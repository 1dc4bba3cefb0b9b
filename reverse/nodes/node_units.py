"""What of hand-written code becomes a reactive class: classes that talk to ROS, and programs.

A class counts with all that it inherits; a program stands for its functions outside of classes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Hashable, Iterator, Mapping, Sequence
from dataclasses import field
from functools import cached_property
from operator import itemgetter

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reserved import RUNTIME_CLASSES
from rebsync.reverse.graph import (
    Callback,
    Fact,
    Graph,
    NodeFact,
    PublisherFact,
    ServiceFact,
    SubscriptionFact,
    TimerFact,
)
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.nodes.node_components import components
from rebsync.reverse.nodes.node_programs import NodeObject, Objects, Program
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of

CONNECTS = (PublisherFact, SubscriptionFact, TimerFact, ServiceFact)


@dataclass(frozen=True)
class Unit:
    """What becomes a reactive class.

    `functions` are its functions with bodies, of overridden ones the last; `owner` is None for
    what a program does outside of classes. `code` is what its functions can name. `own`
    says of Python that parameters are the node's own.
    """

    name: str
    owner: CppClass | None
    lineage: tuple[CppClass, ...]
    functions: tuple[CppFunction, ...]
    facts: tuple[Fact, ...]
    code: Code
    program: Program | None = None
    own: bool = False

    @cached_property
    def names(self) -> frozenset[str]:
        """The classes that its functions belong to."""
        return frozenset(c.name for c in self.lineage)

    def queue(self, loops: int) -> int:
        """The largest depth of the subscriptions, and enough for its own timers and loops."""
        depths = [f.depth for f in self.facts if isinstance(f, SubscriptionFact)]
        known = [d for d in depths if isinstance(d, int) and not isinstance(d, bool)]
        own = sum(isinstance(f, TimerFact) for f in self.facts) + loops + 1
        return max([*known, own + (1 if depths else 0)])

    def constructors(self, of: CppClass) -> list[CppFunction]:
        """The constructors, with bodies, of one of its classes."""
        return [f for f in self.functions if f.owner == of.name == f.name]

    @cached_property
    def flat(self) -> bool:
        """Whether it is for ROS 2, where parameters are the node's own."""
        if self.own or any(c.roots for c in self.lineage):
            return True
        return any(libraries.is_flat(f.cpp.data) for f in self.functions)

    @cached_property
    def files(self) -> frozenset[str]:
        """The paths of the files that its functions stand in."""
        return frozenset({f.cpp.source.path for f in self.functions})


@dataclass(frozen=True, slots=True)
class Start:
    """A rebec to be: a unit, the program that runs it and the object that it is.

    A nodelet or component has no program, nor has a class that no program of the package makes.
    `entry` is the function that starts the object: `main`, or that of the nodelet that has it.
    """

    unit: Unit
    program: Program | None
    made: NodeObject | None
    entry: CppFunction | None = None
    nodelet: str | None = None

    @property
    def process(self) -> Hashable:
        """What objects have in common that run together."""
        return self.program.main.node.id if self.program is not None else self.nodelet or id(self)


@dataclass(frozen=True, slots=True)
class UnitFacts:
    """The facts of a graph by the paths of their files, and the nodelets among them."""

    by_path: Mapping[str, Sequence[Fact]]
    nodelets: frozenset[str]

    @staticmethod
    def of(graph: Graph) -> UnitFacts:
        by_path: dict[str, list[Fact]] = {}
        for fact in graph.facts:
            by_path.setdefault(fact.site.cpp.source.path, []).append(fact)
        nodelets = (f.nodelet for f in graph.facts if isinstance(f, NodeFact))
        names = frozenset(n.rpartition("::")[2] for n in nodelets if n is not None)
        return UnitFacts(by_path, names)

    def of_files(self, paths: Collection[str]) -> list[Fact]:
        """Those of some files, in the order of the graph."""
        return [f for path, facts in self.by_path.items() if path in paths for f in facts]


@dataclass(slots=True)
class Units:
    """The units of some code, and where they start.

    With `whole` these are all that ask ROS for anything: generated ones, and those with clients or
    parameters alone.
    """

    code: Code
    facts: UnitFacts
    programs: tuple[Program, ...]
    generated: bool = False
    whole: bool = False
    _owners: dict[int, str | None] = field(default_factory=dict)
    _here: list[Fact] | None = None
    # By the names of classes, each fact with its number in the order of all.
    _by_class: dict[str, list[tuple[int, Fact]]] | None = None
    # By the paths of files, each with its number in the order of all.
    _free: dict[str, list[tuple[int, CppFunction]]] | None = None

    def all(self) -> tuple[list[Unit], list[Start]]:
        """All units, in the order of the code, and all objects of them that programs make."""
        classes = self._classes()
        objects = Objects(self.code, classes)
        made = {p.main.node.id: objects.made_by(p) for p in self.programs}
        run = {m.owner for all_of in made.values() for m in all_of}
        parts = {n for n in components(self.code) if n in classes and n not in run}
        nodelets = {n: self._entry(n) for n in sorted(self.nodelets() | parts)}
        inner = {
            n: [m for m in objects.made_by_class(self.code.classes[n], entry) if m.owner != n]
            for n, entry in nodelets.items()
        }
        concrete = {m.owner for all_of in (*made.values(), *inner.values()) for m in all_of}
        bases = {b.name for c in classes for b in self.code.lineage(c)[1:]}
        units = {
            n: self._of_class(n)
            for n in classes
            if n in concrete or n in nodelets or n not in bases
        }
        starts: list[Start] = []
        own: list[Unit] = []
        for program in self.programs:
            unit = self.of_program(program)
            if any(self._counts(f) for f in unit.facts):
                own.append(unit)
                starts.append(Start(unit, program, None))
            for m in made[program.main.node.id]:
                starts.append(Start(units[m.owner], program, m, program.main))
        for name, entry in nodelets.items():
            if name in units:
                starts.append(Start(units[name], None, None, None, name))
            starts += [Start(units[m.owner], None, m, entry, name) for m in inner[name]]
        return [*units.values(), *own], starts

    def _entry(self, nodelet: str) -> CppFunction | None:
        """The function that starts a nodelet."""
        for above in self.code.lineage(nodelet):
            for function in self.code.functions_of(above):
                if function.name == "onInit" and function.body is not None:
                    return function
        return None

    def nodelets(self) -> set[str]:
        """The classes that are exported as nodelets."""
        return {n for n in self.facts.nodelets if n in self.code.classes}

    # --- classes --------------------------------------------------------------------------------

    def _classes(self) -> list[str]:
        """The classes with callbacks, publishers or timers, inherited ones counted."""
        with_facts = {o for f in self._facts() if self._counts(f) for o in [self._holder(f)] if o}
        names = [
            n
            for n, c in self.code.classes.items()
            if with_facts & {a.name for a in self.code.lineage(n)}
            and not self._is_generated(c)
            and not (self.generated and n in RUNTIME_CLASSES)
        ]
        return names

    def _counts(self, fact: Fact) -> bool:
        """Whether a fact makes a unit of what it belongs to."""
        return self.whole or _connects(fact)

    def _holder(self, fact: Fact) -> str | None:
        """The class that a fact belongs to, of whatever kind it is."""
        if isinstance(fact, CONNECTS):
            return self.owner_of(fact)
        return fact.site.owner if fact.site.owner in self.code.classes else None

    def _is_generated(self, owner: CppClass) -> bool:
        """Whether a class is one of those that rebsync makes, which are read another way."""
        if self.whole:
            return False
        fields = (f for c in self.code.lineage(owner.name) for f in c.fields)
        return any(text_of(f.type) == "Mailbox" for f in fields)

    def owner_of(self, fact: Fact) -> str | None:
        """The class that a fact belongs to: that of its callback, or else that of its call."""
        if id(fact) not in self._owners:
            self._owners[id(fact)] = self._owner_of(fact)
        return self._owners[id(fact)]

    def _owner_of(self, fact: Fact) -> str | None:
        if not isinstance(fact, CONNECTS):
            return None
        by = fact.site.owner if fact.site.owner in self.code.classes else None
        if isinstance(fact, SubscriptionFact | TimerFact | ServiceFact):
            for callback in fact.callbacks:
                if isinstance(callback, Callback) and callback.function is not None:
                    to = callback.function.owner
                    inherits = by and to in {c.name for c in self.code.lineage(by)}
                    if to in self.code.classes and not inherits:
                        return to
                    return by
        return by

    def _of_class(self, name: str) -> Unit:
        lineage = tuple(self.code.lineage(name))
        names = {c.name for c in lineage}
        defined = [
            function
            for above in lineage
            for function in self.code.functions_of(above)
            if function.body is not None or function.initialisers is not None
        ]
        same = Counter(f.name for f in defined)
        functions: dict[tuple[str, tuple[str, ...]], CppFunction] = {}
        for function in defined:
            key = function.name, function.types if same[function.name] > 1 else ()
            functions.setdefault(key, function)
        numbered = [pair for n in names for pair in self._facts_of(n)]
        facts = tuple(f for _, f in sorted(numbered, key=itemgetter(0)))
        return Unit(name, lineage[0], lineage, tuple(functions.values()), facts, self.code)

    def _facts_of(self, name: str) -> list[tuple[int, Fact]]:
        """The facts that belong to a class, what it inherits left out."""
        if self._by_class is None:
            self._by_class = {}
            for number, fact in enumerate(self._facts()):
                connects = isinstance(fact, CONNECTS)
                owner = self.owner_of(fact) if connects else fact.site.owner
                if owner is not None:
                    self._by_class.setdefault(owner, []).append((number, fact))
        return self._by_class.get(name, [])

    def _facts(self) -> list[Fact]:
        """The facts that calls in these files give; there may be more files in the package."""
        if self._here is None:
            paths = {cpp.source.path for cpp in self.code.files}
            self._here = self.facts.of_files(paths)
        return self._here

    # --- programs -------------------------------------------------------------------------------

    def of_program(self, program: Program) -> Unit:
        """What a program does outside of classes."""
        free = self._free_by_path()
        numbered = [pair for path in program.sources for pair in free.get(path, ())]
        functions = [f for _, f in sorted(numbered, key=itemgetter(0))]
        facts = [
            f
            for f in self.facts.of_files(program.sources)
            if self.owner_of(f) is None and f.site.owner not in self.code.classes
        ]
        return Unit(program.name, None, (), tuple(functions), tuple(facts), self.code, program)

    def _free_by_path(self) -> dict[str, list[tuple[int, CppFunction]]]:
        """The functions outside of classes that have bodies."""
        if self._free is None:
            self._free = {}
            defined = self.code.definitions.items()
            functions = (f for (owner, _), all_of in defined if not owner for f in all_of)
            for number, function in enumerate(f for f in functions if f.body is not None):
                path = function.cpp.source.path
                self._free.setdefault(path, []).append((number, function))
        return self._free


def _connects(fact: Fact) -> bool:
    """Whether a fact makes what it belongs to a node with servers or messages of its own."""
    single = isinstance(fact, SubscriptionFact) and fact.single
    return isinstance(fact, CONNECTS) and not single


def bodies(unit: Unit) -> Iterator[tuple[Cpp, Node]]:
    """The bodies of all functions of a unit, with initialiser lists."""
    for function in unit.functions:
        for node in (function.initialisers, function.body):
            if node is not None:
                yield function.cpp, node
