"""Draws well-typed expressions over the names in scope."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rebsync import model as m

_T = TypeVar("_T")

INTEGERS = ("byte", "short", "int")
NUMBERS = (*INTEGERS, "float", "double")
PRIMITIVES = (*NUMBERS, "boolean")
_LARGEST = {"byte": 100, "short": 3000, "int": 100_000}
_COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")


@dataclass(frozen=True)
class Variable:
    """Something that can be read, and perhaps assigned: its text as a tree and its type."""

    read: m.Expression
    type: m.Type
    assignable: bool = True


@dataclass(frozen=True)
class Signature:
    """A server or method of a class."""

    name: str
    types: tuple[m.Type, ...]
    result: str = "void"


@dataclass
class Scope:
    """What a body may use."""

    owner: str
    kind: str  # "server", "method" or "constructor"
    variables: list[Variable]
    servers: dict[str, list[Signature]]
    methods: list[Signature]
    ancestors: dict[str, tuple[str, ...]]
    robot: bool = False
    locals: int = 0
    prefix: str = "v"
    result: str = "void"
    sender: bool = False

    def fresh(self) -> str:
        """A name for a local variable."""
        self.locals += 1
        return f"{self.prefix}{self.locals}"


def one(draw: DrawFn, options: Sequence[_T]) -> _T:
    """One of the options."""
    return draw(st.sampled_from(options))


def chance(draw: DrawFn, out_of: int) -> bool:
    """True once in a while."""
    return draw(st.integers(0, out_of - 1)) == out_of - 1


def type_of(name: str, *dimensions: int) -> m.Type:
    """A type by name."""
    return m.Type(name, dimensions)


def fits(source: str, target: str, scope: Scope) -> bool:
    """Whether a value of one type may stand where the other is wanted."""
    if source == target:
        return True
    if source in NUMBERS and target in NUMBERS:
        return NUMBERS.index(source) <= NUMBERS.index(target)
    return target in scope.ancestors.get(source, ())


# --- expressions -------------------------------------------------------------------------------


def draw_expression(draw: DrawFn, scope: Scope, kind: str, depth: int = 2) -> m.Expression:
    """An expression whose value fits the type named `kind`."""
    if kind == "boolean":
        return draw_boolean(draw, scope, depth)
    if kind in NUMBERS:
        return _number(draw, scope, kind, depth)
    return _rebec(draw, scope, kind)


def _readable(draw: DrawFn, scope: Scope, kind: str) -> list[m.Expression]:
    found = []
    for variable in scope.variables:
        if fits(variable.type.name, kind, scope):
            found.append(element(draw, variable))
    return found


def element(draw: DrawFn, variable: Variable) -> m.Expression:
    """The variable, or an element of it."""
    expression = variable.read
    for length in variable.type.dimensions:
        expression = m.Index(expression, m.IntLiteral(draw(st.integers(0, length - 1))))
    return expression


def literal(draw: DrawFn, kind: str) -> m.Expression:
    """A literal whose type fits `kind`."""
    if kind == "boolean":
        return m.BoolLiteral(draw(st.booleans()))
    if kind in INTEGERS:
        return m.IntLiteral(draw(st.integers(0, _LARGEST[kind])))
    return m.FloatLiteral(one(draw, ("0.5", "1.0", "2.25", "1.00")))


def _number(draw: DrawFn, scope: Scope, kind: str, depth: int) -> m.Expression:
    leaves = [literal(draw, kind), *_readable(draw, scope, kind)]
    if depth == 0:
        return one(draw, leaves)
    match draw(st.integers(0, 9)):
        case 0 | 1 | 2:
            return _binary(draw, scope, kind, depth)
        case 3:
            signs = ("-", "+", "~") if kind in INTEGERS else ("-", "+")
            operand = draw_expression(draw, scope, kind, depth - 1)
            return m.Unary(one(draw, signs), _operand(operand))
        case 4:
            source = one(draw, NUMBERS)
            inner = draw_expression(draw, scope, source, depth - 1)
            return m.Cast(type_of(kind), m.Paren(inner))
        case 5:
            return m.Paren(_number(draw, scope, kind, depth - 1))
        case 6:
            return _conditional(draw, scope, kind, depth)
        case 7:
            return _call_or(draw, scope, kind, depth, leaves)
        case _:
            return one(draw, leaves)


def _operand(expression: m.Expression) -> m.Expression:
    """Signs of literals are left to the printer; everything lower gets its parentheses."""
    loose = (m.Binary, m.Conditional, m.Assign, m.InstanceOf)
    return m.Paren(expression) if isinstance(expression, loose) else expression


def _conditional(draw: DrawFn, scope: Scope, kind: str, depth: int) -> m.Expression:
    condition = _operand(draw_boolean(draw, scope, depth - 1))
    then = draw_expression(draw, scope, kind, depth - 1)
    otherwise = draw_expression(draw, scope, kind, depth - 1)
    return m.Paren(m.Conditional(condition, then, otherwise))


def _binary(draw: DrawFn, scope: Scope, kind: str, depth: int) -> m.Expression:
    operators = ["+", "-", "*", "/"]
    if kind in INTEGERS:
        operators += ["%", "<<", ">>", "&", "|", "^"]
    operator = one(draw, operators)
    left = _operand(draw_expression(draw, scope, kind, depth - 1))
    if operator in ("/", "%", "<<", ">>"):
        amount = m.IntLiteral(draw(st.integers(1, 7)))
        return m.Binary(operator, left, amount)
    return m.Binary(operator, left, _operand(draw_expression(draw, scope, kind, depth - 1)))


def _call_or(
    draw: DrawFn, scope: Scope, kind: str, depth: int, leaves: Sequence[m.Expression]
) -> m.Expression:
    calls = [f for f in scope.methods if f.result != "void" and fits(f.result, kind, scope)]
    if calls and scope.kind != "method":
        return draw_call(draw, scope, None, one(draw, calls), depth - 1)
    if kind == "double":
        name = one(draw, ("sqrt", "pow"))
        count = 1 if name == "sqrt" else 2
        arguments = [_number(draw, scope, "double", depth - 1) for _ in range(count)]
        return m.Call(None, name, tuple(arguments))
    return one(draw, leaves)


def draw_call(
    draw: DrawFn, scope: Scope, target: m.Expression | None, callee: Signature, depth: int
) -> m.Call:
    """A call with arguments of the right types."""
    return m.Call(
        target, callee.name, tuple(_argument(draw, scope, t, depth) for t in callee.types)
    )


def _argument(draw: DrawFn, scope: Scope, wanted: m.Type, depth: int) -> m.Expression:
    """Of exactly the parameter's type, so that overloads stay unambiguous."""
    if wanted.dimensions:
        return one(draw, [v.read for v in scope.variables if v.type == wanted])
    if wanted.name in NUMBERS:
        return m.Cast(wanted, m.Paren(draw_expression(draw, scope, wanted.name, depth)))
    return draw_expression(draw, scope, wanted.name, depth)


