"""Messages that generated Python tells people something with: whether their fields take the values.

A field that a type has not, and a value of another type, raise where they are stored, or where the
message is published. rclpy takes no whole number for a field with a point, and no other way round.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import field as with_default

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.build.common_messages import COMMON
from rebsync.reverse.build.told_messages import CONSTANTS, TOLD
from rebsync.reverse.python.generated.module_variables import imported_as
from rebsync.reverse.python.generated.slicing.logs import Looks
from rebsync.reverse.python.generated.slicing.publishers import Shown
from rebsync.reverse.syntax.ancestors import functions_around
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

# Types of other packages that people look at; a node may hear them, so only by names of its own.
_PRIVATE = frozenset(
    {
        *("geometry_msgs/PointStamped", "geometry_msgs/PoseStamped", "nav_msgs/Path"),
        "geometry_msgs/TransformStamped",
    }
)
_TYPES = {**COMMON, **TOLD}
_PARTS = 5  # translation, rotation, time, child, parent
_ARRAY = re.compile(r"(.*)\[\d*\]\Z")
_WITH_POINT = frozenset({"float", "double"})
_GIVING_POINTS = frozenset({"float"})
_GIVING_WHOLE = frozenset({"int", "len", "round"})
_NUMBERS = frozenset({"integer", "float", "true", "false"})
_NEVER_NUMBERS = frozenset({"none", "list", "tuple", "dictionary", "string", "concatenated_string"})
_HUGE = 1e9
_TRUE = frozenset({"true", "false", "comparison_operator", "not_operator"})


def told_types(module: Scope) -> dict[str, str]:
    """The types of messages for people that a module imports, by their names there."""
    found = {}
    for name in module.names:
        package, _, type_ = imported_as(module, name).rpartition(".")
        full = f"{package.removesuffix('.msg')}/{type_}"
        if package.endswith(".msg") and full in TOLD.keys() | _PRIVATE:
            found[name] = full
    return found


@dataclass(frozen=True, eq=False, slots=True)
class ToldMessages:
    """The messages of a class, by what its module calls their types; `variables` are its state,
    `shown` its publishers of messages that nobody hears.
    """

    types: Mapping[str, str]
    variables: Mapping[str, m.Type]
    looks: Looks
    shown: Mapping[str, Shown] = with_default(default_factory=dict)

    def fit(self, statement: Node) -> bool:
        """Whether all fields that a statement makes or stores take what they are given."""
        is_asked = self.types or self.shown
        return all(map(self._fits_here, nodes_in(statement))) if is_asked else True

    def _fits_here(self, node: Node) -> bool:
        if node.type == "call":
            function, given = field(node, "function"), named(field(node, "arguments"))
            publisher, _, method = text_of(function).removeprefix("self.").rpartition(".")
            if method == "publish" and publisher in self.shown:
                return self._sends(self.shown[publisher], given)
            if method == "sendTransform":
                return self.sends_transform(given)
            type_ = self.types.get(text_of(function))
            return self._is_appended(node) if type_ is None else self._is_made(node, type_)
        if node.type == "assignment" and node.child_by_field_name("right") is not None:
            left = field(node, "left")
            type_ = self._type_of(left) if left.type == "attribute" else ""
            return type_ == "" or (type_ is not None and self._takes(type_, field(node, "right")))
        if node.type == "attribute":
            of = self.types.get(text_of(field(node, "object")))
            return of is None or text_of(field(node, "attribute")) in CONSTANTS.get(of, ())
        return True

    def _sends(self, shown: Shown, given: list[Node]) -> bool:
        """Whether a publisher gets a message with a value that this takes."""
        value = shown.value(given)
        if value is None:
            return False
        stores = [*_stores(value)] if value.type == "identifier" else []
        computed = stores[0] if len(stores) == 1 else value
        is_small = not any(map(_may_be_huge, nodes_in(computed)))
        is_float = self._has_point(computed) and not self.looks.is_text(computed)
        return shown.takes(value) or (shown.is_float and is_small and is_float)

    def _is_made(self, call: Node, type_: str) -> bool:
        """`KeyValue(key="cell", value=str(x))`, or in the order of the fields."""
        fields, given = _fields(type_), named(field(call, "arguments"))
        by_name = [n for n in given if n.type == "keyword_argument"]
        pairs = [(text_of(field(n, "name")), field(n, "value")) for n in by_name]
        if len(by_name) < len(given):
            if by_name or self._is_strict or len(given) != len(fields):
                return False
            pairs = list(zip(fields, given, strict=True))
        return all(name in fields and self._takes(fields[name], v) for name, v in pairs)

    def _is_appended(self, call: Node) -> bool:
        """`status.values.append(KeyValue(...))`."""
        function = field(call, "function")
        if function.type != "attribute" or text_of(field(function, "attribute")) != "append":
            return True
        type_ = self._type_of(field(function, "object"))
        array = _ARRAY.match(type_ or "")
        given = named(field(call, "arguments"))
        return not type_ or (array is not None and all(self._takes(array[1], g) for g in given))

    def sends_transform(self, arguments: list[Node]) -> bool:
        """Whether a broadcaster of transforms is given one, as a message or in five parts."""
        types = [self._type_of(a) for a in arguments]
        return types == ["geometry_msgs/TransformStamped"] or len(types) == _PARTS

    def _type_of(self, place: Node) -> str | None:
        """The type of a message or field; empty for none, None for one that is not there."""
        if place.type == "identifier":
            return self._of_local(place)
        if place.type != "attribute":
            return ""
        of = self._type_of(field(place, "object"))
        return _fields(of).get(text_of(field(place, "attribute"))) if of else of

    def _of_local(self, local: Node) -> str:
        """The type of the messages that a local only ever is."""
        made = {text_of(v).partition("(")[0] for v in _stores(local)}
        return self.types.get(next(iter(made)), "") if len(made) == 1 else ""

    # --- values ---------------------------------------------------------------------------------

    @property
    def _is_strict(self) -> bool:
        """Whether the messages are those of a node of ROS 2."""
        return self.looks.is_node

    def _takes(self, type_: str, value: Node) -> bool:
        """Whether a field takes a value, as far as it shows what that is."""
        if value.type == "conditional_expression":
            one, _, other = named(value)
            return self._takes(type_, one) and self._takes(type_, other)
        if value.type == "identifier" and len(stores := [*_stores(value)]) == 1:
            return stores[0].type == "identifier" or self._takes(type_, stores[0])
        if _ARRAY.match(type_):
            return not (self._is_number(value) or self.looks.is_text(value))
        if "/" in type_:
            made = value.type == "call" and self.types.get(text_of(field(value, "function")))
            return self._type_of(value) == type_ or made == type_
        match type_:
            case "string":
                return not self._is_number(value) and value.type != "none"
            case "time" | "duration":
                return not (self._is_number(value) or value.type in _NEVER_NUMBERS)
            case "byte" if self._is_strict:
                return not self._is_number(value) and value.type not in _NEVER_NUMBERS
            case "bool" if self._is_strict:
                return value.type in _TRUE or self._is_of(value, frozenset({"boolean"}))
            case _:
                return self._is_of_number(type_, value)

    def _is_of_number(self, type_: str, value: Node) -> bool:
        if value.type in _NEVER_NUMBERS or self.looks.is_text(value):
            return False
        if not self._is_strict:
            return not self._is_array(value)
        return self._has_point(value) if type_.startswith("float") else self._is_whole(value)

    def _is_number(self, value: Node) -> bool:
        """Whether a value is a number, or has elements that are."""
        called = text_of(field(value, "function")) if value.type == "call" else ""
        is_made = called in _GIVING_POINTS | _GIVING_WHOLE | {"abs", "sum"}
        is_own = _own(value) in self.variables
        return value.type in _NUMBERS | _TRUE or is_made or is_own or self._is_sum(value)

    def _is_sum(self, value: Node) -> bool:
        sides = (field(value, "left"), field(value, "right")) if _computes(value) else ()
        return any(map(self._is_number, sides)) and not any(map(self.looks.is_text, sides))

    def _has_point(self, value: Node) -> bool:
        """Whether a value is sure to be a number with a point."""
        match value.type:
            case "float":
                return True
            case "unary_operator":
                return self._has_point(field(value, "argument"))
            case "parenthesized_expression":
                return self._has_point(named(value)[0])
            case "binary_operator":
                sides = field(value, "left"), field(value, "right")
                is_divided = text_of(field(value, "operator")) == "/"
                return is_divided or any(map(self._has_point, sides))
            case "call":
                called = text_of(field(value, "function"))
                return called in _GIVING_POINTS or called.startswith("math.")
            case _:
                return self._is_of(value, _WITH_POINT)

    def _is_whole(self, value: Node) -> bool:
        """Whether a value may be a whole number: it is not sure to be another one."""
        return not (self._has_point(value) or self._is_array(value))

    def _is_of(self, value: Node, types: frozenset[str]) -> bool:
        type_ = self.variables.get(_own(value))
        return type_ is not None and type_.name in types and not type_.dimensions

    def _is_array(self, value: Node) -> bool:
        type_ = self.variables.get(_own(value))
        return type_ is not None and bool(type_.dimensions)


def _fields(type_: str) -> dict[str, str]:
    """The fields of a type, with theirs."""
    pairs = (each.strip().partition(" ") for each in _TYPES.get(type_, "").split(","))
    return {name: of for name, _, of in pairs if name}


def _stores(local: Node) -> Iterator[Node]:
    """What a function stores under the name of a local."""
    function = next(functions_around(local), None)
    for node in nodes_in(function) if function is not None else ():
        value = node.child_by_field_name("right") if node.type == "assignment" else None
        if value is not None and text_of(field(node, "left")) == text_of(local):
            yield value


def _own(value: Node) -> str:
    """The name of an attribute of the object itself, an element's array included."""
    while value.type == "subscript":
        value = field(value, "value")
    is_own = value.type == "attribute" and text_of(field(value, "object")) == "self"
    return text_of(field(value, "attribute")) if is_own else ""


def _computes(value: Node) -> bool:
    return value.type == "binary_operator" and text_of(field(value, "operator")) != "%"


def _may_be_huge(node: Node) -> bool:
    """Whether a part of a number may make more of it than 32 bits of a float hold."""
    match node.type:
        case "float":
            return not -_HUGE < float(text_of(node).replace("_", "")) < _HUGE
        case "binary_operator":
            return text_of(field(node, "operator")) == "**"
        case "call":
            return text_of(field(node, "function")) != "float"
        case _:
            return False
