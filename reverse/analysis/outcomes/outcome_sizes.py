"""What is known after calls, and what they do to the numbers of elements of containers."""

from __future__ import annotations

from rebsync.reverse.analysis.facts import (
    Facts,
    HasKey,
    HasSize,
    Holds,
    Implies,
    IsBelow,
    IsEnd,
    IsOf,
    IsSize,
    IsThere,
    bare,
    size_of,
    sized,
    without_shared,
    without_sizes,
)
from rebsync.reverse.analysis.origins import LibraryOrigin
from rebsync.reverse.analysis.outcomes.outcome_expressions import OutcomeExpressions
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.python.value_types import ANY_TYPE, ValueTypes
from rebsync.reverse.analysis.stores import AnyValue, CallResult, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.outcome_classes import PLAIN_CLASSES
from rebsync.reverse.libraries.outcome_rules import Size, Tells
from rebsync.reverse.libraries.outcomes import CallOutcome
from rebsync.reverse.libraries.size_effects import LEADING_TO_FIRST

_PARTS = frozenset({"split", "rsplit", "splitlines", "partition", "items", "keys", "values"})
_ASKED = ("__len__", "size", "begin", "end")
_ENDS = frozenset({"end", "cend", "rend", "crend"})


class OutcomeSizes:
    """Calls in one function, by what they do to containers and say of them."""

    def __init__(self, notes: ProblemNotes, expressions: OutcomeExpressions) -> None:
        self.notes = notes
        self.expressions = expressions
        self.origins = notes.origins
        self.function = notes.function.name

    def kept(self, node: s.Call, facts: Facts) -> Facts:
        """What is still known after a call."""
        outcome, receiver = self.of_receiver(node)
        if outcome is None:
            facts = without_shared(facts)
            return facts if self.notes.counts.keeps_elements else without_sizes(facts)
        emptying = self.notes.counts.emptying
        if emptying.is_foreign(node, self.function) and emptying.handed:
            facts = without_sizes(facts)
        if receiver is None:
            return facts
        match outcome.size:
            case Size.GROWS:
                stays_empty = not self.notes.counts.bound(receiver, self.function)
                return facts if stays_empty else facts | {HasSize(receiver, 1)}
            case Size.LOSES:
                return without_sizes(facts) | sized(receiver, size_of(facts, receiver) - 1)
            case Size.ANY:
                return without_sizes(facts)
            case _:
                return facts

    def of_receiver(self, node: s.Call) -> tuple[CallOutcome | None, e.Expression | None]:
        """What a method of a library does, with its object; None for functions of the program."""
        match node.callee:
            case s.LibraryCallee(name, receiver):
                return self.notes.table.function(name), receiver
            case s.MethodCallee(receiver, name, None) if not self.origins.methods_of_any(name):
                held = self.origins.of(receiver, self.function)
                classes = {o.name for o in held if isinstance(o, LibraryOrigin)}
                of = classes.pop() if len(classes) == 1 and len(held) == 1 else None
                return self.notes.table.method(of, name), receiver
            case _:
                return None, None

    def told(self, node: s.Call, facts: Facts) -> Facts:
        """What the result of a call says of what the call got."""
        outcome, receiver = self.of_receiver(node)
        of = receiver
        if of is None and node.arguments:
            of = node.arguments[0].value
        if outcome is None or of is None or node.target is None:
            return self._of_result(node)
        first = node.arguments[0].value if node.arguments else None
        last = getattr(node.callee, "name", "").rpartition("::")[2]
        if last in _ENDS:
            return frozenset({IsEnd(node.target)})
        if last in LEADING_TO_FIRST and self.expressions.size(of, facts):
            return frozenset({Holds(node.target)})
        match outcome.tells:
            case Tells.SIZE:
                return frozenset({IsSize(node.target, of)})
            case Tells.EMPTY:
                return frozenset({Implies(node.target, False, HasSize(of, 1))})
            case Tells.HAS if first is not None:
                return frozenset({Implies(node.target, True, HasKey(of, first))})
            case Tells.OBJECT:
                told = IsThere(of), IsOf(of, self._of_classes(node))
                return frozenset(Implies(node.target, True, each) for each in told)
            case Tells.SAME:
                return sized(node.target, self.expressions.size(of, facts))
            case Tells.RANGE if len(node.arguments) == 1:
                return self._of_range(node.target, of, facts)
            case Tells.MOST:
                values = [a.value for a in node.arguments]
                is_above = any(
                    isinstance(v, e.Literal) and isinstance(v.value, int | float) and v.value > 0
                    for v in values
                )
                return frozenset({Holds(node.target)} if is_above and len(values) > 1 else ())
            case _:
                return frozenset()

    def _of_classes(self, node: s.Call) -> ValueTypes:
        """The types that a value is asked for that `isinstance` gets."""
        asked = [a.value for a in node.arguments[1:]]
        if getattr(node.callee, "name", "") != "builtins.isinstance" or len(asked) != 1:
            return ANY_TYPE
        classes = asked[0].elements if isinstance(asked[0], e.Build) else asked
        return self.expressions.types.kinds.of_classes(classes)

    def _of_result(self, node: s.Call) -> Facts:
        assert node.target is not None
        return sized(node.target, self.notes.counts.size(node.target, self.function))

    def _of_range(self, target: e.Lvalue, of: e.Expression, facts: Facts) -> Facts:
        """The numbers below one, which may be the size of a container."""
        if isinstance(of, e.Literal) and isinstance(of.value, int):
            return frozenset({IsBelow(target, of.value)})
        sizes = (f for f in facts if isinstance(f, IsSize) and f.value == of)
        return frozenset(IsSize(target, f.container) for f in sizes)

    def has_some(self, container: e.Expression, facts: Facts) -> bool:
        """Whether what a loop goes through has an element."""
        below = (f.bound for f in facts if isinstance(f, IsBelow) and f.value == container)
        return self.expressions.size(container, facts) > 0 or any(b > 0 for b in below)

    def with_elements(self, value: e.Expression) -> list[e.Expression]:
        """The containers of which a value has the elements, or the keys."""
        key = key_of(value, self.function) if isinstance(value, e.Temporary) else None
        found = []
        for _, stored in self.origins.graph.stores.of(key) if key is not None else ():
            match stored:
                case CallResult(s.Call(_, s.LibraryCallee(name), (first, *_))):
                    if self.notes.table.function(name).tells is Tells.SAME:
                        found.append(first.value)
                case CallResult(s.Call(_, s.MethodCallee(receiver, "keys"))):
                    found.append(receiver)
                case _:
                    return []
        return found

    def is_given(self, value: e.Expression) -> bool:
        """Whether a value is what code gives that is not in the files: as many parts as it says."""
        key = key_of(value, self.function)
        stores = self.origins.graph.stores
        stored = [v for _, v in stores.of(key)] if key is not None else [value]
        return bool(stored) and all(self._is_given(each) for each in stored)

    def _is_given(self, stored: object) -> bool:
        match stored:
            case CallResult(s.Call(_, s.LibraryCallee(name))):
                return not self.notes.table.is_standard(name)
            case CallResult(s.Call(_, s.MethodCallee(receiver, name))):
                held = self.origins.of(receiver, self.function)
                is_plain = any(
                    isinstance(o, LibraryOrigin) and o.name in PLAIN_CLASSES for o in held
                )
                is_own = bool(self.origins.methods_of_any(name))
                return not is_plain and not is_own and name not in _PARTS
            case AnyValue():  # elements and parts of others, and what functions get
                return True
            case _:
                return False

    # --- loops -----------------------------------------------------------------------------------

    def is_bound(self, node: s.Call) -> bool:
        """Whether a call gives the size or the end of a container."""
        return self.bound(node) is not None

    def bound(self, node: s.Call) -> e.Expression | None:
        """The container of which a call gives the size or the end, if it is one of a library."""
        outcome, container = self._asked(node)
        name = node.callee.name if isinstance(node.callee, s.LibraryCallee) else ""
        is_end = name.rpartition("::")[2] in _ENDS
        if not is_end and (outcome is None or outcome.tells is not Tells.SIZE):
            return None
        if container is None:
            return None
        classes = self.origins.own_classes(container, self.function)
        has_own = (self.origins.has_method(c, m) for c in classes for m in _ASKED)
        return None if any(has_own) else container

    def emptied(self, node: s.Call) -> e.Expression | None:
        """The container of a library of which a call says whether it has no elements."""
        outcome, container = self._asked(node)
        if outcome is None or outcome.tells is not Tells.EMPTY or container is None:
            return None
        return None if self.origins.own_classes(container, self.function) else container

    def _asked(self, node: s.Call) -> tuple[CallOutcome | None, e.Expression | None]:
        """What a method does, with its object; or what a function does, with what it gets first."""
        outcome, receiver = self.of_receiver(node)
        given = [argument.value for argument in node.arguments[:1]]
        return outcome, next(iter(given), None) if receiver is None else receiver

    def is_emptied(self, loop: s.Loop) -> bool:
        """Whether each round takes an element out of the container whose size is tested."""
        test = bare(loop.test)
        if isinstance(test, e.Binary) and isinstance(test.right, e.Literal):
            least = {Operator.GREATER: 0, Operator.GREATER_EQUAL: 1}.get(test.operator)
            limit = test.right.value
            if least is None or not isinstance(limit, int) or limit < least:
                return False
            test = bare(test.left)
        asks, asked, tested = self.bound, test, {test}
        if isinstance(test, e.Unary) and test.operator is Operator.NOT:
            asks, asked = self.emptied, bare(test.operand)
        for node in loop.prelude:
            if isinstance(node, s.Call) and node.target == asked:
                container = asks(node)
                tested |= set() if container is None else {container}
        # With a default, `pop` of a key may take nothing.
        calls = [n for n in loop.body if isinstance(n, s.Call) and len(n.arguments) < 2]
        taken = [self.of_receiver(n) for n in calls]
        loses = (of for outcome, of in taken if outcome is not None and outcome.size is Size.LOSES)
        skips = any(isinstance(n, s.Continue) for n in walk(loop.body))
        return not skips and any(of in tested for of in loses)
