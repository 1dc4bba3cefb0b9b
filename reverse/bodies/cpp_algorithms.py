"""Algorithms of the standard library over all elements of an array of the model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import reduce

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.effects.known_functions import takes_values
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.bodies.types.cpp_conversions import operands, type_in
from rebsync.reverse.bodies.types.cpp_widths import check_whole, wide_of
from rebsync.reverse.models.building import binary, chosen, is_calm
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of
from rebsync.reverse.syntax.cpp_declarations import CppParameter, parameters_in
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of
from rebsync.static.types import INT, is_boolean, is_integer, is_numeric

EXTREMES = {"std::max_element": ">", "std::min_element": "<"}
_JOINING = {"==": "&&", "!=": "||"}
_TUPLES = frozenset({"std::tie", "std::make_tuple", "std::make_pair"})
_NAMES = ("identifier", "field_expression")
_BEGINS, _ENDS = ("begin", "cbegin"), ("end", "cend")
_MOST = 4  # elements of which a choice is written: each one more doubles what is to be said
_LONGEST = 32  # elements that are added up, or counted
_TESTING = frozenset({"count_if", "any_of", "all_of", "none_of"})
# What a lambda may capture that only looks, and is called at once: names, and the object.
_CAPTURED = frozenset({"lambda_default_capture", "identifier", "this"})


def dereferenced(reader: CppExpressionReader, node: Node) -> m.Expression | None:
    """`*std::max_element(a.begin(), a.end())` over a whole array; None for another `*e`."""
    argument = node.child_by_field_name("argument")
    call_ = call_of(argument) if argument is not None else None
    if call_ is None or call_.name not in EXTREMES or text_of(node).startswith("&"):
        return None
    elements = _elements(reader, call_.arguments, _MOST)
    if elements is None:
        return None
    sign = EXTREMES[call_.name]
    return reduce(lambda most, x: chosen(binary(sign, x, most), x, most), elements)


def call(reader: CppExpressionReader, name: str, arguments: Sequence[Node]) -> m.Expression | None:
    """What a call gives that adds up, counts or tests a whole array; None for other calls."""
    if name in _TESTING and len(arguments) == 3:
        return _tested(reader, name, arguments)
    if name not in ("accumulate", "count") or len(arguments) != 3:
        return None
    elements = _elements(reader, arguments[:2], _LONGEST)
    if elements is None:
        return None
    check_whole(reader, arguments[2])
    value = reader.read(arguments[2])
    if name == "accumulate":
        return _sum(reader, arguments[2], value, elements)
    if not is_calm(value):
        return None
    tests = (binary(*operands(reader.scope, "==", x, value)) for x in elements)
    ones = [m.Paren(chosen(t, m.IntLiteral(1), m.IntLiteral(0))) for t in tests]
    return _added(ones)


def _tested(
    reader: CppExpressionReader, name: str, arguments: Sequence[Node]
) -> m.Expression | None:
    """`std::count_if`, `any_of`, `all_of` and `none_of` with a lambda that only looks."""
    elements = _elements(reader, arguments[:2], _LONGEST)
    tests = [_answer(reader, arguments[2], x) for x in elements or ()]
    if not tests or None in tests:
        return None
    found: list[m.Expression] = [m.Paren(t) for t in tests if t is not None]
    if name == "count_if":
        return _added([m.Paren(chosen(t, m.IntLiteral(1), m.IntLiteral(0))) for t in found])
    operator = "&&" if name == "all_of" else "||"
    first, *others = found
    joined: m.Expression = reduce(lambda left, right: binary(operator, left, right), others, first)
    return m.Unary("!", m.Paren(joined)) if name == "none_of" else joined


def _answer(
    reader: CppExpressionReader, function: Node, element: m.Expression
) -> m.Expression | None:
    """What a lambda of one `return` says of an element; None of one that may do more."""
    declarator = function.child_by_field_name("declarator")
    if function.type != "lambda_expression" or declarator is None:
        return None
    parameters = list(parameters_in(part(declarator, "parameters")))
    body = named(part(function, "body"))
    if len(parameters) != 1 or [n.type for n in body] != ["return_statement"]:
        return None
    if not _is_same(reader, parameters[0], element) or not named(body[0]):
        return None
    if any(c.type not in _CAPTURED for c in named(part(function, "captures"))):
        return None
    inside = reader.scope.with_locals({parameters[0].name: element})
    alone = replace(reader, scope=inside, findings=None, inlines=None)
    said = alone.condition(named(body[0])[0])
    return said if is_calm(said) else None


def _is_same(reader: CppExpressionReader, parameter: CppParameter, element: m.Expression) -> bool:
    """Whether a parameter holds what an element does, as a copy or as one that nothing changes."""
    if not parameter.name or parameter.may_change:
        return False
    if parameter.type.type.startswith("placeholder") or text_of(parameter.type) == "auto":
        return True
    kept = reader.scope.carried(parameter.type)
    same = type_in(reader.scope, element)
    return kept is not None and kept.type == same and not (kept.bits or kept.wide)


def _added(summands: Sequence[m.Expression]) -> m.Expression:
    first, *others = summands
    return reduce(lambda left, right: binary("+", left, right), others, first)


def _sum(
    reader: CppExpressionReader, node: Node, start: m.Expression, elements: Sequence[m.Expression]
) -> m.Expression | None:
    """All of them added to what the sum begins with, whose type the sum has."""
    types = {type_in(reader.scope, x) for x in elements}
    of = None if isinstance(start, m.IntLiteral) else type_in(reader.scope, start)
    of = INT if node.type == "number_literal" else of
    whole = all(t is not None and is_integer(t) for t in types)
    if of != INT or not whole or not is_calm(start) or wide_of(reader, node):
        return None
    return _added(elements if start == m.IntLiteral(0) else (start, *elements))


def _elements(
    reader: CppExpressionReader, bounds: Sequence[Node], most: int
) -> list[m.Expression] | None:
    """The elements from one iterator to another: all of one array of numbers, and not too many."""
    array = whole_array(bounds)
    type_ = plain_type(reader, array) if array is not None else None
    if array is None or type_ is None or not 0 < type_.dimensions[0] <= most:
        return None
    target = reader.read(array)
    return [m.Index(target, m.IntLiteral(i)) for i in range(type_.dimensions[0])]


def whole_array(bounds: Sequence[Node]) -> Node | None:
    """The array of which two iterators are the begin and the end."""
    arrays = [_end(node, ends) for node, ends in zip(bounds, (_BEGINS, _ENDS), strict=False)]
    if len(bounds) != 2 or None in arrays or len({text_of(a) for a in arrays if a}) != 1:
        return None
    return arrays[0]


def compared(
    reader: CppExpressionReader, operator: str, sides: Sequence[Node]
) -> m.Expression | None:
    """`a == std::array<int, 2>{x, y}`, or `a == b`, of arrays of the model, element by element.

    So are tuples that are only made to be compared: `std::tie(x, y) == std::tie(a, b)`.
    """
    alone = replace(reader, findings=None, inlines=None)  # nothing is called between them
    if (pairs := _tuples(alone, operator, sides)) is not None:
        tests = [alone.binary(side, operator, (side, other)) for side, other in pairs]
        return _joined(operator, tests) if all(map(is_calm, tests)) else None
    left, right = sides
    type_ = plain_type(reader, left) if operator in _JOINING and left.type in _NAMES else None
    if type_ is None or type_.dimensions[0] > _LONGEST:
        return None
    size, others = type_.dimensions[0], elements_of(reader, right, type_)
    if others is not None:
        if len(others) != size:
            return None
        values = [reader.read(value) for value in others]
    elif right.type in _NAMES and plain_type(reader, right) == type_:
        values = [m.Index(reader.read(right), m.IntLiteral(i)) for i in range(size)]
    else:
        return None
    cells = (m.Index(reader.read(left), m.IntLiteral(i)) for i in range(size))
    if not all(map(is_calm, values)):
        return None
    return _joined(operator, [binary(operator, c, v) for c, v in zip(cells, values, strict=True)])


def _joined(operator: str, tests: Sequence[m.Expression]) -> m.Expression:
    return reduce(lambda before, test: binary(_JOINING[operator], before, test), tests)


def _tuples(
    reader: CppExpressionReader, operator: str, sides: Sequence[Node]
) -> list[tuple[Node, Node]] | None:
    """The parts of two tuples of numbers that are compared, each with the one that it meets."""
    calls = [call for call in map(call_of, sides) if call is not None and call.name in _TUPLES]
    if operator not in _JOINING or len(calls) != len(sides):
        return None
    left, right = (call.arguments for call in calls)
    types = [type_in(reader.scope, reader.read(value)) for value in (*left, *right)]
    is_plain = all(t is not None and (is_numeric(t) or is_boolean(t)) for t in types)
    return list(zip(left, right, strict=True)) if is_plain and len(left) == len(right) else None


def elements_of(reader: CppExpressionReader, node: Node, type_: m.Type) -> list[Node] | None:
    """What stands in the braces of an array of a type that is made where it is used."""
    if node.type != "compound_literal_expression":
        return None
    kept = reader.scope.carried(part(node, "type"))
    if kept is None or kept.type != type_ or kept.bits or kept.wide:
        return None
    values = named(part(node, "value"))
    if len(values) == 1 and values[0].type == "initializer_list":
        values = named(values[0])
    return values


def first_of(node: Node) -> Node | None:
    """The array whose first element an iterator is."""
    return _end(node, _BEGINS)


def plain_type(reader: CppExpressionReader, array: Node) -> m.Type | None:
    """The type of an array in one dimension whose elements are as the model has them."""
    place = resolve(reader.scope, array)
    if not isinstance(place, Variable) or place.type is None or place.bits or place.wide:
        return None
    return place.type if len(place.type.dimensions) == 1 else None


def _end(node: Node, names: Sequence[str]) -> Node | None:
    """The array whose first element, or whose end, an iterator is: `a.begin()`, `std::begin(a)`."""
    found = call_of(node)
    if found is None:
        return None
    if found.target is not None and not found.arguments and found.name in names:
        return found.target
    if found.target is None and len(found.arguments) == 1:
        return found.arguments[0] if found.name in {f"std::{n}" for n in names} else None
    return None


# What these give is no place in the array.
_VALUES = frozenset(f"std::{n}" for n in ("count", "count_if", "all_of", "any_of", "none_of"))


def looked_at(call: CppCall) -> bool:
    """Whether `*std::max_element(a.begin(), a.end())` is only looked at where it stands."""
    pointer = call.node.parent
    above = pointer.parent if pointer is not None else None
    is_value = pointer is not None and text_of(pointer).startswith("*")
    if not is_value or above is None or call.name not in EXTREMES:
        return False
    if above.type == "argument_list" and above.parent is not None:
        outer = call_of(above.parent)
        is_looked_at = outer is not None and takes_values(outer)
    else:
        is_looked_at = above.type == "binary_expression" and ">>" not in text_of(above)
    array = whole_array(call.arguments) if is_looked_at else None
    return array is not None and array.type == "identifier"


def only_counts(call: CppCall) -> bool:
    """Whether a call is of an algorithm that gives a value, and only looks at a whole array."""
    array = whole_array(call.arguments[:2]) if call.name in _VALUES else None
    tests = [a for a in call.arguments[2:] if a.type == "lambda_expression"]
    is_tested = call.name.removeprefix("std::") not in _TESTING or len(tests) == 1
    given = [p for test in tests for p in inside(test, "parameter_declaration")]
    takes_places = any("&" in text_of(p) and "const" not in text_of(p) for p in given)
    return array is not None and array.type == "identifier" and is_tested and not takes_places
