"""What `main` does beside the object of a node, once it is made, and before it or others end."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_effects import touching
from rebsync.reverse.bodies.effects.cpp_roots import declared_in, root
from rebsync.reverse.bodies.scope import Called, Inline, Record, Scope, Variable
from rebsync.reverse.nodes.node_bodies import Bodies
from rebsync.reverse.nodes.node_programs import NodeObject
from rebsync.reverse.nodes.node_starts import used_in_main
from rebsync.reverse.nodes.node_units import Start
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, text_of

_SETS = "this sets what the model has, in code that is not read"


def note_entry(bodies: Bodies, start: Start | None) -> None:
    """Lists calls in `main` that act on what the model has, or that may run what was not read.

    What it does with the object itself is read as part of the node's start.
    """
    entry = start.entry if start is not None else None
    made = start.made.statement if start is not None and start.made is not None else None
    if start is None or entry is None or entry.body is None or made is None:
        return
    if entry.name != "main":
        return
    read = used_in_main(start)
    scope = bodies.scope(entry.cpp, entry)
    for call in bodies.code.calls_in(entry.cpp, entry.body):
        at = call.node.start_byte
        if any(each.start_byte <= at < each.end_byte for each in read):
            continue
        for why in _acts(entry.cpp, scope, call, at < made.end_byte):
            bodies.unread(entry.cpp, call.node, why)
    for node in _stores(bodies, entry.body, scope):
        if not any(each.start_byte <= node.start_byte < each.end_byte for each in read):
            bodies.unread(entry.cpp, node, _SETS)
    for node in inside(entry.body, "declaration"):
        is_late = node.start_byte >= made.end_byte
        if is_late and (_hands_on(bodies, start, node) or _keeps_function(start.made, node)):
            bodies.unread(entry.cpp, node, "what this does to the object is not known")


def _keeps_function(made: NodeObject | None, declaration: Node) -> bool:
    """Whether a variable gets a function of its own that names the object: calls of it act."""
    words = (w for f in inside(declaration, "lambda_expression") for w in inside(f, "identifier"))
    return made is not None and any(text_of(w) == made.variable for w in words)


def _hands_on(bodies: Bodies, start: Start, declaration: Node) -> bool:
    """Whether an object of a class of the files is made that gets the node as one of its class.

    What takes any node of the library knows nothing of the variables of this one.
    """
    made, code = start.made, bodies.code
    words = {
        text_of(n)
        for n in inside(declaration, "identifier", "type_identifier", "namespace_identifier")
    }
    if made is None or made.variable not in words:
        return False
    classes = (code.classes[w] for w in words if w in code.classes and w not in bodies.unit.names)
    constructors = (f for c in classes for f in code.functions_of(c) if f.name == c.name)
    taken = {
        text_of(n)
        for f in constructors
        for p in f.parameters
        for n in inside(p.type, "type_identifier")
    }
    return not taken.isdisjoint({above.name for above in bodies.unit.lineage})


def _stores(bodies: Bodies, body: Node, scope: Scope) -> Iterator[Node]:
    """Where a body stores in a variable of a file, or a static one, or takes its address."""
    declarators = (
        d.child_by_field_name("declarator") or d
        for n in inside(body, "declaration")
        for d in n.children_by_field_name("declarator")
    )
    own = {name for each in declarators for name in declared_in(each)}
    for node in inside(body, "assignment_expression", "update_expression", "pointer_expression"):
        if node.type == "pointer_expression" and not text_of(node).startswith("&"):
            continue
        target = node.child_by_field_name("left") or node.child_by_field_name("argument")
        name, meaning = root(scope, own, target) if target is not None else ("", None)
        is_shared = name in bodies.code.variables or "::" in text_of(target or node)
        if is_shared and isinstance(meaning, Variable | Record):
            yield node


def _acts(cpp: Cpp, scope: Scope, call: CppCall, is_before: bool) -> Iterator[str]:
    form = scope.form
    why = form.places.unread(cpp, call.node, None) if form is not None and not is_before else None
    if why is not None:
        yield why
    elif (
        call.target is None
        and isinstance(scope.functions.get(call.name), Called | Inline)
        and touching(cpp, scope, call.node) is not None
    ):
        yield f'"{call.name}" may change what the model has'


def _function(node: Node) -> str:
    function = node.child_by_field_name("function")
    return text_of(function) if function is not None else text_of(node)
