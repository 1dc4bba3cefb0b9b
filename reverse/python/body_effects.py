"""What of Python touches nothing that the model has: it may be left out, and is worth anything."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.python.body_reading import Reading
from rebsync.reverse.python.body_scope import Frame, Message, Own
from rebsync.reverse.python.py_index import last_name
from rebsync.reverse.python.py_tree import field, text_of

# Calls that wait, end the node, or lead to its callbacks: by the last word of what is called.
_ACTS = re.compile(
    r"sleep|wait|spin|publish|shutdown|exit|_exit|abort|kill|cancel|destroy|start|stop|reset|call"
    r"|shut|run|exec|eval|unregister|register|setattr|delattr|connect|raise|create_|input|acquire"
    r"|set_param|signal|send_goal|add_|execute|getch|readline|read\b|recv|accept|join|get_key"
)
_PLAIN = frozenset(
    {"print", "str", "repr", "len", "int", "float", "bool", "abs", "min", "max", "sum", "round"}
    | {"range", "list", "tuple", "dict", "set", "sorted", "reversed", "zip", "map", "filter"}
    | {"enumerate", "any", "all", "isinstance", "type", "format", "pow", "chr", "ord", "hasattr"}
    | {"getattr", "append", "join", "strip", "split", "replace", "lower", "upper", "startswith"}
    | {"endswith", "encode", "decode"}
)
LOG = re.compile(
    r"(rospy\.)?(log(debug|info|warn|err|fatal)(_once|_throttle|_throttle_identical)?)\Z"
    r"|(\w+\.)*(get_logger\(\)|_?logger(_)?|_?log)\.(debug|info|warn|warning|error|fatal)\Z"
)
_WORDS = frozenset({"await", "yield", "named_expression"})


def is_log(call: Node) -> bool:
    """Whether a call only writes to a log."""
    called = text_of(field(call, "function"))
    return LOG.match("".join(called.split())) is not None or called == "print"


def is_harmless(reading: Reading, node: Node, frame: Frame) -> bool:
    """Whether evaluating an expression changes nothing of the model, and takes no time."""
    return all(_is_one(reading, n, frame) for n in _all(node))


def _is_one(reading: Reading, node: Node, frame: Frame) -> bool:
    if node.type in _WORDS:
        return False
    if node.type != "call":
        return _is_safe_name(reading, node, frame)
    if is_log(node):
        return True
    function = field(node, "function")
    name = last_name(function)
    if reading.fact(node, frame) is not None and not _is_parameter(name):
        return False
    if reading.function(function, frame) is not None:
        return False
    return name in _PLAIN or (bool(name) and _ACTS.match(name) is None and _ends(name))


def _is_parameter(name: str) -> bool:
    return name in ("get_param", "get_param_cached", "has_param", "get_parameter") or (
        name in ("declare_parameter", "declare_parameters", "get_parameter_or", "has_parameter")
    )


def _ends(name: str) -> bool:
    return not name.endswith(("_async", "_once"))


def _is_safe_name(reading: Reading, node: Node, frame: Frame) -> bool:
    """Whether a name hands nothing of the node out: not the object itself, nor its methods."""
    above = node.parent
    if node.type not in ("identifier", "attribute") or above is None:
        return True
    if above.type in ("attribute", "call") and node in (
        above.child_by_field_name("object"),
        above.child_by_field_name("function"),
        above.child_by_field_name("attribute"),
    ):
        return True
    if above.type == "keyword_argument" and above.child_by_field_name("name") == node:
        return True
    if node.type == "identifier":
        meaning = reading.name(text_of(node), node, frame)
        if isinstance(meaning, Own):
            return False
        if isinstance(meaning, Message):
            return _is_looked_at(node)
    return reading.function(node, frame) is None


def _is_looked_at(node: Node) -> bool:
    """Whether something only looks at a message: a log or a text."""
    at = node.parent
    while at is not None and not at.type.endswith("statement"):
        if at.type == "call":
            name = last_name(field(at, "function"))
            return is_log(at) or name in _PLAIN
        at = at.parent
    return True


def _all(node: Node) -> Iterator[Node]:
    waiting = [node]
    while waiting:
        current = waiting.pop()
        yield current
        waiting += current.named_children
