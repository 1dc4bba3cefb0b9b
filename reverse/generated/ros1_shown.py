"""Publishers of standard messages that no node of a package can hear, in generated C++.

By its type: nobody subscribes to any message of it. By its topic: nothing else has the name. A
message of the library may be looked at by whoever is outside, as one of diagnostics is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, calls_in, string_of
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, part, squeezed, text_of

OFFERS = frozenset({"advertise", "create_publisher"})
_VALUE = re.compile(r"std_msgs::(?:msg::)?((?:U?Int(?:8|16|32|64)|Float(?:32|64)|Bool|String)\b)")
_PACKAGE = re.compile(r"\bstd_msgs\b(?!/)")
# Subscribers to messages of any type.
_ANY = re.compile(r"ShapeShifter|generic_subscription|GenericSubscription|AnyMsg")
_TOPIC = re.compile(r"[a-z](?:_?[a-z0-9])*", re.IGNORECASE | re.ASCII)
_GLOBAL = re.compile(r"/?(?:[a-z](?:_?[a-z0-9])*/)*", re.IGNORECASE | re.ASCII)
# What a topic is offered with: how deep its queue is, and whether the last message is kept.
_PLAIN = frozenset({"number_literal", "identifier", "true", "false"})
_QOS = re.compile(r"(?:rclcpp::)?(?:SystemDefaults|SensorData)?QoS\(\w*\)(?:\.\w+\(\w*\))*")
_RUNTIME = frozenset({"state", "cmd_vel", "odom", "clock", "tf", "rosout", "diagnostics"})


def shown_only(code: Code) -> frozenset[tuple[str, str]]:
    """The types with the topics of messages that the code sends to nobody in it."""
    texts = [cpp.source.text for cpp in code.files]
    if not any("std_msgs::" in text for text in texts) or any(map(_ANY.search, texts)):
        return frozenset()
    offers = list(_offers(code))
    mentions = [each for cpp in code.files for each in _mentions(cpp)] if offers else []
    if len(mentions) != sum(len(_PACKAGE.findall(text)) for text in texts):
        return frozenset()  # there is a name for the package, or for one of its types
    heard = {squeezed(node) for node in mentions if not _is_sent(node)}
    types = {type_ for type_, _, _ in offers}
    types -= {t for t in types if any(h.startswith(t) or "::" not in h for h in heard)}
    literals = [n for cpp in code.files for n in inside(cpp.root, "string_literal")]
    return frozenset(
        (type_, name)
        for type_, name, _ in offers
        if type_ in types and name not in _RUNTIME
        if _is_free(name, {n.id for t, _, n in offers if t == type_}, literals)
    )


def topic_of(call: CppCall) -> str:
    """The name, alone, of the topic that a call offers; empty if it has more of one."""
    place, name = _split(call)
    return name if place is not None and place in ("", "~/") else ""


def is_plain(call: CppCall) -> bool:
    """Whether a call only offers a topic: nothing is called back, and the name can be one."""
    rest = call.arguments[1:]
    if len(rest) > (2 if call.name == "advertise" else 1):
        return False
    if not all(a.type in _PLAIN or _QOS.fullmatch(squeezed(a)) for a in rest):
        return False
    return string_of(call.arguments[0]) is None or _split(call)[0] is not None


def _split(call: CppCall) -> tuple[str | None, str]:
    """Where a topic is, and its own name; None for what ROS takes for no name."""
    text = string_of(call.arguments[0]) or "" if call.arguments else ""
    private = "~/" if call.name == "create_publisher" and text.startswith("~/") else ""
    _, _, name = text.removeprefix(private).rpartition("/")
    place = text[: len(text) - len(name)]
    is_place = _GLOBAL.fullmatch(place.removeprefix(private)) is not None
    return (place if is_place and _TOPIC.fullmatch(name) else None), name


def type_of(call: CppCall) -> str:
    """The type that a call is for."""
    return squeezed(call.types[0]) if len(call.types) == 1 else ""


def sends(function: Node, member: str, type_: str) -> bool:
    """Whether a function publishes by a member nothing but its own messages of a type.

    These must be filled with values that cannot fail to be.
    """
    made = {
        text_of(part(d, "declarator"))
        for d in inside(function, "declaration")
        if squeezed(part(d, "type")) == type_ and part(d, "declarator").type == "identifier"
    }
    given = [c.arguments for c in calls_in(function) if c.on == member and c.name == "publish"]
    used = [n for n in inside(function, "identifier", "field_identifier") if text_of(n) == member]
    is_known = all(len(a) == 1 and text_of(a[0]) in made for a in given)
    stores = inside(function, "assignment_expression") if given else []
    filled = (n for n in stores if text_of(part(n, "left")).partition(".")[0] in made)
    is_sure = not any(map(_may_fail, filled))
    return is_known and is_sure and len(used) == len(given) + len(_stores(function, member))


def _may_fail(store: Node) -> bool:
    """Whether to find the value of a store may throw, divide by nothing, or look at no object."""
    found = inside(store, "binary_expression", "assignment_expression")
    divides = any(text_of(part(n, "operator")).rstrip("=") in ("/", "%") for n in found)
    reached = [n for n in inside(store, "field_expression") if "->" in text_of(n)]
    is_foreign = any(text_of(part(n, "argument")) != "this" for n in reached)
    looks = inside(store, "subscript_expression", "pointer_expression")
    calls = [n for n in inside(store, "call_expression") if not _is_number_as_text(n)]
    return divides or is_foreign or bool(looks) or bool(calls)


def _is_number_as_text(call: Node) -> bool:
    """Whether it is `std::to_string` of a variable, which is one of a number."""
    given = part(call, "arguments").named_children
    is_plain = len(given) == 1 and given[0].type in ("identifier", "field_expression")
    return is_plain and squeezed(part(call, "function")) == "std::to_string"


def _stores(function: Node, member: str) -> list[Node]:
    """The statements that make a publisher."""
    found = inside(function, "assignment_expression")
    is_made = (text_of(part(n, "left")).removeprefix("this->") == member for n in found)
    return [n for n, made in zip(found, is_made, strict=True) if made]


def _offers(code: Code) -> Iterator[tuple[str, str, Node]]:
    """The calls that offer topics with plain names for single values."""
    for cpp in code.files:
        for node in inside(cpp.root, "call_expression"):
            call = call_of(node)
            if call is None or call.name not in OFFERS:
                continue
            type_, topic = type_of(call), topic_of(call)
            if _VALUE.fullmatch(type_) and topic:
                yield type_, topic, call.arguments[0]


def _mentions(cpp: Cpp) -> Iterator[Node]:
    """The names of types of the package, as they stand."""
    for node in inside(cpp.root, "qualified_identifier"):
        if text_of(node).startswith("std_msgs"):
            yield node


def _is_sent(mention: Node) -> bool:
    """Whether a type is named to declare a message, or for a publisher."""
    above = mention.parent
    if above is not None and above.type == "declaration":
        return part(above, "type") == mention
    around = above.parent if above is not None and above.type == "type_descriptor" else None
    of = around.parent if around is not None else None
    is_argument = around is not None and around.type == "template_argument_list"
    name = text_of(part(of, "name")) if of is not None and is_argument else ""
    return name in OFFERS | {"Publisher"} and _VALUE.fullmatch(squeezed(mention)) is not None


def _is_free(name: str, own: set[int], literals: list[Node]) -> bool:
    """Whether a name stands nowhere else, as a whole or as the last of a longer one."""
    others = (text_of(n).strip('"').rpartition("/")[2] for n in literals if n.id not in own)
    return name not in others
