"""Expressions, from left to right: each pushes the cells of its value."""

from __future__ import annotations

from collections.abc import Callable

from rebsync.checker.lowering import calls, waiting
from rebsync.checker.lowering.conversions import constant, convert, met, promoted
from rebsync.checker.lowering.emitter import Emitter, kind_of, size_of
from rebsync.checker.lowering.places import Place, index_by, index_pushed, kept, push, store
from rebsync.checker.lowering.tables import env_table
from rebsync.checker.program import KINDS, NULL, Kind
from rebsync.checker.values import stored
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
from rebsync.static.constants import float_value
from rebsync.static.symbols import (
    BuiltinSymbol,
    EnvSymbol,
    KnownRebecSymbol,
    LocalSymbol,
    ParameterSymbol,
    StateSymbol,
    Symbol,
)

_CLOCK = {
    "now": "NOW",
    "currentMessageArrival": "ARRIVAL",
    "currentMessageDeadline": "DEADLINE",
    "sender": "SENDER",
}
_OPERATORS = {
    "+": "ADD",
    "-": "SUB",
    "*": "MUL",
    "/": "DIV",
    "%": "MOD",
    "&": "AND",
    "|": "OR",
    "^": "XOR",
    "<<": "SHL",
    ">>": "SHR",
    "==": "EQ",
    "!=": "NE",
    "<": "LT",
    "<=": "LE",
    ">": "GT",
    ">=": "GE",
}
_COMPARISONS = frozenset(("==", "!=", "<", "<=", ">", ">="))


def type_of(node: Expression, e: Emitter) -> Type:
    """The static type of an expression of the model."""
    type_ = e.world.analysis.type_of(node)
    assert type_ is not None, node
    return type_


def value(node: Expression, e: Emitter) -> Kind:
    """Pushes the value of an expression; gives the kind of its cells."""
    match node:
        case IntLiteral(number):
            e.emit("CONST", number)
            return "int"
        case BoolLiteral(truth):
            e.emit("CONST", int(truth))
            return "boolean"
        case FloatLiteral(text):
            kind: Kind = "double" if node.is_double else "float"
            constant(float_value(text), kind, e)
            return kind
        case NullLiteral():
            e.emit("CONST", NULL)
            return "rebec"
        case Paren(inner):
            return value(inner, e)
        case Self():
            e.emit("SELF")
            return "rebec"
        case Name() | Member() | Index():
            return _variable(node, e)
        case Unary("++" | "--" as operator, operand):
            return _step(operator, operand, e, prefix=True)
        case Postfix(operator, operand):
            return _step(operator, operand, e, prefix=False)
        case Unary(operator, operand):
            return _unary(operator, operand, e)
        case Binary():
            return _binary(node, e)
        case Assign():
            return assign(node, e, used=True)
        case Call():
            return calls.call(node, e, value)
        case _:
            return _compound(node, e)


def _compound(node: Expression, e: Emitter) -> Kind:
    match node:
        case Cast(type_, operand):
            target = kind_of(type_)
            convert(value(operand, e), target, e)
            return target
        case Conditional(condition, then, otherwise):
            return _conditional(condition, then, otherwise, promoted(kind_of(type_of(node, e))), e)
        case Choice(options):
            kind = kind_of(type_of(node, e))
            e.emit("CHOICE", KINDS.index(kind), 0, tuple(_option(o, kind, e) for o in options))
            return kind
        case InstanceOf(operand, type_):
            value(operand, e)
            e.emit("IS", 0, 0, e.world.descendants(type_.name))
            return "boolean"
        case StringLiteral() | Super() | New() | Broken() | _:
            raise AssertionError(f"not a value: {node}")


def _option(option: Expression, kind: Kind, e: Emitter) -> int:
    found = e.world.analysis.value_of(option)
    assert found is not None, option
    return stored(found, kind)


def _constant(type_: Type, name: str) -> str:
    """A constant of the model, with the kind of its cells."""
    return f"{kind_of(type_)} {name}"


def as_kind(node: Expression, kind: Kind, e: Emitter) -> None:
    """Pushes the value of an expression as one of a kind; arrays keep theirs."""
    convert(value(node, e), kind, e)


def discard(node: Expression, e: Emitter) -> None:
    """Evaluates an expression for its effects."""
    match node:
        case Paren(inner):
            discard(inner, e)
        case Assign():
            assign(node, e, used=False)
        case Conditional(condition, then, otherwise):  # of sends, too, which have no value
            _either(condition, lambda: discard(then, e), lambda: discard(otherwise, e), e)
        case _:
            value(node, e)
            for _ in range(size_of(type_of(node, e))):
                e.emit("POP")


# --- variables ---------------------------------------------------------------------------------


def place(node: Expression, e: Emitter) -> Place:
    """Where a variable or element is; a computed offset is left on the stack."""
    match node:
        case Paren(inner):
            return place(inner, e)
        case Index(target, index):
            array = place(target, e)
            if isinstance(index, IntLiteral) and 0 <= index.value < array.type.dimensions[0]:
                return index_by(array, index.value, e)
            with e.at(node.span):
                as_kind(index, "int", e)
                return index_pushed(array, e)
        case Name() | Member():
            return symbol_place(e.world.analysis.symbol_of(node), e)
        case _:
            return _temporary(node, e)


