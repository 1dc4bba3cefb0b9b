"""The places of a function that give a variable a value."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.values.cpp_flow import Texts, declaration_of, is_pointer, made_of
from rebsync.reverse.values.cpp_flow_types import Variable

_CHANGES = frozenset({"append", "push_back", "insert", "erase", "replace", "resize", "clear"})


@dataclass(frozen=True, slots=True)
class Definition:
    """A place that gives a variable a value.

    `how` is `value` (then `node` is it), `made` (of `arguments`), `declared` (with none), `added`
    (`node` is appended), `adjusted` (by a method of its own, in `text`), `element` (a loop takes it
    from `node`), `given` (a call, `node`, gets it as the argument `index` and may change it),
    `initialised` (by a constructor's list), `unknown` (why: `text`).
    """

    how: str
    place: Node
    node: Node
    arguments: tuple[Node, ...] = ()
    index: int = 0
    text: str = ""


def definitions(
    texts: Texts, cpp: Cpp, variable: Variable, path: str, start: int, end: int
) -> Iterator[Definition]:
    """The definitions of a variable, or of a field of it, between two bytes of a file."""
    for place in texts.within(cpp, variable.text, start, end):
        found = _definition(place, variable, path)
        if found is not None:
            yield found


def _definition(place: Node, variable: Variable, path: str) -> Definition | None:
    declaration = declaration_of(place)
    if declaration is not None:
        if variable.kind == "member" or place != variable.name:
            return None
        return _declared(place, declaration)
    left = _left_value(place, path)
    above = left.parent if left is not None else None
    if left is None or above is None:
        return None
    if above.type == "pointer_expression" and above.children[0].type in ("&", "*"):
        left, above = above, above.parent
    return _changed(place, left, above) if above is not None else None


def _declared(place: Node, declaration: Node) -> Definition | None:
    if declaration.type == "for_range_loop":
        return Definition("element", place, part(declaration, "right"))
    if declaration.type != "declaration":
        return None  # a parameter
    given = made_of(place)
    if given is None:
        return Definition("declared", place, place)
    holder = climb(place, _holds_value)
    plain = holder is not None and holder.type == "init_declarator"
    if holder is not None and plain and part(holder, "value").type not in _LISTS:
        return Definition("value", place, given[0])
    return Definition("made", place, declaration if holder is None else holder, given)


def _holds_value(node: Node) -> bool:
    if node.type == "function_declarator":
        return not is_pointer(node)
    return node.type == "init_declarator"


_LISTS = ("argument_list", "initializer_list")


def _left_value(place: Node, path: str) -> Node | None:
    """The whole expression of which a name is the start, if it is the variable's (field)."""
    left, above = place, place.parent
    if above is not None and above.type == "field_expression" and part(above, "field") == place:
        if part(above, "argument").type != "this":
            return None
        left, above = above, above.parent
    elif place.type == "field_identifier" and (above is None or above.type != "field_initializer"):
        return None
    for name in path.split(".") if path else []:
        if above is not None and above.type == "parenthesized_expression":
            left, above = above, above.parent
        if above is None or above.type != "field_expression":
            return left if _handed(left) else None
        if text_of(part(above, "field")) != name:
            return None
        left, above = above, above.parent
    return left


def _handed(node: Node) -> bool:
    """Whether a node is an argument of a call, or the address of one that is."""
    above = node.parent
    if above is not None and above.type == "pointer_expression":
        above = above.parent
    return above is not None and above.type == "argument_list"


def _changed(place: Node, left: Node, above: Node) -> Definition | None:
    match above.type:
        case "assignment_expression" if part(above, "left") == left:
            how = "value" if text_of(part(above, "operator")) == "=" else "added"
            if how == "added" and text_of(part(above, "operator")) != "+=":
                return Definition("unknown", place, above, text="arithmetic in place")
            return Definition(how, place, part(above, "right"))
        case "update_expression":
            return Definition("unknown", place, above, text="a count")
        case "argument_list" if above.parent is not None:
            call = above.parent
            if call.type == "call_expression":
                return Definition("given", place, call, index=named(above).index(left))
        case "field_initializer":
            lists = [n for n in above.named_children if n.type in _LISTS]
            given = tuple(named(lists[-1])) if lists else ()
            return Definition("initialised", place, above, given)
        case "field_expression" if part(above, "argument") == left:
            return _by_method(place, above)
        case "binary_expression" if text_of(above.children[1]) == ">>":
            if part(above, "right") == left:
                return Definition("unknown", place, above, text="read at run time")
    return None


def _by_method(place: Node, access: Node) -> Definition | None:
    call, method = access.parent, text_of(part(access, "field"))
    if call is None or call.type != "call_expression" or part(call, "function") != access:
        return None
    given = named(part(call, "arguments"))
    if method in ("reset", "assign") and given:
        return Definition("value", place, given[0])
    if method == "append" and len(given) == 1:
        return Definition("added", place, given[0])
    if method in libraries.named(Kind.CHANGE):
        return Definition("adjusted", place, call, text=method)
    if method in _CHANGES:
        return Definition("unknown", place, call, text=f"changed by {method}")
    return None
