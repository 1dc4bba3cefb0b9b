"""Names and types of expressions; None stands for a type that a reported mistake hides."""

from __future__ import annotations

from rebsync.model import (
    Assign,
    Binary,
    BoolLiteral,
    Broken,
    Call,
    Cast,
    Choice,
    Conditional,
    Expression,
    FloatLiteral,
    Index,
    InstanceOf,
    IntLiteral,
    Member,
    Name,
    New,
    NullLiteral,
    Paren,
    Postfix,
    Self,
    StringLiteral,
    Super,
    Type,
    Unary,
)
from rebsync.static.calls import Receiver, call_type, check_time
from rebsync.static.choices import check_choice
from rebsync.static.conversions import check_condition, check_conversion
from rebsync.static.names import bare, member_type, name_type, place_of, super_type
from rebsync.static.operators import assigns, binary_type, unary_type
from rebsync.static.resolve import resolve_class
from rebsync.static.scope import Body
from rebsync.static.types import (
    BOOLEAN,
    DOUBLE,
    FLOAT,
    INT_MAX,
    NULL,
    STRING,
    casts,
    common,
    element,
    integer_type,
    is_integer,
    is_rebec,
)

_DIVISION = frozenset(("/", "%", "/=", "%="))


def type_of(expression: Expression, body: Body) -> Type | None:
    """The type of an expression; everything wrong in it is reported."""
    type_ = _type_of(expression, body)
    if type_ is not None:
        body.facts.types[id(expression)] = type_
    return type_


def _type_of(expression: Expression, body: Body) -> Type | None:
    match expression:
        case Name():
            return name_type(expression, body)
        case IntLiteral():
            return _integer(expression, expression.value, body)
        case Binary():
            return _binary(expression, body)
        case Call():
            return _call(expression, body)
        case Self():
            return _self(expression, body)
        case Member():
            return _member(expression, body)
        case Index():
            return _indexed(expression, type_of(expression.target, body), body)
        case Assign():
            return _assign(expression, body)
        case Paren(inner):
            return type_of(inner, body)
        case BoolLiteral() | FloatLiteral() | NullLiteral():
            return _literal(expression)
        case Unary():
            return _unary(expression, body)
        case Postfix():
            return _step(expression, body)
        case Cast():
            return _cast(expression, body)
        case InstanceOf():
            return _instance_of(expression, body)
        case Conditional():
            return _conditional(expression, body)
        case Choice():
            return _choice(expression, body)
        case Super():
            return super_type(expression, body)
        case StringLiteral() | New() | Broken():
            _misplaced(expression, body)
            return None


def _literal(literal: BoolLiteral | FloatLiteral | NullLiteral) -> Type:
    match literal:
        case BoolLiteral():
            return BOOLEAN
        case FloatLiteral():
            return DOUBLE if literal.is_double else FLOAT
        case NullLiteral():
            return NULL


def _misplaced(expression: StringLiteral | New | Broken, body: Body) -> None:
    """Reports what has no value in a model."""
    match expression:
        case StringLiteral():
            message = "a text may stand only as the second argument of assertion"
            body.facts.error("RS317", expression.span, message)
        case New():
            _new(expression, body)
        case Broken():
            body.facts.incomplete = True


def _integer(literal: Expression, value: int, body: Body) -> Type | None:
    if -INT_MAX - 1 <= value <= INT_MAX:
        return integer_type(value)
    message = f'the number {value} does not fit the type "int"'
    body.facts.error("RS305", literal.span, message, f"int holds -{INT_MAX + 1} to {INT_MAX}")
    return None


def _new(expression: New, body: Body) -> None:
    for part in (*expression.bindings, *expression.arguments):
        type_of(part, body)
    message = f'"new {expression.type.name}" is not supported: a ROS system has fixed nodes'
    body.facts.error("RS110", expression.span, message, "declare the rebec in main")


def _self(expression: Self, body: Body) -> Type | None:
    if body.self_symbol is None:
        body.facts.error("RS203", expression.span, 'there is no "self" here')
        return None
    body.facts.symbols[id(expression)] = body.self_symbol
    return body.self_symbol.type


