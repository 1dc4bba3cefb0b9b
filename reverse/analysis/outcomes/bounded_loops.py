"""Which loops end: those that count with a constant step to a bound that they do not write.

Everything else may not end.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import replace

from rebsync.intervals import Interval, of_unary
from rebsync.reverse.analysis.numbers.finite_numbers import FiniteNumbers, Limits, values_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import MIRRORED, Operator
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries.routines import Language

_NAMED = e.Local | e.Captured | e.Global | e.Attribute
_UP = (Operator.LESS, Operator.LESS_EQUAL)
_DOWN = (Operator.GREATER, Operator.GREATER_EQUAL)
_OPPOSITE = {
    Operator.LESS: Operator.GREATER_EQUAL,
    Operator.GREATER: Operator.LESS_EQUAL,
    Operator.LESS_EQUAL: Operator.GREATER,
    Operator.GREATER_EQUAL: Operator.LESS,
}


class LoopEnds:
    """The loops of one function.

    `is_size` says of a call whether it gives the size, or the end, of a container; `is_written` of
    a bound whether a loop stores in what it is made of; `lent` has the ids of references by which
    nobody stores.
    """

    def __init__(
        self,
        numbers: FiniteNumbers,
        function: str,
        is_size: Callable[[s.Call], bool],
        is_written: Callable[[s.Loop, e.Expression], bool],
        lent: frozenset[int],
    ) -> None:
        self.numbers = numbers
        self.function = function
        self.is_size = is_size
        self.is_written = is_written
        self.lent = lent

    def ends(self, loop: s.Loop) -> bool:
        """Whether a loop ends, if its body does and puts nothing into its bound."""
        return any(self._is_false_at_last(loop, test) for test in _tests(loop))

    def _is_false_at_last(self, loop: s.Loop, test: e.Expression) -> bool:
        """Whether a test that each round makes does not hold in all of them."""
        if isinstance(test, e.Literal):
            return not test.value
        return isinstance(test, e.Binary) and self._counts(loop, test)

    def _counts(self, loop: s.Loop, test: e.Binary) -> bool:
        left, right = (_before_its_step(loop, _bare(side)) for side in (test.left, test.right))
        match left:
            case e.Binary(Operator.ADD, inner, e.Literal(int() as more)) if more >= 0:  # i + 1 < n
                left = _bare(inner)
            case _:
                pass
        if self._is_counter(loop, left, test.operator, test.right):
            return True
        mirrored = MIRRORED.get(test.operator)
        return mirrored is not None and self._is_counter(loop, right, mirrored, test.left)

    def _is_counter(
        self, loop: s.Loop, counter: e.Expression, operator: Operator, bound: e.Expression
    ) -> bool:
        """Whether a variable gets nearer to a bound in each round."""
        if not isinstance(counter, e.Local) or counter in walk(bound):
            return False
        if self.is_written(loop, bound) or not self._is_asked(loop, bound):
            return False
        if self._is_handed_on(loop, {n for n in walk(bound) if isinstance(n, _NAMED)}):
            return False
        if operator is Operator.UNEQUAL and isinstance(_bare(bound), e.Temporary):
            return _is_iterator(loop, counter)
        step = self._step(loop, counter)
        width, limits = self._width(counter), self.numbers.limits(bound, self.function)
        if not step or width is None or limits is None:
            return False
        if operator is Operator.UNEQUAL:
            return _is_passed(width, limits, step)
        if operator not in (_UP if step > 0 else _DOWN):
            return False
        is_strict = operator in (Operator.LESS, Operator.GREATER)
        return _is_reached(width, is_strict, limits.within, step)

    def _is_handed_on(self, loop: s.Loop, names: Collection[Node]) -> bool:
        """Whether others may store in variables: by a reference, or by `stream >> n`."""
        for node in walk(loop):
            match node:
                case e.AddressOf(target) if target in names and id(node) not in self.lent:
                    return True
                case s.Evaluate(value) | s.If(value) | s.Loop(value):
                    if any(taken in names for taken in _taken_in(value)):
                        return True
                case _:
                    pass
        return False

    def _is_asked(self, loop: s.Loop, bound: e.Expression) -> bool:
        """Whether what each round computes anew of a bound is the size or end of a container."""
        parts = {n for n in walk(bound) if isinstance(n, e.Temporary)}
        stores = (n for n in walk(loop) if getattr(n, "target", None) in parts)
        asked = {id(n) for n in walk(loop.prelude)}
        return all(isinstance(n, s.Call) and self.is_size(n) and id(n) in asked for n in stores)

    def _step(self, loop: s.Loop, counter: e.Local) -> int | None:
        """What is added to a counter in each round, where nothing else is stored in it."""
        stores = [n for n in walk(loop) if _stores_in(n, counter)]
        if len(stores) != 1 or self._is_handed_on(loop, (counter,)):
            return None
        store = stores[0]
        skips = any(isinstance(n, s.Continue) for n in walk(loop.body))
        if store not in (*loop.prelude, *loop.step) and (store not in loop.body or skips):
            return None
        match store:
            case s.CompoundAssign(_, Operator.ADD, e.Literal(int() as step)):
                return step
            case s.CompoundAssign(_, Operator.SUBTRACT, e.Literal(int() as step)):
                return -step
            case s.Assign(_, e.Binary(Operator.ADD, left, e.Literal(int() as step))) if (
                left == counter
            ):
                return step
            case _:
                return None

    def _width(self, counter: e.Local) -> t.Integer | None:
        """The type of a whole number; a float may stay as it is when one is added."""
        if isinstance(counter.type, t.Integer):
            return counter.type
        if self.numbers.table.language is Language.CPP:
            return None
        limits = self.numbers.limits(counter, self.function)
        return t.UNBOUNDED if limits is not None and limits.is_whole else None


def _tests(loop: s.Loop) -> Iterator[e.Expression]:
    """What must hold for a loop to go on after a round: its test, and those that leave it."""
    waiting = [loop.test]
    while waiting:
        test = _bare(waiting.pop())
        if isinstance(test, e.And):
            waiting += [test.left, test.right]
        else:
            yield test
    if any(isinstance(n, s.Continue) for n in walk(loop.body)):
        return
    for node in loop.body:
        match node:
            case s.If(test, (*_, s.Break() | s.Return()), ()):
                held = _bare(test)
                opposite = _OPPOSITE.get(held.operator) if isinstance(held, e.Binary) else None
                if isinstance(held, e.Binary) and opposite is not None:
                    yield replace(held, operator=opposite)
            case _:
                pass


def _taken_in(value: e.Expression) -> Iterator[e.Expression]:
    """What a statement or test like `stream >> a >> b` stores in, perhaps."""
    match value:
        case e.And(left, right) | e.Or(left, right):
            yield from _taken_in(left)
            yield from _taken_in(right)
        case e.Unary(_, operand) | e.Convert(_, operand):
            yield from _taken_in(operand)
        case e.Binary(Operator.SHIFT_RIGHT | Operator.BIT_AND, left, right, _, True):
            yield right
            yield from _taken_in(left)
        case _:
            pass


def _is_reached(width: t.Integer, is_strict: bool, bound: Interval | None, step: int) -> bool:
    """Whether a counter of a width gets to a bound before it wraps."""
    if width.bits is None:
        return True
    if bound is None:
        return False
    whole = values_of(width)
    if step < 0:
        whole, bound, step = of_unary("-", whole), of_unary("-", bound), -step
    if bound.high + step - is_strict <= whole.high:
        return True
    # What a number of `int` or more does beyond its last one, C++ leaves undefined.
    return is_strict and width.signed and width.bits >= 32 and bound.high <= whole.high


def _is_passed(width: t.Integer, limits: Limits, step: int) -> bool:
    """Whether a counter that takes each number of its type comes by all that a bound may be."""
    if width.bits is None or width.bits > 32 or abs(step) != 1:
        return False
    if limits.within is None or not limits.is_whole:
        return False
    return values_of(width).includes(limits.within)


def _before_its_step(loop: s.Loop, value: e.Expression) -> e.Expression:
    """The variable whose value a test has: of `i++ < n` that of before the step."""
    if not isinstance(value, e.Temporary):
        return value
    match [n for n in walk(loop) if getattr(n, "target", None) == value]:
        case [s.Assign(_, e.Local() as of) as store] if store in walk(loop.prelude):
            return of
        case _:
            return value


def _is_iterator(loop: s.Loop, counter: e.Local) -> bool:
    """Whether a variable goes to the next element after each round, and nowhere else."""
    uses = [n for n in walk(loop) if isinstance(n, e.AddressOf) and n.target == counter]
    if len(uses) != 1 or any(_stores_in(n, counter) for n in walk(loop)) or not loop.step:
        return False
    match loop.step[-1]:
        case s.Call(_, s.LibraryCallee(name), (s.CallArgument(value),)):
            return name.endswith("operator++") and value in uses
        case _:
            return False


def _stores_in(node: Node, target: Node) -> bool:
    stored: Node | None = getattr(node, "target", None)
    if isinstance(node, s.Unpack):
        return target in node.targets
    if isinstance(node, e.AddressOf) or stored is None:
        return False
    if isinstance(stored, e.Attribute) and isinstance(target, e.Attribute):
        return stored.name == target.name
    if isinstance(stored, e.Dereference):
        return not isinstance(target, e.Local)
    return stored == target


def _bare(value: e.Expression) -> e.Expression:
    """A value without the conversions around it that leave numbers of 32 bits as they are."""
    while isinstance(value, e.Convert) and not _is_narrow(value.type):
        value = value.operand
    return value


def _is_narrow(type_: t.Type) -> bool:
    return isinstance(type_, t.Integer) and type_.bits is not None and type_.bits < 32
