"""What C++ converts unasked: numbers to truth values, wide numbers to narrow ones.

The model wants such conversions written. Where the type of something is not known nothing is
converted; nor are numbers narrowed in generated code, which writes what the model means.
"""

from __future__ import annotations

from dataclasses import replace

from rebsync import model as m
from rebsync.reverse.bodies.scope import Called, Outside, Record, Scope, Variable
from rebsync.reverse.models.building import bare, binary, cast, chosen
from rebsync.reverse.models.texts import TEXT
from rebsync.static.constants import constant, float_value
from rebsync.static.operators import binary_type, unary_type
from rebsync.static.types import (
    BOOLEAN,
    DOUBLE,
    INT,
    converts,
    integer_type,
    is_boolean,
    is_integer,
    is_numeric,
    wider,
)

_FLOAT = m.Type("float")
_TIMES = frozenset({"now", "currentMessageArrival", "currentMessageWaitingTime"})
_ONE, _ZERO = m.IntLiteral(1), m.IntLiteral(0)


def variable_of(scope: Scope, name: str, is_member: bool = False) -> Variable | None:
    """The variable that has a name in the model; None also for a local of unknown type."""
    for meanings in (scope.members,) if is_member else (scope.locals, scope.members):
        for meaning in meanings.values():
            if type(meaning) is Outside:  # as most are
                continue
            if type(meaning) is Variable:
                if meaning.name == name:
                    return meaning
            elif type(meaning) is m.Name:
                if meaning.name == name and meanings is scope.locals:
                    return None
            elif type(meaning) is Record:
                for variable in meaning.fields.values():
                    if variable.name == name:
                        return variable
    return scope.results.get(name)


def place_of(scope: Scope, target: m.Expression) -> Variable:
    """What is known of a place that is written."""
    match target:
        case m.Name(name) | m.Member(m.Self(), name):
            return variable_of(scope, name, isinstance(target, m.Member)) or Variable(name)
        case m.Paren(inner):
            return place_of(scope, inner)
        case m.Index(array):
            whole = place_of(scope, array)
            if whole.type is None or not whole.type.dimensions:
                return Variable(whole.name)
            of = m.Type(whole.type.name, whole.type.dimensions[1:])
            return Variable(whole.name, of, whole.bits, whole.domain, whole.wide)
        case _:
            return Variable("")


def _is_taken(scope: Scope, name: str) -> bool:
    """Whether a variable of the model has a name."""
    known = (*scope.locals.values(), *scope.members.values())
    return any(isinstance(v, Variable | m.Name) and v.name == name for v in known)


def type_in(scope: Scope, expression: m.Expression) -> m.Type | None:
    """The type that the model gives an expression; None where it is not known."""
    match expression:
        case m.IntLiteral(value):
            return integer_type(value)
        case m.FloatLiteral():
            return DOUBLE if expression.is_double else _FLOAT
        case m.BoolLiteral() | m.InstanceOf():
            return BOOLEAN
        case m.StringLiteral() if scope.open:
            return TEXT
        case m.Name(name) if name in _TIMES and not _is_taken(scope, name):
            return INT
        case m.Name(name) | m.Member(m.Self(), name):
            variable = variable_of(scope, name, isinstance(expression, m.Member))
            return variable.type if variable is not None else None
        case m.Paren(inner) | m.Assign(target=inner):
            return type_in(scope, inner)
        case m.Cast(type_):
            return type_
        case m.Index(array):
            whole = type_in(scope, array)
            return m.Type(whole.name, whole.dimensions[1:]) if whole is not None else None
        case m.Unary(operator, operand) | m.Postfix(operator, operand):
            of = type_in(scope, operand)
            return unary_type(operator, of) if of is not None else None
        case m.Call(name=name):
            return _result(scope, name)
        case m.Binary() | m.Conditional() | m.Choice():
            return _combined(scope, expression)
        case _:
            return None


def _combined(scope: Scope, expression: m.Binary | m.Conditional | m.Choice) -> m.Type | None:
    match expression:
        case m.Binary(operator, left, right):
            if operator in ("&&", "||", "<", ">", "<=", ">=", "==", "!="):
                return BOOLEAN
            types = type_in(scope, left), type_in(scope, right)
            if types[0] is None or types[1] is None:
                return None
            return binary_type(operator, types[0], types[1], {})
        case m.Conditional(_, then, otherwise):
            options: tuple[m.Expression, ...] = then, otherwise
        case m.Choice(options):
            pass
    widest = type_in(scope, options[0])
    for option in options[1:]:
        other = type_in(scope, option)
        if widest is None or other is None:
            return None
        if is_numeric(widest) and is_numeric(other):
            widest = wider(widest, other)
    return widest


def _result(scope: Scope, name: str) -> m.Type | None:
    if name in ("pow", "sqrt"):
        return DOUBLE
    for function in scope.functions.values():
        if isinstance(function, Called) and function.name == name:
            return function.returns
    return None


# --- conversions --------------------------------------------------------------------------------


def as_boolean(scope: Scope, expression: m.Expression) -> m.Expression:
    """What C++ takes a number for where it wants a truth value."""
    of = type_in(scope, expression)
    if of is None or not is_numeric(of):
        return expression
    match bare(expression):
        case m.IntLiteral(value):
            return m.BoolLiteral(value != 0)
        case m.Conditional(condition, m.IntLiteral(1), m.IntLiteral(0)):
            return condition
    zero: m.Expression = _ZERO if is_integer(of) else m.FloatLiteral("0.0")
    return binary("!=", expression, zero)


