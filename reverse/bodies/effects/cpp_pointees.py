"""Whether code may change a message that a pointer leads to.

Every place that names a part of such a message counts, by whatever pointer; one that is not known
only to read it may change it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from tree_sitter import Node

from rebsync.reverse.bodies.effects.known_functions import (
    may_change,
    takes_values,
    type_takes_values,
)
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of

_LARGER = ("field_expression", "subscript_expression", "parenthesized_expression")
_ASKING = frozenset({"size", "empty", "length", "c_str", "count", "find", "compare", "substr"})
_VALUES = frozenset(
    {"unary_expression", "condition_clause", "conditional_expression", "expression_statement"}
    | {"subscript_argument_list", "cast_expression", "initializer_list", "case_statement"}
)
_NEW = ("make_shared", "make_unique", "new ")


def is_changed(fields: Iterable[str], functions: Sequence[CppFunction]) -> bool:
    """Whether functions may set fields of a message by a pointer, other than a new message's own.

    `fields` are the paths of all fields of the message.
    """
    names = {path.partition(".")[0] for path in fields}
    return any(_changes(function, names, functions) for function in functions)


def _changes(
    function: CppFunction, names: Collection[str], functions: Sequence[CppFunction]
) -> bool:
    body = function.body
    if body is None:
        return False
    new = made_in(body)
    return any(
        not is_only_read(node, function, functions)
        for node in inside(body, "field_expression", "pointer_expression")
        if leads_to(node, names) and text_of(part(node, "argument")) not in new
    )


def made_in(body: Node) -> set[str]:
    """The local pointers that lead to what a body makes for them."""
    return {
        text_of(part(node, "declarator")).strip("*& ")
        for node in inside(body, "init_declarator")
        if any(word in text_of(part(node, "value")) for word in _NEW)
    }


def leads_to(node: Node, names: Collection[str]) -> bool:
    """Whether it is what a pointer leads to, or a field of that: `*p`, `p->field`."""
    if node.type == "pointer_expression":
        is_this = part(node, "argument").type == "this"
        return text_of(part(node, "operator")) == "*" and not is_this
    return text_of(part(node, "operator")) == "->" and text_of(part(node, "field")) in names


def is_only_read(node: Node, function: CppFunction, functions: Sequence[CppFunction]) -> bool:
    """Whether what is around a part of a message is known to leave it as it is."""
    above = node.parent
    while above is not None and above.type in _LARGER and not _is_index(node, above):
        node, above = above, above.parent
    match above.type if above is not None else "":
        case kind if above is None or kind in _VALUES:
            return above is not None
        case "binary_expression":
            return text_of(part(above, "operator")) != ">>" or part(above, "left") == node
        case "assignment_expression":
            return part(above, "right") == node
        case "init_declarator" | "for_range_loop":
            return _is_copied(above)
        case "return_statement":
            return not function.gives_place
        case "call_expression":
            return text_of(node).rpartition(".")[2].rpartition("->")[2] in _ASKING
        case "argument_list":
            return _is_taken_as_value(node, above, functions)
        case _:
            return False


def _is_index(node: Node, above: Node) -> bool:
    return above.type == "subscript_expression" and part(above, "argument") != node


def _is_copied(declared: Node) -> bool:
    """Whether a declaration copies its value, or cannot change it."""
    declarator = part(declared, "declarator")
    holder = declared if declared.type == "for_range_loop" else declared.parent
    words = [text_of(child) for child in holder.named_children] if holder is not None else []
    is_place = declarator.type in ("reference_declarator", "pointer_declarator")
    return not is_place or "const" in words


def _is_taken_as_value(node: Node, arguments: Node, functions: Sequence[CppFunction]) -> bool:
    """Whether a function, or a constructor, that gets a part of a message leaves it as it is."""
    holder = arguments.parent
    if holder is None:
        return False
    if holder.type == "init_declarator":
        type_ = holder.parent.child_by_field_name("type") if holder.parent is not None else None
        return type_ is not None and type_takes_values(text_of(type_))
    call = call_of(holder)
    if call is None:
        return False
    plain = call.name.rpartition("::")[2].rpartition(".")[2].rpartition("->")[2]
    if takes_values(call) or plain in libraries.named(Kind.PUBLISH):
        return True
    place = named(arguments).index(node)
    known = [f for f in functions if f.name == plain and len(f.parameters) > place]
    return bool(known) and not any(may_change(f.parameters[place]) for f in known)
