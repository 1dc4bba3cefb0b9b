"""What calls may do, by all that they may reach, and what is known after them."""

from __future__ import annotations

import re

from rebsync.reverse.analysis.cpp_facts import without_moved
from rebsync.reverse.analysis.facts import Facts, Holds, IsThere, stored, tested, without_shared
from rebsync.reverse.analysis.made_objects import made_by
from rebsync.reverse.analysis.origins import (
    AnyOrigin,
    ClassOrigin,
    FunctionOrigin,
    LibraryOrigin,
    Origin,
    PlainOrigin,
)
from rebsync.reverse.analysis.outcomes.endless_iterators import has_own_iterator
from rebsync.reverse.analysis.outcomes.given_arguments import GivenArguments
from rebsync.reverse.analysis.outcomes.library_exceptions import LibraryExceptions
from rebsync.reverse.analysis.outcomes.library_operators import is_standard
from rebsync.reverse.analysis.outcomes.outcome_expressions import OutcomeExpressions
from rebsync.reverse.analysis.outcomes.outcome_sizes import OutcomeSizes
from rebsync.reverse.analysis.problems import Called, ProblemNotes
from rebsync.reverse.analysis.python.call_binding import REFUSED
from rebsync.reverse.analysis.python.library_arguments import LibraryArguments
from rebsync.reverse.analysis.stores import Member
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import ImplicitCall
from rebsync.reverse.libraries.cpp import asks_first
from rebsync.reverse.libraries.outcome_classes import ENUMERATIONS, PLAIN_CLASSES, UNKNOWN_CLASS
from rebsync.reverse.libraries.outcomes import CallOutcome
from rebsync.reverse.libraries.routines import Language

_PARAMETERS = re.compile(r"<[^<>]*>")
_WAITING_ALONE = frozenset({"get", "join"})
UNKNOWN_CALL = "what is called is not known"


