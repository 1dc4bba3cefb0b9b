"""Which permutations of the rebecs leave what is asked of a model as it is.

A predicate is invariant when renaming its rebecs gives the same predicate up to the order of
operands: formulas are compared by normal forms, in which associative and commutative operators
have their operands sorted. Equal normal forms have equal values; the converse need not be.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

from rebsync import properties as p
from rebsync.checker.invariants import MAY_FAIL
from rebsync.checker.lowering.temporal import temporal
from rebsync.checker.problem import Problem
from rebsync.checker.program import Program
from rebsync.model import Binary, Conditional, Index, IntLiteral, Member, Name, Paren

_ANY_ORDER = ("&&", "||", "&", "|", "^")
_OF_WHOLE_NUMBERS = ("+", "*")  # in any order of these, but not of real numbers
_EITHER_SIDE = ("==", "!=", "+", "*")


class Invariance:
    """The predicates and measures of a program, as they stand in its properties."""

    def __init__(self, problem: Problem, program: Program) -> None:
        self._names = [rebec.name for rebec in program.rebecs]
        self._formulas = tuple(_state_formulas(problem))
        self._normal = _NormalForms(problem, program)
        self._forms = self._renamed(range(len(self._names)))

    def holds(self, permutation: Sequence[int]) -> bool:
        """Whether all are as they were when rebecs are renamed along a permutation."""
        return self._renamed(permutation) == self._forms

    def broken(self, permutations: Sequence[Sequence[int]]) -> tuple[str, ...]:
        """The names of what is not as it was under some of the permutations."""
        changed = {
            name: None
            for permutation in permutations
            for (name, _), old, new in zip(
                self._formulas, self._forms, self._renamed(permutation), strict=True
            )
            if old != new
        }
        return tuple(changed)

    def _renamed(self, permutation: Sequence[int]) -> list[object]:
        names = {self._names[i]: self._names[image] for i, image in enumerate(permutation)}
        return [self._normal.of(formula, names) for _, formula in self._formulas]


def _state_formulas(problem: Problem) -> Iterator[tuple[str, p.Formula]]:
    """The largest parts without temporal operators, with the name of the whole."""
    for each in problem.properties.all:
        parts: list[p.Formula] = []

        def predicate(part: p.Formula, parts: list[p.Formula] = parts) -> int:
            parts.append(part)
            return len(parts) - 1

        temporal(each.formula, predicate, problem.analysis)
        yield from ((each.name, part) for part in parts)
    for measure in problem.measures:
        yield measure.text, measure.value


class _NormalForms:
    """Normal forms of formulas; where one may have no value, the order of all operands counts."""

    def __init__(self, problem: Problem, program: Program) -> None:
        self._defines = {d.name: d.value for d in problem.properties.defines}
        self._whole = {
            (rebec.name, slot.name): slot.kind not in ("float", "double")
            for rebec in program.rebecs
            for slot in rebec.state
        }
        observers = (program.bodies[number] for number in program.observers)
        self._ordered = any(
            i.op in MAY_FAIL for body in observers for i in program.code[body.entry : body.end]
        )

    def of(self, node: p.Formula, names: dict[str, str]) -> tuple[Any, ...]:
        """The normal form of a formula whose rebecs have got other names."""
        match node:
            case Paren(inner):
                return self.of(inner, names)
            case Name(name) if name in self._defines:
                return self.of(self._defines[name], names)
            case Name(name):
                return "name", names.get(name, name)
            case Member(Name(rebec), name):
                return "variable", names[rebec], name
            case p.And(left, right):
                return self._operation("&&", left, right, names)
            case p.Or(left, right):
                return self._operation("||", left, right, names)
            case Binary(operator, left, right):
                return self._operation(operator, left, right, names)
            case _:
                parts = (getattr(node, f.name) for f in fields(node) if f.compare)
                forms = (self.of(x, names) if is_dataclass(x) else x for x in parts)  # type: ignore[arg-type]
                return type(node).__name__, *forms

    def _operation(
        self, operator: str, left: p.Formula, right: p.Formula, names: dict[str, str]
    ) -> tuple[Any, ...]:
        sides = self.of(left, names), self.of(right, names)
        if self._ordered:
            return operator, *sides
        if self._is_in_any_order(operator, left, right):
            return operator, *sorted(_flat(operator, sides), key=repr)
        return operator, *(sorted(sides, key=repr) if operator in _EITHER_SIDE else sides)

    def _is_in_any_order(self, operator: str, left: p.Formula, right: p.Formula) -> bool:
        if operator in _OF_WHOLE_NUMBERS:
            return self._is_whole(left) and self._is_whole(right)
        return operator in _ANY_ORDER

    def _is_whole(self, node: p.Formula) -> bool:
        """Whether the value is certainly a whole number, which wraps at 32 bits."""
        match node:
            case IntLiteral():
                return True
            case Paren(inner) | Index(inner, _):
                return self._is_whole(inner)
            case Name(name) if name in self._defines:
                return self._is_whole(self._defines[name])
            case Member(Name(rebec), name):
                return self._whole[rebec, name]
            case Binary("+" | "-" | "*", left, right) | Conditional(_, left, right):
                return self._is_whole(left) and self._is_whole(right)
            case _:
                return False


def _flat(operator: str, sides: tuple[tuple[Any, ...], ...]) -> Iterator[object]:
    """The operands of an operator that is nested in itself."""
    for side in sides:
        if side[0] == operator:
            yield from side[1:]
        else:
            yield side
