"""Publishers of messages that no node of a package can hear, in generated C++.

By its type: nobody subscribes to any message of it. By its topic: nothing else has the name. A
message of the library may be looked at by whoever is outside, as one of diagnostics is.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_form import CppForm
from rebsync.reverse.bodies.scope import Publishes
from rebsync.reverse.syntax.cpp_calls import CppCall, assigned_in, call_of, calls_in, string_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, last_name, part, squeezed, text_of

OFFERS = frozenset({"advertise", "create_publisher"})
_PLACES = frozenset(
    {
        *("assignment_expression", "argument_list", "binary_expression", "init_declarator"),
        *("conditional_expression", "case_statement"),
    }
)
_NAMES = ("type_identifier", "namespace_identifier", "identifier")
# Subscribers to messages of any type.
_ANY = re.compile(r"ShapeShifter|generic_subscription|GenericSubscription|AnyMsg")
_TOPIC = re.compile(r"[a-z](?:_?[a-z0-9])*", re.IGNORECASE | re.ASCII)
_GLOBAL = re.compile(r"/?(?:[a-z](?:_?[a-z0-9])*/)*", re.IGNORECASE | re.ASCII)
# What a topic is offered with: how deep its queue is, and whether the last message is kept.
_PLAIN = frozenset({"number_literal", "identifier", "true", "false"})
_QOS = re.compile(r"(?:rclcpp::)?(?:SystemDefaults|SensorData)?QoS\(\w*\)(?:\.\w+\(\w*\))*")
# Packages whose messages tell people how a node does, and that no node of a model is sent.
_TELLING = re.compile(r"(?:diagnostic_msgs|visualization_msgs)::")
_PUBLISHER = re.compile(r"ros::Publisher|rclcpp::Publisher<(.*)>::SharedPtr")
_RUNTIME = frozenset({"state", "cmd_vel", "odom", "clock", "tf", "rosout", "diagnostics"})


def shown_only(code: Code) -> frozenset[tuple[str, str]]:
    """The types with the topics of messages that the code sends to nobody in it."""
    texts = [cpp.source.text for cpp in code.files]
    offers = list(_offers(code))
    if not offers or any(map(_ANY.search, texts)):
        return frozenset()
    names = {type_.rpartition("::")[2] for type_, _, _ in offers}
    heard = {
        text_of(node)
        for cpp in code.files
        for node in inside(cpp.root, *_NAMES)
        if (node.text or b"").decode() in names and not _is_sent(node)
    }
    heard |= code.aliases.keys()
    literals = [n for cpp in code.files for n in inside(cpp.root, "string_literal")]
    return frozenset(
        (type_, name)
        for type_, name, _ in offers
        if type_.rpartition("::")[2] not in heard and name not in _RUNTIME
        if _is_free(name, {n.id for t, _, n in offers if t == type_}, literals)
    )


def is_free(code: Code, topic: Node) -> bool:
    """Whether a topic is a literal with a name that nothing else in the code has."""
    name = (string_of(topic) or "").rpartition("/")[2]
    literals = [n for cpp in code.files for n in inside(cpp.root, "string_literal")]
    return bool(name) and name not in _RUNTIME and _is_free(name, {topic.id}, literals)


def topic_of(call: CppCall) -> str:
    """The last name of the topic that a call offers; empty for what is none."""
    place, name = _split(call)
    return name if place is not None else ""


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


def _type_of(call: CppCall) -> str:
    """The type that a call is for."""
    return squeezed(call.types[0]) if len(call.types) == 1 else ""


def telling_publishers(
    code: Code, form: CppForm, owner: CppClass, shown: Collection[tuple[str, str]]
) -> dict[str, Publishes]:
    """The publishers of messages for people that the constructor of a class makes, by member.

    `shown` are types with topics that nobody in the code hears.
    """
    made: dict[str, list[CppCall | None]] = {}
    functions = [f for f in code.functions_of(owner) if f.body is not None]
    for function in functions:
        for name, value in assigned_in(function.body) if function.name == owner.name else ():
            made.setdefault(name, []).append(call_of(value))
    members = {f.name: _PUBLISHER.fullmatch(squeezed(f.type)) for f in owner.fields}
    found = {}
    for name, calls in made.items():
        call, declared = calls[0], members.get(name)
        if len(calls) > 1 or call is None or call.name not in OFFERS or declared is None:
            continue
        if not is_plain(call) or declared[1] not in (None, type_ := _type_of(call)):
            continue
        is_shown = (type_, topic_of(call)) in shown
        if _TELLING.match(type_) or (
            is_shown and all(_sends(code, form, owner, f, name) for f in functions)
        ):
            found[name] = Publishes(())
    return found


def _sends(code: Code, form: CppForm, owner: CppClass, function: CppFunction, member: str) -> bool:
    """Whether a function only publishes by a member; nothing that fills the messages may fail."""
    given = [c for c in calls_in(function.body) if c.on == member and c.name == "publish"]
    used = code.named(function.cpp, function.node, [member])
    messages = {text_of(a) for c in given for a in c.arguments}
    stores = inside(function.body, "expression_statement") if given else []
    filled = [n for n in stores if squeezed(n).partition(".")[0] in messages]
    may_fail = (
        form.raises(function.cpp, n) is not None or form.looked_up(function.cpp, n) for n in filled
    )
    return len(used) == len(given) + len(_stores(function.node, member)) and not any(may_fail)


def _stores(function: Node, member: str) -> list[Node]:
    """The statements that make a publisher."""
    found = inside(function, "assignment_expression")
    is_made = (text_of(part(n, "left")).removeprefix("this->") == member for n in found)
    return [n for n, made in zip(found, is_made, strict=True) if made]


def _offers(code: Code) -> Iterator[tuple[str, str, Node]]:
    """The calls that offer topics with plain names."""
    for cpp in code.files:
        for node in inside(cpp.root, "call_expression"):
            call = call_of(node)
            if call is None or call.name not in OFFERS:
                continue
            type_, topic = _type_of(call), topic_of(call)
            if type_ and topic:
                yield type_, topic, call.arguments[0]


def _is_sent(name: Node) -> bool:
    """Whether a type is named for a message that is made, a publisher, or one of its constants."""
    node = name
    while node.parent is not None and node.parent.type == "qualified_identifier":
        node = node.parent
    above = node.parent
    if above is None or node.type == "identifier":
        return False
    if last_name(node) != text_of(name):
        return above.type in _PLACES and node.type == "qualified_identifier"
    if above.type == "declaration":
        return above.child_by_field_name("type") == node
    if above.type in ("call_expression", "compound_literal_expression"):
        return _is_published(above)
    around = above.parent if above.type == "type_descriptor" else None
    of = around.parent if around is not None else None
    is_argument = around is not None and around.type == "template_argument_list"
    return of is not None and is_argument and text_of(part(of, "name")) in OFFERS | {"Publisher"}


def _is_published(message: Node) -> bool:
    """Whether a message is made where it is published, and has no name."""
    around = message.parent
    call = call_of(around.parent) if around is not None and around.parent is not None else None
    return call is not None and call.name == "publish" and call.arguments == (message,)


def _is_free(name: str, own: set[int], literals: list[Node]) -> bool:
    """Whether a name stands nowhere else, as a whole or as the last of a longer one."""
    others = (text_of(n).strip('"').rpartition("/")[2] for n in literals if n.id not in own)
    return name not in others
