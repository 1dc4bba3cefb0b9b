"""Arrays of C++ that get all of their elements at once."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_algorithms import elements_of, first_of, plain_type, whole_array
from rebsync.reverse.bodies.cpp_mailbox import has_mailbox
from rebsync.reverse.bodies.cpp_messages import zero_of
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.constants import constant as constant_of

_ZERO = m.IntLiteral(0)


def filled(reader: CppStatementReader, node: Node) -> Sequence[m.Statement] | None:
    """What gives an array its elements; None for another expression.

    `array.fill(x)`, `std::fill(array.begin(), array.end(), x)`, `std::fill_n(array.begin(), n, x)`,
    `array = {}` and `array = {x, y}`.
    """
    if node.type == "assignment_expression":
        return _assigned(reader, node)
    call = call_of(node)
    if call is None or not call.arguments:
        return None
    *bounds, value = call.arguments
    match call.name, call.target:
        case "fill", Node() as target if not bounds:
            pass
        case "std::fill", None if (found := whole_array(bounds)) is not None:
            target = found
        case "std::fill_n", None if len(bounds) == 2 and (first := first_of(bounds[0])):
            target = first
        case _:
            return None
    type_ = plain_type(reader.expressions, target)
    if type_ is None:
        return None
    count = type_.dimensions[0]
    if call.name == "std::fill_n":
        given = constant_of(reader.expressions.read(bounds[1]))
        if type(given) is not int or not 0 <= given <= count:
            return None
        count = given
    array, of = reader.expressions.read(target), m.Type(type_.name)
    read = reader.expressions.stored(value, Variable("", of))
    if not is_calm(read) or _names(array) & _names(read):
        raise reader.unread(value, "this is evaluated once here, and for each element there")
    return [_set(reader, node, array, count, read)]


def _assigned(reader: CppStatementReader, node: Node) -> Sequence[m.Statement] | None:
    """`array = {x, y}`, or `std::array<int, 2>{x, y}`, in a generated class.

    All values are known before an element changes; elements that no value is for are zero. Of
    `one = other = {x, y}` the other has them first, and then the one what that has.
    """
    target, value = part(node, "left"), part(node, "right")
    type_ = plain_type(reader.expressions, target)
    if text_of(part(node, "operator")) != "=" or type_ is None or not has_mailbox(reader.scope):
        return None
    if value.type == "assignment_expression" and (first := _assigned(reader, value)) is not None:
        other = part(value, "left")
        if plain_type(reader.expressions, other) != type_:
            return None
        one, known = reader.expressions.read(target), reader.expressions.read(other)
        copied = m.Assign("=", one, known)
        return [*first, m.ExpressionStatement(copied, (), reader.cpp.span(node))]
    if value.type not in ("initializer_list", "compound_literal_expression"):
        return None
    of, zero = m.Type(type_.name), zero_of(m.Type(type_.name))
    is_typed = value.type != "initializer_list"
    values = elements_of(reader.expressions, value, type_) if is_typed else named(value)
    if zero is None or values is None:
        return None
    array, count = reader.expressions.read(target), type_.dimensions[0]
    # A local may be a vector, which has as many elements as it gets.
    is_member = resolve(reader.scope, target) in reader.scope.members.values()
    if not values and is_member:
        return [_set(reader, node, array, count, zero)]
    if len(values) == 1 and values[0].type == "initializer_list":
        values = named(values[0])
    is_whole = len(values) == count or (is_member and len(values) < count)
    if not is_whole or any(v.type == "initializer_list" for v in values):
        return None
    read = [reader.expressions.stored(v, Variable("", of)) for v in values]
    for each, source in zip(read, values, strict=True):
        if not is_calm(each) or _names(array) & _names(each):
            raise reader.unread(source, "this is evaluated before any element changes")
    read += [zero] * (count - len(values))
    span = reader.cpp.span(node)
    stores = (m.Assign("=", m.Index(array, m.IntLiteral(i)), x, span) for i, x in enumerate(read))
    return [m.ExpressionStatement(store, (), span) for store in stores]


def _set(
    reader: CppStatementReader, node: Node, array: m.Expression, count: int, read: m.Expression
) -> m.Statement:
    """A loop that gives the first elements of an array one value."""
    counter = m.Name(reader.fresh("i"))
    initial = m.Declaration(m.Type("int"), (m.Declarator(counter.name, _ZERO),))
    bound = m.Binary("<", counter, m.IntLiteral(count))
    store = m.ExpressionStatement(m.Assign("=", m.Index(array, counter), read))
    step = (m.Postfix("++", counter),)
    return m.For(initial, bound, step, m.Block((store,)), (), reader.cpp.span(node))


def _names(expression: m.Expression) -> set[str]:
    """The variables in an expression, those of the rebec by `self` among them."""
    return {n.name for n in m.walk(expression) if isinstance(n, m.Name | m.Member)}
