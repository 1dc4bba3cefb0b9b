"""Types that code gives names: aliases in bodies, and the parameters of function templates."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.cpp_kinds import NOTHING
from rebsync.reverse.bodies.types.cpp_conversions import place_of, type_in
from rebsync.reverse.bodies.types.cpp_types import Carried
from rebsync.reverse.bodies.types.cpp_widths import wide_of
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import bare, is_place
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.types import BYTE, INT, SHORT

_HINT = "say its type: static_cast<int32_t>(...)"


def declares_nothing(reader: CppStatementReader, node: Node) -> bool:
    """Whether a statement only declares something; a type has the name from here on."""
    if node.type not in NOTHING:
        return False
    name = node.child_by_field_name("name" if node.type == "alias_declaration" else "declarator")
    if name is not None and node.type in ("alias_declaration", "type_definition"):
        kept = reader.scope.carried(part(node, "type")) if name.type == "type_identifier" else None
        aliases = {**reader.scope.aliases, text_of(name): kept}
        reader.scope = replace(reader.scope, aliases=aliases)
    return True


def instantiated(
    reader: CppStatementReader, node: Node, function: CppFunction, arguments: Sequence[Node]
) -> Mapping[str, Carried | None]:
    """The types that the parameters of a template stand for in a call; nothing of no template.

    Unread: one of them is not known, or is none of the model's.
    """
    template = function.node.parent
    if template is None or template.type != "template_declaration":
        return {}
    names = list(_parameters(reader, node, template))
    called = part(node, "function")
    explicit = named(part(called, "arguments")) if called.type == "template_function" else []
    found: dict[str, Carried] = {}
    for name, given in zip(names, explicit, strict=False):
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
    if found.keys() != set(names):
        raise reader.unread(node, "the types of this template are not known here", _HINT)
    return found


def _parameters(reader: CppStatementReader, node: Node, template: Node) -> Iterator[str]:
    """The names of the types that a template takes."""
    for parameter in named(part(template, "parameters")):
        if parameter.type != "type_parameter_declaration" or len(named(parameter)) != 1:
            raise reader.unread(node, "the model knows no template with such parameters")
        yield text_of(named(parameter)[0])
    if any(c.type == "requires_clause" for c in template.named_children):
        raise reader.unread(node, "the model knows no template with such parameters")


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
