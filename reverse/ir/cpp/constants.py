"""Constant expressions ([expr.const]) as numbers: bounds of arrays, enumerators, bit-fields."""

from __future__ import annotations

import weakref

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.context import Context, Unlowered, World, lower_value
from rebsync.reverse.ir.cpp.conversions import wrapped
from rebsync.reverse.ir.operators import Conversion, Operator
from rebsync.reverse.syntax.cpp_numbers import whole_result
from rebsync.reverse.syntax.cpp_tree import Cpp

_MOST = 40  # names that one constant may stand on
_SIGNS = {
    **{Operator.ADD: "+", Operator.SUBTRACT: "-", Operator.MULTIPLY: "*"},
    **{Operator.TRUNCATING_DIVIDE: "/", Operator.TRUNCATING_REMAINDER: "%"},
    **{Operator.SHIFT_LEFT: "<<", Operator.SHIFT_RIGHT: ">>"},
    **{Operator.BIT_AND: "&", Operator.BIT_OR: "|", Operator.BIT_XOR: "^"},
}


class Constants:
    """The numbers of constant expressions of a program; of names by their initialisers."""

    def __init__(self) -> None:
        self._world: weakref.ref[World] | None = None
        self._depth = 0

    @property
    def world(self) -> World | None:
        """What names are looked up in, while it is there: it has this object in itself."""
        return self._world() if self._world is not None else None

    @world.setter
    def world(self, world: World) -> None:
        self._world = weakref.ref(world)

    def number(self, node: Node, scope: str, cpp: Cpp) -> int | None:
        """The number that an expression is, where it is constant."""
        world = self.world
        if world is None or self._depth > _MOST:
            return None
        context = Context(world, cpp, "a constant", scope)
        context.owner = world.symbols.classes.get(scope)
        self._depth += 1
        try:
            value = lower_value(context, node)
            return None if context.out else self._folded(value.expression)
        except Unlowered:
            return None
        finally:
            self._depth -= 1

    def _folded(self, expression: e.Expression) -> int | None:
        match expression:
            case e.Literal(int(value)):
                return int(value)
            case e.Global(path, name):
                return self._variable(path, name)
            case e.Attribute(e.ClassReference(class_), name):
                return self._static(class_, name)
            case e.Convert(conversion, operand, t.Integer() as type_):
                inner = self._folded(operand)
                whole = conversion in (Conversion.WRAP, Conversion.WIDEN, Conversion.CAST)
                return wrapped(type_, inner) if inner is not None and whole else None
            case e.Unary(Operator.NEGATE, operand, t.Integer() as type_):
                inner = self._folded(operand)
                return None if inner is None else wrapped(type_, -inner)
            case e.Binary(operator, left, right, t.Integer() as type_):
                return self._binary(operator, self._folded(left), self._folded(right), type_)
            case _:
                return None

    def _binary(
        self, operator: Operator, left: int | None, right: int | None, type_: t.Integer
    ) -> int | None:
        if left is None or right is None:
            return None
        value = whole_result(_SIGNS.get(operator, ""), left, right)
        return None if value is None else wrapped(type_, value)

    def _variable(self, path: str, name: str) -> int | None:
        if self.world is None:
            return None
        for variable in self.world.symbols.variables.get(name, ()):
            is_it = variable.cpp.source.path == path and _is_constant(variable.type)
            if variable.value is not None and is_it:
                return self.number(variable.value, variable.scope, variable.cpp)
        return None

    def _static(self, class_: str, name: str) -> int | None:
        owner = self.world.symbols.classes.get(class_) if self.world is not None else None
        for symbol in owner.fields if owner is not None else ():
            if symbol.name == name and symbol.value is not None and _is_constant(symbol.type):
                return self.number(symbol.value, class_, symbol.cpp)
        return self._variable_of_class(class_, name)

    def _variable_of_class(self, class_: str, name: str) -> int | None:
        full = f"{class_}::{name}"
        found = self.world.symbols.variables.get(full, []) if self.world is not None else []
        if len(found) == 1 and found[0].value is not None and _is_constant(found[0].type):
            return self.number(found[0].value, class_, found[0].cpp)
        return None


def _is_constant(type_: Node) -> bool:
    parent = type_.parent
    words = {(c.text or b"").decode() for c in parent.children} if parent is not None else set()
    return bool(words & {"const", "constexpr"})