def _temporary(node: Expression, e: Emitter) -> Place:
    """The cells of an array that is no variable, such as the result of a method."""
    type_ = type_of(node, e)
    value(node, e)
    held = Place("LOCAL", e.allocate(size_of(type_)), type_)
    store(held, e)
    return held


def symbol_place(symbol: Symbol | None, e: Emitter) -> Place:
    """Where the value of a symbol is kept."""
    match symbol:
        case StateSymbol(name, _, owner):
            slot = e.state[f"{owner}.{name}"]
            return Place("VAR", slot.offset, slot.type)
        case LocalSymbol(_, _, declaration) | ParameterSymbol(_, _, declaration):
            slot = e.slots[id(declaration)]
            return Place("LOCAL", slot.offset, slot.type)
        case EnvSymbol(_, type_, declaration):
            assert type_ is not None
            table = env_table(declaration, type_, e.world.analysis)
            return Place(
                "TABLE", 0, type_, table=table, constant=_constant(type_, declaration.name)
            )
        case _:
            raise AssertionError(f"not a variable: {symbol}")


def _variable(node: Name | Member | Index, e: Emitter) -> Kind:
    symbol = e.world.analysis.symbol_of(node) if not isinstance(node, Index) else None
    match symbol:
        case KnownRebecSymbol(name, _, owner):
            e.emit("KNOWN", e.known[f"{owner}.{name}"])
            return "rebec"
        case BuiltinSymbol(waiting.NAME):
            waiting.push(e)
            return "int"
        case BuiltinSymbol(name):
            e.emit(_CLOCK[name])
            return "rebec" if name == "sender" else "int"
        case EnvSymbol(name, type_, _, number) if number is not None and type_ is not None:
            constant(number, kind_of(type_), e, e.mark(_constant(type_, name)))
            return kind_of(type_)
    with e.scope():
        found = place(node, e)
        push(found, e)
    return found.kind


# --- operators ---------------------------------------------------------------------------------


def _unary(operator: str, operand: Expression, e: Emitter) -> Kind:
    if operator == "-" and isinstance(operand, IntLiteral):
        e.emit("CONST", -operand.value)
        return "int"
    kind = promoted(value(operand, e))
    match operator:
        case "-":
            e.emit("NEG" if kind == "int" else "FNEG")
        case "~":
            e.emit("INV")
        case "!":
            e.emit("NOT")
    return kind


def _binary(node: Binary, e: Emitter) -> Kind:
    if node.operator in ("&&", "||"):
        value(node.left, e)
        decide(node.operator, lambda: value(node.right, e), e)
        return "boolean"
    kind = met(kind_of(type_of(node.left, e)), kind_of(type_of(node.right, e)))
    as_kind(node.left, kind, e)
    as_kind(node.right, kind, e)
    with e.at(node.span):
        return operate(node.operator, kind, e)


def decide(operator: str, right: Callable[[], object], e: Emitter) -> None:
    """`&&` or `||` with the left value on the stack; `right` pushes the other if it matters."""
    end = [e.emit("JUMPF" if operator == "&&" else "JUMPT", 0, 1)]
    right()
    end.append(e.emit("JUMP"))
    e.patch(end[0])
    e.emit("CONST", int(operator == "||"))
    e.patch(end[1])


def operate(operator: str, kind: Kind, e: Emitter) -> Kind:
    """Applies an operator to the two values on the stack, both of a kind."""
    name = _OPERATORS[operator]
    real = kind in ("float", "double")
    e.emit(f"F{name}" if real else name)
    if operator in _COMPARISONS:
        return "boolean"
    if kind == "float":
        e.emit("SINGLE")
    return kind


def _conditional(
    condition: Expression, then: Expression, otherwise: Expression, kind: Kind, e: Emitter
) -> Kind:
    _either(condition, lambda: as_kind(then, kind, e), lambda: as_kind(otherwise, kind, e), e)
    return kind


def _either(
    condition: Expression, then: Callable[[], None], otherwise: Callable[[], None], e: Emitter
) -> None:
    """Emits one of two alternatives, each by what emits it."""
    value(condition, e)
    with e.at(condition.span):
        other = e.emit("JUMPF")
    then()
    end = e.emit("JUMP")
    e.patch(other)
    otherwise()
    e.patch(end)


# --- assignments -------------------------------------------------------------------------------


def assign(node: Assign, e: Emitter, *, used: bool) -> Kind:
    """Stores a value; pushes what was stored if it is used."""
    with e.scope(), e.at(node.span):
        target = place(node.target, e)
        if used or node.operator != "=" or target.size > 1:
            target = kept(target, e)
        if node.operator == "=":
            as_kind(node.value, target.kind, e)
        else:
            _compound_value(node, target, e)
        store(target, e)
        if used:
            push(target, e)
    return target.kind


def _compound_value(node: Assign, target: Place, e: Emitter) -> None:
    push(target, e)
    kind = met(target.kind, kind_of(type_of(node.value, e)))
    convert(target.kind, kind, e)
    as_kind(node.value, kind, e)
    convert(operate(node.operator[:-1], kind, e), target.kind, e)


def _step(operator: str, operand: Expression, e: Emitter, *, prefix: bool) -> Kind:
    with e.scope():
        target = kept(place(operand, e), e)
        if not prefix:
            push(target, e)
        push(target, e)
        e.emit("CONST", 1)
        e.emit("ADD" if operator == "++" else "SUB")
        convert("int", target.kind, e)
        store(target, e)
        if prefix:
            push(target, e)
    return target.kind
