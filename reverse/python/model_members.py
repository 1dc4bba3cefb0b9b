"""What members of generated Python are that no model has: parameters of people's own, and locks."""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.reverse.libraries.generated_calls import PARAMETER_OF_ROS_1
from rebsync.reverse.python.model_types import call_parts, string_value
from rebsync.reverse.python.module_variables import imported_as
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, text_of

VALUES = frozenset({"string", "concatenated_string", "none", "list", "tuple"})
_LOCKS = frozenset({"threading.Lock", "threading.RLock"})


def is_own_parameter(node: Node) -> bool:
    """`rospy.get_param("~label", "robot")` and `self.declare_parameter("label", "robot").value`."""
    if node.type == "attribute" and text_of(field(node, "attribute")) == "value":
        called, arguments = call_parts(field(node, "object")) or ("", [])
        is_read = called == "self.declare_parameter" and len(arguments) == 2
    else:
        called, arguments = call_parts(node) or ("", [])
        is_read = called == PARAMETER_OF_ROS_1 and len(arguments) == 2
    key = string_value(arguments[0]) if is_read else None
    if key is None or (called == PARAMETER_OF_ROS_1 and not key.startswith("~")):
        return False
    is_plain = arguments[1].type in VALUES | {"true", "false", "integer", "float"}
    section = re.split(r"[./]", key.removeprefix("~"))[0]
    return is_plain and section not in ("env", "knownrebecs", "mailbox", "drive")


def is_lock(module: Scope, node: Node) -> bool:
    """Whether a value is a lock of Python's library."""
    called, arguments = call_parts(node) or ("", [])
    head, _, rest = called.partition(".")
    whole = ".".join(filter(None, (imported_as(module, head), rest)))
    return whole in _LOCKS and not arguments
