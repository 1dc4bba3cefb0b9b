"""The statements of a function in their order, with what is known at each, and what they may do."""

from __future__ import annotations

from collections.abc import Iterable

from rebsync.reverse.analysis.cpp_facts import without_moved
from rebsync.reverse.analysis.facts import (
    NO_FACTS,
    Facts,
    HasKey,
    Holds,
    IsBelow,
    IsBound,
    IsSame,
    IsSize,
    IsThere,
    bare,
    is_bound,
    joined,
    size_of,
    sized,
    stored,
    tested,
    without,
    without_shared,
    without_sizes,
)
from rebsync.reverse.analysis.origins import ClassOrigin, FunctionOrigin, LibraryOrigin
from rebsync.reverse.analysis.outcomes.endless_iterators import EndlessIterators
from rebsync.reverse.analysis.outcomes.handlers import Handlers
from rebsync.reverse.analysis.outcomes.loop_endings import LoopEndings
from rebsync.reverse.analysis.outcomes.outcome_calls import OutcomeCalls
from rebsync.reverse.analysis.outcomes.outcome_expressions import OutcomeExpressions
from rebsync.reverse.analysis.outcomes.outcome_sizes import OutcomeSizes
from rebsync.reverse.analysis.problems import Called, Problem, ProblemNotes
from rebsync.reverse.analysis.python.special_results import SpecialResults
from rebsync.reverse.analysis.python.unset_names import UnsetNames
from rebsync.reverse.analysis.python.value_types import at_index, elements_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import walk
from rebsync.unions import assert_never

ENDLESS = "nothing shows that this loop ends"