def _member(member: Member, body: Body) -> Type | None:
    inner = bare(member.target)
    target = type_of(member.target, body)
    return member_type(member, inner, target, body)


# --- operators ---------------------------------------------------------------------------------


def _binary(expression: Binary, body: Body) -> Type | None:
    spine = [expression]
    while isinstance(spine[-1].left, Binary):
        spine.append(spine[-1].left)
    left = type_of(spine[-1].left, body)
    for node in reversed(spine):
        right = type_of(node.right, body)
        left = _operate(node, left, right, body)
        if left is not None:
            body.facts.types[id(node)] = left
    return left


def _operate(node: Binary, left: Type | None, right: Type | None, body: Body) -> Type | None:
    if left is None or right is None:
        return BOOLEAN if node.operator in _BOOLEAN_RESULT else None
    result = binary_type(node.operator, left, right, body.facts.classes)
    if result is None:
        _undefined(node, node.operator, left, right, body)
        return BOOLEAN if node.operator in _BOOLEAN_RESULT else None
    if node.operator in _DIVISION and is_integer(result):
        _check_divisor(node.right, body)
    if node.operator in _PRODUCTS and isinstance(node.left, Cast):
        _check_cast(node.left, node.operator, body)
    return result


_PRODUCTS = frozenset(("*", "/", "%"))


def _check_cast(cast: Cast, operator: str, body: Body) -> None:
    """`(int) a * b` was `(int) (a * b)` before compiler 2.30: matters where the type changes."""
    source = body.facts.types.get(id(cast.operand))
    if source is not None and source != cast.type:
        message = f"compilers before 2.30 read this cast as one of all that {operator} computes"
        hint = (
            f"write what is meant: (({cast.type})a) {operator} b, or ({cast.type})(a {operator} b)"
        )
        body.facts.warn("RS521", cast.span, message, hint)


_BOOLEAN_RESULT = frozenset(("==", "!=", "<", ">", "<=", ">=", "&&", "||"))


def _undefined(node: Expression, operator: str, left: Type, right: Type, body: Body) -> None:
    message = f'the operator {operator} is not defined for "{left}" and "{right}"'
    hint = None
    if operator in ("&&", "||") and is_integer(left) and is_integer(right):
        hint = "write the comparison out, such as x != 0"
    elif operator in ("==", "!=") and is_rebec(left) and is_rebec(right):
        hint = "neither class descends from the other, so the two are never equal"
    body.facts.error("RS301", node.span, message, hint)


def _check_divisor(divisor: Expression, body: Body) -> None:
    if body.facts.value(divisor) == 0:
        body.facts.warn("RS514", divisor.span, "division by zero")


def _unary(expression: Unary, body: Body) -> Type | None:
    operator, operand = expression.operator, expression.operand
    if operator in ("++", "--"):
        return _step(expression, body)
    if operator == "-" and isinstance(operand, IntLiteral):
        type_ = _integer(expression, -operand.value, body)
        return body.facts.note_type(operand, type_)
    type_ = type_of(operand, body)
    if type_ is None:
        return BOOLEAN if operator == "!" else None
    result = unary_type(operator, type_)
    if result is None:
        message = f'the operator {operator} is not defined for "{type_}"'
        body.facts.error("RS301", expression.span, message)
        return BOOLEAN if operator == "!" else None
    return result


def _step(expression: Unary | Postfix, body: Body) -> Type | None:
    type_ = _place(expression.operand, body, reads=True)
    if type_ is not None and unary_type(expression.operator, type_) is None:
        message = f'the operator {expression.operator} is not defined for "{type_}"'
        body.facts.error("RS301", expression.span, message, "it counts integers only")
        return None
    return type_


def _assign(expression: Assign, body: Body) -> Type | None:
    compound = expression.operator != "="
    value = type_of(expression.value, body)
    target = _place(expression.target, body, reads=compound)
    if target is None or value is None:
        return target
    classes = body.facts.classes
    if not compound:
        check_conversion(expression.value, value, target, body)
    elif not assigns(expression.operator[:-1], target, value, classes):
        operator = expression.operator[:-1]
        if binary_type(operator, target, value, classes) is None:
            _undefined(expression, expression.operator, target, value, body)
        else:
            check_conversion(expression.value, value, target, body)
    elif expression.operator in _DIVISION and is_integer(target):
        _check_divisor(expression.value, body)
    return target


