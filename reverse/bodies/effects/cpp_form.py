"""What readers of bodies in C++ ask of the intermediate form, by nodes of the trees."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.analysis.definite_assignment import may_be_unset
from rebsync.reverse.analysis.outcomes.held_locks import UNKNOWN_LOCK, HeldLocks
from rebsync.reverse.analysis.outcomes.loop_endings import ProgramLoops
from rebsync.reverse.analysis.outcomes.outcomes import RECURSES, OutcomeAnalysis
from rebsync.reverse.analysis.problems import (
    NO_RESULT,
    NOTHING_THERE,
    SHIFTS_TOO_FAR,
    UNSAID,
    Problem,
)
from rebsync.reverse.analysis.unread_code import UnreadCode
from rebsync.reverse.bodies.effects.cpp_form_places import FormPlaces
from rebsync.reverse.bodies.effects.cpp_known_objects import KnownObjects
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.cpp.functions import lambda_names
from rebsync.reverse.ir.cpp.lowering import CppLowering
from rebsync.reverse.ir.cpp.symbols import ClassSymbol
from rebsync.reverse.ir.program import Function, FunctionKind, Program
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Kind, Language
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside
from rebsync.source import NOWHERE, Span

# Words without which nothing locks, or waits for who does.
_LOCKS = re.compile(rb"(?<![cCbB])lock|\bsem_\w*wait")
_ACTING = ("call_expression", "assignment_expression", "update_expression", "new_expression")
_UNSEEN = UNSAID | {NOTHING_THERE, NO_RESULT, SHIFTS_TOO_FAR}
# Headers of messages of ROS 1, which are named as these are.
_MESSAGE = re.compile(rb"#\s*include\s*[<\"](\w+)/([A-Z]\w*)\.h[>\"]")


class CppForm:
    """The form of some files, of which nothing is lowered before something is asked.

    What the functions of `known` files lock is known by their text: none leaves it locked.
    """

    def __init__(self, code: Code, known: Collection[Cpp] = ()) -> None:
        self._code = code
        self._known = known

    @cached_property
    def acting_macros(self) -> frozenset[bytes]:
        """The macros without parameters whose text calls something, or stores."""
        known = {id(cpp) for cpp in self._code.files}
        values = self._code.constants.items()
        texts = ((name, node) for (_, name), (cpp, node) in values if id(cpp) not in known)
        return frozenset(name.encode() for name, node in texts if any(inside(node, *_ACTING)))

    @cached_property
    def naming_macros(self) -> frozenset[str]:
        """The macros without parameters whose text names a variable."""
        known = {id(cpp) for cpp in self._code.files}
        values = self._code.constants.items()
        texts = ((name, node) for (_, name), (cpp, node) in values if id(cpp) not in known)
        return frozenset(n for n, v in texts if any(inside(v, "identifier", "this")))

    @cached_property
    def objects(self) -> KnownObjects:
        """Which objects are known by their declarations."""
        return KnownObjects(self._code, self.places)

    @cached_property
    def places(self) -> FormPlaces:
        """What stands at places of the trees."""
        every = self._lowering.world.symbols.functions.values()
        runtime = frozenset(f.name for f in every if f.code.cpp in self._known)
        unread = UnreadCode(self._outcomes.origins, runtime)
        return FormPlaces(self._lowering, self._program, unread)

    @cached_property
    def _lowering(self) -> CppLowering:
        return CppLowering(self._code)

    @cached_property
    def _program(self) -> Program:
        return self._lowering.program()

    @cached_property
    def _outcomes(self) -> OutcomeAnalysis:
        headers = (m for cpp in self._code.files for m in _MESSAGE.finditer(cpp.data))
        messages = frozenset(f"{m[1].decode()}::{m[2].decode()}" for m in headers)
        macros = frozenset(self._code.macros)
        table = LibraryOutcomes(Language.CPP, macros, messages=messages)
        return OutcomeAnalysis(self._program, table, lambda name: False)

    @cached_property
    def _loops(self) -> ProgramLoops:
        return ProgramLoops(self._outcomes.origins)

    @cached_property
    def _locks(self) -> HeldLocks:
        return HeldLocks(self._outcomes.origins, self._of_known)

    @cached_property
    def _has_locks(self) -> bool:
        """Whether files other than known ones may lock something, by their words."""
        return any(_LOCKS.search(cpp.data) for cpp in self._code.files if cpp not in self._known)

    @cached_property
    def _of_known(self) -> frozenset[str]:
        """The functions of known files: the times that they ask for are of one clock."""
        return frozenset(
            f.name for f in self.places.functions.values() if f.code.cpp in self._known
        )

    def ends(self, cpp: Cpp, loop: Node) -> bool:
        """Whether a loop in a function ends, if what stands in it does."""
        name = self.places.around(loop)
        return name is not None and self._loops.ends(name, cpp.span(loop))

    def raises(self, cpp: Cpp, statement: Node) -> str | None:
        """What an exception is that a statement of a function may end with; None if it has none."""
        return min((p.why for p in self.raised(cpp, statement)), default=None)

    def raised(self, cpp: Cpp, statement: Node) -> frozenset[Problem]:
        """The exceptions that a statement of a function may end with, by their places.

        Periods of timers are facts of the graph, which says of each whether it is known.
        """
        name = self.places.around(statement)
        if name is None:
            return frozenset()
        function = self._program.function(name)
        every = self._outcomes.raised_by(function, cpp.span(statement))
        found = {p for p in every if p.why not in _UNSEEN or p.function not in self._of_known}
        odd = {p for p in found if p.why in UNSAID and p.function == name}
        timers = list(map(cpp.span, _timers(statement))) if odd else []
        within = (p for p in odd for t in timers if t.start <= p.place.start < t.end)
        return frozenset(found.difference(within))

    def may_be_unset(self, cpp: Cpp, declarator: Node, name: str) -> bool:
        """Whether a local that is declared without a value may be read before it gets one."""
        around, span = self.places.around(declarator), cpp.span(declarator)
        if around is None:
            return True
        function = self._program.function(around)
        declared = (n for n in walk(function.body) if isinstance(n, s.Declare))
        here = (n.target for n in declared if n.place.holds(span) or span.holds(n.place))
        names = {of.name for of in here if isinstance(of, e.Local)}
        own = {n for n in names if n.partition("~")[0] == name}
        return not own or any(may_be_unset(self._program, function, n) for n in own)

    def looked_up(self, cpp: Cpp, place: Node) -> list[Span]:
        """What code looks up at a place that may not be there, by how the language has it."""
        symbol, span = self.places.symbol_around(place), cpp.span(place)
        if symbol is None:
            return []
        owner = self._lowering.world.symbols.classes.get(symbol.owner or "")
        names = (symbol.name, *lambda_names(symbol, owner).values())
        own = (p for n in names for p in self._outcomes.own(n) if p.given is None)
        found = {p.place for p in own if p.why == NOTHING_THERE}
        inside_ = (p for p in found if span.holds(p))
        return sorted(inside_, key=lambda p: (p.start, p.end))

    def raised_at_start(self, owner: CppClass, member: str) -> str | None:
        """What an exception is that a class's member may end with where it is made."""
        every = map(self._program.function, self._program.functions)
        made = [f for f in every if f.kind is FunctionKind.CONSTRUCTOR and f.owner]
        names = {c.name for c in self._classes if c.node.id == owner.node.id}
        for constructor in (f for f in made if f.owner in names):
            if (why := self._raised_making(constructor, member)) is not None:
                return why
        return None

    def raised_before(self, cpp: Cpp, variable: str) -> str | None:
        """What an exception is that a variable of a file may end with where it is made."""
        return self._raised_making(self._program.function(cpp.source.path), variable)

    def _raised_making(self, function: Function, name: str) -> str | None:
        found = self._outcomes.of_body(function, _making(function, name))
        return min((p.why for p in found if p.raises), default=None)

    @property
    def _classes(self) -> Iterable[ClassSymbol]:
        return self._lowering.world.symbols.classes.values()

    def unsaid(self, cpp: Cpp, statement: Node) -> list[Problem]:
        """What in a statement itself may fail, of which models say nothing."""
        name = self.places.around(statement)
        if name is None or not any(p.why in _UNSEEN for p in self._outcomes.of(name)):
            return []
        found = (p for p in self.raised(cpp, statement) if p.function == name or p.is_of_call)
        return sorted((p for p in found if p.why in _UNSEEN), key=lambda p: p.place.start)

    def recurses(self, function: CppFunction) -> bool:
        """Whether a function may call itself, perhaps by others."""
        symbol = self.places.functions.get(function.node.id)
        name = symbol.name if symbol is not None else ""
        return any(p.why == RECURSES and p.function == name for p in self._problems(function))

    def throws(self, function: CppFunction) -> bool:
        """Whether a call of a function may end with an exception."""
        return any(p.raises for p in self._problems(function))

    def terminating(self, cpp: Cpp, throwing: str, posting: str) -> Iterator[tuple[Span, str]]:
        """The places in `noexcept` functions of a file that may throw, and what these are called.

        Of the functions of known files only the `throwing` one throws, by the end of its name; the
        `posting` one runs what it gets later.
        """
        for symbol in (f for f in self.places.functions.values() if f.code.cpp is cpp):
            within = ".".join(filter(None, (symbol.code.owner, symbol.code.name)))
            for name in (symbol.name, *lambda_names(symbol, self.places.owner(symbol)).values()):
                function = self._program.function(name)
                reached = self._reached(name, posting) if function.noexcept else frozenset[str]()
                own = (p for each in reached - self._of_known for p in self._outcomes.own(each))
                raised = (p for p in own if p.raises)
                found = {p.place if p.function == name else function.place for p in raised}
                found |= {function.place for each in reached if each.endswith(throwing)}
                yield from ((place, within) for place in sorted(found, key=lambda p: p.start))

    def _reached(self, name: str, posting: str) -> frozenset[str]:
        """The functions that one runs, but for what is posted; known ones are not looked into."""
        found, waiting = {name}, [name]
        while waiting:
            if (each := waiting.pop()) not in self._of_known:
                calls = (n for n in walk(self._program.function(each)) if isinstance(n, s.Call))
                posts = (c for c in calls if getattr(c.callee, "name", "").endswith(posting))
                later = {n.function for c in posts for n in walk(c) if isinstance(n, e.Closure)}
                new = self._outcomes.called(each) - later - found
                found |= new
                waiting += new
        return frozenset(found)

    def _problems(self, function: CppFunction) -> frozenset[Problem]:
        symbol = self.places.functions.get(function.node.id)
        return self._outcomes.of(symbol.name) if symbol is not None else frozenset()

    def odd_locks(self, functions: Iterable[CppFunction]) -> Iterator[tuple[Cpp, Span, str]]:
        """The places in functions where a thread may wait for itself, for ever."""
        for function in functions if self._has_locks else ():
            symbol = self.places.functions.get(function.node.id)
            if symbol is None:
                if _LOCKS.search(function.node.text or b""):
                    yield function.cpp, function.cpp.span(function.node), UNKNOWN_LOCK
                continue
            for name in (symbol.name, *lambda_names(symbol, self.places.owner(symbol)).values()):
                found = {(p.place.start, p.place.end, p.why): p.place for p in self._locks.of(name)}
                for (_, _, why), place in sorted(found.items()):
                    yield function.cpp, place, why
                yield from ((function.cpp, p, UNKNOWN_LOCK) for p in self._unread(function, name))

    def run_by(self, functions: Iterable[CppFunction]) -> list[CppFunction]:
        """The functions besides some that these may run, where something may be locked."""
        if not self._has_locks:
            return []
        every, origins = self.places.functions, self._outcomes.origins
        roots = [every[f.node.id].name for f in functions if f.node.id in every]
        found = origins.all_run(frozenset(roots)) - frozenset(roots)
        return [f.code for f in sorted(every.values(), key=lambda f: f.name) if f.name in found]

    def _unread(self, function: CppFunction, name: str) -> Iterator[Span]:
        """The places in a function that lock something, perhaps, and have no form."""
        for node in walk(self._program.function(name).body):
            if isinstance(node, s.Unsupported):
                place = node.place if node.place != NOWHERE else function.cpp.span(function.node)
                if _LOCKS.search(function.cpp.source.text[place.start : place.end].encode()):
                    yield place


def _timers(node: Node) -> Iterator[Node]:
    """The calls that make timers."""
    for place in inside(node, "call_expression"):
        call = call_of(place)
        name = call.name.partition("<")[0].rpartition("::")[2] if call is not None else ""
        if name in libraries.named(Kind.TIMER):
            yield place


def _making(function: Function, name: str) -> s.Body:
    """The statements of a constructor or file that make a member or variable, with those before."""
    found: list[s.Statement] = []
    for statement in function.body:
        found.append(statement)
        match getattr(statement, "target", None):
            case e.Attribute(e.Local(owner), made) if owner == function.receiver:
                pass
            case e.Attribute(e.ClassReference(), made) | e.Global(_, made):
                pass
            case _:
                continue
        if made.rpartition("::")[2] == name:
            return tuple(found)
        found.clear()
    return ()
