"""Which loops end: those that count with a constant step to a bound that they do not write.

Everything else may not end.
"""

from __future__ import annotations

from collections.abc import Callable

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.walk import Node, walk

_UP = (Operator.LESS, Operator.LESS_EQUAL)
_DOWN = (Operator.GREATER, Operator.GREATER_EQUAL)
_MIRRORED = {
    Operator.LESS: Operator.GREATER,
    Operator.GREATER: Operator.LESS,
    Operator.LESS_EQUAL: Operator.GREATER_EQUAL,
    Operator.GREATER_EQUAL: Operator.LESS_EQUAL,
}


def ends(loop: s.Loop, is_size: Callable[[s.Call], bool]) -> bool:
    """Whether a loop ends, if its body does and puts nothing into its bound.

    `is_size` says of a call whether it gives the size, or the end, of a container.
    """
    for node in walk(loop):
        target = getattr(node, "target", None)
        if not isinstance(target, e.Temporary) or target not in walk(loop.test):
            continue
        if not isinstance(node, s.Call) or not is_size(node):
            return False
    tests = [loop.test]
    while tests:
        test = tests.pop()
        test = _bare(test)
        if isinstance(test, e.And):
            tests += [test.left, test.right]
        elif isinstance(test, e.Binary) and _counts(loop, test):
            return True
    return False


def _counts(loop: s.Loop, test: e.Binary) -> bool:
    left, right = _bare(test.left), _bare(test.right)
    match left:
        case e.Binary(Operator.ADD, inner, e.Literal()):  # i + 1 < n
            left = _bare(inner)
        case _:
            pass
    if _is_counter(loop, left, test.operator, test.right):
        return True
    mirrored = _MIRRORED.get(test.operator)
    return mirrored is not None and _is_counter(loop, right, mirrored, test.left)


def _is_counter(
    loop: s.Loop, counter: e.Expression, operator: Operator, bound: e.Expression
) -> bool:
    """Whether a variable gets nearer to a bound in each round."""
    if not isinstance(counter, e.Local) or _is_written(loop, bound, counter):
        return False
    if operator is Operator.UNEQUAL:
        return isinstance(_bare(bound), e.Temporary) and _is_iterator(loop, counter)
    step = _step(loop, counter)
    if step is None:
        return False
    width = counter.type if isinstance(counter.type, t.Integer) else t.UNBOUNDED
    limit = _bare(bound)
    if operator in _UP and step > 0:
        return _is_reached(width, operator, limit, step)
    if operator in _DOWN and step < 0:
        return width.signed or (operator is Operator.GREATER and step == -1)
    return False


def _is_reached(width: t.Integer, operator: Operator, bound: e.Expression, step: int) -> bool:
    """Whether a counter of a width gets to a bound before it wraps."""
    if width.bits is None:
        return True
    highest = (1 << (width.bits - width.signed)) - 1
    if isinstance(bound, e.Literal) and isinstance(bound.value, int):
        return bound.value + step <= highest
    narrow = getattr(bound, "type", None)
    is_narrow = isinstance(narrow, t.Integer) and narrow.bits is not None
    if not is_narrow or operator is Operator.LESS_EQUAL or step != 1:
        return width.bits >= 32 and operator is Operator.LESS
    assert isinstance(narrow, t.Integer) and narrow.bits is not None
    # A size is no greater than the memory; a counter of 32 bits gets there.
    return width.bits >= min(narrow.bits, 32)


def _step(loop: s.Loop, counter: e.Local) -> int | None:
    """What is added to a counter in each round, where nothing else is stored in it."""
    stores = [n for n in walk(loop) if _stores_in(n, counter)]
    if len(stores) != 1 or any(
        isinstance(n, e.AddressOf) and n.target == counter for n in walk(loop)
    ):
        return None
    store = stores[0]
    skips = any(isinstance(n, s.Continue) for n in walk(loop.body))
    if store not in loop.step and (store not in loop.body or skips):
        return None
    match store:
        case s.CompoundAssign(_, Operator.ADD, e.Literal(int() as step)):
            return step
        case s.CompoundAssign(_, Operator.SUBTRACT, e.Literal(int() as step)):
            return -step
        case s.Assign(_, e.Binary(Operator.ADD, left, e.Literal(int() as step))) if left == counter:
            return step
        case _:
            return None


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


def _is_written(loop: s.Loop, bound: e.Expression, counter: e.Local) -> bool:
    """Whether the body may store in what a bound is made of; what is shared, if it calls."""
    shared = (e.Global, e.Captured, e.Attribute, e.Index, e.Dereference)
    for node in walk(bound):
        if node == counter:
            return True
        if isinstance(node, e.Temporary):
            continue  # the size of a container, or set before the loop
        if any(_stores_in(n, node) for n in walk(loop)):
            return True
        if isinstance(node, shared) and any(map(_runs_others, walk(loop))):
            return True
    return False


def _runs_others(node: Node) -> bool:
    match node:
        case s.Call(_, s.LibraryCallee()) | s.Call(_, s.MethodCallee(_, _, None)):
            return False
        case s.Call() | s.Construct() | s.Destroy() | s.Unsupported():
            return True
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
