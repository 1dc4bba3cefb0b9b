"""What generated Python reads a parameter with: rospy's words, rclpy's, and the run-time part's."""

from __future__ import annotations

import re
from collections.abc import Mapping

from tree_sitter import Node

from rebsync import model as m
from rebsync.package import Value
from rebsync.records import dataclass
from rebsync.reverse.generated.own_parameters import OwnParameter
from rebsync.reverse.libraries.generated_calls import PARAMETER_OF_ROS_1
from rebsync.reverse.python.generated.py_types import (
    call_parts,
    literal_type,
    string_value,
    without_parentheses,
)
from rebsync.reverse.syntax.ancestors import functions_around
from rebsync.reverse.syntax.py_tree import field, named, number_of, text_of

# Their names say whose a parameter is: `~` in front in ROS 1, `env.` in ROS 2.
_READS = frozenset({PARAMETER_OF_ROS_1, "declared", "read_array", "declare_array"})
_OF_ROS_2 = frozenset({"declared", "declare_array"})
_DECLARES = frozenset({"self.declare_parameter", "node.declare_parameter"})
_MOST_DECLARED = 3  # the next one is `ignore_override`: nobody else gives it a value then
_ASKS = frozenset({"self.get_parameter", "node.get_parameter"})
_GIVES = {
    "integer_value": m.Type("int"),
    "double_value": m.Type("double"),
    "bool_value": m.Type("boolean"),
}
_MADE_OF_ANY = frozenset({"bool", "str"})
LITERALS = frozenset(
    {
        *("string", "concatenated_string", "none", "list", "tuple"),
        *("true", "false", "integer", "float"),
    }
)
_CONVERTS = frozenset(
    {
        *("Rebec", "bool", "boolean", "float", "float32", "float64"),
        *("int", "int8", "int16", "int32"),
    }
)


@dataclass(frozen=True, slots=True)
class ParameterRead:
    """A parameter that code reads: a node's own one, or else a constant of the model."""

    key: str
    default: Node | None
    is_own: bool
    for_all: bool = False

    @property
    def type(self) -> m.Type | None:
        """The type of a variable that gets it, as far as the default says so."""
        return literal_type(self.default) if self.default is not None else None

    def own(self) -> OwnParameter | None:
        """The same as a parameter that the model's constructor may have."""
        default = constant(self.default)
        if not self.is_plain or default is None or isinstance(default, tuple):
            return None
        return OwnParameter(self.key, default, not self.for_all, self.for_all)

    @property
    def is_plain(self) -> bool:
        """Whether it is none of the parameters that generated code reads for itself."""
        return self.is_own and OwnParameter(self.key, 0).is_plain


def parameter_read(
    value: Node, declared: Mapping[str, ParameterRead] | None = None
) -> ParameterRead | None:
    """The parameter that a value is, converted or not; None if it is more than that.

    `declared` are those that a node of ROS 2 has, by their names.
    """
    called, arguments = call_parts(without_parentheses(value)) or ("", [])
    if called.partition("[")[0] in _CONVERTS and len(arguments) == 1:
        return parameter_read(arguments[0], declared)
    return _asked(without_parentheses(value), declared or {})


def is_of_people(value: Node) -> bool:
    """Whether a value is a parameter of the node's own, or its truth or text, with a default.

    `self.get_parameter("label").value` is one behind the declaration. It may be of any type.
    """
    called, arguments = call_parts(value) or ("", [])
    if called in _MADE_OF_ANY and len(arguments) == 1:
        return is_of_people(arguments[0])
    function = next(functions_around(value), None)
    statements = named(field(function, "body")) if function is not None else []
    before = (s for s in statements if s.start_byte < value.start_byte)
    declared = (declared_by(named(s)[0]) for s in before if s.type == "expression_statement")
    read = _asked(value, dict(filter(None, declared)))
    default = read.default if read is not None and read.is_plain else None
    return default is not None and default.type in LITERALS


