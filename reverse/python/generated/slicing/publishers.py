"""Publishers of standard messages that no node of a package can hear, in generated Python.

By its type: nobody subscribes to any message of it. By its topic: nothing else has the name. A
value that the message may refuse is another matter: to publish that raises.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.build.told_messages import TOLD
from rebsync.reverse.libraries.generated_calls import PUBLISHER_OF_NODE, PUBLISHER_OF_ROS_1
from rebsync.reverse.libraries.python_telling import broadcasters
from rebsync.reverse.python.generated.module_variables import call_and_arguments, imported_as
from rebsync.reverse.python.generated.py_types import call_parts, string_value
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import field, named, text_of, whole_number_of

_INTEGERS = frozenset({"byte", "int", "short"})
# By the names of messages, the types of variables that their values can be.
_VALUES = {
    **{"Bool": frozenset({"boolean"}), "Int32": _INTEGERS, "Int64": _INTEGERS},
    **{"Float32": frozenset({"float", "double"}), "Float64": frozenset({"float", "double"})},
    **{"Int32MultiArray": _INTEGERS, "Int64MultiArray": _INTEGERS, "String": frozenset[str]()},
}
_LITERALS = {
    **{"Bool": ("true", "false"), "Int32": ("integer",), "Int64": ("integer",)},
    **{"Float32": ("float",), "Float64": ("float",)},
}
_PLAIN = frozenset({"string", "integer", "float", "true", "false", "none"})
_IN_TEXTS = _INTEGERS | {"boolean", "float", "double"}
_QUOTED = re.compile(r"[fF]?[\"']")
# What says how many messages may wait: without, rospy waits for those who listen.
_DEPTH = {
    PUBLISHER_OF_ROS_1: re.compile(r"queue_size=[1-9]\d*"),
    PUBLISHER_OF_NODE: re.compile(r"[1-9]\d*"),
}
PUBLISHERS = frozenset(_DEPTH)
_LATCHED = frozenset({"latch=False", "latch=True"})
_GREATEST = 2**31 - 1
_PACKAGE = "std_msgs"
_TOPIC = re.compile(r"(?:~/?|/)?(?:[a-z](?:_?[a-z0-9])*/)*([a-z](?:_?[a-z0-9])*)", re.I | re.A)
_RUNTIME = frozenset({"state", "cmd_vel", "odom", "clock", "tf", "rosout", "diagnostics"})


@dataclass(frozen=True, eq=False, slots=True)
class Shown:
    """A publisher of messages of a type, and the types of the variables of its class.

    `dumps` are the names in the module for what writes a value as JSON.
    """

    type: str
    variables: Mapping[str, m.Type]
    dumps: frozenset[str] = frozenset()

    @property
    def full_type(self) -> str:
        """The type as the library of messages has it."""
        return f"{_PACKAGE}.msg.{self.type}"

    @property
    def is_float(self) -> bool:
        """Whether its messages have one number with a point."""
        return self.type in ("Float32", "Float64")

    def value(self, arguments: list[Node]) -> Node | None:
        """The value of the message that it is given: `Int32(data=self._x)`."""
        given = arguments[0] if len(arguments) == 1 else None
        if given is None or given.type != "call" or text_of(field(given, "function")) != self.type:
            return None
        values = named(field(given, "arguments"))
        if len(values) != 1 or values[0].type != "keyword_argument":
            return None
        is_data = text_of(field(values[0], "name")) == "data"
        return field(values[0], "value") if is_data else None

    def takes(self, value: Node) -> bool:
        """Whether its messages take a value."""
        if self.type == "String":
            return self._is_text(value)
        if value.type in _LITERALS.get(self.type, ()):
            whole = whole_number_of(value)
            return value.type != "integer" or (whole is not None and whole <= _GREATEST)
        called, given = call_parts(value) or ("", [])
        if self.type.endswith("Array"):
            is_made = called == "list" and len(given) == 1
            return is_made and self._is_of(given[0], _VALUES[self.type], 1)
        if self.type == "Bool" and value.type == "not_operator":
            return self._is_of(field(value, "argument"), _VALUES[self.type])
        if self.type.startswith("Float") and called == "float" and len(given) == 1:
            return self._is_of(given[0], _INTEGERS | _VALUES[self.type])
        return self._is_of(value, _VALUES[self.type])

    def _is_of(self, value: Node, types: frozenset[str], dimensions: int = 0) -> bool:
        """Whether a value is a variable of one of some types, or an element that is there."""
        at = value.children_by_field_name("subscript") if value.type == "subscript" else []
        holder, _, name = text_of(field(value, "value") if at else value).partition(".")
        type_ = self.variables.get(name) if holder == "self" else None
        if type_ is None or len(type_.dimensions) != dimensions + len(at) or len(at) > 1:
            return False
        numbers = [whole_number_of(each) for each in at]
        is_there = all(n is not None and 0 <= n < type_.dimensions[0] for n in numbers)
        return is_there and type_.name in types

    def _is_text(self, value: Node) -> bool:
        """Whether it is a text that can be sent, put together of plain ones and of variables."""
        if value.type == "call":
            _, given = call_parts(value) or ("", [])
            if text_of(field(value, "function")) in self.dumps and len(given) == 1:
                return self._is_record(given[0])
            is_plain = text_of(field(value, "function")) == "str" and len(given) == 1
            return is_plain and self._is_of(given[0], _IN_TEXTS)
        if value.type != "string" or _QUOTED.match(text_of(value)) is None:
            return False
        parts = [n for n in named(value) if n.type not in ("string_start", "string_end")]
        return "\\" not in text_of(value) and all(
            n.type == "string_content" or self._is_put_in(n) for n in parts
        )

    def _is_record(self, value: Node) -> bool:
        """Whether a dictionary has plain texts as keys, and variables, numbers or texts in it."""
        pairs = named(value) if value.type == "dictionary" else []
        keys = (field(p, "key") if p.type == "pair" else p for p in pairs)
        return bool(pairs) and all(
            key.type == "string" and (self._is_of(kept, _IN_TEXTS) or kept.type in _PLAIN)
            for key, kept in zip(keys, (p.child_by_field_name("value") for p in pairs), strict=True)
            if kept is not None
        )

    def _is_put_in(self, part: Node) -> bool:
        """Whether a part of a text is a variable, as it is."""
        inside = named(part) if part.type == "interpolation" else []
        return len(inside) == 1 and self._is_of(inside[0], _IN_TEXTS)


def shown_by(
    code: PyCode, module: Scope, value: Node, variables: Mapping[str, m.Type]
) -> Shown | None:
    """The publisher that a call in a module makes, if nothing in the package can hear it."""
    called, _ = call_parts(value) or ("", [])
    if called not in _DEPTH or not code.alone:
        return None
    arguments = named(field(value, "arguments"))
    given, rest = arguments[:2], [text_of(a) for a in arguments[2:]]
    if not rest or _DEPTH[called].fullmatch(rest[0]) is None or not set(rest[1:]) <= _LATCHED:
        return None
    topics = [s for a in given if (s := string_value(a)) is not None]
    types = [t for a in given if (t := text_of(a)) in _VALUES and _is_standard(module, t)]
    if len(topics) != 1 or len(types) != 1 or not is_topic(topics[0], called):
        return None
    type_, name = types[0], _own_name(topics[0])
    if not name:
        return None
    modules = [*code.modules.values()]
    is_heard = any(_hears(each, type_) for each in modules)
    taken = any(_is_named(each.node, name, type_) for each in modules)
    return None if is_heard or taken else Shown(type_, variables, _dumps(module))


def _dumps(module: Scope) -> frozenset[str]:
    names = {"json": "json.dumps", "dumps": "dumps"}
    return frozenset(
        n for i, n in names.items() if imported_as(module, i) in ("json", "json.dumps")
    )


def is_topic(name: str, offered_by: str) -> bool:
    """Whether a name can be that of a topic; `~name` only rospy knows."""
    is_private = name.startswith("~") and not name.startswith("~/")
    return _TOPIC.fullmatch(name) is not None and not (
        is_private and offered_by == PUBLISHER_OF_NODE
    )


def tells_by(code: PyCode, module: Scope, node: Node, types: Mapping[str, str]) -> bool:
    """Whether something makes a publisher for people, of messages of some types.

    `types` are by what the module calls them. So is a broadcaster of transforms that nobody asks
    for.
    """
    called, arguments = call_and_arguments(node)
    if imported_as(module, called) in broadcasters():
        return not any("TransformListener" in s.py.source.text for s in code.modules.values())
    given = [name for a in arguments if (name := text_of(a)) in types]
    topics = [s for a in arguments if (s := string_value(a)) is not None]
    is_named = len(topics) == 1 and is_topic(topics[0], called)
    if called not in PUBLISHERS or len(given) != 1 or not is_named:
        return False
    return types[given[0]] in TOLD or is_private(code, module, topics[0], given[0])


def is_private(code: PyCode, module: Scope, topic: str, type_: str) -> bool:
    """Whether a topic is a node's own, and nothing in the package asks for messages of its type.

    `type_` is what the module calls that.
    """
    name, modules = _own_name(topic), code.modules.values()
    if not name or not code.alone:
        return False
    if topic == name and any(_is_named(each.node, name, type_) for each in modules):
        return False
    others = (s.py.source.text for s in code.modules.values() if s is not module)
    uses = (n for n in nodes_in(module.node) if n.type == "identifier" and text_of(n) == type_)
    return not any(type_ in text for text in others) and all(map(_is_sent, uses))


def _own_name(topic: str) -> str:
    """The name of a topic in the node, or where the node is; empty if it is another's."""
    name = topic.removeprefix("~").removeprefix("/") if topic.startswith("~") else topic
    return "" if "/" in name or name in _RUNTIME else name


