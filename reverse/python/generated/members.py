"""What members of generated Python are that no model has: parameters of people's own, and locks."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.libraries.generated_calls import PARAMETER_OF_ROS_1
from rebsync.reverse.python.generated.module_variables import (
    imported_as,
    is_clock,
    loggers_of,
)
from rebsync.reverse.python.generated.py_types import call_parts, string_value
from rebsync.reverse.python.generated.slicing.logs import Looks, looks_in
from rebsync.reverse.syntax.ancestors import functions_around
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

VALUES = frozenset({"string", "concatenated_string", "none", "list", "tuple"})
NUMBERS = frozenset({"true", "false", "integer", "float"})
_DECLARE, _GET = "self.declare_parameter", "self.get_parameter"
_MADE_OF_ANY = frozenset({"bool", "str"})
_LOCKS = frozenset({"threading.Lock", "threading.RLock"})


def is_own_parameter(node: Node) -> bool:
    """`rospy.get_param("~label", "robot")` and `self.declare_parameter("label", "robot").value`.

    So is `self.get_parameter("label").value` behind the declaration, and a truth or text of it.
    """
    made, of = call_parts(node) or ("", [])
    if made in _MADE_OF_ANY and len(of) == 1:
        return is_own_parameter(of[0])
    inner = _asked(node)
    called, arguments = call_parts(inner if inner is not None else node) or ("", [])
    if inner is not None and called == _GET and len(arguments) == 1:
        key = string_value(arguments[0])
        return key is not None and any(declares_plain(c, key) for c in _before(node))
    if inner is not None:
        return inner is not node and declares_plain(inner)
    key = string_value(arguments[0]) if called == PARAMETER_OF_ROS_1 and arguments else None
    is_private = key is not None and key.startswith("~") and len(arguments) == 2
    return is_private and _is_plain(key or "", arguments[1])


def declares_plain(call: Node, name: str | None = None) -> bool:
    """Whether a call declares a parameter that no model has, described or not."""
    called, arguments = call_parts(call) or ("", [])
    key = string_value(arguments[0]) if called == _DECLARE and 1 < len(arguments) < 4 else None
    if key is None or name not in (None, key) or not _is_plain(key, arguments[1]):
        return False
    return all(_is_description(each) for each in arguments[2:])


def _is_description(node: Node) -> bool:
    if node.type == "keyword_argument":
        is_named = text_of(field(node, "name")) == "descriptor"
        return is_named and _is_description(field(node, "value"))
    function = node.child_by_field_name("function")
    given = field(node, "arguments") if function is not None else node
    is_made = function is not None and text_of(function).rpartition(".")[2] == "ParameterDescriptor"
    values = [n.child_by_field_name("value") or n for n in named(given)]
    return is_made and all(v.type in VALUES | NUMBERS for v in values)


def _asked(node: Node) -> Node | None:
    """What a value is asked of: `.value`, or `.get_parameter_value().string_value`."""
    if node.type != "attribute":
        return None
    inner, name = field(node, "object"), text_of(field(node, "attribute"))
    if name.endswith("_value") and inner.type == "call":
        function = field(inner, "function")
        is_value = function.type == "attribute" and not named(field(inner, "arguments"))
        is_value = is_value and text_of(field(function, "attribute")) == "get_parameter_value"
        return field(function, "object") if is_value else None
    return inner if name == "value" and inner.type == "call" else None


def _before(node: Node) -> Iterator[Node]:
    """The calls that are statements of a function before something in it."""
    function = next(functions_around(node), None)
    for statement in named(field(function, "body")) if function is not None else ():
        if statement.start_byte < node.start_byte and statement.type == "expression_statement":
            yield named(statement)[0]


def _is_plain(key: str, default: Node) -> bool:
    section = re.split(r"[./]", key.removeprefix("~"))[0]
    is_other = section not in ("env", "knownrebecs", "mailbox", "drive")
    return is_other and default.type in VALUES | NUMBERS


def is_lock(module: Scope, node: Node) -> bool:
    """Whether a value is a lock of Python's library."""
    called, arguments = call_parts(node) or ("", [])
    return imported_as(module, called) in _LOCKS and not arguments


def looks_of(
    code: PyCode, line: Sequence[Scope], makers: frozenset[str], hidden: Collection[str]
) -> Looks:
    """What names stand for in the code of a class; `hidden` are bound anew somewhere."""
    module = line[0].module
    return replace(
        looks_in(code, [*{id(c.module): c.module for c in line}.values()], makers),
        loggers=loggers_of(module).difference(hidden),
        clocks=frozenset(n for n in module.names if is_clock(module, n)).difference(hidden),
    )