def _asked(value: Node, declared: Mapping[str, ParameterRead]) -> ParameterRead | None:
    """The parameter that is asked for, not converted."""
    if value.type == "attribute":
        return _given(value, declared)
    called, arguments = call_parts(value) or ("", [])
    strings = [(i, s) for i, a in enumerate(arguments) if (s := string_value(a)) is not None]
    if not strings or called not in _READS:
        return None
    index, said = strings[0]
    default = arguments[index + 1] if index + 1 < len(arguments) else None
    if called in _OF_ROS_2:
        return _of_ros2(said, default)
    return ParameterRead(said.removeprefix("~"), default, said.startswith("~"))


def declared_by(call: Node) -> tuple[str, ParameterRead] | None:
    """The parameter that `self.declare_parameter("x", 7)` declares, by its name."""
    called, arguments = call_parts(call) or ("", [])
    name = string_value(arguments[0]) if len(arguments) > 1 else None
    if called not in _DECLARES or name is None or not all(map(_is_descriptor, arguments[2:])):
        return None
    if len(arguments) > _MOST_DECLARED:
        return None
    return name, _of_ros2(name, arguments[1])


def _is_descriptor(argument: Node) -> bool:
    """Whether it only describes: by a name it may change what a parameter is given."""
    if argument.type == "keyword_argument":
        is_named = text_of(field(argument, "name")) == "descriptor"
        return is_named and _is_descriptor(field(argument, "value"))
    called, arguments = call_parts(argument) or ("", [])
    values = [n.child_by_field_name("value") or n for n in arguments]
    is_made = called.rpartition(".")[2] == "ParameterDescriptor"
    is_made = is_made and all(v.type in LITERALS for v in values)
    return is_made or argument.type in ("identifier", "attribute")


def only_declares(call: Node, function: Node) -> bool:
    """Whether a call declares a parameter that the model may have, and nothing else there does."""
    said = declared_by(call)
    if said is None or said[1].is_own:
        is_text = said is not None and string_value(said[1].default) is not None
        return said is not None and (said[1].is_plain if is_text else said[1].own() is not None)
    again = re.compile(rf"declare\w*\([^()]*[\"']{re.escape(said[0])}[\"']")
    return len(again.findall(text_of(function))) == 1


def _of_ros2(name: str, default: Node | None) -> ParameterRead:
    key = name.removeprefix("env.").replace(".", "/")
    return ParameterRead(key, default, not name.startswith("env."), True)


def _given(value: Node, declared: Mapping[str, ParameterRead]) -> ParameterRead | None:
    """What `.value` of a parameter is, or `.get_parameter_value().integer_value`."""
    asked, name = without_parentheses(field(value, "object")), text_of(field(value, "attribute"))
    if name.endswith("_value"):
        function = asked.child_by_field_name("function")
        called, arguments = call_parts(asked) or ("", [])
        if function is None or not called.endswith(".get_parameter_value") or arguments:
            return None
        asked = without_parentheses(field(function, "object"))
    elif name != "value":
        return None
    found = declared_by(asked)
    if found is None:
        called, arguments = call_parts(asked) or ("", [])
        said = string_value(arguments[0]) if called in _ASKS and len(arguments) == 1 else None
        read = declared.get(said or "")
    else:
        _, read = found
    is_given = read is not None and (name == "value" or read.type == _GIVES.get(name))
    return read if is_given else None


def constant(node: Node | None) -> Value | None:
    """A constant of Python: a number, a truth value, or an array of these."""
    match node.type if node is not None else None:
        case "true" | "false":
            return node is not None and node.type == "true"
        case "integer" | "float":
            return number_of(node) if node is not None else None
        case "unary_operator" if node is not None:
            inner = constant(field(node, "argument"))
            return -inner if isinstance(inner, (int, float)) else None
        case "call":
            called, arguments = call_parts(node) or ("", [])
            if called == "Array" and len(arguments) == 1:
                values = [constant(v) for v in named(arguments[0])]
                return None if None in values else tuple(v for v in values if v is not None)
            return constant(arguments[0]) if len(arguments) == 1 else None
        case _:
            return None
