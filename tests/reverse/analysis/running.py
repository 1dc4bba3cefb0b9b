"""Runs bodies on numbers: as C++ does, each operator in its type, or as Python, without bounds."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from random import Random

from rebsync import model as m
from rebsync.reverse.models.building import bare
from tests.reverse.analysis.drawing import BITS, LENGTH, type_of

_INT = 31
_MODEL = {"byte": 7, "short": 15, "int": 31}
_FUEL = 400


class Stop(Exception):
    """The run ends here: what follows is none of what the analysis speaks of."""


class _Leaves(Exception):
    pass


class _Breaks(_Leaves):
    pass


class _Continues(_Leaves):
    pass


class _Returns(_Leaves):
    pass


class Number(int):
    """A number of a type with so many bits without the sign; whether it has wrapped on its way."""

    bits: int
    wrapped: bool

    def __new__(cls, value: int, bits: int = _INT, wrapped: bool = False) -> Number:
        made = super().__new__(cls, value)
        made.bits, made.wrapped = bits, wrapped
        return made


def _within(value: int, bits: int) -> int:
    """What a type of so many bits makes of a number."""
    if bits in (32, 64):
        return value & ((1 << bits) - 1)
    half = 1 << bits
    return (value + half) % (2 * half) - half


def is_int(value: int) -> bool:
    """Whether an `int` holds a number."""
    return -(2**31) <= value < 2**31


def bits_of(name: str) -> int:
    """The bits of a variable that hold its number, without the sign."""
    return BITS.get(name[0]) or _MODEL[type_of(name).name]


class Run:
    """One run; `stored` and `seen` hear what variables get and expressions give."""

    def __init__(
        self,
        values: Mapping[str, int | list[int]],
        random: Random,
        wraps: bool = True,
        stored: Callable[[str, int], None] = lambda name, value: None,
        seen: Callable[[m.Expression, int], None] = lambda expression, value: None,
    ) -> None:
        self.scopes = [dict(values)]
        self.random, self.wraps = random, wraps
        self.stored, self.seen = stored, seen
        self.fuel = _FUEL

    def body(self, statements: Sequence[m.Statement]) -> dict[str, int | list[int]]:
        """Runs a body to its end; gives what is in its variables then."""
        with suppress(_Returns):
            self.block(statements)
        return self.scopes[0]

    # --- statements -----------------------------------------------------------------------------

    def block(self, statements: Sequence[m.Statement]) -> None:
        depth = len(self.scopes)
        self.scopes.append({})
        try:
            for statement in statements:
                self.statement(statement)
        finally:
            del self.scopes[depth:]

    def statement(self, statement: m.Statement) -> None:
        self.fuel -= 1
        if self.fuel < 0:
            raise Stop
        match statement:
            case m.Block(statements):
                self.block(statements)
            case m.ExpressionStatement(expression):
                self.value(expression)
            case m.Local(declaration):
                self.declared(declaration)
            case m.If(condition, then, otherwise):
                if self.value(condition):
                    self.statement(then)
                elif otherwise is not None:
                    self.statement(otherwise)
            case m.While(condition, body):
                self.loop(condition, (), body)
            case m.For(m.Declaration() as initial, condition, updates, body):
                self.scopes.append({})
                self.declared(initial)
                self.loop(condition, updates, body)
                self.scopes.pop()
            case m.Switch():
                self.switch(statement)
            case m.Return():
                raise _Returns
            case m.Break():
                raise _Breaks
            case m.Continue():
                raise _Continues
            case _:
                raise AssertionError(statement)

    def declared(self, declaration: m.Declaration) -> None:
        (declarator,) = declaration.declarators
        assert declarator.initial is not None
        assert not isinstance(declarator.initial, m.ArrayInitializer)
        value = self.value(declarator.initial)
        self.scopes[-1][declarator.name] = 0
        self.store(m.Name(declarator.name), value)

    def loop(
        self, condition: m.Expression | None, updates: Sequence[m.Expression], body: m.Statement
    ) -> None:
        depth = len(self.scopes)
        while condition is None or self.value(condition):
            try:
                self.statement(body)
            except _Continues:
                del self.scopes[depth:]
            except _Breaks:
                del self.scopes[depth:]
                return
            for update in updates:
                self.value(update)

    def switch(self, switch: m.Switch) -> None:
        subject = self.value(switch.subject)
        labels = [
            c.value.value if isinstance(c.value, m.IntLiteral) else None for c in switch.cases
        ]
        first = labels.index(subject) if subject in labels else labels.index(None)
        depth = len(self.scopes)
        try:
            for case in switch.cases[first:]:
                self.block(case.statements)
        except _Breaks:
            del self.scopes[depth:]

    # --- expressions ----------------------------------------------------------------------------

    def value(self, expression: m.Expression) -> Number:
        found = self.evaluated(expression)
        self.seen(bare(expression), found)
        return found

    def evaluated(self, expression: m.Expression) -> Number:
        match expression:
            case m.IntLiteral(value):
                return Number(value)
            case m.Name() | m.Index():
                return self.load(expression)
            case m.Paren(inner):
                return self.value(inner)
            case m.Unary("!", operand):
                return Number(not self.value(operand))
            case m.Unary(operator, operand):
                of = self.value(operand)
                return self.typed(-of if operator == "-" else ~of, of.bits, of.wrapped)
            case m.Cast(type_, operand):
                return Number(_within(self.value(operand), _MODEL[type_.name]))
            case m.Conditional(condition, then, otherwise):
                found = self.value(then if self.value(condition) else otherwise)
                bits = max(self.type(then), self.type(otherwise))
                return self.converted(found, bits)
            case m.Choice(options):
                return self.value(self.random.choice(options))
            case m.Call():
                return self.called()
            case m.Postfix(operator, target):
                before = self.value(target)
                self.store(target, self.operated(operator[0], before, Number(1)))
                return before
            case m.Assign(operator, target, value):
                given = self.value(value)
                if operator != "=":
                    given = self.operated(operator[:-1], self.load(target), given)
                return self.store(target, given)
            case m.Binary("&&" | "||" as operator, left, right):
                one = self.value(left)
                return Number(bool(self.value(right))) if bool(one) is (operator == "&&") else one
            case m.Binary(operator, left, right):
                return self.operated(operator, self.value(left), self.value(right))
            case _:
                raise AssertionError(expression)

    def called(self) -> Number:
        """A function that may change each variable of the state."""
        for name in self.scopes[0]:
            if self.random.random() < 0.3 and name[0] not in "az":
                bits = min(31, bits_of(name))
                low = 0 if bits_of(name) in (32, 64) else -(1 << bits)
                self.scopes[0][name] = self.random.choice((low, (1 << bits) - 1, 0))
        return Number(self.random.choice((-(2**31), 2**31 - 1, 0, 1)))

    def type(self, expression: m.Expression) -> int:
        """The bits of the type of an expression."""
        match bare(expression):
            case m.Name(name) | m.Index(m.Name(name)):
                return max(_INT, bits_of(name))
            case m.Unary(operator, operand) if operator != "!":
                return self.type(operand)
            case m.Binary("<<" | ">>", left, _):
                return self.type(left)
            case m.Binary("+" | "-" | "*" | "/" | "%" | "&" | "|" | "^", left, right):
                return max(self.type(left), self.type(right))
            case m.Conditional(_, then, otherwise):
                return max(self.type(then), self.type(otherwise))
            case m.Choice(options):
                return max(map(self.type, options))
            case _:
                return _INT

    def operated(self, operator: str, left: Number, right: Number) -> Number:
        if operator in ("<<", ">>"):
            if operator == ">>" and not is_int(left):
                raise Stop
            moved = int(left) << right if operator == "<<" else int(left) >> right
            return self.typed(moved, left.bits, left.wrapped)
        bits = max(left.bits, right.bits)
        one, other = self.converted(left, bits), self.converted(right, bits)
        looks = operator in ("/", "%", "<", "<=", ">", ">=", "==", "!=")
        if looks and not (is_int(one) and is_int(other)):
            raise Stop  # it is refused: the model's numbers are others
        if not self.wraps and operator in ("&", "|", "^") and not (is_int(one) and is_int(other)):
            raise Stop
        if operator in ("/", "%"):
            return Number(self.divided(operator, one, other), bits)
        found = _OPERATORS[operator](int(one), int(other))
        if operator == "&" and any(n >= 0 and is_int(n) and not n.wrapped for n in (one, other)):
            return Number(found, bits)
        if looks:
            return Number(found)
        return self.typed(found, bits, one.wrapped or other.wrapped)

    def divided(self, operator: str, left: int, right: int) -> int:
        if right == 0 or right == -1 or (not self.wraps and (left < 0 or right < 0)):
            raise Stop
        quotient = abs(left) // abs(right) * (1 if (left < 0) is (right < 0) else -1)
        return quotient if operator == "/" else left - right * quotient

    def typed(self, value: int, bits: int, wrapped: bool = False) -> Number:
        """What an operator gives, in its type."""
        if not self.wraps:
            return Number(value)
        inside = _within(value, bits)
        return Number(inside, bits, wrapped or inside != value)

    def converted(self, value: Number, bits: int) -> Number:
        """A number in a wider type, which it must not have wrapped before."""
        if not self.wraps or bits == value.bits:
            return value
        if value.wrapped and bits > 32:
            raise Stop  # it is refused, or the program has no meaning in C++
        return self.typed(value, bits, value.wrapped)

    # --- places ---------------------------------------------------------------------------------

    def scope(self, name: str) -> dict[str, int | list[int]]:
        return next(s for s in reversed(self.scopes) if name in s)

    def load(self, place: m.Expression) -> Number:
        name, index = self.named(place)
        held = self.scope(name)[name]
        value = held[index] if isinstance(held, list) else held
        return Number(value, max(_INT, bits_of(name)) if self.wraps else _INT)

    def store(self, place: m.Expression, value: Number) -> Number:
        name, index = self.named(place)
        scope, bits = self.scope(name), bits_of(name)
        if self.wraps and bits > 32 and value.bits <= 32 and value.wrapped:
            raise Stop
        kept = _within(value, bits) if self.wraps else int(value)
        self.stored(name, kept)
        held = scope[name]
        if isinstance(held, list):
            held[index] = kept
        else:
            scope[name] = kept
        return Number(kept, max(_INT, bits) if self.wraps else _INT)

    def named(self, place: m.Expression) -> tuple[str, int]:
        match bare(place):
            case m.Name(name):
                return name, 0
            case m.Index(m.Name(name), m.IntLiteral(index)):
                return name, index % LENGTH
            case _:
                raise AssertionError(place)


_OPERATORS: dict[str, Callable[[int, int], int]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "&": lambda a, b: a & b,
    "|": lambda a, b: a | b,
    "^": lambda a, b: a ^ b,
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
}
