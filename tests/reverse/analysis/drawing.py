"""Draws bodies over integers of several widths.

Names say what they are: `w` a number of 64 bits with a sign, `v` one without, `u` one of 32 bits
without; `i`, `s`, `b` an int, a short and a byte; `a` an array of three ints, `z` one of 64 bits
with signs. Each may have a number behind it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rebsync import model as m

_T = TypeVar("_T")
BITS = {"w": 63, "v": 64, "u": 32, "z": 63}  # without the sign
_MODEL = {"s": "short", "b": "byte"}
LENGTH = 3
STATE = ("w0", "v0", "u0", "i0", "s0", "b0", "a0", "z0")
_NUMBERS = (0, 1, 2, 3, 5, 7, 31, 100, 127, 128, 255, 40_000, 65_536, 2**30, 2**31 - 1)
_STEPS = ("++", "--")
_COMPARES = ("<", "<=", ">", ">=", "==", "!=")
_CHANGES = ("+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=")
_ARITHMETIC = ("+", "+", "-", "-", "*", "/", "%", "&", "|", "^", "<<", ">>")


def type_of(name: str) -> m.Type:
    """The type that the model gives a variable."""
    return m.Type(_MODEL.get(name[0], "int"), (LENGTH,) if name[0] in "az" else ())


def widths(names: Sequence[str]) -> dict[str, int]:
    """The bits of those variables that hold more than an `int`."""
    return {n: BITS[n[0]] for n in names if n[0] in BITS}


class _Body:
    """A body that is being drawn: `names` are the variables in scope, `here` those of
    the innermost block, `loops` and
    `repeats` count what a `break` and a `continue` may be in."""

    def __init__(self, draw: DrawFn, names: Sequence[str], wide: bool, calls: bool) -> None:
        self.draw = draw
        self.names = list(names)
        self.here: set[str] = set()
        self.fixed: set[str] = set()
        self.wide, self.calls = wide, calls
        self.loops = self.repeats = 0

    def one(self, options: Sequence[_T]) -> _T:
        return self.draw(st.sampled_from(options))

    # --- expressions ----------------------------------------------------------------------------

    def place(self, written: bool = False) -> m.Expression:
        names = [n for n in self.names if not (written and n in self.fixed)]
        name = self.one(names)
        if name[0] in "az":
            return m.Index(m.Name(name), m.IntLiteral(self.draw(st.integers(0, LENGTH - 1))))
        return m.Name(name)

    def number(self, depth: int = 2) -> m.Expression:
        kind = self.draw(st.integers(0, 11 if depth else 4))
        match kind:
            case 0 | 1:
                return m.IntLiteral(self.one(_NUMBERS))
            case 2 | 3 | 4:
                return self.place()
            case 5:
                operand = m.Paren(self.number(depth - 1))
                return m.Unary(self.one("-~"), operand)
            case 6:
                condition = m.Paren(self.condition(depth - 1))
                then, otherwise = self.number(depth - 1), self.number(depth - 1)
                return m.Paren(m.Conditional(condition, m.Paren(then), m.Paren(otherwise)))
            case 7:
                type_ = m.Type(self.one(("byte", "short", "int")))
                return m.Cast(type_, m.Paren(self.number(depth - 1)))
            case 8 if self.calls and self.draw(st.booleans()):
                return m.Choice((self.number(0), self.number(0)))
            case 8 if self.calls:
                return m.Call(None, "f")
            case 8:
                one, other = self.number(0), self.number(0)
                return _extreme(self.one("<>"), one, other)
            case _:
                return self.operation(depth)

    def operation(self, depth: int) -> m.Expression:
        operator = self.one(_ARITHMETIC)
        left = m.Paren(self.number(depth - 1))
        if operator in ("<<", ">>"):
            return m.Binary(operator, left, m.IntLiteral(self.draw(st.integers(0, 20))))
        if operator in ("/", "%") and self.draw(st.booleans()):
            return m.Binary(operator, left, m.IntLiteral(self.one(_NUMBERS[1:])))
        return m.Binary(operator, left, m.Paren(self.number(depth - 1)))

    def condition(self, depth: int = 1) -> m.Expression:
        match self.draw(st.integers(0, 6 if depth else 3)):
            case 4:
                return m.Unary("!", m.Paren(self.condition(depth - 1)))
            case 5 | 6:
                one, other = (m.Paren(self.condition(depth - 1)) for _ in "12")
                return m.Binary(self.one(("&&", "||")), one, other)
            case 0:
                moved = m.Binary(self.one("+-"), self.place(), m.IntLiteral(self.one(_NUMBERS)))
                return m.Binary(self.one(_COMPARES), moved, m.IntLiteral(self.one(_NUMBERS)))
            case _:
                return m.Binary(self.one(_COMPARES), self.place(), m.Paren(self.number(1)))

    # --- statements -----------------------------------------------------------------------------

    def block(self, depth: int, most: int = 4) -> m.Block:
        around, above = list(self.names), self.here
        self.here = set()
        statements = tuple(self.statement(depth) for _ in range(self.draw(st.integers(1, most))))
        self.names, self.here = around, above
        return m.Block(statements)

    def statement(self, depth: int) -> m.Statement:
        match self.draw(st.integers(0, 13 if depth else 6)):
            case 0 | 1 | 2:
                return self.assignment()
            case 3:
                operator = self.one(_CHANGES if self.wide else ("/=", "%=", "&="))
                given = m.Assign(operator, self.place(True), self.number(1))
                return m.ExpressionStatement(given)
            case 4:
                return m.ExpressionStatement(
                    m.Postfix(self.one(_STEPS if self.wide else ("++",)), self.place(True))
                )
            case 5:
                return self.local()
            case 6 if self.loops and self.draw(st.booleans()):
                return m.Continue() if self.repeats and self.draw(st.booleans()) else m.Break()
            case 6 if self.draw(st.integers(0, 4)) == 4:
                return m.Return()
            case 7 | 8 | 9 | 10 | 11:
                then = self.block(depth - 1)
                otherwise = self.block(depth - 1) if self.draw(st.booleans()) else None
                return m.If(self.condition(), then, otherwise)
            case 12:
                return self.switch(depth)
            case _ if depth:
                return self.loop(depth)
            case _:
                return self.assignment()

    def assignment(self) -> m.Statement:
        return m.ExpressionStatement(m.Assign("=", self.place(True), self.given()))

    def given(self) -> m.Expression:
        """What a variable gets; where nothing wraps, mostly a number between two others."""
        found = self.number()
        if self.wide or self.draw(st.integers(0, 15)) == 15:
            return found
        for sign in "<>":
            found = _extreme(sign, m.Paren(found), m.IntLiteral(self.one(_NUMBERS)))
        return found

    def local(self) -> m.Statement:
        plain = ("i1", "s1", "b1", "i0")  # the last hides a state variable
        free = [
            n for n in ((*plain, "w1", "v1", "u1") if self.wide else plain) if n not in self.here
        ]
        if not free:
            return self.assignment()
        name = self.one(free)
        self.names = [n for n in self.names if n != name]
        value = self.given()
        self.names.append(name)
        self.here.add(name)
        self.fixed.discard(name)
        return m.Local(m.Declaration(type_of(name), (m.Declarator(name, value),)))

    def switch(self, depth: int) -> m.Statement:
        cases = []
        self.loops += 1
        for value in (0, 1, None):
            inner = list(self.block(depth - 1, 2).statements)
            if self.draw(st.booleans()):
                inner.append(m.Break())
            label = m.IntLiteral(value) if value is not None else None
            cases.append(m.Case(label, (m.Block(tuple(inner)),)))
        self.loops -= 1
        return m.Switch(m.Binary("&", m.Paren(self.place()), m.IntLiteral(3)), tuple(cases))

    def loop(self, depth: int) -> m.Statement:
        self.loops += 1
        self.repeats += 1
        around = list(self.names)
        if self.draw(st.booleans()):
            found: m.Statement = m.While(self.condition(), self.block(depth - 1))
        else:
            name, last = f"i{4 + self.loops}", m.IntLiteral(self.draw(st.integers(0, 40)))
            self.names.append(name)
            fixed = self.draw(st.booleans())
            self.fixed |= {name} if fixed else set()
            body = self.block(depth - 1)
            self.fixed.discard(name)
            counter = m.Declaration(m.Type("int"), (m.Declarator(name, m.IntLiteral(0)),))
            step = m.Postfix("++", m.Name(name))
            found = m.For(counter, m.Binary("<", m.Name(name), last), (step,), body)
        self.names = around
        self.loops -= 1
        self.repeats -= 1
        return found


def _extreme(sign: str, one: m.Expression, other: m.Expression) -> m.Expression:
    """The lesser or the greater of two numbers."""
    return m.Paren(m.Conditional(m.Paren(m.Binary(sign, one, other)), one, other))


@st.composite
def bodies(
    draw: DrawFn, names: Sequence[str] = STATE, wide: bool = True, calls: bool = True
) -> tuple[m.Statement, ...]:
    """The statements of a body over some variables."""
    body = _Body(draw, names, wide, calls)
    return body.block(2, 6).statements
