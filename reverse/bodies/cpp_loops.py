"""Loops of C++ that the model writes differently: over arrays, and with the test at the end."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import cpp_special
from rebsync.reverse.bodies.cpp_algorithms import plain_type, whole_array
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.bodies.types.cpp_conversions import converted_to, place_of, type_in
from rebsync.reverse.bodies.types.cpp_widths import wide_of
from rebsync.reverse.models.building import binary, negated
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.types import BOOLEAN, BYTE, INT, SHORT

_ONE, _ZERO = m.IntLiteral(1), m.IntLiteral(0)
# What has a `continue` of its own.
_APART = frozenset(
    {"for_statement", "while_statement", "do_statement", "for_range_loop", "lambda_expression"}
)


def range_loop(
    reader: CppStatementReader, node: Node, annotations: tuple[m.Annotation, ...]
) -> Iterator[m.Statement]:
    """`for (auto x : array)` as a loop over the indices."""
    span, over = reader.cpp.span(node), part(node, "right")
    outside = reader.scope
    if over.type == "initializer_list":
        array, before = _listed(reader, node, over)
        yield before
    else:
        array = reader.expressions.read(over)
    whole = type_in(reader.scope, array)
    if whole is None or not whole.dimensions:
        raise reader.unread(over, "how many elements this has is not known")
    loop = _over(reader, (over, array, whole), node, part(node, "body"))
    reader.scope = outside
    yield replace(loop, annotations=annotations, span=span)


def _over(
    reader: CppStatementReader, whole: tuple[Node, m.Expression, m.Type], named_by: Node, body: Node
) -> m.For:
    """A loop over the indices of an array, whose element has the name of a declaration in it."""
    over, array, type_ = whole
    index = Variable(reader.fresh("i"), m.Type("int"))
    reader.meaning(f"for {named_by.start_byte}", index)
    counter = m.Name(index.name)
    element = m.Index(array, counter, reader.cpp.span(over))
    first = _element(reader, named_by, element, m.Type(type_.name, type_.dimensions[1:]))
    block = reader.branch(body)
    initial = m.Declaration(m.Type("int"), (m.Declarator(index.name, _ZERO),))
    bound = m.Binary("<", counter, m.IntLiteral(type_.dimensions[0]))
    inner = m.Block((*first, *block.statements), (), block.span)
    return m.For(initial, bound, (m.Postfix("++", counter),), inner)


def for_each(reader: CppStatementReader, node: Node) -> m.Statement | None:
    """`std::for_each(a.begin(), a.end(), [&](int x) { ... })`, which is a loop over the array.

    None where the lambda keeps values of its own, or returns.
    """
    call = call_of(node)
    if call is None or call.target is not None or call.name != "std::for_each":
        return None
    *bounds, function = call.arguments or (node,)
    array = whole_array(bounds)
    type_ = plain_type(reader.expressions, array) if array is not None else None
    if array is None or type_ is None or function.type != "lambda_expression":
        return None
    declarator = function.child_by_field_name("declarator")
    listed = part(declarator, "parameters") if declarator is not None else None
    parameters = named(listed) if listed is not None else []
    body = part(function, "body")
    if (
        [p.type for p in parameters] != ["parameter_declaration"]
        or not _has_only_references(function)
        or _returns(body)
    ):
        return None
    outside = reader.scope
    loop = _over(reader, (array, reader.expressions.read(array), type_), parameters[0], body)
    reader.scope = outside
    return replace(loop, span=reader.cpp.span(node))


def _has_only_references(function: Node) -> bool:
    """Whether what a lambda captures is the object, or is what it is outside."""
    before = ""
    for child in part(function, "captures").children:
        if child.type == "lambda_default_capture":
            is_reference = text_of(child) == "&"
        else:
            is_named = child.type == "identifier" and before == "&"
            is_reference = is_named or child.type in ("[", "]", ",", "&", "this")
        if not is_reference:
            return False
        before = child.type
    return True


def _returns(node: Node) -> bool:
    """Whether a body may end before its end, or has a body within."""
    if node.type in ("return_statement", "lambda_expression", "co_return_statement"):
        return True
    return any(map(_returns, named(node)))


def _listed(reader: CppStatementReader, node: Node, over: Node) -> tuple[m.Expression, m.Statement]:
    """The array that holds the values of `for (int x : {1, 2, 3})`."""
    values = named(over)
    kept = reader.scope.carried(part(node, "type"))
    of = kept.type if kept is not None else _type_of_all(reader, over, values)
    bits, wide = (kept.bits, kept.wide) if kept is not None else (0, 0)
    array = m.Type(of.name, (len(values), *of.dimensions))
    local = Variable(reader.fresh("values"), array, bits, (), wide)
    reader.meaning(f"in {node.start_byte}", local)
    inner = Variable("", of, bits, (), wide)
    initial = m.ArrayInitializer(tuple(reader.expressions.stored(v, inner) for v in values))
    return m.Name(local.name), reader.local(over, local, initial)


def _type_of_all(reader: CppStatementReader, node: Node, values: Sequence[Node]) -> m.Type:
    """The one type of several values, which `auto` stands for."""
    alone = replace(reader.expressions, findings=None, inlines=None)
    found = {type_in(reader.scope, alone.read(value)) for value in values}
    found = {INT if of in (BYTE, SHORT) else of for of in found}
    of = found.pop() if len(found) == 1 else None
    if of is None or any(wide_of(alone, value) for value in values):
        raise reader.unread(node, "the type of these values is not known")
    return of


def _element(
    reader: CppStatementReader, node: Node, element: m.Expression, of: m.Type
) -> tuple[m.Statement, ...]:
    """What the name of the element stands for: the place itself, or a copy."""
    declarator = part(node, "declarator")
    if declarator.type == "reference_declarator":
        reader.meaning(text_of(named(declarator)[-1]), element)
        return ()
    if declarator.type != "identifier":
        raise reader.unread(declarator, "the model has no such element")
    name = text_of(declarator)
    kept = reader.scope.carried(part(node, "type"))
    wide = place_of(reader.scope, element).wide
    local = Variable(reader.fresh(name), of, wide=wide)
    if kept is not None:
        local = Variable(local.name, kept.type, kept.bits, (), kept.wide)
    reader.meaning(name, local, own=True)
    return (reader.local(declarator, local, converted_to(reader.scope, element, local)),)


def do_loop(
    reader: CppStatementReader, node: Node, annotations: tuple[m.Annotation, ...]
) -> Iterator[m.Statement]:
    """`do { ... } while (c);`: the test ends a loop that has none at its start."""
    span, body, condition = reader.cpp.span(node), part(node, "body"), part(node, "condition")
    once = text_of(condition).strip("() ") in ("0", "false")
    if once and (_goes_on(body) or _breaks(body)):
        raise reader.unread(node, "the model has no such loop with continue or break")
    if _goes_on(body):
        yield _first_time(reader, node, annotations)
        return
    block = reader.branch(body)
    if once:
        yield m.Block(block.statements, annotations, span)
        return
    ends = negated(condition_of(reader, condition))
    last = m.If(ends, m.Block((m.Break(),)), None)
    yield m.While(m.BoolLiteral(True), m.Block((*block.statements, last)), annotations, span)


def _first_time(
    reader: CppStatementReader, node: Node, annotations: tuple[m.Annotation, ...]
) -> m.Statement:
    """`for (boolean first = true; first || c; first = false)`: `continue` goes to the test."""
    outside = reader.scope
    first = Variable(reader.fresh("first"), BOOLEAN)
    reader.meaning(f"do {node.start_byte}", first)
    body = reader.branch(part(node, "body"))
    reader.scope = outside
    name = m.Name(first.name)
    again = binary("||", name, condition_of(reader, part(node, "condition")))
    initial = m.Declaration(BOOLEAN, (m.Declarator(first.name, m.BoolLiteral(True)),))
    done = m.Assign("=", name, m.BoolLiteral(False))
    return m.For(initial, again, (done,), body, annotations, reader.cpp.span(node))


def _goes_on(node: Node) -> bool:
    """Whether a `continue` in the body is one of this loop."""
    if node.type == "continue_statement":
        return True
    if b"continue" not in (node.text or b""):
        return False
    return any(_goes_on(c) for c in named(node) if c.type not in _APART)


def _breaks(node: Node) -> bool:
    if node.type == "break_statement":
        return True
    if b"break" not in (node.text or b""):
        return False
    others = (*_APART, "switch_statement")
    return any(_breaks(c) for c in named(node) if c.type not in others)


def condition_of(reader: CppStatementReader, node: Node) -> m.Expression:
    """The condition of a loop, which the model must know."""
    value = node if node.type != "condition_clause" else part(node, "value")
    while reader.scope.open and value.type == "parenthesized_expression":
        value = reader.expressions.only(value)
    if value.type == "declaration":
        raise reader.unread(node, "the model has no declarations in conditions")
    read = replace(reader.expressions, findings=None, inlines=None).condition(value)
    return cpp_special.without_ok(read) if reader.scope.open else read
