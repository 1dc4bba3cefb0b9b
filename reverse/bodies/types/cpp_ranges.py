"""Which values an integer of C++ can have, as far as its type and its operands say."""

from __future__ import annotations

import re
from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.intervals import (
    INT32,
    INTEGERS,
    TRUTH,
    Interval,
    exactly,
    of_binary,
    of_bits,
    of_unary,
    unsigned,
    within_int,
)
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_places import HELD, resolve
from rebsync.reverse.bodies.scope import Called, Inline, Lambda, Meaning, Record, Scope, Variable
from rebsync.reverse.bodies.types.cpp_conversions import variable_of
from rebsync.reverse.bodies.types.cpp_types import Carried
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_numerals import numeral
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.static.constants import constant
from rebsync.static.types import is_boolean

COMPARES = frozenset({"<", ">", "<=", ">=", "==", "!="})
LOGICAL = frozenset({"&&", "||", "and", "or", "not", "!"})
INT_BITS = 31  # without the sign
_SIZES = frozenset({"size", "length", "max_size", "capacity", "count", "strlen", "distance"})
NAMES_WIDE = re.compile(r"unsigned|long|size|uint|int64|32_t|64_t")
_SAME = frozenset({"std::move", "std::abs", "abs", "narrow", "widen"})


@dataclass(frozen=True, slots=True)
class Ranged:
    """What the integer that an expression gives can be, of a type with so many bits."""

    bits: int
    values: Interval

    @property
    def fits(self) -> bool:
        """Whether the model's `int` is the same number."""
        return INT32.includes(self.values)


def all_of(bits: int) -> Ranged:
    """Any value of a type."""
    return Ranged(bits, of_bits(bits))


def as_type(found: Ranged, bits: int) -> Ranged:
    """What becomes of a number in a type."""
    return Ranged(bits, found.values.in_type(of_bits(bits)))


def _int(values: Interval) -> Ranged:
    return Ranged(INT_BITS, values)


def range_of(cpp: Cpp, scope: Scope, node: Node) -> Ranged | None:
    """What an integer can be; None for other values, and those that nobody knows."""
    match node.type:
        case "number_literal":
            return _literal(text_of(node))
        case "char_literal" | "true" | "false":
            return _int(unsigned(8))
        case "sizeof_expression":
            return Ranged(64, unsigned(8))
        case "identifier" | "qualified_identifier" | "field_expression" | "subscript_expression":
            return _named(scope, node)
        case "pointer_expression":
            return _named(scope, node)
        case "parenthesized_expression" if len(named(node)) == 1:
            return range_of(cpp, scope, named(node)[0])
        case "comma_expression" | "assignment_expression":
            last = node.type == "comma_expression"
            return range_of(cpp, scope, part(node, "right" if last else "left"))
        case "unary_expression" | "update_expression":
            return _changed(cpp, scope, node)
        case "binary_expression":
            sides = (range_of(cpp, scope, part(node, side)) for side in ("left", "right"))
            return _computed(text_of(part(node, "operator")), *sides)
        case "conditional_expression":
            _, then, otherwise = named(node)
            ways = (range_of(cpp, scope, way) for way in (then, otherwise))
            return _either(*ways)
        case "cast_expression":
            return _cast(cpp, scope, part(node, "type"), [part(node, "value")])
        case "compound_literal_expression":
            return _cast(cpp, scope, part(node, "type"), named(part(node, "value")))
        case "call_expression":
            return _called(cpp, scope, node)
        case _:
            return None


def _literal(text: str) -> Ranged | None:
    found = numeral(text)
    if found is None or found.whole is None:
        return None
    suffix, value = found.suffix.lower(), abs(found.whole)
    bits = (64 if "l" in suffix else 32) if "u" in suffix else (63 if "l" in suffix else INT_BITS)
    steps = (bits, *(b for b in (32, 63, 64) if b > bits and (b == 63 or not found.is_decimal)))
    bits = next((b for b in steps if value < 1 << b), 64)
    return Ranged(bits, exactly(found.whole))


