"""What readers of bodies in C++ ask of the intermediate form, by nodes of the trees."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.analysis.outcomes.held_locks import HeldLocks
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
from rebsync.reverse.ir.cpp.symbols import ClassSymbol, FunctionSymbol
from rebsync.reverse.ir.program import Function, FunctionKind, Program
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Kind, Language
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside
from rebsync.source import NOWHERE, Span

_LOCKS = re.compile(rb"(?<![cCbB])lock")
# Locks that are none of the guards by their names: functions, and guards by another name.
_OTHERWISE = re.compile(
    rb"\bstd\s*::\s*(?:try_)?lock\s*\(|\bpthread_\w*(?:lock|wait)\w*\s*\(|\bsem_\w*wait\s*\("
)
_RENAMED = re.compile(
    rb"\busing\s+(\w+)\s*=[^;]*\b(?:lock_guard|unique_lock|scoped_lock|shared_lock)\b"
    rb"|\btypedef\b[^;]*\b(?:lock_guard|unique_lock|scoped_lock|shared_lock)\b[^;]*?(\w+)\s*;"
)
_GUARD = re.compile(rb"\b(?:lock_guard|unique_lock|scoped_lock|shared_lock)\b")
_NAMED = re.compile(rb"\breturn\s+(?:std\s*::\s*move\s*\(\s*)?\w+\s*\)?\s*;")
_INHERITED = re.compile(rb"\busing\s[^;=]*::\s*\w+\s*;")
_ALIAS = re.compile(rb"\busing\s+(\w+)\s*=([^;]*);|\btypedef\b([^;]*?)(\w+)\s*;")
_WORD = re.compile(rb"\w+")
_ACTING = ("call_expression", "assignment_expression", "update_expression", "new_expression")
_UNSEEN = UNSAID | {NOTHING_THERE, NO_RESULT, SHIFTS_TOO_FAR}
_UNKNOWN = "what this locks is not known"
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

    @property
    def _locks(self) -> HeldLocks:
        return self._outcomes.locks

    @cached_property
    def _of_known(self) -> frozenset[str]:
        """The functions of known files: the times that they ask for are of one clock."""
        return frozenset(
            f.name for f in self.places.functions.values() if f.code.cpp in self._known
        )

    @cached_property
    def _guards(self) -> frozenset[bytes]:
        """Other names of guards."""
        found = (m for cpp in self._code.files for m in _RENAMED.finditer(cpp.data))
        return frozenset(m[1] or m[2] for m in found)

    @cached_property
    def _locking(self) -> frozenset[bytes]:
        """The names of functions and classes that leave something locked for who calls them."""
        files = [cpp for cpp in self._code.files if cpp not in self._known]
        if not any(_LOCKS.search(cpp.data) for cpp in files):
            return frozenset()
        read = (f for f in self.places.functions.values() if f.code.cpp not in self._known)
        texts = [(f, self._text(f)) for f in read]
        waiting = [(f, frozenset(_WORD.findall(text))) for f, text in texts]
        asked = [w for w, (_, text) in zip(waiting, texts, strict=True) if _LOCKS.search(text)]
        found = frozenset[bytes]()
        while asked:
            left = {f.simple.encode() for f, _ in asked if self._locks.left_by(f.name)}
            waiting = [w for w in waiting if w not in asked]
            found |= left
            found |= {b for a, b in self._aliases if a & found}
            asked = [w for w in waiting if w[1] & found]
        return found

    @cached_property
    def _aliases(self) -> list[tuple[frozenset[bytes], bytes]]:
        """What files give other names, by the words in it."""
        found = (m for cpp in self._code.files for m in _ALIAS.finditer(cpp.data))
        return [(frozenset(_WORD.findall(m[2] or m[3])), m[1] or m[4]) for m in found]

    @cached_property
    def _unclear(self) -> frozenset[bytes]:
        """The names of guards whose constructors lock something in a way that has no form."""
        every = [f for f in self.places.functions.values() if self._is_constructor(f)]
        unread = (f for f in every if f.is_template and _LOCKS.search(self._text(f)))
        otherwise = (f for f in every if _OTHERWISE.search(f.code.node.text or b""))
        found = self._guards | self._inheriting
        return found.union(f.simple.encode() for each in (unread, otherwise) for f in each)

    @cached_property
    def _inheriting(self) -> frozenset[bytes]:
        """The classes that inherit the constructors of one that locks something."""
        symbols = self._lowering.world.symbols
        found = set[bytes]()
        for name, owner in symbols.classes.items():
            if not _INHERITED.search(owner.node.text or b""):
                continue
            above = b" ".join(c.node.text or b"" for c in symbols.lineage(name))
            if _LOCKS.search(above):
                found.add(name.rpartition("::")[2].encode())
        return frozenset(found)

    @cached_property
    def _holding(self) -> frozenset[bytes]:
        """The functions that give a guard that is a variable of theirs."""
        found = set[bytes]()
        for function in self.places.functions.values():
            result = function.code.result
            if result is None or not _GUARD.search(result.text or b""):
                continue
            if _NAMED.search(function.code.node.text or b""):
                found.add(function.simple.encode())
        return frozenset(found)

    def _may_hold_twice(self, text: bytes) -> bool:
        """Whether a function gets a guard of another one, and may lock something besides."""
        words = _WORD.findall(text)
        if self._holding.isdisjoint(words):
            return False
        others = [w for w in words if w not in self._holding]
        lockers = {f.simple.encode() for f in self.places.functions.values() if self._says_lock(f)}
        is_again = len(words) - len(others) > 1
        return is_again or not lockers.isdisjoint(others) or any(map(_LOCKS.search, others))

    def _says_lock(self, function: FunctionSymbol) -> bool:
        return _LOCKS.search(function.code.node.text or b"") is not None

    def _is_constructor(self, function: FunctionSymbol) -> bool:
        owner = self._lowering.world.symbols.classes.get(function.owner or "")
        return owner is not None and function in owner.constructors

    def _text(self, function: FunctionSymbol) -> bytes:
        """The text of a function; of a constructor that of its class too, which says of members."""
        text = function.code.node.text or b""
        owner = self._lowering.world.symbols.classes.get(function.owner or "")
        if owner is None or not self._is_constructor(function):
            return text
        return text + (owner.node.text or b"")

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

    def _problems(self, function: CppFunction) -> frozenset[Problem]:
        symbol = self.places.functions.get(function.node.id)
        return self._outcomes.of(symbol.name) if symbol is not None else frozenset()

    def odd_locks(self, functions: Iterable[CppFunction]) -> Iterator[tuple[Cpp, Span, str]]:
        """The places in functions where a thread may wait for itself, for ever."""
        found_in = [(f, f.body.text or b"") for f in functions if f.body is not None]
        for function, text in found_in:
            is_unclear = not self._unclear.isdisjoint(_WORD.findall(text))
            if _OTHERWISE.search(text) or is_unclear or self._may_hold_twice(text):
                yield function.cpp, function.cpp.span(function.node), _UNKNOWN
        for function in (f for f, text in found_in if self._may_lock(text)):
            symbol = self.places.functions.get(function.node.id)
            if symbol is None:
                yield function.cpp, function.cpp.span(function.node), _UNKNOWN
                continue
            owner = self._lowering.world.symbols.classes.get(symbol.owner or "")
            for name in (symbol.name, *lambda_names(symbol, owner).values()):
                found = {(p.place.start, p.place.end, p.why): p.place for p in self._locks.of(name)}
                for (_, _, why), place in sorted(found.items()):
                    yield function.cpp, place, why
                yield from ((function.cpp, p, _UNKNOWN) for p in self._unread(function, name))

    def run_by(self, functions: Iterable[CppFunction]) -> list[CppFunction]:
        """The functions besides some that these may run, where they may lock something."""
        own = {function.node.id for function in functions}
        others = [f for i, f in self.places.functions.items() if i not in own]
        locking = {f.name: f.code for f in others if self._may_lock(f.code.node.text or b"")}
        if not locking:
            return []
        roots = [self.places.functions[i].name for i in own if i in self.places.functions]
        body_of = self._program.function
        found = {
            n for root in roots for n, _ in self._outcomes.origins.runs(body_of(root).body, root)
        }
        return [code for name, code in sorted(locking.items()) if name in found]

    def _may_lock(self, text: bytes) -> bool:
        """Whether the text of a function names what locks."""
        return bool(_LOCKS.search(text)) or not self._locking.isdisjoint(_WORD.findall(text))

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