def draw_boolean(draw: DrawFn, scope: Scope, depth: int) -> m.Expression:
    """A condition."""
    leaves = [literal(draw, "boolean"), *_readable(draw, scope, "boolean")]
    if depth == 0:
        return one(draw, leaves)
    match draw(st.integers(0, 7)):
        case 0 | 1 | 2:
            kind = one(draw, NUMBERS)
            left, right = (
                _operand(draw_expression(draw, scope, kind, depth - 1)) for _ in range(2)
            )
            return m.Binary(one(draw, _COMPARISONS), left, right)
        case 3:
            return m.Unary("!", _operand(draw_boolean(draw, scope, depth - 1)))
        case 4:
            operator = one(draw, ("&&", "||", "&", "|", "^", "==", "!="))
            left, right = (_operand(draw_boolean(draw, scope, depth - 1)) for _ in range(2))
            return m.Binary(operator, left, right)
        case 5:
            return m.Paren(draw_boolean(draw, scope, depth - 1))
        case 6:
            return _about_rebecs(draw, scope)
        case _:
            return one(draw, leaves)


def _about_rebecs(draw: DrawFn, scope: Scope) -> m.Expression:
    rebecs = [v for v in scope.variables if v.type.name not in PRIMITIVES]
    if not rebecs:
        return m.BoolLiteral(draw(st.booleans()))
    chosen = one(draw, rebecs)
    read = element(draw, chosen)
    if draw(st.booleans()):
        return m.Binary(one(draw, ("==", "!=")), read, m.NullLiteral())
    return m.InstanceOf(read, type_of(chosen.type.name))


def _rebec(draw: DrawFn, scope: Scope, kind: str) -> m.Expression:
    options: list[m.Expression] = [m.NullLiteral(), *_readable(draw, scope, kind)]
    if fits(scope.owner, kind, scope):
        options.append(m.Self())
    if scope.sender:
        options.append(m.Cast(type_of(kind), m.Name("sender")))
    return one(draw, options)


def _choice(draw: DrawFn, kind: str) -> m.Expression:
    if kind == "boolean":
        first = draw(st.booleans())
        return m.Choice((m.BoolLiteral(first), m.BoolLiteral(not first)))
    if kind in INTEGERS:
        values = draw(st.lists(st.integers(0, 100), min_size=2, max_size=3, unique=True))
        return m.Choice(tuple(m.IntLiteral(v) for v in values))
    return m.Choice((m.FloatLiteral("0.5"), m.FloatLiteral("1.5")))


def draw_value(draw: DrawFn, scope: Scope, kind: str) -> m.Expression:
    """An expression; in a server now and then a nondeterministic one."""
    if scope.kind == "server" and kind in PRIMITIVES and chance(draw, 4):
        return _choice(draw, kind)
    return draw_expression(draw, scope, kind)
