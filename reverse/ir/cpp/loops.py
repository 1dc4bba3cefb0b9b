"""Loops of C++ ([stmt.iter]): while, do, for, and for over the elements of a range."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.context import (
    Context,
    Unlowered,
    Value,
    lower_value,
    lowers_statement,
)
from rebsync.reverse.ir.cpp.declarations import bind_parts
from rebsync.reverse.ir.cpp.expressions import discarded
from rebsync.reverse.ir.cpp.initialisation import element_value
from rebsync.reverse.ir.cpp.objects import address, as_value, dereferenced, implicitly
from rebsync.reverse.ir.cpp.statements import one, repeated, with_start
from rebsync.reverse.ir.cpp.types import Declared, ReferenceKind
from rebsync.reverse.syntax.cpp_declarations import declared_name
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.source import Span


@lowers_statement("while_statement")
def while_statement(context: Context, node: Node) -> None:
    """`while (test)`."""
    clause, place = part(node, "condition"), context.place(node)
    value = clause.child_by_field_name("value") if clause.type == "condition_clause" else clause
    if value is None:
        raise Unlowered("a condition")
    with context.scoped():
        with context.body() as prelude:
            test = repeated(context, value)
        body = one(context, part(node, "body"))
    context.emit(s.Loop(test, body, tuple(prelude), dynamic=False, place=place))


@lowers_statement("do_statement")
def do_statement(context: Context, node: Node) -> None:
    """`do ... while (test)`: the first round is not tested."""
    body = one(context, part(node, "body"))
    with context.body() as prelude:
        test = repeated(context, part(node, "condition"))
    place = context.place(node)
    context.emit(s.Loop(test, body, tuple(prelude), body_first=True, dynamic=False, place=place))


@lowers_statement("for_statement")
def for_statement(context: Context, node: Node) -> None:
    """`for (init; test; step)`."""
    place = context.place(node)
    start = node.child_by_field_name("initializer")
    test_node, step_node = node.child_by_field_name("condition"), node.child_by_field_name("update")

    def whole() -> None:
        with context.body() as prelude:
            test: e.Expression = e.Literal(True, t.TRUTH, place=place)
            if test_node is not None:
                test = repeated(context, test_node)
        with context.body() as step, context.full_expression():
            if step_node is not None:
                discarded(context, step_node)
        body = one(context, part(node, "body"))
        loop = s.Loop(test, body, tuple(prelude), tuple(step), dynamic=False, place=place)
        context.emit(loop)

    with context.scoped(), context.body() as body:
        if start is not None and start.type not in ("declaration", "init_statement"):
            with context.full_expression():
                discarded(context, start)
            whole()
        else:
            with_start(context, start, whole)
    context.emit(s.Block(tuple(body), place))


# --- ranges ([stmt.ranged]) -----------------------------------------------------------------------


@lowers_statement("for_range_loop")
def for_range(context: Context, node: Node) -> None:
    """`for (auto& x : range)`: a round for each element."""
    place = context.place(node)
    if node.child_by_field_name("initializer") is not None:
        raise Unlowered("a loop over a range with a declaration before it")
    with context.scoped(), context.body() as body, context.full_expression():
        range_ = _range(context, part(node, "right"))
        if isinstance(range_.type, t.Container) and range_.type.kind is t.ContainerKind.MAPPING:
            _over_entries(context, node, range_, place)
        else:
            _over_elements(context, node, range_, place)
    context.emit(*(body if len(body) == 1 else [s.Block(tuple(body), place)]))


def _range(context: Context, node: Node) -> Value:
    """The range, which is evaluated once."""
    if node.type != "initializer_list":
        found = lower_value(context, node)
        if found.is_lvalue and not isinstance(found.expression, e.Local | e.Captured | e.Attribute):
            pointer = context.stored(
                address(context, found, context.place(node)),
                t.Reference(found.type),
                context.place(node),
            )
            return dereferenced(pointer, found.type, context.place(node))
        return found
    elements = named(node)
    kinds = set()
    with context.body(), context.trial():
        kinds = {lower_value(context, each).type for each in elements}
    if len(kinds) != 1:
        raise Unlowered("a loop over values of several types")
    element = kinds.pop()
    built = tuple(element_value(context, element, each) for each in elements)
    type_ = t.Container(t.ContainerKind.SEQUENCE, (element,))
    return Value(e.Build(type_, built, context.place(node)), type_)


def _element(type_: t.Type) -> t.Type:
    match type_:
        case t.Container(t.ContainerKind.SEQUENCE | t.ContainerKind.SET, (element,)):
            return element
        case t.Array(element, _):
            return element
        case t.Text():
            return t.Integer(8)
        case _:
            return t.UNKNOWN


def _over_elements(context: Context, node: Node, range_: Value, place: Span) -> None:
    declarator = part(node, "declarator")
    element = _element(range_.type)
    declared, name = _declared(context, node, declarator, element)
    is_reference = declared.reference is not ReferenceKind.NONE
    is_object = isinstance(element, t.Record | t.Container | t.Array | t.RosMessage | t.Unknown)
    if isinstance(range_.type, t.Container) and range_.type.kind is t.ContainerKind.SET:
        kind = t.Container(t.ContainerKind.SEQUENCE, (element,))
        elements = context.temporary(kind, place)
        callee = s.LibraryCallee("std::set::elements", range_.expression)
        context.emit(s.Call(elements, callee, (), place))
        range_ = Value(elements, kind)
    with context.scoped(), context.body() as start:
        by_reference = is_reference or is_object or declared.type != element
        hidden = by_reference and not (is_reference and name is not None)
        own = name if name is not None and not hidden else "element"
        target = e.Local(context.unique(own), element, place)
        if by_reference:
            context.aliases.add(target.name)
        item = Value(target, element, is_lvalue=True)
        if name is None:
            bind_parts(context, _binding(declarator), item, place)
        elif hidden:
            _copied(context, name, declared.type, item, place)
        else:
            context.bind(name, item)
        body = (*start, *one(context, part(node, "body")))
    is_dynamic = range_.type == t.UNKNOWN or isinstance(range_.type, t.Record)
    context.emit(
        s.ForEach(
            target, range_.expression, body, (), by_reference, dynamic=is_dynamic, place=place
        )
    )


def _copied(context: Context, name: str, type_: t.Type, item: Value, place: Span) -> None:
    """A variable that is a copy of each element, or the element as one of another type."""
    local = e.Local(context.unique(name), type_, place)
    value = as_value(context, implicitly(context, item, type_, place), place)
    context.emit(s.Declare(local, type_, value, place))
    context.bind(name, Value(local, type_, is_lvalue=True))


def _declared(
    context: Context, node: Node, declarator: Node, element: t.Type
) -> tuple[Declared, str | None]:
    """The type of the variable, and its name; None for a structured binding."""
    type_node = part(node, "type")
    declared = context.world.types.declared(context.cpp, context.scope, type_node, declarator)
    if "auto" in text_of(type_node).split():
        declared = Declared(element, declared.reference)
    name = declared_name(declarator)
    return declared, None if name is None else text_of(name)


def _binding(declarator: Node) -> Node:
    while declarator.type == "reference_declarator":
        declarator = named(declarator)[-1]
    if "structured_binding" not in declarator.type:
        raise Unlowered("a loop over a range with a variable of this kind")
    return declarator


def _over_entries(context: Context, node: Node, range_: Value, place: Span) -> None:
    """Over a map: for each of its keys, `first`, with the element at it, `second`."""
    container = range_.type
    if not isinstance(container, t.Container) or len(container.elements) != 2:
        raise Unlowered("a loop over a map of unknown elements")
    key_type, value_type = container.elements
    if not isinstance(range_.expression, e.Lvalue):
        range_ = Value(context.stored(range_.expression, container, place), container)
    keys_type = t.Container(t.ContainerKind.SEQUENCE, (key_type,))
    keys = context.temporary(keys_type, place)
    context.emit(s.Call(keys, s.LibraryCallee("std::map::keys", range_.expression), (), place))
    declarator = part(node, "declarator")
    key = context.temporary(key_type, place)
    element = e.Index(range_.expression, key, value_type, False, False, False, place)
    first, second = Value(key, key_type), Value(element, value_type, is_lvalue=True)
    with context.scoped(), context.body() as start:
        declared, name = _declared(context, node, declarator, t.UNKNOWN)
        is_reference = declared.reference is not ReferenceKind.NONE
        if name is None:
            names = [text_of(n) for n in named(_binding(declarator))]
            if len(names) != 2:
                raise Unlowered("a loop over a map with other than two names")
            context.bind(names[0], first)
            if is_reference:
                context.bind(names[1], second)
            else:
                _copied(context, names[1], value_type, second, place)
        else:
            _entry(context, name, first, second, is_reference, place)
        body = (*start, *one(context, part(node, "body")))
    context.emit(s.ForEach(key, keys, body, (), dynamic=False, place=place))


def _entry(
    context: Context, name: str, first: Value, second: Value, is_reference: bool, place: Span
) -> None:
    """A variable for an entry: a pair of references to its key and value, or of copies."""
    of = t.Reference(second.type) if is_reference else second.type
    type_ = context.world.types.record_of("std::pair", ("first", "second"), (first.type, of))
    value = address(context, second, place) if is_reference else as_value(context, second, place)
    pair = e.BuildRecord(type_, (("first", first.expression), ("second", value)), place)
    local = e.Local(context.unique(name), type_, place)
    context.emit(s.Declare(local, type_, pair, place))
    context.bind(name, Value(local, type_, is_lvalue=True))
