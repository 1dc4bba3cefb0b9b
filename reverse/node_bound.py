"""Members that refer to what the model has: what is done through them is done to the model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from tree_sitter import Node

from rebsync.reverse.cpp_declarations import CppField
from rebsync.reverse.cpp_index import CppClass, CppFunction
from rebsync.reverse.cpp_roots import is_modelled, root
from rebsync.reverse.cpp_tree import Cpp, inside, named, text_of
from rebsync.reverse.findings import Unread
from rebsync.reverse.node_bodies import Bodies
from rebsync.reverse.node_units import Unit
from rebsync.reverse.scope import Itself, Outside, Publishes, Scope, Variable

_PLACES = frozenset(
    {"identifier", "this", "pointer_expression", "field_expression", "subscript_expression"}
)
_REFERS = ("reference_declarator", "pointer_declarator")


def note_bound(bodies: Bodies) -> None:
    """Lists what gives members of a unit other names for what the model has, from the start."""
    for owner in bodies.unit.lineage:
        members = {f.name: f for f in (*owner.fields, *owner.others)}
        for member, cpp, function, value in _values(bodies.unit, owner, members):
            scope = bodies.scope(cpp, function)
            for place in _given(member, scope, value):
                why = f'"{member.name}" may use or change "{text_of(place)}" where it is not seen'
                bodies.findings.unreadable(
                    cpp.source, Unread(cpp.span(place), why), bodies.unit.name
                )


def _values(
    unit: Unit, owner: CppClass, members: Mapping[str, CppField]
) -> Iterator[tuple[CppField, Cpp, CppFunction | None, Node]]:
    """What members are made with."""
    for member in members.values():
        if member.value is not None:
            yield member, member.cpp, None, member.value
    for constructor in unit.constructors(owner):
        entries = constructor.initialisers
        for entry in named(entries) if entries is not None else ():
            inner = named(entry)
            if len(inner) > 1 and text_of(inner[0]) in members:
                yield members[text_of(inner[0])], constructor.cpp, constructor, inner[-1]


def _given(member: CppField, scope: Scope, value: Node) -> Iterator[Node]:
    """The places of the model that an object outside of it can reach from then on."""
    if not isinstance(scope.members.get(member.name), Outside) or _is_constant(member):
        return
    refers = _refers(member)
    for argument in _arguments(value):
        place = _place(argument)
        meaning = root(scope, (), place)[1]
        match meaning:
            case Itself():
                reached = place.type == "this"
            case Publishes(targets):
                reached = bool(targets)
            case Variable():
                reached = refers or place is not argument
            case _:
                reached = False
        if reached or (refers and is_modelled(place, meaning)):
            yield place


def _is_constant(member: CppField) -> bool:
    return any(text_of(c) == "const" for c in member.node.named_children)


def _refers(member: CppField) -> bool:
    return any(True for _ in inside(member.node, *_REFERS))


def _arguments(value: Node) -> list[Node]:
    """`x` of `(x)`, `{x}` and `new C(x)`, where it is a place."""
    if value.type == "new_expression":
        arguments = value.child_by_field_name("arguments")
        return _arguments(arguments) if arguments is not None else []
    if value.type in ("argument_list", "initializer_list"):
        return [a for v in named(value) for a in _arguments(v)]
    return [value] if value.type in _PLACES else []


def _place(value: Node) -> Node:
    """`x` of `&x`."""
    if value.type == "pointer_expression" and text_of(value).startswith("&"):
        return value.children_by_field_name("argument")[0]
    return value
