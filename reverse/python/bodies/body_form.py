"""What readers of bodies in Python ask of the intermediate form, by nodes of the trees."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.outcomes.endless_iterators import EndlessIterators
from rebsync.reverse.analysis.outcomes.held_locks import HeldLocks
from rebsync.reverse.analysis.outcomes.loop_endings import ProgramLoops
from rebsync.reverse.analysis.outcomes.outcomes import OutcomeAnalysis
from rebsync.reverse.analysis.outcomes.size_changes import GROWING
from rebsync.reverse.analysis.problems import Problem
from rebsync.reverse.analysis.python.operand_kinds import OperandKinds
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function, Program, innermost
from rebsync.reverse.ir.python.lowering import python_program
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries import python
from rebsync.reverse.libraries.endless import FINITE
from rebsync.reverse.libraries.outcomes import LibraryOutcomes, SetValues, no_values
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.libraries.size_effects import CHANGING_OBJECT
from rebsync.reverse.syntax.py_index import FUNCTION, PyCode, Scope
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import Py
from rebsync.source import NOWHERE, Source, Span

# What files name that have, or make, iterators without end.
_ENDLESS = re.compile(
    rb"\bitertools\b|\biter\s*\(|\b__(?:next|getitem)__\b|\byield\b|\bsys\.stdin\b"
)
_LOOPS = re.compile(rb"\b(?:while|for)\b")
_LOCKS = re.compile(rb"[lL]ock|\bwith\b|\b(?:acquire|Condition|\w*Semaphore|enter_context)\b")
_IMPORTS = re.compile(rb"^\s*(?:import|from)\s+(\w+)", re.MULTILINE)


class PyForm:
    """The form of some modules, of which nothing is lowered before something is asked.

    `without_runtime`: what the run-time part of generated code does is left out; `typed` adds the
    types that values are known to have all the same.
    """

    def __init__(
        self,
        code: PyCode,
        types: MessageTypes,
        *,
        set_to: SetValues = no_values,
        without_runtime: bool = False,
        typed: Callable[[Program], Program] = lambda program: program,
    ) -> None:
        self._code = code
        self._types = types
        self._set_to = set_to
        self._without_runtime = without_runtime
        self._typed = typed

    @cached_property
    def program(self) -> Program:
        """The functions and classes of the modules."""
        whole = python_program(self._code)
        if not self._without_runtime:
            return whole
        own = [name for name in whole.functions if not self._is_of_runtime(name)]
        classes = [c for c in whole.classes.values() if not self._is_of_runtime(c.name)]
        modules = [(name, of) for name, of in whole.modules.items() if not self._is_of_runtime(of)]
        return self._typed(Program(own, classes, whole.function, modules))

    def _is_of_runtime(self, name: str) -> bool:
        module = self._code.modules.get(name.partition(":")[0])
        return module is not None and is_runtime_file(module.py.source)

    @cached_property
    def _origins(self) -> Origins:
        return Origins.of_program(self.program, LibraryOutcomes(Language.PYTHON))

    @cached_property
    def _outcomes(self) -> OutcomeAnalysis:
        table = LibraryOutcomes(
            Language.PYTHON,
            trusts_others=True,
            trusts_types=False,
            trusts_attributes=self._without_runtime,
            fields=self._fields,
            constant=self._types.constant,
            set_to=self._set_to,
        )
        return OutcomeAnalysis(self.program, table, lambda name: False)

    def _fields(self, type_: str) -> Mapping[str, str] | None:
        """The fields of a type of messages, as the client library has them that files import."""
        return self._types.python_fields(type_, self._has_stamps)

    @cached_property
    def _has_stamps(self) -> bool:
        """Whether times are messages: in a client library whose nodes are objects."""
        modules = {m[1].decode() for py in self._files for m in _IMPORTS.finditer(py.data)}
        return any(map(python.of_nodes, modules))

    def raised(self, py: Py, place: Span) -> Iterator[tuple[Problem, Scope]]:
        """The exceptions that leave a function from a place in it, each with where it is raised."""
        function = innermost(self._bodies(py), place)
        if function is None:
            return
        elsewhere = []
        for problem, scope in self._leaving(function.name):
            if problem.function != function.name:
                elsewhere.append((problem, scope))
            elif place.holds(problem.place):
                yield problem, scope
        if elsewhere:
            called = self._outcomes.raised_by(function, place)
            yield from ((problem, scope) for problem, scope in elsewhere if problem in called)

    @property
    def origins(self) -> Origins:
        """What values may be, where methods of what a library made are trusted by their names."""
        return self._outcomes.origins

    def statements(self, py: Py, place: Span) -> tuple[Function | None, s.Body]:
        """The function around a place, and its statements there."""
        function = innermost(self._bodies(py), place)
        return function, self._outcomes.statements(function, place) if function is not None else ()

    def kinds(self, function: Function) -> OperandKinds:
        """Of which types the values of a function are."""
        return self._outcomes.kinds(function)

    def acting(self, function: Function, place: Span) -> Iterator[Problem]:
        """What statements at a place may do besides to compute, and to raise exceptions."""
        return (p for p in self._outcomes.of_statements(function, place) if not p.raises)

    def raising(self, py: Py, place: Span) -> Iterator[tuple[Problem, Scope]]:
        """The exceptions of statements at a place, handled around it or not."""
        if (function := innermost(self._bodies(py), place)) is not None:
            yield from self._placed(self._outcomes.of_statements(function, place))

    def _placed(self, problems: Iterable[Problem]) -> Iterator[tuple[Problem, Scope]]:
        """The exceptions among some problems, each with where it is raised."""
        scopes = ((p, self._scope_of.get(p.function)) for p in problems if p.raises)
        return ((p, scope) for p, scope in scopes if scope is not None)

    def _leaving(self, name: str) -> list[tuple[Problem, Scope]]:
        """The exceptions that leave a function, where each is raised."""
        if name not in self._left:
            placed = self._placed(self._outcomes.of(name))
            self._left[name] = sorted(placed, key=lambda each: (each[0].place.start, each[0].why))
        return self._left[name]

    @cached_property
    def _left(self) -> dict[str, list[tuple[Problem, Scope]]]:
        return {}

    def _bodies(self, py: Py) -> list[Function]:
        """The functions of a module, lowered once."""
        if id(py) not in self._lowered:
            self._lowered[id(py)] = [self.program.function(n) for n in self._functions(py)]
        return self._lowered[id(py)]

    @cached_property
    def _lowered(self) -> dict[int, list[Function]]:
        return {}

    @cached_property
    def _scope_of(self) -> dict[str, Scope]:
        """The functions of the files, by their names in the form."""
        scopes = (*self._code.scopes.values(), *self._code.modules.values())
        places = [(s.py.span(s.node), s) for s in scopes]
        found = {}
        for name, py in self._file_of.items():
            place = self.program.function(name).place
            # A generator expression, which is no scope there, is of what it stands in.
            around = [(at, s) for at, s in places if s.py is py and at.holds(place)]
            if around:
                found[name] = min(around, key=lambda each: each[0].end - each[0].start)[1]
        return found

    @cached_property
    def _loops(self) -> ProgramLoops:
        return ProgramLoops(self._origins)

    @cached_property
    def _locks(self) -> HeldLocks:
        return HeldLocks(self._origins)

    def ends(self, py: Py, loop: Node) -> bool:
        """Whether a loop ends, if what it goes through does, and what stands in it."""
        place = py.span(loop)
        return any(self._loops.ends(name, place) for name in self._functions(py))

    def endless(self, nodes: Collection[int]) -> Iterator[tuple[Source, Span]]:
        """Where functions, or what they run, go through iterators that may have no end.

        The functions are those with some nodes of trees, by their ids.
        """
        files = self._files
        if not any(_ENDLESS.search(py.data) or self._has_foreign(py) for py in files):
            return
        for name in sorted(self._origins.all_run(f.name for f in self._roots(nodes))):
            for place in self._endless_in(name):
                is_there = place != NOWHERE
                function = self.program.function(name)
                yield self._file_of[name].source, place if is_there else function.place

    def _endless_in(self, name: str) -> list[Span]:
        """The places in one function that go through iterators that may have no end."""
        if name not in self._gone_through:
            found = self._iterators.gone_through(self.program.function(name))
            self._gone_through[name] = [getattr(node, "place", NOWHERE) for node in found]
        return self._gone_through[name]

    @cached_property
    def _gone_through(self) -> dict[str, list[Span]]:
        return {}

    @cached_property
    def _iterators(self) -> EndlessIterators:
        return EndlessIterators(self._origins)

    def hanging(
        self, nodes: Collection[int], classes: Collection[int]
    ) -> Iterator[tuple[Source, Span]]:
        """The loops that are not shown to end in functions that others call, and nobody reads.

        What is read are functions with some `nodes`, by their ids, and those of some `classes`.
        """
        unread = self._unread(nodes, _LOOPS)
        places = {p for p, s in unread.items() if s.owner is None or s.owner.node.id not in classes}
        for name in sorted(self._called_from(nodes)) if places else ():
            py, function = self._file_of[name], self.program.function(name)
            if (id(py), function.place) not in places:
                continue
            for node in walk(function.body):
                match node:
                    case s.Loop(place=place) if not self._loops.ends(name, place):
                        pass
                    case s.ForEach(place=place) if _fills_itself(node):
                        pass
                    case _:
                        continue
                yield py.source, place if place != NOWHERE else function.place

    def odd_locks(self, nodes: Collection[int]) -> Iterator[tuple[Source, Span]]:
        """Where a thread may wait for itself in functions that others run, and nobody reads.

        What is read are functions with some nodes of trees, by their ids.
        """
        places = self._unread(nodes, _LOCKS)
        read = {f.name for f in self._roots(nodes)} if places else set()
        for name in sorted(self._origins.all_run(read) - read):
            py, function = self._file_of[name], self.program.function(name)
            is_asked = (id(py), function.place) in places
            for problem in sorted(self._locks.of(name), key=str) if is_asked else ():
                is_there = problem.place != NOWHERE
                yield py.source, problem.place if is_there else function.place

    def _unread(
        self, nodes: Collection[int], words: re.Pattern[bytes]
    ) -> dict[tuple[int, Span], Scope]:
        """The functions besides some, by their places, that have one of some words."""
        return {
            (id(scope.py), scope.py.span(scope.node)): scope
            for scope in self._code.scopes.values()
            if scope.kind == FUNCTION
            and scope.node.id not in nodes
            and words.search(scope.node.text or b"")
        }

    @cached_property
    def _file_of(self) -> dict[str, Py]:
        """The files of functions, by their names."""
        return {name: py for py in self._files for name in self._functions(py)}

    def _called_from(self, nodes: Collection[int]) -> set[str]:
        """The functions that some functions call, or call in turn."""
        waiting, found = self._roots(nodes), set[str]()
        while waiting:
            function = waiting.pop()
            for node in walk(function.body):
                match node:
                    case s.Call(_, callee):
                        called = self._origins.graph.callee(callee, function).functions
                    case s.Construct():
                        called = self._origins.reached(node, function.name)
                    case _:
                        continue
                waiting += (self.program.function(name) for name in called - found)
                found |= called
        return found

    def _roots(self, nodes: Collection[int]) -> list[Function]:
        """The functions with some nodes of trees, by their ids."""
        scopes = [scope for scope in self._code.scopes.values() if scope.node.id in nodes]
        read = {(id(scope.py), scope.py.span(scope.node)) for scope in scopes}
        of = {name: py for py in self._files for name in self._functions(py)}
        return [
            f for n, py in of.items() if (id(py), (f := self.program.function(n)).place) in read
        ]

    @property
    def _files(self) -> list[Py]:
        return [module.py for module in self._code.modules.values()]

    def _has_foreign(self, py: Py) -> bool:
        """Whether a file imports what no table knows; modules of the files may be among it."""
        table = LibraryOutcomes(Language.PYTHON)
        roots = {m[1].decode() for m in _IMPORTS.finditer(py.data)}
        return any(root not in FINITE and not table.is_standard(root) for root in roots)

    def waits_for_itself(self, py: Py, statement: Node) -> bool:
        """Whether what `with lock:` runs may enter the same lock again, and so wait for ever."""
        place, is_read = py.span(statement), False
        for name in self._functions(py):
            withs = (n for n in walk(self.program.function(name).body) if isinstance(n, s.With))
            if any(place.holds(n.place) for n in withs):
                is_read = True
                if any(place.holds(problem.place) for problem in self._locks.of(name)):
                    return True
        return not is_read

    def _functions(self, py: Py) -> list[str]:
        """The functions of a module."""
        paths = [path for path, module in self._code.modules.items() if module.py is py]
        names = self.program.functions
        return [n for n in names for path in paths if n == path or n.startswith(f"{path}:")]


def _fills_itself(loop: s.ForEach) -> bool:
    """Whether a loop puts elements into what it goes through."""
    calls = (n.callee for n in walk(loop.body) if isinstance(n, s.Call))
    methods = (c for c in calls if isinstance(c, s.MethodCallee) and c.receiver == loop.iterable)
    table = LibraryOutcomes(Language.PYTHON)
    return any(
        c.name in CHANGING_OBJECT or table.method(None, c.name).size in GROWING for c in methods
    )
