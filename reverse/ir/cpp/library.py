"""What the lowering must know of the standard library: result types, and what has no effect.

What a callable does besides is the matter of analyses; one that is not here gives an unknown value.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.conversions import common_type, promoted
from rebsync.reverse.ir.cpp.types import SIZE, STRING

# The class of the library under whose name methods of a kind of value go.
_KINDS: Mapping[t.ContainerKind, str] = {
    t.ContainerKind.SEQUENCE: "std::vector",
    t.ContainerKind.QUEUE: "std::queue",
    t.ContainerKind.SET: "std::set",
    t.ContainerKind.MAPPING: "std::map",
    t.ContainerKind.TUPLE: "std::tuple",
}
# Classes of values that are trees: an element of one is such a value too.
_TREES = frozenset({"nlohmann::json", "nlohmann::ordered_json", "YAML::Node", "Json::Value"})
_ASKING: Mapping[str, t.Type] = {
    **{"size": SIZE, "length": SIZE, "capacity": SIZE, "count": SIZE, "max_size": SIZE},
    **{"empty": t.TRUTH, "contains": t.TRUTH, "has_value": t.TRUTH},
    **{"c_str": STRING, "substr": STRING, "str": STRING, "compare": t.Integer(32)},
    **{"find": t.UNKNOWN, "begin": t.UNKNOWN, "end": t.UNKNOWN, "cbegin": t.UNKNOWN},
    **{"cend": t.UNKNOWN, "rbegin": t.UNKNOWN, "rend": t.UNKNOWN},
}
_FINDING = frozenset({"find", "rfind", "find_first_of", "find_last_of", "find_first_not_of"})
_FLOATING = frozenset(
    {
        *("sqrt", "cbrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log"),
        *("log10", "log2", "pow", "hypot", "floor", "ceil", "round", "trunc", "fmod", "fabs"),
        *("sinh", "cosh", "tanh", "exp2", "fmin", "fmax", "copysign", "remainder", "rint"),
    }
)
_PREDICATES = frozenset({"isnan", "isinf", "isfinite", "signbit"})
_SAME = frozenset({"min", "max", "clamp"})
_OF_RANGES: Mapping[str, t.Type] = {
    **dict.fromkeys(("std::count", "std::count_if", "std::distance"), t.Integer(64)),
    **dict.fromkeys(("std::all_of", "std::any_of", "std::none_of", "std::equal"), t.TRUTH),
}
_ELEMENTS = frozenset({"elements", "keys"})


def library_class(type_: t.Type) -> str | None:
    """The full name of the library's class that values of a type are of."""
    match type_:
        case t.Container(kind):
            return _KINDS[kind]
        case t.Text():
            return "std::string"
        case t.Optional():
            return "std::optional"
        case t.Array():
            return "std::array"
        case t.Record(name):
            return name.partition("<")[0]
        case t.RosMessage():
            return "message"
        case t.FunctionType():
            return "std::function"
        case t.Reference(_, _, t.Ownership.UNIQUE):
            return "std::unique_ptr"
        case t.Reference(_, _, t.Ownership.SHARED):
            return "std::shared_ptr"
        case _:
            return None


def of_element(type_: t.Type) -> t.Type:
    """The type of an element of a library's object: of trees that of the whole."""
    is_tree = isinstance(type_, t.Record) and type_.name.partition("<")[0] in _TREES
    return type_ if is_tree else t.UNKNOWN


def method_result(type_: t.Type, name: str) -> t.Type:
    """The type of what a method of the standard library gives."""
    if isinstance(type_, t.Text) and name in _FINDING:
        return SIZE
    if isinstance(type_, t.Container | t.Text | t.Optional | t.Array) and name in _ASKING:
        return _ASKING[name]
    if isinstance(type_, t.Record) and name == "str":
        return STRING
    return t.UNKNOWN


def function_result(name: str, arguments: Sequence[t.Type]) -> t.Type:
    """The type of what a function of the standard library gives for arguments of some types."""
    space, _, last = name.rpartition("::")
    if name in _OF_RANGES:
        return _OF_RANGES[name]
    if space not in ("", "std") or t.UNKNOWN in arguments:
        return STRING if name == "std::to_string" else t.UNKNOWN
    numbers = [a for a in arguments if isinstance(a, t.Integer | t.Float | t.Truth)]
    are_numbers = len(numbers) == len(arguments) > 0
    if last in _FLOATING and are_numbers:
        all_single = all(a == t.Float(32) for a in numbers) and (space or last[-1:] == "f")
        return t.Float(32) if all_single else t.DOUBLE
    if last in _PREDICATES and are_numbers:
        return t.TRUTH
    if last in _SAME and len(set(arguments)) == 1 and are_numbers:
        return arguments[0]
    if last in ("abs", "labs", "llabs") and are_numbers:
        is_c = not space and isinstance(numbers[0], t.Float)
        return t.UNKNOWN if is_c else promoted(numbers[0])
    if last == "to_string":
        return STRING
    return common_type(*numbers) if last == "gcd" and len(numbers) == 2 else t.UNKNOWN


def is_pure(name: str) -> bool:
    """Whether a callable of the standard library only looks at its arguments."""
    space, _, last = name.rpartition("::")
    if space in _KINDS.values() or space in ("std::string", "std::optional", "std::array"):
        return last in _ASKING or last in _FINDING or last in _ELEMENTS
    functions = _FLOATING | _PREDICATES | _SAME | {"abs", "to_string", "labs", "llabs"}
    return (
        (space in ("", "std") and last in functions)
        or name == "sizeof"
        or (space == "std::literals")
    )
