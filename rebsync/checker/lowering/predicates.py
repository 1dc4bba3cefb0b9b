"""The state formulas of a property file as bodies that compute one boolean."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync import properties as p
from rebsync.checker.lowering.conversions import constant, convert, met, promoted
from rebsync.checker.lowering.defines import Defines
from rebsync.checker.lowering.emitter import Emitter, kind_of
from rebsync.checker.lowering.expressions import decide, operate
from rebsync.checker.lowering.places import Place, index_by, index_pushed, push
from rebsync.checker.lowering.tables import env_table
from rebsync.checker.program import NULL, Kind, RebecInfo
from rebsync.checker.values import stored
from rebsync.model import (
    Binary,
    BoolLiteral,
    Cast,
    Conditional,
    FloatLiteral,
    Index,
    IntLiteral,
    Member,
    Name,
    NullLiteral,
    Paren,
    Type,
    Unary,
)
from rebsync.static.constants import float_value
from rebsync.static.operators import binary_type
from rebsync.static.types import BOOLEAN, DOUBLE, FLOAT, INT, common, element
from rebsync.static.types import NULL as NULL_TYPE


class Predicates:
    """One formula of a file; `rebecs` by their names with their numbers."""

    def __init__(
        self, emitter: Emitter, rebecs: Mapping[str, tuple[int, RebecInfo]], known: Defines
    ) -> None:
        self.e = emitter
        self.rebecs = rebecs
        self.known = known
        self.defines = known.values
        self._cells: dict[str, tuple[int, Kind]] = {}

    def whole(self, formula: p.Formula) -> None:
        """Pushes the value of a formula; what is used more than once is computed first."""
        for name in self.known.shared(formula):
            kind = self.value(self.defines[name])
            self._cells[name] = self.e.allocate(1), kind
            self.e.emit("SETLOCAL", self._cells[name][0])
        self.value(formula)

    def value(self, node: p.Formula) -> Kind:
        """Pushes the value of a formula without temporal operators; gives its kind."""
        e = self.e
        match node:
            case p.Not(operand):
                self.value(operand)
                e.emit("NOT")
            case p.And(left, right):
                self._both("&&", left, right)
            case p.Or(left, right):
                self._both("||", left, right)
            case p.Implies(left, right):
                self.value(left)
                e.emit("NOT")
                decide("||", lambda: self.value(right), e)
            case p.Ltl() | p.Tctl():
                raise AssertionError("a temporal operator in a state formula")
            case _:
                with e.at(node.span):
                    return self._expression(node)
        return "boolean"

    def _both(self, operator: str, left: p.Formula, right: p.Formula) -> None:
        self.value(left)
        decide(operator, lambda: self.value(right), self.e)

    def _expression(self, node: p.Formula) -> Kind:
        e = self.e
        match node:
            case IntLiteral(number):
                e.emit("CONST", number)
                return "int"
            case FloatLiteral(text):
                real: Kind = "double" if node.is_double else "float"
                constant(float_value(text), real, e)
                return real
            case BoolLiteral(truth):
                e.emit("CONST", int(truth))
                return "boolean"
            case NullLiteral():
                e.emit("CONST", NULL)
                return "rebec"
            case Paren(inner):
                return self.value(inner)
            case Name(name) if name in self._cells:
                cell, kind = self._cells[name]
                e.emit("LOCAL", cell)
                return kind
            case Name(name) if name in self.defines:
                return self.value(self.defines[name])
            case Name(name) if name in self.rebecs:
                e.emit("CONST", self.rebecs[name][0])
                return "rebec"
            case Name() | Member() | Index():
                return self._variable(node)
            case Binary("&&" | "||" as operator, left, right):
                self._both(operator, left, right)
                return "boolean"
            case Binary(operator, left, right):
                return self._binary(operator, left, right)
            case _:
                return self._rest(node)

    def _rest(self, node: p.Formula) -> Kind:
        e = self.e
        match node:
            case Unary("-", IntLiteral(number)):
                e.emit("CONST", -number)
                return "int"
            case Unary(operator, operand):
                kind = promoted(self.value(operand))
                names = {"!": "NOT", "~": "INV", "-": "NEG" if kind == "int" else "FNEG"}
                if operator in names:
                    e.emit(names[operator])
                return kind
            case Cast(type_, operand):
                convert(self.value(operand), kind_of(type_), e)
                return kind_of(type_)
            case Conditional(condition, then, otherwise):
                kind = promoted(kind_of(self.type_of(node)))
                self.value(condition)
                other = e.emit("JUMPF", 0, 1)
                convert(self.value(then), kind, e)
                end = e.emit("JUMP")
                e.patch(other)
                convert(self.value(otherwise), kind, e)
                e.patch(end)
                return kind
            case _:
                raise AssertionError(f"not part of a property: {node}")

    def _binary(self, operator: str, left: p.Formula, right: p.Formula) -> Kind:
        kind = met(kind_of(self.type_of(left)), kind_of(self.type_of(right)))
        convert(self.value(left), kind, self.e)
        convert(self.value(right), kind, self.e)
        return operate(operator, kind, self.e)

    def _variable(self, node: Name | Member | Index) -> Kind:
        with self.e.scope():
            place = self._place(node)
            push(place, self.e)
        return place.kind

    def _place(self, node: p.Formula) -> Place:
        match node:
            case Paren(inner):
                return self._place(inner)
            case Index(target, index):
                array = self._place(target)
                if isinstance(index, IntLiteral) and 0 <= index.value < array.type.dimensions[0]:
                    return index_by(array, index.value, self.e)
                self.value(index)
                return index_pushed(array, self.e)
            case Member(Name(rebec), name):
                number, info = self.rebecs[rebec]
                slot = next(s for s in reversed(info.state) if s.name == name)
                return Place("STATE", slot.offset, slot.type, rebec=number)
            case Name(name):
                symbol = self.e.world.analysis.env[name]
                assert symbol.type is not None
                table: tuple[int, ...]
                if symbol.value is not None:
                    table = (stored(symbol.value, kind_of(symbol.type)),)
                else:
                    table = env_table(symbol.declaration, symbol.type, self.e.world.analysis)
                return Place("TABLE", 0, symbol.type, table=table)
            case _:
                raise AssertionError(f"not a variable: {node}")

    def type_of(self, node: p.Formula) -> Type:
        """The static type of a state formula that has passed the check of properties."""
        classes = self.e.world.analysis.classes
        match node:
            case IntLiteral():
                return INT
            case FloatLiteral():
                return DOUBLE if node.is_double else FLOAT
            case NullLiteral():
                return NULL_TYPE
            case Paren(inner):
                return self.type_of(inner)
            case Name(name) if name in self.defines:
                if name not in self.known.types:
                    self.known.types[name] = self.type_of(self.defines[name])
                return self.known.types[name]
            case Name(name) if name in self.rebecs:
                return Type(self.rebecs[name][1].class_name)
            case Name(name):
                return self.e.world.analysis.env[name].type or INT
            case Member(Name(rebec), name):
                info = self.rebecs[rebec][1]
                return next(s.type for s in reversed(info.state) if s.name == name)
            case Index(target, _):
                return element(self.type_of(target))
            case Unary("!", _):
                return BOOLEAN
            case Unary(_, operand):
                return self.type_of(operand)
            case Cast(type_, _):
                return type_
            case Binary(operator, left, right):
                sides = self.type_of(left), self.type_of(right)
                return binary_type(operator, *sides, classes) or BOOLEAN
            case Conditional(_, then, otherwise):
                return common(self.type_of(then), self.type_of(otherwise), classes) or INT
            case _:
                return BOOLEAN
