"""Members of generated C++ that nothing of the model depends on: what is only told to people.

Parameters of a node that are only logged, or decide what is logged, and publishers of diagnostics.
"""

from __future__ import annotations

import re
from collections.abc import Collection

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_users import is_logging
from rebsync.reverse.bodies.scope import Publishes
from rebsync.reverse.generated.cpp_shown import OFFERS, is_plain, sends, topic_of, type_of
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import CppCall, assigned_in, call_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass
from rebsync.reverse.syntax.cpp_tree import part, squeezed, text_of

# Packages whose messages tell people how a node does, and that no node of a model is sent.
_TELLING = re.compile(r"(?:diagnostic_msgs|visualization_msgs)::")
_ARRAY = re.compile(r"std::array<[\w:]+,(\d+)>")
_PUBLISHER = re.compile(r"ros::Publisher|rclcpp::Publisher<(.*)>::SharedPtr")


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
            around = [node, *ancestors(node)]
            is_other = _is_own(node) and any(n.id in others for n in around)
            if not (is_other or any(n.id in known or is_logging(n) for n in around)):
                left.discard(text_of(node))
    return left


def _is_own(node: Node) -> bool:
    """Whether a name is that of a member of the class it stands in, if it is one of a member."""
    above = node.parent
    if above is None or above.type != "field_expression":
        return True
    return text_of(part(above, "argument")) == "this"


def telling_publishers(
    code: Code, owner: CppClass, shown: Collection[tuple[str, str]]
) -> dict[str, Publishes]:
    """The publishers of messages for people that the constructor of a class makes, by member.

    `shown` are types with topics that nobody in the code hears.
    """
    made: dict[str, list[CppCall | None]] = {}
    functions = [f for f in code.functions_of(owner) if f.body is not None]
    for function in functions:
        for name, value in assigned_in(function.body) if function.name == owner.name else ():
            made.setdefault(name, []).append(call_of(value))
    members = {f.name: _PUBLISHER.fullmatch("".join(text_of(f.type).split())) for f in owner.fields}
    arrays = {f.name: _ARRAY.fullmatch(squeezed(f.type)) for f in owner.fields}
    sizes = {name: int(found[1]) for name, found in arrays.items() if found is not None}
    found = {}
    for name, calls in made.items():
        call, declared = calls[0], members.get(name)
        if len(calls) > 1 or call is None or call.name not in OFFERS or declared is None:
            continue
        if not is_plain(call):
            continue
        type_ = type_of(call)
        is_shown = (type_, topic_of(call)) in shown and all(
            sends(f.node, name, type_, sizes) for f in functions
        )
        if declared[1] in (None, type_) and (_TELLING.match(type_) or is_shown):
            found[name] = Publishes(())
    return found
