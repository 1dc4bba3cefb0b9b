"""How functions may end, and what else they may do that is to be seen: one walk over the form.

A function is harmless if it comes back with a value, in bounded time, whatever it gets. Every place
that may do otherwise is listed: exceptions that nothing in the function handles, loops and
recursion that may not end, calls that wait or act, what is the model's, what has no lowering.

What C++ leaves undefined may end the program: no handler is for it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import replace
from functools import cached_property

from rebsync.records import dataclass
from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.element_counts import ElementCounts
from rebsync.reverse.analysis.facts import NO_FACTS
from rebsync.reverse.analysis.fixpoint import Equation, LeastFixpoint, in_cycles
from rebsync.reverse.analysis.implicit_calls import implicit_calls
from rebsync.reverse.analysis.origins import FunctionOrigin, Origins
from rebsync.reverse.analysis.outcomes.endless_iterators import EndlessIterators
from rebsync.reverse.analysis.outcomes.given_arguments import with_none
from rebsync.reverse.analysis.outcomes.held_locks import HeldLocks
from rebsync.reverse.analysis.outcomes.outcome_statements import ENDLESS, OutcomeWalk
from rebsync.reverse.analysis.problems import NO_RESULT, Called, Problem, ProblemNotes
from rebsync.reverse.analysis.python.operand_classes import OperandClasses
from rebsync.reverse.analysis.python.operand_kinds import OperandKinds
from rebsync.reverse.analysis.python.special_results import kind_of
from rebsync.reverse.analysis.silent_calls import SilentCalls
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import ImplicitCall
from rebsync.reverse.ir.program import Function, FunctionKind, Program
from rebsync.reverse.ir.walk import STATEMENTS, Node, parts, walk
from rebsync.reverse.libraries.outcome_classes import TERMINATES
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from rebsync.source import NOWHERE, Span

_GETS_NONE = frozenset({"__eq__", "__ne__", "__exit__"})
RECURSES = "this may call itself, and may not end"


class OutcomeAnalysis:
    """The functions of a program, each looked through once.

    `is_model` says of a module, class or function whether it is the model's: of generated code.
    """

    def __init__(
        self, program: Program, table: LibraryOutcomes, is_model: Callable[[str], bool]
    ) -> None:
        self.program = program
        self.table = table
        self.is_model = is_model
        self.graph = CallGraph(program)
        own = [name for name in program.functions if not is_model(name)]
        self.origins = Origins(self.graph, table, own)
        self.counts = ElementCounts(self.origins)
        self.locks = HeldLocks(self.origins)
        self.iterators = EndlessIterators(self.origins)
        self.elements: dict[str, int] = {}  # of what functions get, by their names
        self._solutions = LeastFixpoint(self._of_function, self._recursion)
        self._equations: dict[str, Equation[Problem]] = {}
        self._calls: dict[str, set[str]] = {}
        self._raised: dict[tuple[str, Span], frozenset[Problem]] = {}
        self._nested: dict[str, tuple[_Nested, ...]] = {}

    def of(self, name: str) -> frozenset[Problem]:
        """What one call of a function may do besides giving a value."""
        return frozenset(p for p in self._solutions.of(name) if p.given is None)

    def own(self, name: str) -> frozenset[Problem]:
        """What a function itself may do besides giving a value, without what it calls."""
        return self._of_function(name).own

    def called(self, name: str) -> frozenset[str]:
        """The functions that a function runs itself."""
        self._of_function(name)
        return frozenset(self._calls[name])

    def _of_function(self, name: str) -> Equation[Problem]:
        if name not in self._equations:
            function = self.program.function(name)
            self._equations[name] = self._of_body(function, frozenset({name}))
        return self._equations[name]

    def _recursion(self, names: Collection[str]) -> dict[str, frozenset[Problem]]:
        """Which functions of some may call themselves, as far as that depends on no others."""
        found = in_cycles({name: sorted(self._calls.get(name, ())) for name in names})
        places = {name: self.program.function(name).place for name in found}
        return {n: frozenset({Problem(n, place, RECURSES)}) for n, place in places.items()}

    def functions(self, value: e.Expression) -> frozenset[str]:
        """The functions that a variable of a module may stand for."""
        held = self.origins.of(value, "")
        return frozenset(o.name for o in held if isinstance(o, FunctionOrigin))

    @cached_property
    def _operands(self) -> OperandClasses | None:
        """Which classes answer for values, in Python; in C++ the types of these say so."""
        return OperandClasses(self.origins) if self.table.language is Language.PYTHON else None

    @cached_property
    def _silent(self) -> SilentCalls:
        return SilentCalls(self.origins)

    def of_statements(self, function: Function, span: Span) -> frozenset[Problem]:
        """What the statements of a function at a place may do besides to compute."""
        return self.of_body(function, self.statements(function, span))

    def statements(self, function: Function, span: Span) -> s.Body:
        """The statements of a function at a place."""
        if function.name not in self._nested:
            self._nested[function.name] = tuple(_nested(function.body))
        return tuple(_within(self._nested[function.name], span))

    def of_body(self, function: Function, body: s.Body) -> frozenset[Problem]:
        """What some statements of a function may do besides to compute."""
        found = self._solutions.solved(self._of_body(replace(function, body=body), frozenset()))
        return frozenset(p for p in found if p.given is None)

    def raised_by(self, function: Function, span: Span) -> frozenset[Problem]:
        """The exceptions of statements at a place that leave the function, or end the program."""
        key = function.name, span
        if key not in self._raised:
            self._raised[key] = self._raised_by(function, span)
        return self._raised[key]

    def _raised_by(self, function: Function, span: Span) -> frozenset[Problem]:
        def is_own(p: Problem) -> bool:
            return bool(p.raises) and p.function == function.name and span.holds(p.place)

        of_statements = self.of_statements(function, span)
        # Most statements raise nothing: then nobody looks at what else the function calls.
        own = self._of_function(function.name).own
        if not any(p.raises for p in of_statements) and not any(map(is_own, own)):
            return frozenset()
        leaving = frozenset(p for p in self.of(function.name) if p.raises)
        return leaving & of_statements | frozenset(filter(is_own, leaving))

    def _of_body(self, function: Function, running: frozenset[str]) -> Equation[Problem]:
        """What a body may do; `running` are functions that silent calls are not looked for of."""
        notes = ProblemNotes(function, self.origins, self.counts, self.is_model, self.elements)
        walk_ = OutcomeWalk(notes, self.iterators)
        walk_.defaults(self._defaults.get(function.name, ()))
        after = walk_.body(function.body, walk_.first if running else NO_FACTS)
        if running and after is not None and self._lacks_result(function):
            notes.problem(function.body[-1], NO_RESULT, self._of_no_result)
        self.locks.check(function, notes)
        for node in self.iterators.gone_through(function):
            notes.problem(node, ENDLESS)
        found = implicit_calls(self.graph, function, self._operands)
        asked = self._asked(function) if found.has_library else frozenset()
        implicit = found.functions | asked
        self._run(function, implicit, notes)
        called = {c.function for c in notes.found if isinstance(c, Called)}
        self._calls.setdefault(function.name, set()).update(called)
        # What may run silently is no recursion: which places run it is not looked for.
        OutcomeWalk(notes, self.iterators).defaults(self._silent.factories(function, running))
        self._run(function, self._silent.called(function) - running, notes)
        calls = [c for c in notes.found if isinstance(c, Called)]
        own = frozenset(p for p in notes.found if isinstance(p, Problem))
        if not function.noexcept:
            return Equation(own, tuple((c.function, c.leaving) for c in calls))
        uses = ((c.function, lambda p, c=c: frozenset(map(_ending, c.leaving(p)))) for c in calls)
        return Equation(frozenset(map(_ending, own)), tuple(uses))

    def _lacks_result(self, function: Function) -> bool:
        """Whether a function must not come to its end: that leaves its result open in C++.

        See [stmt.return]. Some methods of Python give None there, which is refused.
        """
        if self.table.language is Language.PYTHON:
            return bool(kind_of(function, Language.PYTHON) and function.body)
        is_procedure = function.result in (t.NOTHING, t.UNKNOWN) or not function.body
        is_main = function.name.partition(" ")[0] == "main"
        is_plain = function.kind is FunctionKind.FUNCTION and not is_main
        return is_plain and not is_procedure

    @property
    def _of_no_result(self) -> str:
        is_cpp = self.table.language is Language.CPP
        return TERMINATES if is_cpp else self.table.of_failure("is of another type")

    def _asked(self, function: Function) -> frozenset[str]:
        """The operators that libraries may run of the objects that a function hands to them."""
        if not self.table.trusts_others:
            return self.origins.operators
        calls = (n for n in walk(function) if isinstance(n, s.Call))
        values = (a.value for call in calls for a in call.arguments)
        classes = {c for v in values for c in self._classes_of(v, function.name)}
        families = {each for c in classes for each in self.graph.family(c)}
        owners = {n: self.program.function(n).owner for n in self.origins.operators}
        return frozenset(n for n, owner in owners.items() if owner in families)

    def _classes_of(self, value: e.Expression, function: str) -> frozenset[str]:
        """The classes that a value may be an object of, the function's own one among them."""
        own = self.counts.rules.types.attributes.receiver(value, function)
        return self.origins.own_classes(value, function) | ({own} if own is not None else set())

    def kinds(self, function: Function) -> OperandKinds:
        """Of which types the values of a function in Python are."""
        return OperandKinds(self._notes(function))

    def _notes(self, function: Function) -> ProblemNotes:
        return ProblemNotes(function, self.origins, self.counts, self.is_model, self.elements)

    def _run(self, function: Function, names: Collection[str], notes: ProblemNotes) -> None:
        """Notes functions that run though no call of them stands in a function."""
        for name in names:
            if not self.is_model(name) and name != function.name:
                compares = name.rpartition(".")[2] in _GETS_NONE
                gives = with_none if compares else None
                notes.take({Called(name, (), gives)})
                if name in self._endless:
                    notes.take({Problem(name, self.program.function(name).place, ENDLESS)})

    @cached_property
    def _endless(self) -> frozenset[str]:
        """The methods of iterators, of which nothing shows how often they give an element."""
        classes = self.program.classes.values()
        iterated = [c for c in classes if ImplicitCall.ITERATE in dict(c.operators)]
        names = {
            method
            for c in iterated
            for implicit, method in c.operators
            if implicit is ImplicitCall.NEXT
        }
        return frozenset(f for c in iterated for method, f in c.methods if method in names)

    @cached_property
    def _defaults(self) -> dict[str, tuple[tuple[str, e.Expression], ...]]:
        """What functions get for parameters that no argument is for, and where that stands."""
        found: dict[str, tuple[tuple[str, e.Expression], ...]] = {}
        for around in self.program.functions:
            for node in walk(self.program.function(around)):
                if isinstance(node, e.Closure) and node.defaults:
                    found[node.function] = tuple((around, value) for _, value in node.defaults)
        return found


