"""All that the code of nodes asks ROS for: each call with its names and numbers as far as known."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.cpp_flow import climb, covers, declaration_of, made_of
from rebsync.reverse.cpp_index import Code
from rebsync.reverse.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.cpp_values import Values
from rebsync.reverse.graph import Fact, Graph
from rebsync.reverse.ros_calls_facts import Asked, Facts
from rebsync.reverse.ros_calls_sites import site_of
from rebsync.reverse.roscpp_vocabulary import (
    FILTER_SCOPES,
    FILTERS,
    FUNCTIONS,
    HANDLE,
    HANDLE_TYPE,
    NODELETS,
    RATES,
    TRANSPORTS,
    WORDS,
    Ask,
)

_CALLED = frozenset({"template_method", "template_function", "dependent_name"})


def graph_of(code: Code) -> Graph:
    """What the files ask of ROS, in the order of files and places."""
    facts = Facts(Values(code))
    found: list[Fact] = []
    for cpp in code.files:
        data = facts.values.texts.data(cpp)
        for match in WORDS.finditer(data):
            place = cpp.root.descendant_for_byte_range(match.start(), match.end())
            if place is None or place.start_byte != match.start() or place.named_child_count:
                continue
            asked = _asked(facts.values, cpp, place, match.group().decode())
            if asked is not None and not _left_out(place):
                found += facts.of(asked)
    return Graph(tuple(found))


def _left_out(place: Node) -> bool:
    """Whether a place is in `#if 0`."""
    around = climb(place, lambda n: n.type == "preproc_if")
    while around is not None:
        condition = around.child_by_field_name("condition")
        other = around.child_by_field_name("alternative")
        if condition is not None and text_of(condition) == "0":
            return other is None or not covers(other, place)
        around = climb(around, lambda n: n.type == "preproc_if")
    return False


def _asked(values: Values, cpp: Cpp, place: Node, name: str) -> Asked | None:
    """What a word of the vocabulary asks for where it stands, if anything."""
    if name in NODELETS:
        return _nodelet(values, cpp, place, name)
    if (name in RATES or name in FILTERS) and (found := _object(values, cpp, place, name)):
        return found
    node, above = place, place.parent
    while above is not None and above.type in _CALLED:
        node, above = above, above.parent
    if above is None:
        return None
    if above.type == "field_expression" and part(above, "field") == node:
        call = above.parent
        if call is None or call.type != "call_expression" or part(call, "function") != above:
            return None
        ask = _of_method(values, cpp, part(above, "argument"), name)
        return _made(values, cpp, place, call, ask, part(above, "argument"), node)
    return _of_function(values, cpp, place, node, above, name)


def _of_function(
    values: Values, cpp: Cpp, place: Node, node: Node, above: Node, name: str
) -> Asked | None:
    scope = ""
    last = node
    while above.type == "qualified_identifier" and part(above, "name") == node:
        if not scope:
            written = above.child_by_field_name("scope")
            scope = text_of(written) if written is not None else ""
        if above.parent is None:
            return None
        node, above = above, above.parent
    if above.type != "call_expression" or part(above, "function") != node:
        return None
    ask = FUNCTIONS.get((scope, name))
    return _made(values, cpp, place, above, ask, None, last)


def _of_method(values: Values, cpp: Cpp, target: Node, name: str) -> Ask | None:
    """What a method asks for, by the class of the object that it is called on."""
    type_ = values.types.type_of(cpp, target).rpartition("::")[2]
    if type_ == HANDLE_TYPE:
        return HANDLE.get(name)
    if type_ in TRANSPORTS:
        return TRANSPORTS[type_].get(name)
    if type_ in FILTERS and name == "subscribe":
        return FILTERS[type_]
    if type_ and values.texts.class_near(type_, cpp) is not None:
        names = {c.name for c in values.texts.lineage(values.texts.class_near(type_, cpp))}
        return HANDLE.get(name) if HANDLE_TYPE in names else None
    return None


def _made(
    values: Values,
    cpp: Cpp,
    place: Node,
    call: Node,
    ask: Ask | None,
    target: Node | None,
    called: Node,
) -> Asked | None:
    if ask is None:
        return None
    types: tuple[Node, ...] = ()
    if called.type in ("template_method", "template_function"):
        types = tuple(named(part(called, "arguments")))
    arguments = tuple(named(part(call, "arguments")))
    return Asked(ask, site_of(values, cpp, place, call), arguments, types, target)


def _nodelet(values: Values, cpp: Cpp, place: Node, name: str) -> Asked | None:
    call = place.parent
    if call is None or call.type != "call_expression":
        return None
    arguments = tuple(named(part(call, "arguments")))
    return Asked(NODELETS[name], site_of(values, cpp, place, call), arguments)


# --- objects that ask when they are made --------------------------------------------------------


def _object(values: Values, cpp: Cpp, place: Node, name: str) -> Asked | None:
    """`ros::Rate r(10)`, `new message_filters::Subscriber<T>(nh, "x", 1)`."""
    node, above = place, place.parent
    types: tuple[Node, ...] = ()
    scope = ""
    while above is not None and above.type in (
        "template_type",
        "qualified_identifier",
        "template_function",
    ):
        if above.type != "qualified_identifier":
            types = tuple(named(part(above, "arguments")))
        elif not scope:
            written = above.child_by_field_name("scope")
            scope = text_of(written) if written is not None else ""
        node, above = above, above.parent
    if above is None or (name in FILTERS and scope != FILTER_SCOPES[name]):
        return None
    ask = RATES.get(name) or FILTERS[name]
    if name in RATES and scope not in ("ros", ""):
        return None
    for call, arguments in _objects(values, cpp, node, above):
        if arguments and not (name in RATES and _handed_on(call)):
            return Asked(ask, site_of(values, cpp, place, call), arguments, types)
    return None


def _objects(
    values: Values, cpp: Cpp, node: Node, above: Node
) -> Iterator[tuple[Node, tuple[Node, ...]]]:
    match above.type:
        case "declaration":
            for declarator in above.children_by_field_name("declarator"):
                name = declarator
                while name.type not in ("identifier", "field_identifier"):
                    inner = name.child_by_field_name("declarator")
                    if inner is None:
                        break
                    name = inner
                if declaration_of(name) is not None and (given := made_of(name)):
                    yield declarator, given
        case "call_expression" if part(above, "function") == node:
            yield above, tuple(named(part(above, "arguments")))
        case "new_expression":
            given_ = above.child_by_field_name("arguments")
            yield above, tuple(named(given_)) if given_ is not None else ()
        case _:
            return


def _handed_on(call: Node) -> bool:
    """Whether an object is only the argument of a call, or of a declaration."""
    above = call.parent
    if above is None or call.type == "init_declarator" or above.type == "declaration":
        return False
    return above.type in ("argument_list", "init_declarator", "optional_parameter_declaration")
