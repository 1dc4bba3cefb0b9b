"""What a word of a library without node handles asks for: of nodes, and nodes themselves."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.calls.receivers import says_enough
from rebsync.reverse.calls.ros_calls_shapes import (
    MAKERS,
    TEMPLATES,
    Asked,
    called_as,
    handed_on,
    is_used,
    objects_of,
    types_of,
)
from rebsync.reverse.calls.ros_calls_types import is_interface
from rebsync.reverse.calls.words import Word
from rebsync.reverse.libraries.routines import Kind, Routine
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_declarations import unscoped
from rebsync.reverse.syntax.cpp_index import CppClass
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.reverse.values.cpp_flow_types import unscoped_member
from rebsync.reverse.values.cpp_values import Values


def asked_of_nodes(word: Word) -> Iterator[Asked]:
    """What a word asks for, if anything."""
    if word.name in word.calls.nodes:
        return _node(word)
    if word.name in word.calls.objects:
        return _object(word)
    return word.as_called(_of_method, _of_function)


# --- calls --------------------------------------------------------------------------------------


def _of_method(word: Word, call: Node, called: Node, target: Node) -> Iterator[Asked]:
    """`node->create_publisher<T>("x", 10)`."""
    calls, values, cpp = word.calls, word.values, word.cpp
    name = unscoped_member(called)
    ask = calls.on_nodes.get(name)
    if ask is None:
        return
    scope, _, type_ = values.types.type_of(cpp, target).rpartition("::")
    is_own = scope.rpartition("::")[2] not in calls.node_scopes  # `rclcpp::Node` is no own `Node`
    class_ = values.texts.class_near(type_, cpp) if type_ and is_own else None
    if class_ is not None:
        meant = _may_be_node(values, class_, name)
    elif type_ in calls.known:
        ask = calls.methods.get(type_, {}).get(name)
        meant = ask is not None
    else:
        given = tuple(named(part(call, "arguments")))
        meant = type_ in calls.nodes or says_enough(values, cpp, ask, given)
    if meant and ask is not None:
        yield word.asked(ask, call, types=types_of(called), target=target)


def _of_function(word: Word, node: Node, above: Node) -> Iterator[Asked]:
    """`create_publisher<T>("x", 10)` in a class of nodes, `library::create_timer(...)`."""
    calls, values, cpp, name = word.calls, word.values, word.cpp, word.name
    called = called_as(node, above)
    if called is None:
        return
    scope, call = called
    if not scope:
        scope = next((s for s, n in calls.functions if n == name and is_used(cpp, (s,), n)), "")
    ask = calls.functions.get((scope, name))
    if ask is not None and values.calls.functions(cpp, call):
        return  # it is among the files, and read itself
    if ask is None and scope in ("", *calls.nodes):
        function = values.texts.function_around(cpp, word.place)
        class_ = values.texts.class_of(function)
        if class_ is not None and _may_be_node(values, class_, name):
            ask = calls.on_nodes.get(name)
    if ask is not None:
        yield word.asked(ask, call, types=types_of(node))


def _may_be_node(values: Values, class_: CppClass, method: str) -> bool:
    """Whether a class has a method of nodes from above: from rclcpp, or from outside of the files.

    A class that declares a method of that name itself has its own.
    """
    lineage = values.texts.lineage(class_)
    if any(f.name == method for c in lineage for f in c.functions):
        return False
    if any(c.roots for c in lineage):
        return True
    known = {c.name for c in lineage}
    return any("Node" in b for c in lineage for b in _bases(c) - known)


def _bases(class_: CppClass) -> set[str]:
    """The last names of the bases of a class that may be nodes, which types of messages are not."""
    clauses = (n for n in class_.node.named_children if n.type == "base_class_clause")
    return {unscoped(b) for n in clauses for b in named(n) if not is_interface(text_of(b))}


# --- nodes --------------------------------------------------------------------------------------


def _node(word: Word) -> Iterator[Asked]:
    """`: Node("x")`, `rclcpp::Node::make_shared("x")`, `std::make_shared<rclcpp::Node>("x")`."""
    texts, name = word.values.texts, word.name
    named_ = word.calls.nodes[name]
    scope, node, above = "", word.place, word.place.parent
    while above is not None and above.type == "qualified_identifier":
        written = above.child_by_field_name("scope")
        if written is not None and part(above, "name") == node:
            scope = text_of(written)
        elif written == node and above.parent is not None:
            yield from _by_own_maker(word, above, named_)
            return
        node, above = above, above.parent
    if above is None:
        return
    if not scope and texts.code.all_classes.get(name):
        return  # a class of that name of their own
    if above.type == "field_initializer":
        class_ = texts.class_of(texts.function_around(word.cpp, word.place))
        if class_ is not None and name in _bases(class_):
            lists = [n for n in above.named_children if n.type.endswith("_list")]
            given = tuple(named(lists[-1])) if lists else ()
            yield word.asked(named_, above, given)
    elif scope.rpartition("::")[2] in word.calls.node_scopes:
        for call, given in objects_of(node, above):
            if given or above.type == "type_descriptor":
                yield word.asked(named_, call, given)


def _object(word: Word) -> Iterator[Asked]:
    """`rclcpp::GenericTimer<F>::make_shared(clock, period, f)`, `rclcpp::Rate rate(10)`."""
    ask, scopes = word.calls.objects[word.name]
    node, above = word.place, word.place.parent
    scope = ""
    while above is not None and above.type in (*TEMPLATES, "qualified_identifier"):
        if above.type == "qualified_identifier" and part(above, "name") != node:
            yield from _by_own_maker(word, above, ask)
            return
        if above.type == "qualified_identifier" and not scope:
            written = above.child_by_field_name("scope")
            scope = text_of(written) if written is not None else ""
        node, above = above, above.parent
    is_rate = ask.kind is Kind.RATE
    if above is None or (is_rate and scope not in scopes):
        return
    for call, given in objects_of(node, above):
        if not is_rate or (given and not handed_on(call)):
            yield word.asked(ask, call, given)


def _by_own_maker(word: Word, above: Node, ask: Routine) -> Iterator[Asked]:
    """`rclcpp::Node::make_shared("x")`; `above` is the name with the class before it."""
    if unscoped_member(part(above, "name")) not in MAKERS:
        return
    call = climb(above, lambda n: n.type != "qualified_identifier")
    if call is not None and call.type == "call_expression":
        yield word.asked(ask, call)
