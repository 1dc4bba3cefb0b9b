"""Types that code gives names: aliases in bodies, and the parameters of function templates."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_idioms import whole
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.cpp_kinds import NOTHING
from rebsync.reverse.bodies.scope import Meaning, Outside
from rebsync.reverse.bodies.types.cpp_conversions import place_of, type_in
from rebsync.reverse.bodies.types.cpp_types import Carried
from rebsync.reverse.bodies.types.cpp_widths import wide_of
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import bare, is_place
from rebsync.reverse.syntax.cpp_declarations import CppFunction, CppParameter
from rebsync.reverse.syntax.cpp_numbers import enumerated
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.constants import constant
from rebsync.static.types import BOOLEAN, BYTE, INT, SHORT

_HINT = "say its type: static_cast<int32_t>(...)"


def declares_nothing(reader: CppStatementReader, node: Node) -> bool:
    """Whether a statement only declares something; a type has the name from here on."""
    if node.type == "enum_specifier":
        _enumerate(reader, node)
        return True
    if node.type not in NOTHING:
        return False
    name = node.child_by_field_name("name" if node.type == "alias_declaration" else "declarator")
    if name is not None and node.type in ("alias_declaration", "type_definition"):
        kept = reader.scope.carried(part(node, "type")) if name.type == "type_identifier" else None
        aliases = {**reader.scope.aliases, text_of(name): kept}
        reader.scope = replace(reader.scope, aliases=aliases)
    return True


def _enumerate(reader: CppStatementReader, enum: Node) -> None:
    """Takes the constants of an enumeration of a body, and its name where it is an `int`."""
    name, base = enum.child_by_field_name("name"), enum.child_by_field_name("base")
    kept = reader.scope.carried(base) if base is not None else Carried(INT)
    of, is_int = text_of(name) if name is not None else "", kept == Carried(INT)
    is_scoped = any(child.type in ("class", "struct") for child in enum.children)
    for each, number in enumerated(enum, partial(_constant_number, reader)):
        value: Meaning = Outside()
        if is_int and number is not None and -(2**31) <= number < 2**31:
            value = whole(number, reader.cpp.span(each))
        for spelled in (f"{of}::", "")[: 1 if is_scoped else 2]:
            reader.meaning(f"{spelled}{text_of(part(each, 'name'))}", value)
    if of:
        aliases = {**reader.scope.aliases, of: kept if is_int else None}
        reader.scope = replace(reader.scope, aliases=aliases)


def _constant_number(reader: CppStatementReader, node: Node) -> int | None:
    """The whole number that an expression always gives."""
    try:
        number = constant(replace(reader.expressions, findings=None, inlines=None).read(node))
    except Unread:
        return None
    return number if isinstance(number, int) and not isinstance(number, bool) else None


def instantiated(
    reader: CppStatementReader, node: Node, function: CppFunction, arguments: Sequence[Node]
) -> tuple[Mapping[str, Carried | None], Mapping[str, Meaning]]:
    """The types, and the numbers, that the parameters of a template stand for in a call.

    Nothing of no template. Unread: one of them is not known, or is none of the model's.
    """
    template = function.node.parent
    if template is None or template.type != "template_declaration":
        return {}, {}
    parameters = list(_parameters(reader, node, template))
    names = [name for name, type_ in parameters if type_ is None]
    called = part(node, "function")
    explicit = named(part(called, "arguments")) if called.type == "template_function" else []
    found: dict[str, Carried] = {}
    values: dict[str, Meaning] = {}
    for (name, type_), given in zip(parameters, explicit, strict=False):
        if type_ is not None:
            values[name] = _number(reader, type_, given)
            continue
        kept = reader.scope.carried(given)
        if kept is None or "&" in text_of(given):
            raise reader.unread(given, f'the model has no type "{text_of(given)}"')
        found[name] = kept
    told = set(found)
    for parameter, argument in zip(function.parameters, arguments, strict=False):
        name = text_of(parameter.type)
        if name not in names or name in told:
            continue
        kept = _deduced(reader, argument)
        if found.setdefault(name, kept) != kept:
            raise reader.unread(node, f'"{name}" would be of two types here', _HINT)
    if len(found) + len(values) != len(parameters):
        raise reader.unread(node, "the types of this template are not known here", _HINT)
    return found, values


def _number(reader: CppStatementReader, type_: Node, given: Node) -> m.Expression:
    """The whole number, or truth value, that a parameter of a template is."""
    kept, read = reader.scope.carried(type_), None
    if kept is not None and kept.type in (INT, BOOLEAN) and not (kept.bits or kept.wide):
        read = replace(reader.expressions, findings=None, inlines=None).read(given)
    number = constant(read) if read is not None else None
    is_same = kept is not None and isinstance(number, bool) == (kept.type == BOOLEAN)
    if read is None or not is_same or not isinstance(number, int):
        raise reader.unread(given, "the model has no such parameter of a template")
    return read


def _parameters(
    reader: CppStatementReader, node: Node, template: Node
) -> Iterator[tuple[str, Node | None]]:
    """The names of what a template takes, with the types of the numbers among that."""
    for parameter in named(part(template, "parameters")):
        if parameter.type == "type_parameter_declaration" and len(named(parameter)) == 1:
            yield text_of(named(parameter)[0]), None
        elif parameter.type == "parameter_declaration" and len(named(parameter)) == 2:
            type_, name = named(parameter)
            yield text_of(name), type_
        else:
            raise reader.unread(node, "the model knows no template with such parameters")
    if any(c.type == "requires_clause" for c in template.named_children):
        raise reader.unread(node, "the model knows no template with such parameters")


def type_of(
    reader: CppStatementReader, inside: CppStatementReader, parameter: CppParameter, argument: Node
) -> Carried | None:
    """The type of a parameter: of a generic lambda it is that of the argument."""
    if parameter.type.type != "placeholder_type_specifier" or parameter.refers:
        return inside.scope.carried(parameter.type)
    try:
        return _deduced(reader, argument)
    except Unread:
        return None


def _deduced(reader: CppStatementReader, argument: Node) -> Carried:
    """The type that a parameter of a template gets by an argument."""
    unread = reader.unread(argument, "the type of this argument is not known", _HINT)
    try:
        read = replace(reader.expressions, findings=None, inlines=None).read(argument)
        wide = wide_of(reader.expressions, argument)
    except Unread:
        raise unread from None
    place = place_of(reader.scope, bare(read)) if is_place(read) else None
    of = place.type if place is not None else type_in(reader.scope, read)
    is_cut = place is not None and (place.bits or place.wide)
    if of is None or (of.dimensions and place is None) or wide or is_cut:
        raise unread
    if place is None and of in (BYTE, SHORT):  # numbers and sums are of type int in C++
        match bare(read):
            case m.IntLiteral() | m.Unary(_, m.IntLiteral()):
                of = INT
            case m.Cast():
                pass
            case _:
                raise unread
    return Carried(of)