class OutcomeCalls:
    """Calls in one function."""

    def __init__(
        self,
        notes: ProblemNotes,
        expressions: OutcomeExpressions,
        sizes: OutcomeSizes,
    ) -> None:
        self.notes = notes
        self.expressions = expressions
        self._sizes = sizes
        self._exceptions = LibraryExceptions(notes, expressions)
        self.given = LibraryArguments(expressions)
        self._binding = notes.counts.rules.binding
        self.origins = notes.origins
        self.function = notes.function.name
        self._is_cpp = notes.table.language is Language.CPP
        self._here: Facts = frozenset()  # what is known where the call stands

    def call(self, node: s.Call, facts: Facts) -> Facts:
        """Notes what a call may do, and gives what is known after it."""
        self._here = facts
        self._arguments(node, facts)
        self.expressions.types.call(node, facts)
        self.given.check(node, facts)
        if self._binding.of_callback(node, self.notes.function):
            self.notes.fails(node, REFUSED)
        match node.callee:
            case s.FunctionCallee(name):
                self._enters(node, name)
            case s.LibraryCallee(name, receiver):
                is_own = receiver is None and self._of_template(node, name)
                if receiver is not None:
                    self.expressions.check(receiver, facts)
                outcome = CallOutcome() if is_own else self.notes.table.function(name)
                self._library(node, name, outcome, receiver, facts)
            case s.ValueCallee(value):
                self.expressions.check(value, facts)
                self.expressions.none.check(value, node, facts)
                for origin in self.origins.of(value, self.function):
                    self._value(node, value, origin, facts)
            case s.MethodCallee(receiver):
                self.expressions.check(receiver, facts)
                asked = "asks None for an attribute"
                self.expressions.none.check(receiver, node, facts, asked)
                if node.callee.name == "format":
                    self.expressions.none.filled(node, receiver, facts)
                self._method(node, node.callee, facts)
        for name in made_by(self.origins, node) if self._is_cpp else ():
            self._enters(node, name)
        after = without_moved(self._sizes.kept(node, facts), node)
        if node.target is None:
            return after
        types = self.expressions.types.given(node)
        after = stored(after, node.target, types) | self._sizes.told(node, facts)
        if self._is_cpp and self.expressions.undefined.pointers.gives(node):
            return after | {IsThere(node.target), Holds(node.target)}
        return after if self.expressions.none.gives(node) else after | {IsThere(node.target)}

    def construct(self, node: s.Construct, facts: Facts) -> Facts:
        """Notes what making an object of a class of the program may do."""
        self._here = facts
        for argument in node.arguments:
            self.expressions.check(argument.value, facts)
        if node.constructor is not None:
            self._enters(node, node.constructor)
        else:
            self._makes(node, node.class_name)
        facts = without_shared(facts)
        if node.target is None:
            return facts
        return stored(facts, node.target) | {IsThere(node.target), Holds(node.target)}

    def destroy(self, node: s.Destroy, facts: Facts) -> None:
        """Notes what the end of an object may do."""
        self.expressions.undefined.lifetimes.check(node, facts)
        for name in self._answers(node.class_name or "", ImplicitCall.DESTROY):
            self._enters(node, name)

    def entered(self, context: e.Expression, facts: Facts) -> None:
        """Notes what entering a context of a library may do."""
        self.expressions.check(context, facts)
        for origin in self.origins.of(context, self.function):
            if isinstance(origin, LibraryOrigin) and origin.of_object:
                self._acts(context, origin.name)

    def called(self, place: e.Expression, origin: Origin) -> None:
        """Notes what calling a value may do, with arguments of which nothing is known."""
        call = s.Call(None, s.ValueCallee(place), (), place.place)
        match origin:
            case FunctionOrigin(name):
                self.notes.elements[name] = 0
                self._enters(call, name)
            case _:
                self._value(call, place, origin, frozenset())

    # --- what is called --------------------------------------------------------------------------

    def _enters(self, node: s.Statement, name: str) -> None:
        """A function of the program runs."""
        if self.notes.is_model(name):
            self.notes.problem(node, f'"{name.rpartition("/")[2]}" is the model\'s')
        elif isinstance(node, s.Call | s.Construct):
            called = self.origins.graph.program.function(name)
            gives = GivenArguments(self.expressions, node, called, self._here)
            self.notes.take({Called(name, (), gives)})
        else:
            self.notes.take({Called(name)})

    def _hands(self, node: s.Statement, name: str) -> None:
        """A function is handed over, and may run with other arguments than those of the call."""
        if self.notes.is_model(name):
            self._enters(node, name)
        else:
            self.notes.take({Called(name)})

    def _of_template(self, node: s.Call, name: str) -> bool:
        """A function of a parameter of a template, or of a class that one gives: of any class.

        Whether it is one of the program's templates, which has it.
        """
        before = ""
        while before != name:
            before, name = name, _PARAMETERS.sub("", name)
        scope, _, last = name.rpartition("::")
        if scope and not self.notes.table.is_standard(name):
            for method in sorted(self.origins.methods_of_any(last)):
                if not self.notes.is_model(method):
                    self._enters(node, method)
        classes = self.origins.graph.program.classes
        return any(c == scope or c.endswith(f"::{scope}") for c in classes)

    def _arguments(self, node: s.Call, facts: Facts) -> None:
        keeps, asks = self._keeps_types(node), asks_first(getattr(node.callee, "name", ""))
        sizes = [self.notes.counts.elements(a.value, self.function) for a in node.arguments]
        for argument in node.arguments:
            value = argument.value
            self.expressions.check(value, facts)
            facts = tested(facts, value, True) if asks else facts
            for origin in self.origins.of(value, self.function):
                match origin:
                    case FunctionOrigin() if self._asks_a_node(node):
                        pass  # it runs when a message is there; that this asks is noted
                    case FunctionOrigin(name):
                        if self.notes.counts.rules.binding.of_handed(node, argument, name):
                            self.notes.fails(node, REFUSED)
                        known = self.notes.elements.get(name, 0)
                        self.notes.elements[name] = max(known, *sizes)
                        self._hands(node, name)
                    case ClassOrigin(name, False) if not keeps:
                        self._makes(node, name)
                    case LibraryOrigin(name, False) if not keeps and self.notes.table.may_be_called(
                        name
                    ):
                        outcome = self.notes.table.function(name)
                        self._library(node, name, outcome, None, facts)
                    case _:
                        pass

    def _asks_a_node(self, node: s.Call) -> bool:
        """Whether a method is one that asks a node for something, as to call back."""
        match node.callee:
            case s.LibraryCallee(name, None) if self.notes.table.language is Language.PYTHON:
                return bool(self.notes.table.function(name).acts)
            case s.MethodCallee(name=name) | s.LibraryCallee(name=name, receiver=e.Attribute()):
                return bool(self.notes.table.method(None, name.rpartition("::")[2]).acts)
            case _:
                return False

    def _keeps_types(self, node: s.Call) -> bool:
        """Whether what is called only looks at classes that it gets, or makes plain values."""
        callee = node.callee
        return isinstance(callee, s.LibraryCallee) and self.notes.table.function(callee.name).keeps

    def _value(self, node: s.Call, value: e.Expression, origin: Origin, facts: Facts) -> None:
        match origin:
            case FunctionOrigin(name):
                if self._binding.of_function(node, name):
                    self.notes.fails(node, REFUSED)
                self.notes.elements[name] = max(
                    [self.notes.counts.elements(a.value, self.function) for a in node.arguments],
                    default=0,
                )
                self._enters(node, name)
            case ClassOrigin(name, False):
                if self._binding.of_class(node, name):
                    self.notes.fails(node, REFUSED)
                self._makes(node, name)
            case ClassOrigin(name):
                if self._binding.of_method(node, name, "__call__", True):
                    self.notes.fails(node, REFUSED)
                for method in self._answers(name, ImplicitCall.CALL):
                    self._enters(node, method)
            case LibraryOrigin(name, False):
                self._library(node, name, self.notes.table.function(name), None, facts)
                if not self.notes.is_parameter(value):
                    self.given.of_value(node, name, facts)
            case _ if is_standard(value):
                pass  # a distribution, a comparison: it gives a value
            case _ if (of := self.expressions.operators.class_of(value)) is not None:
                outcome = self.notes.table.method(of, "operator()")
                self._library(node, of, outcome, value, facts)
            case LibraryOrigin(name) if not self.notes.table.is_standard(name):
                pass
            case LibraryOrigin(name) if self.notes.table.has_methods_of(name):
                outcome = self.notes.table.method(name, "__call__")
                self._library(node, name, outcome, None, facts)
            case _:
                # What a function gets was looked at where it was handed over.
                if not self.notes.is_parameter(value):
                    raises = self.notes.table.of_anything if self._is_cpp else ""
                    self.notes.problem(node, UNKNOWN_CALL, raises)

    def _makes(self, node: s.Statement, name: str) -> None:
        if self.notes.is_model(name):
            self.notes.problem(node, f'"{name}" is the model\'s')
        for method in self._answers(name, ImplicitCall.CONSTRUCT):
            self._enters(node, method)
        bases = self.origins.graph.bases(name)
        for base in bases:
            if base not in self.origins.graph.program.classes:
                self._acts(node, base)
        if not ENUMERATIONS.isdisjoint(bases):
            for method in sorted(self.origins.methods(name, "_missing_")):
                self._enters(node, method)
            self.notes.fails(node, "lacks the member")

    def _acts(self, node: s.Statement | e.Expression, name: str) -> None:
        """What a class of a library does when an object of it is made."""
        if acts := self.notes.table.function(name).acts:
            self.notes.problem(node, f'"{name}": {acts}')

    def _answers(self, name: str, implicit: ImplicitCall) -> list[str]:
        """The functions by which a class, or one it extends, answers what no text calls."""
        graph = self.origins.graph
        line = [name, *graph.bases(name)]
        classes = [graph.program.classes[c] for c in line if c in graph.program.classes]
        return [
            function
            for class_ in classes
            for operator, method in class_.operators
            if operator is implicit
            for own, function in class_.methods
            if own == method
        ]

    def _method(self, node: s.Call, callee: s.MethodCallee, facts: Facts) -> None:
        if callee.declared is not None:
            found = self.origins.methods(callee.declared, callee.name)
            for name in sorted(found):
                self._enters(node, name)
            if not found:
                outcome = self.notes.table.method(callee.declared, callee.name)
                self._library(node, callee.name, outcome, callee.receiver, facts)
            return
        if callee.after is not None:
            self._of_base(node, callee, callee.after, facts)
            return
        held = self.origins.of(callee.receiver, self.function)
        for origin in sorted(held, key=str):
            self._of_object(node, callee, origin, facts)

    def _of_base(self, node: s.Call, callee: s.MethodCallee, after: str, facts: Facts) -> None:
        """A method that comes after those of a class, in the order of its bases or another's."""
        graph = self.origins.graph
        family = graph.family(after) - graph.subclasses.get(after, {after})
        classes = (graph.program.classes.get(name) for name in family)
        own = [f for c in classes if c is not None for n, f in c.methods if n == callee.name]
        if self._binding.of_base(node, after, callee.name):
            self.notes.fails(node, REFUSED)
        for name in sorted(own):
            self._enters(node, name)
        for base in sorted(family - graph.program.classes.keys()):
            table = self.notes.table
            makes = callee.name == "__init__"
            outcome = table.function(base) if makes else table.method(base, callee.name)
            self._library(node, callee.name, outcome, callee.receiver, facts)

    def _of_object(
        self, node: s.Call, callee: s.MethodCallee, origin: Origin, facts: Facts
    ) -> None:
        """A method of one of the objects that a receiver may be."""
        name, receiver = callee.name, callee.receiver
        match origin:
            case ClassOrigin(of, is_object):
                if self._binding.of_method(node, of, name, is_object):
                    self.notes.fails(node, REFUSED)
                found = self.origins.methods(of, name)
                self._stored_in(node, name, facts)
                for method in sorted(found):
                    self._enters(node, method)
                if not found:
                    for base in self.origins.graph.bases(of):
                        self._library(
                            node, name, self.notes.table.method(base, name), receiver, facts
                        )
            case LibraryOrigin(of, False):
                full = f"{of}.{name}"
                self._library(node, full, self.notes.table.function(full), receiver, facts)
            case LibraryOrigin(of) if self.notes.table.is_function(of):
                self._of_object(node, callee, AnyOrigin(), facts)  # which class it gives is open
            case LibraryOrigin(of):
                if of == UNKNOWN_CLASS:
                    for method in sorted(self.origins.methods_of_any(name)):
                        if not self.notes.is_model(method):
                            self._enters(node, method)
                self._library(node, name, self.notes.table.method(of, name), receiver, facts)
                if of not in PLAIN_CLASSES and name in _WAITING_ALONE and not node.arguments:
                    self.notes.problem(node, f'"{name}" may wait')
            case PlainOrigin():
                self._library(node, name, self.notes.table.method(None, name), receiver, facts)
            case _:
                own = self.origins.graph.class_of(receiver, self.notes.function)
                if own is not None and self._binding.of_own_method(node, own, name):
                    self.notes.fails(node, REFUSED)
                self._stored_in(node, name, facts)
                for method in sorted(self.origins.methods_of_any(name)):
                    if not self.notes.is_model(method):
                        self._enters(node, method)
                self._library(node, name, self.notes.table.method(None, name), receiver, facts)
                if name in _WAITING_ALONE and not node.arguments:
                    self.notes.problem(node, f'"{name}" may wait')

    def _stored_in(self, node: s.Call, name: str, facts: Facts) -> None:
        """What is stored in attributes of a name, and called in place of a method."""
        for function, value in self.origins.graph.stores.of(Member(name)):
            if isinstance(value, e.Closure) and value.function in self.origins.methods_of_any(name):
                continue
            for origin in self.origins.of_stored((function, value)):
                if isinstance(origin, FunctionOrigin | LibraryOrigin | AnyOrigin):
                    self._value(node, e.Literal(None), origin, facts)

    # --- libraries -------------------------------------------------------------------------------

    def _library(
        self,
        node: s.Call,
        name: str,
        outcome: CallOutcome,
        receiver: e.Expression | None,
        facts: Facts,
    ) -> None:
        if (
            name == "format"
            and receiver is not None
            and not self._exceptions.has_pieces(node, receiver)
        ):
            self.notes.fails(node, "lacks the argument")
        if outcome.acts:
            self.notes.problem(node, f'"{name}": {outcome.acts}')
        if name.endswith("shared_from_this") and self.function in self.origins.of_cpp.constructing:
            self.notes.problem(node, f'"{name}" may raise an exception', "std::bad_weak_ptr")
        values = [a.value for a in node.arguments] if self._is_cpp else []
        if self._is_cpp:
            self.expressions.undefined.call(node, outcome, receiver, facts)
        if any(has_own_iterator(self.origins, value, self.function) for value in values):
            self.notes.problem(node, f'"{name}" may never come to the end')
        for raised in self._exceptions.of(node, outcome, receiver, facts):
            self.notes.problem(node, self._exceptions.why(name, outcome), raised)