class OutcomeWalk:
    """The statements of one function, in their order, with what is known at each."""

    def __init__(self, notes: ProblemNotes, iterators: EndlessIterators) -> None:
        self.notes = notes
        self.origins = notes.origins
        self.name = notes.function.name
        self._expressions = OutcomeExpressions(notes)
        self._sizes = OutcomeSizes(notes, self._expressions)
        self._calls = OutcomeCalls(notes, self._expressions, self._sizes)
        self._endings = LoopEndings(notes, self._sizes, iterators)
        self._results = SpecialResults(self._expressions, self._calls.given)
        self._handlers = Handlers(notes)
        self._handled: list[set[Problem | Called]] = []
        self._breaks: list[list[Facts]] = []  # what is known where the loops around are left
        self.first = UnsetNames(notes).first()

    def value(self, value: e.Expression | None, facts: Facts) -> None:
        """What evaluating an expression may do."""
        if value is not None:
            self._expressions.check(value, facts)

    def defaults(self, values: Iterable[tuple[str, e.Expression]]) -> None:
        """What the function may call of what its parameters are when no argument is for them."""
        for around, value in values:
            for origin in self.origins.of(value, around):
                if isinstance(origin, FunctionOrigin | LibraryOrigin):
                    self._calls.called(value, origin)

    # --- statements ------------------------------------------------------------------------------

    def body(self, body: s.Body, facts: Facts | None) -> Facts | None:
        """What is known after some statements; None where none comes after them."""
        for statement in body:
            if facts is None:
                return None
            facts = self._statement(statement, facts)
        return facts

    def _statement(self, node: s.Statement, facts: Facts) -> Facts | None:
        match node:
            case s.Assert() | s.Block() | s.If() | s.Loop() | s.ForEach() | s.Switch():
                return self._structured(node, facts)
            case s.Try() | s.With() | s.Unsequenced():
                return self._structured(node, facts)
            case s.Return(value):
                self.value(value, facts)
                self._results.check(node, facts)
                return None
            case s.Raise():
                self._raises(node, facts)
                return None
            case s.Break():
                if self._breaks:
                    self._breaks[-1].append(facts)
                return None
            case s.Continue():
                return None
            case s.Call():
                self._handlers.note(node)
                return self._calls.call(node, facts)
            case s.Construct():
                return self._calls.construct(node, facts)
            case s.Destroy():
                self._calls.destroy(node, facts)
                return without_shared(without_moved(facts, node))
            case s.Evaluate(value):
                self.value(value, facts)
                return facts
            case s.Assign(target, value):
                return self._assigned(target, value, facts)
            case s.Declare(target, _, value):
                if value is None:
                    return without(facts, target)
                return self._assigned(target, value, facts)
            case s.CompoundAssign(target, operator, value):
                dynamic = node.dynamic
                combined = e.Binary(operator, target, value, target.type, dynamic, node.place)
                return self._assigned(target, combined, facts)
            case _:
                return self._other(node, facts)

    def _other(self, node: s.Statement, facts: Facts) -> Facts | None:
        match node:
            case s.Unpack(targets, value):
                self.value(value, facts)
                of = self.notes.counts.size(value, self.name)
                least = len(targets) - (node.rest is not None)
                is_given = self._sizes.is_given(value)
                is_short = max(size_of(facts, value), of) < least and not is_given
                if is_short or self._expressions.none.unpacks_wrongly(node):
                    self.notes.fails(node, "has another number of elements")
                self._expressions.none.check(value, node, facts)
                self._expressions.types.iterates(node, value, facts)
                types = self._expressions.types.of(value, facts)
                for at, target in enumerate(targets):
                    has_place = node.rest is None or at < node.rest
                    part = at_index(types, at) if types is not None and has_place else None
                    facts = stored(facts, target, part)
                    if not self._expressions.none.may_be(target, facts):
                        facts |= {IsThere(target)}
                return facts
            case s.Insert(container, value, key):
                self.value(value, facts)
                self.value(key, facts)
                self._expressions.types.inserts(node, facts)
                return without(facts, container)
            case s.Delete(e.Index(container)):
                self.value(node.target, facts)
                return without_sizes(facts) | sized(container, size_of(facts, container) - 1)
            case s.Delete(target):
                return without(facts, target) - {IsBound(target)}
            case s.Import(target, module, _, True) if self.notes.is_model(module):
                self.notes.problem(node, f'"{module}" is the model\'s')
                return facts
            case s.Import(target) | s.DefineClass(target):
                return facts if target is None else stored(facts, target) | {IsThere(target)}
            case s.Yield(target, value):
                self.value(value, facts)
                facts = without_sizes(without_shared(facts))
                return facts if target is None else stored(facts, target)
            case s.Unsupported(reason, raises=raises):
                raised = self.notes.table.of_anything if raises else ""
                self.notes.problem(node, f"this may do anything: {reason}", raised)
                return NO_FACTS
            case _:
                self.notes.problem(node, "this waits")
                return NO_FACTS

    def _assigned(self, target: e.Lvalue, value: e.Expression, facts: Facts) -> Facts:
        """What is known after a value is stored; of the target it is as of the value."""
        self.value(value, facts)
        self._stored(target, facts, value)
        before, facts = facts, stored(facts, target, self._expressions.types.of(value, facts))
        facts |= self._expressions.there(target, value, before)
        facts = without_moved(facts, value)
        if isinstance(target, e.Index):
            return facts | {HasKey(target.object, target.index)}
        if any(n == target for n in walk(value)):
            return facts
        size = max(size_of(before, value), self.notes.counts.size(value, self.name))
        facts |= sized(target, size)
        if isinstance(target, e.Temporary):
            facts |= {IsSame(target, value)}
        plain = bare(value)
        for fact in before:
            match fact:
                case Holds(known) if known == value:
                    facts |= {Holds(target)}
                case IsSize(known, container) if known == plain:
                    facts |= {IsSize(target, container)}
                case _:
                    pass
        if self._expressions.is_nonzero(value, before):
            facts |= {Holds(target)}
        return facts

    def _stored(self, target: e.Lvalue, facts: Facts, value: e.Expression) -> None:
        """What it may do to store in a target."""
        match target:
            case e.Index():
                self._expressions.stored_at(target, facts)
            case _ if self._is_of_model(target):
                self.notes.problem(target, "this is stored in what is the model's")
            case e.Attribute(holder) | e.Dereference(holder):
                self.value(holder if isinstance(target, e.Attribute) else target, facts)
                if isinstance(target, e.Attribute):
                    asked = "asks None for an attribute"
                    self._expressions.none.check(holder, target, facts, asked)
                    self._expressions.types.sets(target, value, facts)
                held = self.origins.of(holder, self.name)
                if any(isinstance(o, LibraryOrigin) and not o.of_object for o in held):
                    self.notes.problem(target, "this is stored in another module")
            case _:
                pass

    def _is_of_model(self, target: e.Expression) -> bool:
        """Whether a target is a part of what is the model's."""
        while isinstance(target, e.Attribute | e.Index):
            target = target.object
        match target:
            case e.Global(name) | e.Captured(name) | e.ClassReference(name):
                return self.notes.is_model(name)
            case e.Dereference(of):
                return self._is_of_model(of)
            case _:
                return False

    def _raises(self, node: s.Raise, facts: Facts) -> None:
        if node.value is None:
            if self._handled:
                self.notes.take(self._handled[-1])
            return
        self.value(node.value, facts)
        for origin in self.origins.of(node.value, self.name):
            name = origin.name if isinstance(origin, ClassOrigin | LibraryOrigin) else ""
            self.notes.problem(node, "this raises an exception", name or "an exception")

    # --- control ---------------------------------------------------------------------------------

    def _structured(self, node: s.Structured, facts: Facts) -> Facts | None:
        match node:
            case s.Block(body):
                return self.body(body, facts)
            case s.If(test, then, otherwise):
                self.value(test, facts)
                first = self.body(then, tested(facts, test, True))
                if test == e.Literal(True):
                    return first
                return joined(first, self.body(otherwise, tested(facts, test, False)))
            case s.Loop():
                return self._loop(node, facts)
            case s.ForEach():
                return self._for_each(node, facts)
            case s.Switch(value, cases):
                self.value(value, facts)
                inside = self._changed(facts, tuple(s for c in cases for s in c.body))
                ends = [self.body(c.body, inside) for c in cases][-1:]
                leaves = ends != [None] or any(isinstance(n, s.Break) for n in walk(node))
                return inside if leaves or not any(c.is_default for c in cases) else None
            case s.Try():
                return self._try(node, facts)
            case s.With(context, target, body):
                self._calls.entered(context, facts)
                facts = facts if target is None else stored(facts, target)
                after = self._body_of_context(context, body, facts)
                if after is None:
                    return None
                bound = () if self._handlers.may_swallow(context) else filter(is_bound, after)
                return self._changed(facts, body).union(bound)
            case s.Assert(test):
                self.value(test, facts)
                self.notes.fails(node, "does not hold")
                return tested(facts, test, True)
            case s.Unsequenced(parts):
                inside = self._changed(facts, tuple(s for part in parts for s in part))
                for part in parts:
                    after = self.body(part, inside)
                    inside = inside if after is None else after
                return inside
            case _:
                assert_never(node)

    def _body_of_context(self, context: e.Expression, body: s.Body, facts: Facts) -> Facts | None:
        """What is known after the body of a `with`, which may end some exceptions."""
        outer, self.notes.found = self.notes.found, set()
        after = self.body(body, facts)
        raised, self.notes.found = self.notes.found, outer
        self.notes.take(self._handlers.passed(context, raised))
        if after is None and self._handlers.suppresses(context):
            return self._changed(facts, body)
        return after

    def _loop(self, node: s.Loop, facts: Facts) -> Facts | None:
        inner = (*node.prelude, *node.body, *node.step)
        if not self._endings.ends(node):
            self.notes.problem(node, ENDLESS)
        inside = self._changed(facts, inner)
        before = self.body(node.prelude, inside) or inside
        self.value(node.test, before)
        entered = inside if node.body_first else tested(before, node.test, True)
        self._breaks.append([])
        after = self.body(node.body, entered)
        breaks = self._breaks.pop()
        self.body(node.step, self._changed(facts, inner) if after is None else after)
        left = tested(before, node.test, False)
        self.body(node.otherwise, left)
        has_break = any(isinstance(n, s.Break) for n in walk(node.body))
        if not has_break and isinstance(node.test, e.Literal) and node.test.value:
            return None
        if has_break and node.test == e.Literal(True) and not node.otherwise:
            return breaks[0].intersection(*breaks) if breaks else inside
        return inside if has_break or node.otherwise else left

    def _for_each(self, node: s.ForEach, facts: Facts) -> Facts:
        self.value(node.iterable, facts)
        if not self._endings.ends(node):
            self.notes.problem(node, ENDLESS)
        self._expressions.none.check(node.iterable, node, facts)
        self._expressions.types.iterates(node, node.iterable, facts)
        inside = without(self._changed(facts, node.body), node.target)
        size = self.notes.counts.elements(node.iterable, self.name)
        if self.notes.is_parameter(node.iterable):
            size = max(size, self.notes.elements.get(self.name, 0))
        types = self._expressions.types.of(node.iterable, facts)
        element = None if types is None else elements_of(types)
        known = {*sized(node.target, size), *stored(NO_FACTS, node.target, element)}
        if not self._expressions.none.has_none(node.iterable):
            known.add(IsThere(node.target))
        for fact in inside:
            if isinstance(fact, IsSize) and fact.value == node.iterable:
                known.add(HasKey(fact.container, node.target))
            if isinstance(fact, IsBelow) and fact.value == node.iterable:
                known.add(IsBelow(node.target, fact.bound))
        known.add(HasKey(node.iterable, node.target))
        known |= {HasKey(of, node.target) for of in self._sizes.with_elements(node.iterable)}
        self._breaks.append([])
        self.body(node.body, inside | known)
        ends = self._breaks.pop()
        if self._sizes.has_some(node.iterable, facts):
            inside |= {IsBound(node.target)}
        after = self.body(node.otherwise, inside)
        ends += [] if after is None else [after]
        bound = filter(is_bound, ends[0].intersection(*ends) if ends else ())
        return inside.union(bound)

    def _changed(self, facts: Facts, body: s.Body) -> Facts:
        """What is still known once a body may have run, some of it or all, any number of times."""
        facts = without_moved(facts, body)
        for node in walk(body):
            target = getattr(node, "target", None)
            if target is not None and not isinstance(node, e.AddressOf):
                facts = without(facts, target)
            match node:
                case s.Unpack(targets):
                    for each in targets:
                        facts = without(facts, each)
                case s.Call():
                    facts = self._sizes.kept(node, facts)
                case s.Construct() | s.Destroy() | s.Import():
                    facts = without_shared(facts)
                case s.Delete() | s.Yield():
                    facts = without_sizes(facts)
                case s.Unsupported():
                    facts = NO_FACTS
                case _:
                    pass
        return facts

    # --- exceptions ------------------------------------------------------------------------------

    def _try(self, node: s.Try, facts: Facts) -> Facts | None:
        outer, self.notes.found = self.notes.found, set()
        after = self.body(node.body, facts)
        raised, self.notes.found = self.notes.found, outer
        inside = self._changed(facts, node.body)
        ways = []
        for handler in node.handlers:
            caught, raised = self._handlers.split(raised, handler)
            self._handled.append(caught)
            caught_as = self._expressions.types.caught(inside, handler.target)
            ways.append(self.body((*handler.prelude, *handler.body), caught_as))
            self._handled.pop()
        self.notes.take(raised)
        if after is not None:
            after = self.body(node.otherwise, after)
        for way in ways:
            after = joined(after, way)
        if not node.final:
            return after
        last = self._changed(inside, node.final) if after is None else after
        final = self.body(node.final, last if after is not None else inside)
        return None if after is None else final
