"""Constructs of C++ that bodies are read without, listed.

The order of initialisers, narrow enumerations, other names for an object, state that objects of one
class share.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.intervals import TRUTH, Interval, signed, unsigned
from rebsync.reverse.bodies.types.cpp_ranges import range_of
from rebsync.reverse.nodes.node_bodies import Bodies
from rebsync.reverse.nodes.node_namespaces import note_namespaces
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.syntax.cpp_calls import calls_in
from rebsync.reverse.syntax.cpp_index import CppClass, CppField, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, text_of
from rebsync.reverse.syntax.descendants import nodes_in

_NARROW = {
    **dict.fromkeys(("uint8_t", "unsigned char"), unsigned(8)),
    **dict.fromkeys(("int8_t", "signed char", "char"), signed(7)),
    **dict.fromkeys(("uint16_t", "unsigned short"), unsigned(16)),
    **dict.fromkeys(("int16_t", "short"), signed(15)),
    "bool": TRUTH,
}
_CHANGES = ("assignment_expression", "update_expression")


def note_unmodelled(bodies: Bodies) -> None:
    """Lists what would be read as if the language did otherwise."""
    note_namespaces(bodies.unit, bodies.findings)
    for owner in bodies.unit.lineage:
        for function in bodies.unit.constructors(owner):
            if _out_of_order(bodies, owner, function):
                why = "members are made in the order of their declarations, not in this one"
                bodies.unread(function.cpp, function.initialisers or function.node, why)
    for function in bodies.unit.functions:
        if function.name.startswith("~") and _acts(function) and _ends_before(bodies):
            why = (
                "this runs when the object ends, before the program does: the model has none of it"
            )
            bodies.unread(function.cpp, function.node, why)
    narrow = _narrow_enums(bodies)
    for function in bodies.unit.functions:
        if function.body is None:
            continue
        for node, name in _casts(function.body, narrow):
            scope = bodies.scope(function.cpp, function)
            found = range_of(function.cpp, scope, node)
            if found is None or not narrow[name].includes(found.values):
                bodies.unread(function.cpp, node, f'"{name}" holds less than this may be')
        for node in _aliases(function.body):
            bodies.unread(
                function.cpp, node, "another name for an object through which it is changed"
            )


# --- the end of objects -------------------------------------------------------------------------


def _acts(function: CppFunction) -> bool:
    """Whether a destructor calls or changes anything."""
    kinds = ("call_expression", *_CHANGES)
    return function.body is not None and any(True for k in kinds for _ in inside(function.body, k))


def _ends_before(bodies: Bodies) -> bool:
    """Whether the function that makes the object may end it: by `reset`, `delete` or another."""
    entry = bodies.opening.entry
    body = entry.body if entry is not None else None
    if body is None:
        return False
    targets = (a.child_by_field_name("left") for a in inside(body, "assignment_expression"))
    names = {text_of(t) for t in targets if t is not None}
    names |= {c.on for c in calls_in(body) if c.name == "reset"}
    names |= {text_of(named(d)[-1]) for d in inside(body, "delete_expression") if named(d)}
    return bool(names & set(bodies.opening.objects))


# --- the order of initialisers ------------------------------------------------------------------


def _out_of_order(bodies: Bodies, owner: CppClass, function: CppFunction) -> bool:
    """Whether initialisers stand in another order than they run, and it may matter to values."""
    order = [
        f.name for f in sorted((*owner.fields, *owner.others), key=lambda f: f.node.start_byte)
    ]
    entries = named(function.initialisers) if function.initialisers is not None else []
    written = [(text_of(named(e)[0]), e) for e in entries if named(e)]
    places = [order.index(name) for name, _ in written if name in order]
    if places == sorted(places):
        return False
    functions = {name for _, name in bodies.code.definitions}
    functions |= {f.name for f in bodies.unit.functions}
    return any(_depends(entry, set(order), functions) for name, entry in written if name in order)


def _depends(entry: Node, members: set[str], functions: set[str]) -> bool:
    """Whether an initialiser calls a function of the code, changes something, or names a member."""
    names = members | functions
    return any(
        n.type in _CHANGES or (n.type == "identifier" and text_of(n) in names)
        for value in named(entry)[1:]
        for n in nodes_in(value)
    )


# --- narrow enumerations ------------------------------------------------------------------------


def _narrow_enums(bodies: Bodies) -> dict[str, Interval]:
    """The least and greatest values of enumerations that hold less than an int."""
    found = {}
    for enumerators in bodies.code.enumerators.values():
        for each in enumerators:
            above = each.node.parent.parent if each.node.parent is not None else None
            base = above.child_by_field_name("base") if above is not None else None
            spelled = text_of(base).removeprefix("std::") if base is not None else ""
            if each.enum and spelled in _NARROW:
                found[each.enum] = _NARROW[spelled]
    return found


def _casts(body: Node, narrow: dict[str, Interval]) -> Iterator[tuple[Node, str]]:
    """What is cast to one of some enumerations, and to which."""
    if not narrow:
        return
    for call in inside(body, "call_expression"):
        function, arguments = (
            call.child_by_field_name("function"),
            call.child_by_field_name("arguments"),
        )
        values = named(arguments) if arguments is not None else []
        if function is None or len(values) != 1:
            continue
        text = text_of(function)
        name = text.partition("<")[2].rstrip(">") if text.startswith("static_cast<") else text
        if (plain := name.strip().rpartition("::")[2]) in narrow:
            yield values[0], plain
    for cast in inside(body, "cast_expression"):
        to, value = cast.child_by_field_name("type"), cast.child_by_field_name("value")
        plain = text_of(to).strip().rpartition("::")[2] if to is not None else ""
        if value is not None and plain in narrow:
            yield value, plain


# --- other names for an object ------------------------------------------------------------------


def _aliases(body: Node) -> Iterator[Node]:
    """Copies of pointers through which a body changes the object that both lead to."""
    changed = {
        text_of(holder)
        for kind in _CHANGES
        for change in inside(body, kind)
        if (holder := _through_pointer(change)) is not None
    }
    for declared in inside(body, "init_declarator") if changed else ():
        value, name = (
            declared.child_by_field_name("value"),
            declared.child_by_field_name("declarator"),
        )
        if value is None or name is None or name.type != "identifier":
            continue
        if value.type == "identifier" and changed & {text_of(name), text_of(value)}:
            yield declared


def _through_pointer(change: Node) -> Node | None:
    """The local `p` of `p->field = value`."""
    target = change.child_by_field_name("left") or change.child_by_field_name("argument")
    while target is not None and target.type == "field_expression":
        holder = target.child_by_field_name("argument")
        operator = target.child_by_field_name("operator")
        if holder is not None and holder.type == "identifier":
            return holder if operator is not None and text_of(operator) == "->" else None
        target = holder
    return None


# --- state that objects share -------------------------------------------------------------------


def shared_state(unit: Unit) -> Iterator[tuple[Cpp, Node]]:
    """Static members and static locals, of which all objects of a class have the same."""
    for owner in unit.lineage:
        for member in statics(owner):
            yield member.cpp, member.node
    for function in unit.functions:
        for node in inside(function.body, "declaration"):
            if _is_static(node):
                yield function.cpp, node


def statics(owner: CppClass) -> Iterator[CppField]:
    """The static variables of a class that are no constants."""
    return (f for f in (*owner.fields, *owner.others) if _is_static(f.node))


def _is_static(node: Node) -> bool:
    at: Node | None = node
    while at is not None and not at.type.endswith("declaration"):
        at = at.parent
    words = [text_of(c) for c in at.named_children] if at is not None else []
    return "static" in words and not {"const", "constexpr"} & set(words)
