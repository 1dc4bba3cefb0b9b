"""What generated code for ROS 2 says differently from that for ROS 1."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.generated.parameters import DECLARES, read_by
from rebsync.reverse.syntax.cpp_calls import CppCall, calls_in, string_of
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import named, part, text_of

SETS_UP = frozenset({"create_publisher", "start"})
# Functions that only tell of the node and its clock.
ASKS = frozenset({"get_logger", "get_clock", "get_name", "get_namespace"})
_POINTERS = ("::ConstSharedPtr", "::SharedPtr", "::ConstPtr", "ConstPtr", "::Ptr")
_ROS = frozenset(
    {
        *("NodeHandle", "Publisher", "Publishers", "Subscriber", "Subscription", "Timer"),
        *("ActionServer", "Service", "ServiceServer"),
        *("TimerBase", "WallTimer"),
    }
)
_MADE = re.compile(r"std::make_shared<\s*([\w:]+)\s*>\Z")
_PARTED = re.compile(r"\s*::\s*")
_WORD = re.compile(r"\w+")
_KNOWN, _ENV = "knownrebecs.", "env."


def message_name(type_: str) -> str:
    """A message type without its package, and without what points at it."""
    type_ = _PARTED.sub("::", type_)
    for end in _POINTERS:
        type_ = type_.removesuffix(end)
    return type_.rpartition("::")[2]


def is_of_ros(type_: str) -> bool:
    """Whether it is the type of a publisher, a subscription or a timer."""
    plain = _PARTED.sub("::", type_).removesuffix("::SharedPtr").partition("<")[0]
    plain = "ActionServer" if plain.endswith("rclcpp_action::Server") else plain
    return plain.rpartition("::")[2].strip() in _ROS


def known_rebec(key: str) -> str | None:
    """The known rebec that a parameter names, as its graph name."""
    return key.removeprefix(_KNOWN) if key.startswith(_KNOWN) else None


def constant_of_model(key: str) -> str | None:
    """The entry of `env` that a parameter is."""
    return key.removeprefix(_ENV) if key.startswith(_ENV) else None


def declared_array(call: CppCall) -> tuple[str, Node] | None:
    """The entry of `env` that `declareArray(*this, "env.x", T{...}, ...)` is, and its values."""
    if call.name != "declareArray" or len(call.arguments) != 4:
        return None
    key = constant_of_model(string_of(call.arguments[1]) or "")
    values = call.arguments[2].child_by_field_name("value")
    return (key, values) if key and values is not None else None


def arguments_in(constructor: CppFunction) -> Iterator[tuple[str, str]]:
    """The arguments of the model's constructor: the local variable, and the parameter it is of."""
    handed = _handed_on(constructor)
    for statement in named(constructor.body) if constructor.body is not None else []:
        declarator = statement.child_by_field_name("declarator")
        if declarator is None or declarator.type != "init_declarator":
            continue
        type_ = text_of(part(statement, "type"))
        call = read_by(declarator.child_by_field_name("value"), type_)
        key = string_of(call.arguments[0]) if call is not None and call.arguments else None
        name = text_of(part(declarator, "declarator"))
        if call is not None and call.name == DECLARES and key is not None and name in handed:
            yield name, key


def _handed_on(constructor: CppFunction) -> set[str]:
    """What stands in the call of `mailbox_.construct`."""
    made = (c for c in calls_in(constructor.body) if c.name == "construct" and c.arguments)
    return {word for call in made for a in call.arguments for word in _WORD.findall(text_of(a))}


def made_in(code: Code, main: CppFunction) -> Iterator[tuple[str, list[str]]]:
    """The nodes that a program's `main` makes, and the parameters that their constructors take."""
    for call in calls_in(main.body):
        made = _MADE.match(_PARTED.sub("::", call.name))
        if made is None:
            continue
        type_ = made[1]
        owner = code.classes.get(type_.rpartition("::")[2])
        functions = code.functions_of(owner) if owner is not None else ()
        own = [f for f in functions if owner is not None and f.name == owner.name]
        yield type_, [key for f in own for _, key in arguments_in(f)]