def _place(expression: Expression, body: Body, *, reads: bool) -> Type | None:
    """The type of what an assignment changes."""
    match expression:
        case Paren(inner):
            type_ = _place(inner, body, reads=reads)
        case Index(target, _):
            type_ = _indexed(expression, _place(target, body, reads=reads), body)
        case Name() | Member():
            if isinstance(expression, Member):
                type_of(expression.target, body)
            type_ = place_of(expression, body, reads=reads)
        case Broken():
            return type_of(expression, body)
        case _:
            type_of(expression, body)
            body.facts.error("RS314", expression.span, "only a variable can be assigned")
            return None
    return body.facts.note_type(expression, type_)


# --- parts of compound expressions --------------------------------------------------------------


def _indexed(expression: Index, target: Type | None, body: Body) -> Type | None:
    facts = body.facts
    index = type_of(expression.index, body)
    if index is not None and not is_integer(index):
        facts.error("RS309", expression.index.span, f'an index must be an integer, not "{index}"')
    if target is None:
        return None
    if not target.dimensions:
        message = f'a value of type "{target}" has no elements'
        facts.error("RS308", expression.span, message)
        return None
    position, length = facts.value(expression.index), target.dimensions[0]
    if isinstance(position, int) and not 0 <= position < length:
        message = f'the index {position} is outside "{target}"'
        facts.warn("RS513", expression.index.span, message, f"indices go from 0 to {length - 1}")
    return element(target)


def _cast(expression: Cast, body: Body) -> Type | None:
    source = type_of(expression.operand, body)
    target = resolve_class(body.facts, expression.type)
    if source is None or target is None:
        return target
    if not casts(source, target, body.facts.classes):
        message = f'a value of type "{source}" cannot be cast to "{target}"'
        body.facts.error("RS303", expression.span, message)
    return target


def _instance_of(expression: InstanceOf, body: Body) -> Type:
    source = type_of(expression.operand, body)
    target = resolve_class(body.facts, expression.type)
    for type_, span in ((source, expression.operand.span), (target, expression.type.span)):
        if type_ is not None and not is_rebec(type_):
            message = f'instanceof compares rebecs with classes, not "{type_}"'
            body.facts.error("RS313", span, message)
    return BOOLEAN


def _conditional(expression: Conditional, body: Body) -> Type | None:
    check_condition(expression.condition, type_of(expression.condition, body), "?:", body)
    then, otherwise = type_of(expression.then, body), type_of(expression.otherwise, body)
    if then is None or otherwise is None:
        return None
    both = common(then, otherwise, body.facts.classes)
    if both is None:
        message = f'the alternatives have the types "{then}" and "{otherwise}"'
        body.facts.error("RS307", expression.span, message, "both must be of one type")
    return both


def _choice(expression: Choice, body: Body) -> Type | None:
    types = [type_of(option, body) for option in expression.options]
    return check_choice(expression, types, body)


# --- calls -------------------------------------------------------------------------------------


def _call(call: Call, body: Body) -> Type | None:
    receiver = _receiver(call, body)
    arguments = tuple(_argument(call, a, body) for a in call.arguments)
    for time, word in ((call.after, "after"), (call.deadline, "deadline")):
        if time is not None:
            check_time(time, type_of(time, body), word, body)
    return call_type(call, receiver, arguments, body)


def _receiver(call: Call, body: Body) -> Receiver:
    if call.target is None:
        return Receiver(None, implicit=True)
    inner = bare(call.target)
    type_ = type_of(call.target, body)
    return Receiver(type_, to_self=isinstance(inner, Self), to_super=isinstance(inner, Super))


def _argument(call: Call, argument: Expression, body: Body) -> Type | None:
    if isinstance(argument, StringLiteral) and call.target is None and call.name == "assertion":
        return body.facts.note_type(argument, STRING)
    return type_of(argument, body)


def fits(expression: Expression, target: Type | None, body: Body) -> None:
    """Types an expression and checks that its value can become one of type `target`."""
    source = type_of(expression, body)
    if source is not None and target is not None:
        check_conversion(expression, source, target, body)