def _of_type(kept: Carried) -> Ranged | None:
    if kept.wide:
        return all_of(kept.wide)
    if kept.bits:
        return _int(unsigned(kept.bits))
    return _of_model(kept.type)


def _of_model(type_: m.Type) -> Ranged | None:
    values = TRUTH if is_boolean(type_) else INTEGERS.get(type_.name)
    return _int(values) if values is not None else None


def _variable(scope: Scope, variable: Variable) -> Ranged | None:
    if variable.wide:
        whole = of_bits if variable.name in scope.overflowing else within_int
        return Ranged(variable.wide, whole(variable.wide))
    if variable.type is None:
        return None
    return _of_type(Carried(m.Type(variable.type.name), variable.bits))


def _named(scope: Scope, node: Node) -> Ranged | None:
    place = node
    while place.type == "subscript_expression":
        place = part(place, "argument")
    match resolve(scope, place):
        case Variable() as variable:
            return _variable(scope, variable)
        case m.IntLiteral() | m.Unary() | m.Binary() | m.Paren() as value:
            known = constant(value)
            if isinstance(known, int):
                return _int(exactly(int(known)))
            return _int(INT32) if known is None else None
        case m.Index(m.Name(name)):
            array = variable_of(scope, name)
            return _variable(scope, array) if array is not None else _int(INT32)
        case None:
            return _constant(scope, text_of(node))
        case m.FloatLiteral() | m.BoolLiteral() | m.StringLiteral():
            return None
        case _:
            return _int(INT32)


def _constant(scope: Scope, name: str) -> Ranged | None:
    for spelled in (name, name.rpartition("::")[2]):
        if spelled in scope.enumerators:
            value = scope.enumerators[spelled]
            if isinstance(value, str):
                return None
            number = _int(exactly(value))
            return number if number.fits else all_of(63)
        if spelled in scope.constants:
            cpp, node = scope.constants[spelled]
            found = range_of(cpp, scope.without_constant(spelled), node)
            above = climb(node, lambda n: n.type in ("declaration", "field_declaration"))
            kept = scope.carried(part(above, "type")) if above is not None else None
            whole = _of_type(kept) if kept is not None else None
            return as_type(found, whole.bits) if found is not None and whole is not None else found
    return None


def _changed(cpp: Cpp, scope: Scope, node: Node) -> Ranged | None:
    operator = text_of(part(node, "operator"))
    argument = part(node, "argument")
    found = range_of(cpp, scope, argument)
    if operator in LOGICAL:
        return _int(TRUTH)
    if found is None:
        return None
    match operator:
        case "-" | "~":
            values = of_unary(operator, found.values)
        case "++" | "--" if argument.start_byte != node.start_byte:
            values = of_binary(operator[0], found.values, exactly(1))
        case _:
            return found
    return as_type(Ranged(found.bits, values), found.bits)


def _computed(operator: str, left: Ranged | None, right: Ranged | None) -> Ranged | None:
    if operator in COMPARES or operator in LOGICAL:
        return _int(TRUTH)
    if left is None or right is None:
        return None
    if operator in ("<<", ">>"):
        bits = left.bits
    else:
        left, right = _of_one_type(left, right)
        bits = left.bits
    return as_type(Ranged(bits, of_binary(operator, left.values, right.values)), bits)


def _of_one_type(one: Ranged, other: Ranged) -> tuple[Ranged, Ranged]:
    """Two operands after the conversion to the wider type."""
    bits = max(one.bits, other.bits)
    return as_type(one, bits), as_type(other, bits)


def _either(then: Ranged | None, otherwise: Ranged | None) -> Ranged | None:
    if then is None or otherwise is None:
        return None
    then, otherwise = _of_one_type(then, otherwise)
    return Ranged(then.bits, then.values.join(otherwise.values))


