"""The assertions of a property file, judged by the reference in every state."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rebsync import model as m
from rebsync import properties as p
from rebsync.static import Analysis
from rebsync.static.constants import float_value
from tests.checker.reference_steps import Actor, State
from tests.checker.reference_values import Tagged, Value, convert, negative, operate, tag


def false_assertions(
    analysis: Analysis, properties: p.Properties, states: Iterable[State]
) -> Iterator[str]:
    """The names of assertions that do not hold in all states."""
    reached = list(states)
    for each in properties.assertions:
        if not all(holds(analysis, properties, each.formula, s.actors) for s in reached):
            yield each.name


def holds(
    analysis: Analysis, properties: p.Properties, formula: p.Formula, actors: tuple[Actor, ...]
) -> bool:
    """Whether a formula without temporal operators is true in a state."""
    return bool(_Judge(analysis, properties, actors).value(formula)[1])


class _Judge:
    def __init__(
        self, analysis: Analysis, properties: p.Properties, actors: tuple[Actor, ...]
    ) -> None:
        self.analysis, self.actors = analysis, actors
        self.defines = {d.name: d.value for d in properties.defines}
        main = analysis.model.main
        assert main is not None
        self.rebecs = {r.name: i for i, r in enumerate(main.rebecs)}
        self.classes = [analysis.classes[r.type.name] for r in main.rebecs]

    def truth(self, formula: p.Formula) -> bool:
        return bool(self.value(formula)[1])

    def value(self, node: p.Formula) -> Tagged:
        match node:
            case p.Not(operand):
                return "boolean", not self.truth(operand)
            case p.And(left, right) | m.Binary("&&", left, right):
                return "boolean", self.truth(left) and self.truth(right)
            case p.Or(left, right) | m.Binary("||", left, right):
                return "boolean", self.truth(left) or self.truth(right)
            case p.Implies(left, right):
                return "boolean", not self.truth(left) or self.truth(right)
            case m.Paren(inner):
                return self.value(inner)
            case m.Binary(operator, left, right):
                return operate(operator, self.value(left), self.value(right))
            case m.Unary(operator, operand):
                return negative(operator, self.value(operand))
            case m.Conditional(condition, then, otherwise):
                return self.value(then if self.truth(condition) else otherwise)
            case m.Cast(type_, operand):
                return tag(type_), convert(self.value(operand)[1], tag(type_))
            case _:
                return self._leaf(node)

    def _leaf(self, node: p.Formula) -> Tagged:
        match node:
            case m.IntLiteral(number):
                return "int", number
            case m.BoolLiteral(truth):
                return "boolean", truth
            case m.FloatLiteral(text):
                kind = "double" if node.is_double else "float"
                return kind, convert(float_value(text), kind)
            case m.NullLiteral():
                return "rebec", None
            case m.Name(name) if name in self.defines:
                return self.value(self.defines[name])
            case m.Name(name) if name in self.rebecs:
                return "rebec", self.rebecs[name]
            case m.Name(name):
                symbol = self.analysis.env[name]
                assert symbol.type is not None
                return tag(symbol.type), convert(symbol.value, tag(symbol.type))
            case m.Member(m.Name(rebec), name):
                return self._variable(self.rebecs[rebec], name)
            case m.Index(target, index):
                kind, values = self.value(target)
                position: Value = self.value(index)[1]
                assert isinstance(values, tuple) and isinstance(position, int)
                return kind, values[position]
            case _:
                raise NotImplementedError(node)

    def _variable(self, rebec: int, name: str) -> Tagged:
        symbol = next(s for s in reversed(self.classes[rebec].state) if s.name == name)
        assert symbol.type is not None
        return tag(symbol.type), self.actors[rebec].variables[symbol]
