"""Members of generated C++ that nothing of the model depends on: what is only told to people.

Parameters of a node that are only logged, or decide what is logged, and publishers of diagnostics.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_users import is_logging
from rebsync.reverse.bodies.scope import Publishes
from rebsync.reverse.syntax.cpp_calls import assigned_in, call_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass
from rebsync.reverse.syntax.cpp_tree import part, text_of

# Packages whose messages tell people how a node does, and that no node of a model is sent.
_TELLING = re.compile(r"(?:diagnostic_msgs|visualization_msgs)::")
_PUBLISHER = re.compile(r"ros::Publisher|rclcpp::Publisher<(.*)>::SharedPtr")
_OFFERS = frozenset({"advertise", "create_publisher"})


def only_logged(
    code: Code, owner: CppClass, names: Collection[str], reading: Collection[int]
) -> set[str]:
    """Those of some members that nothing but statements that log names, and those in `reading`."""
    left = set(names) - {f.name for f in owner.fields if f.markers}
    if not left:
        return left
    known = {f.node.id for f in owner.fields} | set(reading)
    others = {
        node.id
        for of in code.classes.values()
        if of.name != owner.name
        for node in (of.node, *(f.node for f in code.functions_of(of)))
    }
    for cpp in code.files:
        for node in code.named(cpp, cpp.root, sorted(left)):
            around = list(_around(node))
            is_other = _is_own(node) and any(n.id in others for n in around)
            if not (is_other or any(n.id in known or is_logging(n) for n in around)):
                left.discard(text_of(node))
    return left


def _around(node: Node) -> Iterator[Node]:
    current: Node | None = node
    while current is not None:
        yield current
        current = current.parent


def _is_own(node: Node) -> bool:
    """Whether a name is that of a member of the class it stands in, if it is one of a member."""
    above = node.parent
    if above is None or above.type != "field_expression":
        return True
    return text_of(part(above, "argument")) == "this"


def telling_publishers(code: Code, owner: CppClass) -> dict[str, Publishes]:
    """The publishers of messages for people that the constructor of a class makes, by member."""
    made: dict[str, list[str]] = {}
    for function in code.functions_of(owner):
        for name, value in assigned_in(function.body) if function.name == owner.name else ():
            call = call_of(value)
            is_offer = call is not None and call.name in _OFFERS and len(call.types) == 1
            type_ = text_of(call.types[0]) if call is not None and is_offer else ""
            made.setdefault(name, []).append("".join(type_.split()))
    members = {f.name: _PUBLISHER.fullmatch("".join(text_of(f.type).split())) for f in owner.fields}
    return {
        name: Publishes(())
        for name, types in made.items()
        if len(types) == 1
        and _TELLING.match(types[0])
        and (found := members.get(name)) is not None
        and found[1] in (None, types[0])
    }
