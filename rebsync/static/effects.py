"""What expressions read and write: whether it matters which of several is evaluated first.

The model evaluates operands and arguments from left to right, and what an assignment stores into
before the value (semantics, "Expressions"). C++ leaves most of that open ([intro.execution]), and
Python finds the target of an assignment after its value.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence, Set
from typing import TypeAlias

from rebsync.model import (
    Assign,
    Binary,
    Call,
    Expression,
    Index,
    Member,
    Method,
    Name,
    Node,
    Paren,
    Postfix,
    Unary,
    walk,
)
from rebsync.records import dataclass
from rebsync.static.analysis import Analysis
from rebsync.static.constants import constant
from rebsync.static.symbols import BuiltinFunctionSymbol, MethodSymbol, StateSymbol

# A variable, by the id of its symbol, and whether it belongs to the state of the rebec.
_Place: TypeAlias = tuple[int, bool]

# Stands for all of the state: what a method may read or write.
_STATE: _Place = (0, True)
# Stands for the messages that are sent and the time that passes, which are in an order as well.
_OUTSIDE: _Place = (1, True)


@dataclass(frozen=True, slots=True)
class _Effects:
    reads: frozenset[_Place]
    writes: frozenset[_Place]
    fails: bool

    @property
    def lasts(self) -> bool:
        """Whether what it does is still there when the body is abandoned."""
        return any(state for _, state in self.writes)


def _overlap(one: Set[_Place], other: Set[_Place]) -> bool:
    if one & other:
        return True
    return (_STATE in one and any(state for _, state in other)) or (
        _STATE in other and any(state for _, state in one)
    )


def conflicting(operands: Sequence[Expression], analysis: Analysis) -> bool:
    """Whether the value of one operand depends on whether another is evaluated before it."""
    found = [_effects(o, analysis) for o in operands]
    for i, one in enumerate(found):
        for other in found[i + 1 :]:
            if _overlap(one.writes, other.reads | other.writes) or _overlap(
                other.writes, one.reads
            ):
                return True
            if (one.fails and other.lasts) or (other.fails and one.lasts):
                return True
    return False


def indices_of(element: Expression) -> list[Expression]:
    """The indices of an element of an array, or of an array in one: of `a[i][j]` both."""
    if not isinstance(element, Index):
        return []
    return [*indices_of(element.target), element.index]


def assigns_apart(assign: Assign, analysis: Analysis) -> bool:
    """Whether it matters that an assignment's target is found, and read, before its value."""
    target, value = assign.target, assign.value
    if assign.operator == "=" and not any(isinstance(n, Index) for n in walk(target)):
        return _overlap(_stored(value, analysis), _written(target, analysis))
    found = _effects(value, analysis)
    if _overlap(found.writes, _written(target, analysis)):
        return True
    if found.lasts and _fails([target], analysis, set()):
        return True
    indexes = [n.index for n in walk(target) if isinstance(n, Index)]
    return conflicting([*indexes, value], analysis)


def _effects(expression: Expression, analysis: Analysis) -> _Effects:
    reads, writes = _touched(expression, analysis, set())
    fails = _fails([expression], analysis, set())
    return _Effects(frozenset(reads), frozenset(writes), fails)


def _touched(root: Node, analysis: Analysis, seen: set[int]) -> tuple[set[_Place], set[_Place]]:
    """What is read and what is written, by the methods that are called as well."""
    reads, writes = set[_Place](), _stored(root, analysis)
    for node in walk(root):
        match node:
            case Name() | Member():
                reads |= _places(node, analysis)
            case Call():
                called = _called(node, analysis, seen)
                reads |= called[0]
                writes |= called[1]
            case _:
                pass
    return reads, writes


def _called(call: Call, analysis: Analysis, seen: set[int]) -> tuple[Set[_Place], Set[_Place]]:
    match analysis.symbols.get(id(call)):
        case None:
            return {_STATE}, {_STATE}
        case BuiltinFunctionSymbol("pow" | "sqrt" | "assertion"):
            return set(), set()
        case MethodSymbol() as method if id(method) in seen:
            return set(), set()
        case MethodSymbol() as method:
            seen.add(id(method))
            bodies = [version.body for version in _versions(method, analysis)]
            each = [_touched(b, analysis, seen) for b in bodies if b is not None]
            each += [({_STATE}, {_STATE})] if None in bodies else []
            reads, writes = ({p for e in each for p in e[i] if p[1]} for i in (0, 1))
            return reads, writes
        case _:
            return {_OUTSIDE}, {_OUTSIDE}


def _stored(root: Node, analysis: Analysis) -> set[_Place]:
    """The variables that something stores into, those of the methods that it calls left out."""
    found: set[_Place] = set()
    for node in walk(root):
        match node:
            case Assign(target=target):
                found |= _written(target, analysis)
            case Unary(operator="++" | "--", operand=operand) | Postfix(operand=operand):
                found |= _written(operand, analysis)
            case _:
                pass
    return found


def _fails(nodes: Iterable[Node], analysis: Analysis, seen: set[int]) -> bool:
    """Whether an index or a division below the nodes may abandon the body."""
    return any(_may_fail(inner, analysis, seen) for node in nodes for inner in walk(node))


def _may_fail(node: Node, analysis: Analysis, seen: set[int]) -> bool:
    match node:
        case Index(index=index):
            return constant(index) is None
        case Binary("/" | "%", right=divisor) | Assign("/=" | "%=", value=divisor):
            return not constant(divisor)
        case Call():
            method = analysis.symbols.get(id(node))
            if not isinstance(method, MethodSymbol) or id(method) in seen:
                return False
            seen.add(id(method))
            bodies = [version.body for version in _versions(method, analysis)]
            return None in bodies or _fails((b for b in bodies if b is not None), analysis, seen)
        case _:
            return False


def _places(node: Node, analysis: Analysis) -> set[_Place]:
    symbol = analysis.symbols.get(id(node))
    return set() if symbol is None else {(id(symbol), isinstance(symbol, StateSymbol))}


def _written(target: Expression, analysis: Analysis) -> set[_Place]:
    root = _root(target)
    return _places(root, analysis) if root is not None else set()


def _root(target: Expression) -> Expression | None:
    """The variable that is stored into: `a` of `a[i]`."""
    match target:
        case Name() | Member():
            return target
        case Index(target=inner) | Paren(inner):
            return _root(inner)
        case _:
            return None


def _versions(method: MethodSymbol, analysis: Analysis) -> Iterator[Method]:
    """The methods that a call may run: the one that it names, and those that override it."""
    yield method.declaration
    for info in analysis.classes.values():
        if method.owner in info.ancestors:
            for each in info.methods:
                if (each.name, each.signature) == (method.name, method.signature):
                    yield each.declaration