def _cast(cpp: Cpp, scope: Scope, to: Node, values: Sequence[Node]) -> Ranged | None:
    kept = scope.carried(to)
    whole = _of_type(kept) if kept is not None else None
    found = range_of(cpp, scope, values[0]) if len(values) == 1 else None
    if whole is None or found is None:
        return whole
    return Ranged(whole.bits, found.values.in_type(whole.values))


# --- calls --------------------------------------------------------------------------------------


def _called(cpp: Cpp, scope: Scope, node: Node) -> Ranged | None:
    function, arguments = part(node, "function"), named(part(node, "arguments"))
    if isinstance(place := resolve(scope, node), Variable):
        return _variable(scope, place)
    if function.type == "field_expression":
        name = text_of(part(function, "field"))
        if name == "value_or":
            return _or_other(scope, resolve(scope, part(function, "argument")))
        if name in ("load", "get"):
            return _named(scope, part(function, "argument"))
        if name in _SIZES:
            return Ranged(64, unsigned(31))
        return None if name == "toSec" else _result(scope, name)
    if function.type == "lambda_expression":
        return _of_lambda(text_of(function))
    name = text_of(function)
    plain, _, given = name.partition("<")
    types = part(function, "arguments") if function.type == "template_function" else None
    if plain in ("static_cast", "narrow_cast", "boost::numeric_cast") and types is not None:
        return _cast(cpp, scope, named(types)[0], arguments)
    kept = scope.carried(function) if len(arguments) == 1 else None
    if kept is not None:
        return _cast(cpp, scope, function, arguments)
    if plain.rpartition("::")[2] in _SIZES:
        return Ranged(64, unsigned(31))
    if plain in ("std::count", "std::count_if"):
        return Ranged(63, unsigned(31))
    if plain in _SAME and len(arguments) == 1:
        found = range_of(cpp, scope, arguments[0])
        return all_of(found.bits) if found is not None else None
    if plain.rpartition("::")[2] in ("min", "max", "clamp"):
        return _widest(cpp, scope, arguments, given.rstrip(">"))
    return _result(scope, plain.rpartition("::")[2])


def _or_other(scope: Scope, optional: Meaning | None) -> Ranged | None:
    """The value of an optional, or another one of its type."""
    held = optional.fields.get(HELD) if isinstance(optional, Record) else None
    if held is None or held.wide:
        return all_of(held.wide if held is not None else 64)
    return _variable(scope, held)


def _widest(cpp: Cpp, scope: Scope, arguments: Sequence[Node], given: str) -> Ranged | None:
    inner = [v for a in arguments for v in (named(a) if a.type == "initializer_list" else [a])]
    found = [range_of(cpp, scope, value) for value in inner]
    whole = None
    for each in found:
        whole = _either(whole, each) if whole is not None else each
    return all_of(64) if whole is not None and NAMES_WIDE.search(given) else whole


def _result(scope: Scope, name: str) -> Ranged | None:
    """What a function of the code gives, by the type of its result."""
    match scope.locals.get(name) or scope.functions.get(name):
        case Inline(function) if function.result is not None:
            return _of_result(scope, function.result)
        case Called(overloads=(first, *others)) if first.result is not None:
            found = _of_result(scope, first.result)
            results = (f.result for f in others)
            same = all(r is not None and _of_result(scope, r) == found for r in results)
            return found if same else all_of(64)
        case Called(returns=type_) if type_ is not None:
            return _of_model(type_)
        case Lambda(node):
            return _of_lambda(text_of(node))
        case _:
            return None


def _of_result(scope: Scope, result: Node) -> Ranged | None:
    kept = scope.carried(result)
    return _of_type(kept) if kept is not None else _of_lambda(text_of(result))


def _of_lambda(text: str) -> Ranged | None:
    """What a function gives whose type is not looked for."""
    return all_of(64) if NAMES_WIDE.search(text) else None