def as_number(scope: Scope, expression: m.Expression) -> m.Expression:
    """What C++ takes a truth value for where it wants a number."""
    of = type_in(scope, expression)
    if of is None or not is_boolean(of):
        return expression
    if isinstance(bare(expression), m.BoolLiteral):
        return _ONE if bare(expression) == m.BoolLiteral(True) else _ZERO
    return chosen(expression, _ONE, _ZERO)


def converted_to(scope: Scope, expression: m.Expression, target: Variable) -> m.Expression:
    """A value as one that the variable holds after C++ stored it there."""
    type_ = target.type
    if type_ is None or type_.dimensions:
        return expression
    if is_boolean(type_):
        return as_boolean(scope, expression)
    if not is_numeric(type_):
        return expression
    value = as_number(scope, expression)
    of = type_in(scope, value)
    if of is None or not is_numeric(of):
        return value
    if not scope.open:
        return value
    value = _literal(value, type_) or (value if converts(of, type_, {}) else cast(type_, value))
    return _wrapped(scope, value, target.bits) if target.bits else value


def is_truth(scope: Scope, expression: m.Expression) -> bool:
    """Whether C++ takes the value of an expression for 0 or 1 where it is stored as a number."""
    match bare(expression):
        case m.IntLiteral(value):
            return value in (0, 1)
        case m.Conditional(_, then, otherwise):
            return is_truth(scope, then) and is_truth(scope, otherwise)
        case m.Cast(_, operand):
            return is_truth(scope, operand)
        case other:
            of = type_in(scope, other)
            return of is not None and is_boolean(of)


def _literal(expression: m.Expression, type_: m.Type) -> m.Expression | None:
    """A literal of another type as one of this type."""
    match bare(expression):
        case m.FloatLiteral(text) if type_ == _FLOAT:
            return replace(m.FloatLiteral(text.rstrip("dD")), span=expression.span)
        case m.FloatLiteral(text) if is_integer(type_) and abs(float_value(text)) < 2**31:
            return m.IntLiteral(int(float_value(text)), expression.span)
        case m.Unary("-", m.FloatLiteral() as inner, span):
            positive = _literal(inner, type_)
            return m.Unary("-", positive, span) if positive is not None else None
        case _:
            return None


def _wrapped(scope: Scope, expression: m.Expression, bits: int) -> m.Expression:
    """A number modulo 2 ** bits."""
    mask = (1 << bits) - 1
    value = constant(expression)
    if isinstance(value, int):
        return m.IntLiteral(value & mask, expression.span)
    inner = bare(expression)
    if isinstance(inner, m.Conditional) and all(
        isinstance(way := constant(w), int) and 0 <= way <= mask
        for w in (inner.then, inner.otherwise)
    ):
        return expression
    if isinstance(inner, m.Index):
        inner = inner.target
    if isinstance(inner, m.Name):
        variable = variable_of(scope, inner.name)
        if variable is not None and 0 < variable.bits <= bits:
            return expression
    return binary("&", expression, m.IntLiteral(mask))


def alternatives(
    scope: Scope, then: m.Expression, otherwise: m.Expression
) -> tuple[m.Expression, m.Expression]:
    """The alternatives of a conditional expression: both numbers, or both truth values."""
    types = type_in(scope, then), type_in(scope, otherwise)
    if types[0] is None or types[1] is None or is_boolean(types[0]) == is_boolean(types[1]):
        return then, otherwise
    return as_number(scope, then), as_number(scope, otherwise)


def operands(
    scope: Scope, operator: str, left: m.Expression, right: m.Expression
) -> tuple[str, m.Expression, m.Expression]:
    """Operator and operands as the model wants them: both numbers, or both truth values."""
    types = type_in(scope, left), type_in(scope, right)
    if types[0] is None or types[1] is None:
        return operator, left, right
    truths = [is_boolean(t) for t in types if t is not None]
    if all(truths):
        if operator in ("==", "!=", "&", "|", "^", "&&", "||"):
            return operator, left, right
        return operator, as_number(scope, left), as_number(scope, right)
    if any(truths):
        left, right = as_number(scope, left), as_number(scope, right)
    if scope.open and operator in ("==", "!=", "<", ">", "<=", ">="):
        left, right = _of_seconds(scope, left, right), _of_seconds(scope, right, left)
        left, right = _whole(scope, left, right), _whole(scope, right, left)
    return operator, left, right


def _of_seconds(scope: Scope, expression: m.Expression, other: m.Expression) -> m.Expression:
    """`(double) n` as `n` where it is compared with a whole number."""
    match bare(expression):
        case m.Cast(m.Type("double"), operand):
            value, of = constant(other), type_in(scope, operand)
            whole = isinstance(value, int) or (isinstance(value, float) and value.is_integer())
            if whole and of is not None and is_integer(of):
                return operand
    return expression


def _whole(scope: Scope, expression: m.Expression, other: m.Expression) -> m.Expression:
    """A literal `2.0` as `2` where it is compared with an integer."""
    of = type_in(scope, other)
    value = constant(expression)
    fits = isinstance(value, float) and value.is_integer() and abs(value) < 2**31
    if fits and value is not None and of is not None and is_integer(of):
        return m.IntLiteral(int(value), expression.span)
    return expression