def _ending(problem: Problem) -> Problem:
    """What a problem of a `noexcept` function is: an exception ends the program."""
    return replace(problem, raises=problem.raises and TERMINATES)


@dataclass(frozen=True, slots=True)
class _Nested:
    """A statement with those that stand in it, but for what is between: no expressions."""

    statement: s.Statement
    inner: tuple[_Nested, ...]

    @property
    def place(self) -> Span:
        return getattr(self.statement, "place", NOWHERE)


def _nested(nodes: Iterable[Node]) -> Iterator[_Nested]:
    """The outermost statements among some nodes and their parts, each with those in it."""
    for node in nodes:
        if isinstance(node, STATEMENTS):
            yield _Nested(node, tuple(_nested(parts(node))))  # type: ignore[arg-type]
        else:
            yield from _nested(parts(node))


def _within(nested: Iterable[_Nested], span: Span) -> Iterator[s.Statement]:
    """The outermost statements that stand at a place.

    The rest of a block after a local, which its destruction ends, stands at the place of the local:
    of that only the destruction is the local's own.
    """
    for node in nested:
        is_there = span.holds(node.place)
        match node.statement:
            case s.Try(final=final) if any(isinstance(n, s.Destroy) for n in final):
                ends = set(map(id, final))
                yield from _within((n for n in node.inner if id(n.statement) not in ends), span)
                at_the_end = (n for n in node.inner if id(n.statement) in ends)
                yield from final if is_there else _within(at_the_end, span)
            case statement if is_there:
                yield statement
            case statement:
                yield from _within(node.inner, span)
                if node.place.holds(span) and not any(
                    _meets(inner.place, span) for inner in node.inner
                ):
                    yield from _head(statement)


def _meets(place: Span, span: Span) -> bool:
    return place.start < span.end and span.start < place.end


def _head(statement: s.Statement) -> Iterator[s.Statement]:
    """What runs of a statement though nothing that stands in it does: its test, what it enters."""
    match statement:
        case s.If():
            yield replace(statement, then=(), otherwise=())
        case s.Loop():
            yield s.If(statement.test, (), (), statement.dynamic, statement.place)
        case s.ForEach() | s.With():
            yield replace(statement, body=())
        case s.Switch():
            yield replace(statement, cases=())
        case _:
            pass
