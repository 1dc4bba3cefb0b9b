"""Functions and constants of C++'s and ROS's libraries as expressions of the model."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from itertools import islice

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import cpp_algorithms, cpp_atomics, cpp_optional_calls, cpp_texts
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader, Exchange
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.cpp_time import is_flat, time_called, to_seconds
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.bodies.effects.cpp_effects import Effects
from rebsync.reverse.bodies.scope import Called, Record, Variable
from rebsync.reverse.bodies.types.cpp_conversions import as_number, operands, type_in
from rebsync.reverse.bodies.types.cpp_literals import lower
from rebsync.reverse.bodies.types.cpp_widths import check_whole, check_wide_call
from rebsync.reverse.findings import Unread
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.models.building import binary, cast, chosen, is_calm, tight
from rebsync.reverse.models.texts import text_literal
from rebsync.reverse.syntax.cpp_declarations import CppParameter
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.source import Span
from rebsync.static.constants import constant
from rebsync.static.types import DOUBLE, INT, is_floating, is_integer

_LEAST = -0x80000000
_LARGE = 200  # parts of an expression
_LIMITS = {
    **{"INT_MAX": 2**31 - 1, "INT_MIN": _LEAST, "INT32_MAX": 2**31 - 1, "INT32_MIN": _LEAST},
    **{"INT8_MAX": 127, "INT8_MIN": -128, "INT16_MAX": 2**15 - 1, "INT16_MIN": -(2**15)},
    **{"UINT8_MAX": 255, "UINT16_MAX": 2**16 - 1, "SHRT_MAX": 2**15 - 1, "SHRT_MIN": -(2**15)},
}
_REAL = {"M_PI": "3.141592653589793d", "M_PI_2": "1.5707963267948966d", "M_E": "2.718281828459045d"}
# What has a method `now` in ROS 2: clocks and nodes.
_CLOCKS = re.compile(r"(?i)(?!.*chrono)(?:.*clock\w*(?:\(.*\))?|.*node_?|nh_?|n_?)\Z", re.DOTALL)
_NODES = re.compile(r"(?i)(?:nh|node|handle|n)_?\Z|.*(?:nh|node_?handle)_?\Z")
_LIMIT = re.compile(r"(?:std::)?numeric_limits<\s*(?:int|int32_t|std::int32_t)\s*>::(\w+)\Z")


def whole(value: int, span: Span) -> m.Expression:
    """An integer as an expression; of a larger one the lower bits."""
    value = lower(value)
    if value < 0:
        return m.Unary("-", m.IntLiteral(-value, span), span)
    return m.IntLiteral(value, span)


def enumerator(value: int | str, span: Span) -> m.Expression:
    """A constant of an enumeration or message."""
    return text_literal(value, span) if isinstance(value, str) else whole(value, span)


def constant_named(name: str, span: Span) -> m.Expression | None:
    """A constant of the library."""
    if name in _LIMITS:
        return whole(_LIMITS[name], span)
    return m.FloatLiteral(_REAL[name], span) if name in _REAL else None


def call(
    reader: CppExpressionReader, node: Node, name: str, arguments: Sequence[Node]
) -> m.Expression | None:
    """The call of a function of a library, if the model can say what it gives."""
    span, count = reader.cpp.span(node), len(arguments)
    plain = name.partition("<")[0].removeprefix("std::").removeprefix("boost::")
    if plain in ("pow", "sqrt", "floor", "ceil", "round", "trunc"):
        for argument in arguments:
            check_whole(reader, argument)
    _check_explicit(reader, node, arguments)
    match plain, count:
        case _, 0 if plain in libraries.names_of(Kind.RUNNING, result="bool"):
            return m.BoolLiteral(True, span)
        case "min" | "max", 2:
            check_wide_call(reader, node)
            return _least(reader, arguments, plain)
        case "min" | "max", 1 if arguments[0].type == "initializer_list":
            return _least(reader, named(arguments[0]), plain)
        case "clamp" | "math::clamp" | "algorithm::clamp", 3:
            value, low, high = _calm(reader, arguments)
            return _lesser(reader, _lesser(reader, value, low, ">"), high, "<")
        case "abs" | "fabs" | "labs" | "fabsf", 1:
            return _magnitude(reader, arguments[0], plain)
        case "floor" | "ceil" | "round" | "trunc", 1:
            return _rounded(reader, arguments[0])
        case "exchange", 2 if name.startswith("std::"):
            return reader.inlined(node, Exchange(arguments[0], arguments[1]), ())
        case "isnan", 1:
            (value,) = _calm(reader, arguments)
            return binary("!=", value, value)
        case "pow", 2:
            return reader.calls(node, None, plain, arguments)
        case "sqrt", 1:
            return reader.calls(node, None, plain, arguments)
    if (found := cpp_algorithms.call(reader, plain, arguments)) is not None:
        return found
    if (limit := _LIMIT.match(name)) is not None and count == 0:
        least = limit[1] in ("min", "lowest")
        return whole(_LEAST if least else 2**31 - 1, span) if least or limit[1] == "max" else None
    kept = reader.scope.carried(_function(node)) if count == 1 else None
    if kept is not None and not name.startswith(libraries.scopes()):
        return reader.cast(_function(node), arguments[0], node)
    return time_called(reader, node, name, list(arguments))


def _check_explicit(reader: CppExpressionReader, node: Node, arguments: Sequence[Node]) -> None:
    """Raises where `std::min<int8_t>(a, b)` makes other numbers of what it is given."""
    function = _function(node)
    while function.type == "qualified_identifier":
        function = part(function, "name")
    types = named(part(function, "arguments")) if function.type == "template_function" else []
    lists = (named(a) if a.type == "initializer_list" else [a] for a in arguments)
    values = [value for each in lists for value in each] if types else []
    for kept in map(reader.scope.carried, types):
        if kept is None or (kept.wide and reader.scope.open):  # that is `check_wide_call`'s
            continue
        for argument in values:
            of = type_in(reader.scope, reader.read(argument))
            is_same = of == kept.type or (of is not None and is_integer(of) and kept.type == INT)
            if kept.bits or kept.wide or not is_same:
                raise reader.unread(argument, "this is converted before it is used")


def _function(node: Node) -> Node:
    return node.children_by_field_name("function")[0]


def _calm(reader: CppExpressionReader, nodes: Sequence[Node]) -> list[m.Expression]:
    """Operands that may be evaluated more than once."""
    read = [as_number(reader.scope, reader.read(n)) for n in nodes]
    for node, value in zip(nodes, read, strict=True):
        check_whole(reader, node)
        cpp_texts.check_no_text(reader, node, value)
        if not is_calm(value) or _is_large(value):
            raise reader.unread(node, "the model would do this more than once", "use a local")
    return read


def _is_large(value: m.Expression) -> bool:
    """Whether an expression has too many parts to stand in the model several times."""
    return len(list(islice(m.walk(value), _LARGE))) == _LARGE


def _least(reader: CppExpressionReader, nodes: Sequence[Node], name: str) -> m.Expression:
    """The least, or the greatest, of some values."""
    first, *others = _calm(reader, nodes)
    for other in others:
        first = _lesser(reader, first, other, "<" if name == "min" else ">")
    return first


def _lesser(
    reader: CppExpressionReader, left: m.Expression, right: m.Expression, sign: str
) -> m.Expression:
    """The one of two values that is first by `sign`; of equal ones the first."""
    opposite = {"<": ">", ">": "<"}[sign]
    _, low, high = operands(reader.scope, "<", left, right)
    return chosen(binary(opposite, low, high), right, left)


def _magnitude(reader: CppExpressionReader, node: Node, name: str) -> m.Expression:
    (value,) = _calm(reader, [node])
    of = type_in(reader.scope, value)
    if name.startswith("f") and of is not None and is_integer(of):
        value = cast(DOUBLE, value)
    number = constant(value)
    if number is not None and not isinstance(number, bool) and number >= 0:
        return value
    zero: m.Expression = m.IntLiteral(0)
    if of is not None and is_floating(of):
        zero = m.FloatLiteral("0.0")
    return chosen(binary("<", value, zero), m.Unary("-", tight(value, 13)), value)


def _rounded(reader: CppExpressionReader, node: Node) -> m.Expression | None:
    """Rounding changes nothing of an integer; the model cannot round others."""
    value = reader.read(node)
    of = type_in(reader.scope, value)
    return cast(DOUBLE, value) if of is not None and is_integer(of) else None


def drawn(reader: CppExpressionReader, node: Node, sides: Sequence[Node]) -> m.Expression | None:
    """`rand() % n` as a choice of `0` to `n - 1`; None for another remainder."""
    left, right = sides
    while left.type == "parenthesized_expression":
        left = reader.only(left)
    if left.type != "call_expression" or text_of(left) not in ("rand()", "std::rand()", "random()"):
        return None
    count = constant(reader.read(right))
    if not isinstance(count, int) or not 0 < count <= 256:
        raise reader.unread(node, "the model cannot choose among so many values")
    if not reader.scope.chooses:
        raise reader.unread(node, "only a message server can choose")
    if count == 1:
        return m.IntLiteral(0, reader.cpp.span(node))
    return m.Choice(tuple(m.IntLiteral(n) for n in range(count)), reader.cpp.span(node))


# --- functions of objects -----------------------------------------------------------------------


def member_call(
    reader: CppExpressionReader, node: Node, target: Node, name: str, arguments: Sequence[Node]
) -> m.Expression | None:
    """The call of a function of an array, an atomic object, a time or a node handle."""
    if (found := cpp_texts.call(reader, node, target, name, arguments)) is not None:
        return found
    if (kept := cpp_optional_calls.call(reader, node, target, name, arguments)) is not None:
        return kept
    if (held := cpp_atomics.call(reader, node, target, name, arguments)) is not None:
        return held
    if arguments:
        return None
    if name == "toSec" or (name == "seconds" and _asks_now(target) and is_flat(reader)):
        return to_seconds(reader, target)
    if name == "now" and is_flat(reader) and _CLOCKS.match(text_of(target)):
        return m.Name("now", reader.cpp.span(node))
    if name.partition("<")[0] in libraries.named(Kind.VALUE) and target.type == "call_expression":
        return reader.read(target)
    if name == "ok" and _NODES.match(text_of(target)):
        return m.BoolLiteral(True, reader.cpp.span(node))
    meaning = resolve(reader.scope, target)
    if not isinstance(meaning, Variable) or meaning.type is None:
        return None
    if not meaning.type.dimensions:
        match name:
            case "get":
                return reader.read(target)
            case "isZero":
                return binary("==", reader.read(target), m.IntLiteral(0))
        return None
    length = meaning.type.dimensions[0]
    match name:
        case "size" | "max_size":
            return m.IntLiteral(length, reader.cpp.span(node))
        case "empty":
            return m.BoolLiteral(length == 0, reader.cpp.span(node))
        case "front":
            return m.Index(reader.read(target), m.IntLiteral(0), reader.cpp.span(node))
        case "back":
            return m.Index(reader.read(target), m.IntLiteral(length - 1), reader.cpp.span(node))
        case _:
            return None


def _asks_now(target: Node) -> bool:
    """Whether it is the time that a node or a clock of ROS 2 gives."""
    return target.type == "call_expression" and text_of(target).endswith("now()")


# --- arguments ----------------------------------------------------------------------------------


def passed(
    reader: CppExpressionReader, node: Node, called: Called, arguments: Sequence[Node]
) -> tuple[m.Expression, ...]:
    """What a local method gets of the arguments of a call."""
    found: list[m.Expression] = []
    takes = called.takes or ()
    if len(arguments) > len(takes):
        raise reader.unread(node, "there are more arguments here than parameters")
    for number, take in enumerate(takes):
        if number >= len(arguments):
            if isinstance(take, m.Type) and called.function is not None:
                parameter = called.function.parameters[number]
                found.append(left_out(reader, node, parameter, Variable("", take)))
            elif take is not None and take != ():
                raise reader.unread(node, "what is left out of this call is not known")
            continue
        argument = arguments[number]
        match take:
            case None:
                Effects(reader.cpp, reader.scope).check(argument)
            case m.Type():
                found.append(reader.stored(argument, Variable("", take)))
            case paths:
                found += fields_of(reader, argument, paths)
    return tuple(found)


def left_out(
    reader: CppExpressionReader, node: Node, parameter: CppParameter, place: Variable
) -> m.Expression:
    """What a parameter is that a call leaves out, where nothing of the caller's is in it."""
    if parameter.default is None:
        raise reader.unread(node, "what is left out of this call is not known")
    cpp, value = parameter.default
    scope = replace(reader.scope, locals={})
    try:
        return replace(reader, cpp=cpp, scope=scope, findings=None, inlines=None).stored(
            value, place
        )
    except Unread as unread:
        raise reader.unread(node, f"what is left out of this call: {unread.why}") from None


def fields_of(
    reader: CppExpressionReader, argument: Node, paths: Sequence[str]
) -> list[m.Expression]:
    """Fields of a message by their paths."""
    if not paths:
        return []
    record = resolve(reader.scope, argument)
    if not isinstance(record, Record):
        raise Unknown(reader.cpp.span(argument), f'the model cannot know "{text_of(argument)}"')
    found: list[m.Expression] = []
    for path in paths:
        if path not in record.fields:
            why = f'the model cannot know "{text_of(argument)}.{path}"'
            raise Unknown(reader.cpp.span(argument), why)
        found.append(m.Name(record.fields[path].name))
    return found
