"""What C++ makes that has no place in a model: ends of actions, and objects of some classes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.calls.action_calls import actions_in
from rebsync.reverse.calls.ros_calls_shapes import objects_of, types_of
from rebsync.reverse.calls.ros_calls_sites import site_of
from rebsync.reverse.graph import Site, Unmodelled, UnmodelledFact
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.cpp_calls import last
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.syntax.cpp_tree import Cpp, part, text_of
from rebsync.reverse.values.cpp_flow import made_of
from rebsync.reverse.values.cpp_values import Values

_ACTIONS = frozenset({Kind.ACTION_SERVER, Kind.ACTION_CLIENT})
_NAMES = frozenset({"template_type", "template_function", "qualified_identifier"})
_DECLARATIONS = frozenset({"declaration", "field_declaration"})
# What a declarator is of that makes an object; pointers, references and functions make none.
_OBJECTS = frozenset({"identifier", "field_identifier", "init_declarator", "array_declarator"})


def unmodelled_in(values: Values) -> Iterator[UnmodelledFact]:
    """All of them, in no order."""
    yield from actions_in(values)
    for full, (routine, _) in libraries.unmodelled().items():
        if routine.kind in _ACTIONS:
            continue
        what = Unmodelled[routine.kind.name]
        scope, name = full.rpartition("::")[0], last(full)
        for cpp, place in values.texts.everywhere(name):
            for site, types in _made(values, cpp, place, scope):
                config = text_of(types[0]) if types else None
                yield UnmodelledFact(site, what, None, config)


def _made(
    values: Values, cpp: Cpp, place: Node, scope: str
) -> Iterator[tuple[Site, tuple[Node, ...]]]:
    """The objects that are made where the name of a class stands, with the template's arguments."""
    node, above = place, place.parent
    written = ""
    while above is not None and above.type in _NAMES:
        if above.type == "qualified_identifier":
            of = above.child_by_field_name("scope")
            if above.child_by_field_name("name") != node:
                return
            written = text_of(of) if of is not None else ""
        node, above = above, above.parent
    is_used = not written and f"using namespace {scope};".encode() in cpp.original
    if above is None or not (is_used or written.rpartition("::")[2] == scope):
        return
    types = types_of(node)
    if above.type in _DECLARATIONS:
        for declarator in above.children_by_field_name("declarator"):
            if declarator.type in _OBJECTS or _is_local_object(declarator):
                name = declarator.child_by_field_name("declarator") or declarator
                yield replace(_site(values, cpp, place, above), kept=text_of(name)), types
        return
    for call, _ in objects_of(node, above):
        yield _site(values, cpp, place, call), types


def _is_local_object(declarator: Node) -> bool:
    """Whether `T name(other)` in a body makes an object, though it is spelled as a function."""
    block = declarator.parent.parent if declarator.parent is not None else None
    if declarator.type != "function_declarator" or block is None:
        return False
    return block.type == "compound_statement" and bool(made_of(part(declarator, "declarator")))


def _site(values: Values, cpp: Cpp, place: Node, call: Node) -> Site:
    """The site of what is made; that of a member is in its class."""
    site = site_of(values, cpp, place, call)
    if site.owner is not None:
        return site
    around = values.texts.class_node_around(place)
    name = around.child_by_field_name("name") if around is not None else None
    return replace(site, owner=text_of(name)) if name is not None else site
