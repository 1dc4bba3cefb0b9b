"""What expressions read and write: decides where C++ must be told the order of evaluation."""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Set
from typing import TypeAlias

from rebsync.model import (
    Assign,
    Binary,
    Call,
    Declaration,
    Declarator,
    Expression,
    Index,
    Local,
    Member,
    Name,
    Node,
    Paren,
    Postfix,
    Switch,
    Unary,
    walk,
)
from rebsync.records import dataclass
from rebsync.static import Analysis
from rebsync.static.constants import constant
from rebsync.static.symbols import MethodSymbol, StateSymbol

# A variable, by the id of its symbol, and whether it belongs to the state of the rebec.
_Place: TypeAlias = tuple[int, bool]

# Stands for all of the state: what a method may read or write.
_STATE: _Place = (0, True)


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


def writes_to(target: Expression, value: Expression, analysis: Analysis) -> bool:
    """Whether a value, or the index of a target, has effects on the other or on the target."""
    found = _effects(value, analysis)
    if _overlap(found.writes, _written(target, analysis)):
        return True
    if found.lasts and _fails([target], analysis, set()):
        return True
    indexes = [n.index for n in walk(target) if isinstance(n, Index)]
    return conflicting([*indexes, value], analysis)


def _effects(expression: Expression, analysis: Analysis) -> _Effects:
    reads: set[_Place] = set()
    writes: set[_Place] = set()
    for node in walk(expression):
        match node:
            case Name() | Member():
                reads |= _places(node, analysis)
            case Assign(target=target):
                writes |= _written(target, analysis)
            case Unary(operator="++" | "--", operand=operand) | Postfix(operand=operand):
                writes |= _written(operand, analysis)
            case Call() if isinstance(method := analysis.symbols.get(id(node)), MethodSymbol):
                reads.add(_STATE)
                if changes_state(method, analysis, set()):
                    writes.add(_STATE)
            case _:
                pass
    fails = _fails([expression], analysis, set())
    return _Effects(frozenset(reads), frozenset(writes), fails)


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
            body = method.declaration.body
            return body is None or _fails([body], analysis, seen)
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


def changes_state(method: MethodSymbol, analysis: Analysis, seen: set[int]) -> bool:
    """Whether a local method writes a state variable, sends, delays or calls one that does."""
    body = method.declaration.body
    if body is None:
        return True
    if id(method) in seen:
        return False
    seen.add(id(method))
    return any(_changes(node, analysis, seen) for node in walk(body))


def _changes(node: Node, analysis: Analysis, seen: set[int]) -> bool:
    match node:
        case Assign(target=target):
            return any(state for _, state in _written(target, analysis))
        case Unary(operator="++" | "--", operand=operand) | Postfix(operand=operand):
            return any(state for _, state in _written(operand, analysis))
        case Call(name=name):
            symbol = analysis.symbols.get(id(node))
            if isinstance(symbol, MethodSymbol):
                return changes_state(symbol, analysis, seen)
            return name not in ("pow", "sqrt", "assertion")
        case _:
            return False


def read_declarations(nodes: Iterable[Node], analysis: Analysis) -> set[int]:
    """The ids of the declarations whose values are used, not only written, below the nodes."""
    read: set[int] = set()
    for node in nodes:
        only_written: set[int] = set()
        for inner in walk(node):
            match inner:
                case Assign(operator="=", target=Name() as target):
                    only_written.add(id(target))
                case Name() if id(inner) not in only_written:
                    symbol = analysis.symbols.get(id(inner))
                    read.add(id(getattr(symbol, "declaration", None)))
                case _:
                    pass
    return read


def crossing_locals(switch: Switch, analysis: Analysis) -> list[tuple[Declaration, Declarator]]:
    """The locals of a case that later cases use: C++ needs their declaration before the cases."""
    found: dict[int, tuple[Declaration, Declarator]] = {}
    declared: dict[int, tuple[Declaration, Declarator]] = {}
    for case in switch.cases:
        for node in (n for s in case.statements for n in walk(s) if isinstance(n, Name)):
            key = id(getattr(analysis.symbols.get(id(node)), "declaration", None))
            if key in declared:
                found[key] = declared[key]
        own = [s.declaration for s in case.statements if isinstance(s, Local)]
        declared |= {
            id(d): (declaration, d) for declaration in own for d in declaration.declarators
        }
    return list(found.values())


def hoisted(nodes: Iterable[Node], analysis: Analysis) -> set[int]:
    """The ids of all declarators that stand before the `switch` in C++."""
    switches = (n for node in nodes for n in walk(node) if isinstance(n, Switch))
    return {id(d) for s in switches for _, d in crossing_locals(s, analysis)}