def _is_standard(module: Scope, name: str) -> bool:
    """Whether a name of a module is that of a message of the package, and nothing else."""
    bindings = module.names.get(name, [])
    nodes = [b.node for b in bindings if b.node.type == "import_from_statement"]
    return len(nodes) == len(bindings) == 1 and _is_plain(nodes[0])


def _is_plain(statement: Node) -> bool:
    """Whether it is `from std_msgs.msg import Int32`, each by its own name."""
    module = field(statement, "module_name")
    names = [c for c in named(statement) if c != module]
    is_messages = text_of(module) == f"{_PACKAGE}.msg"
    return is_messages and all(n.type == "dotted_name" for n in names)


def _hears(module: Scope, type_: str) -> bool:
    """Whether a module may do more with messages of a type than to make and to publish them."""
    source = module.py.source
    if is_runtime_file(source):
        return False
    imports = [n for n in nodes_in(module.node) if n.type == "import_from_statement"]
    plain = [n for n in imports if _PACKAGE in text_of(n) and _is_plain(n)]
    if source.text.count(_PACKAGE) != len(plain) or "AnyMsg" in source.text:
        return True
    if not plain:
        return False
    uses = (n for n in nodes_in(module.node) if n.type == "identifier" and text_of(n) == type_)
    return not all(map(_is_sent, uses))


def _is_sent(use: Node) -> bool:
    """Whether a type is named to make a message or a publisher, or where it is imported."""
    above = use.parent
    if above is None or above.type == "dotted_name":
        return above is not None
    if above.type == "call":
        return field(above, "function") == use
    call = above.parent if above.type == "argument_list" else None
    return call is not None and text_of(field(call, "function")) in PUBLISHERS


def _is_named(root: Node, name: str, type_: str) -> bool:
    """Whether a text is a name, or ends with it, but for those of publishers of a type."""
    for node in nodes_in(root):
        if node.type != "string_content" or re.split(r"[/~]", text_of(node))[-1] != name:
            continue
        listed = node.parent.parent if node.parent is not None else None
        call = listed.parent if listed is not None else None
        if call is None or call.type != "call" or listed is None:
            return True
        is_publisher = text_of(field(call, "function")) in PUBLISHERS
        if not is_publisher or type_ not in map(text_of, named(listed)):
            return True
    return False
