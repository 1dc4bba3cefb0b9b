"""The values that calls give: of methods of texts and handles, of functions of ROS, of our own."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator

from tree_sitter import Node

from rebsync.reverse.graph import Resolved, Unresolved
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.reverse.values.cpp_evaluator import CppEvaluator
from rebsync.reverse.values.cpp_flow_reach import taken
from rebsync.reverse.values.cpp_flow_types import HOLDERS, unscoped_member
from rebsync.reverse.values.cpp_values_made import constructed
from rebsync.reverse.values.cpp_values_names import name_under, resolved, tidy
from rebsync.reverse.values.cpp_values_numbers import converted
from rebsync.reverse.values.cpp_values_parameters import from_parameter
from rebsync.reverse.values.cpp_values_plain import (
    NUMBERS,
    OWN_NAME,
    Frame,
    Function,
    Handle,
    Length,
    Nothing,
    Use,
    Value,
    choice,
    each,
    pairs,
)
from rebsync.reverse.values.cpp_values_ros2 import (
    changed,
    is_quality_method,
    makes,
    parameter,
    span,
)
from rebsync.reverse.values.cpp_values_texts import is_stream, streamed

_LIMITS: dict[tuple[str, str], float] = {
    ("double", "max"): sys.float_info.max,
    ("double", "min"): sys.float_info.min,
    ("double", "lowest"): -sys.float_info.max,
    ("int", "max"): 0x7FFFFFFF,
    ("int", "min"): -0x80000000,
}
# What gives its argument, or its target, as it is.
_SAME = frozenset({"move", "ref", "cref", "forward", "boost::ref", "get_pointer"})
_SAME_OF = frozenset({"c_str", "get", "data", "toStdString", "str", "value", "string"})
_CASTS = frozenset({"static_cast", "const_cast", "dynamic_cast", "reinterpret_cast"})
_MAKERS = frozenset({"make_shared", "make_unique"})
_MOST_FUNCTIONS = 8
_BINDS = frozenset({"bind", "mem_fn", "bind_front"})
_PARAMETERS = frozenset({"param", "param_cached", "paramCached"})


def called_value(values: CppEvaluator, node: Node, frame: Frame) -> Value:
    """What a call gives."""
    function = part(node, "function")
    given = tuple(named(part(node, "arguments")))
    if function.type == "field_expression":
        return _of_method(values, node, function, given, frame)
    types: tuple[Node, ...] = ()
    scopes: list[str] = []
    while function.type == "qualified_identifier":
        scope = function.child_by_field_name("scope")
        scopes.append(text_of(scope) if scope is not None else "")
        function = part(function, "name")
    if function.type == "template_function":
        types = tuple(named(part(function, "arguments")))
        function = part(function, "name")
    return _of_function(values, node, scopes, text_of(function), types, given, frame)


# --- functions ----------------------------------------------------------------------------------


def _of_function(
    values: CppEvaluator,
    node: Node,
    scopes: list[str],
    name: str,
    types: tuple[Node, ...],
    given: tuple[Node, ...],
    frame: Frame,
) -> Value:
    scope = scopes[-1] if scopes else ""
    if scope == "this_node":
        return (
            OWN_NAME
            if name == "getName"
            else values.unknown("the node's namespace", node, frame, "*")
        )
    if scope in ("param", "names") and given:
        return _of_ros(values, node, scope, name, given, frame)
    if name in libraries.own_handles() and not given:
        return Handle(libraries.own_handles()[name])
    if name in libraries.own_names() and not given and not values.calls.functions(frame.cpp, node):
        return OWN_NAME
    if name in _SAME and len(given) == 1:
        return values.value(given[0], frame)
    if name in _CASTS and types and given:
        type_ = values.types.plain(frame.cpp, types[0])
        return converted(values.value(given[0], frame), type_)
    if name in HOLDERS and len(given) == 1:
        return values.value(given[0], frame)
    if name in _MAKERS and types:
        use = Use(frame.cpp, node, given, frame.function)
        return constructed(values, values.types.plain(frame.cpp, types[0]), use, frame)
    if name in _BINDS:
        return Function(node, frame)
    if name in ("quiet_NaN", "signaling_NaN"):
        return Nothing()
    if scope.startswith("numeric_limits<") and (scope[15:-1], name) in _LIMITS:
        return _LIMITS[scope[15:-1], name]
    if name in ("to_string", "lexical_cast", "max", "min", "abs", "fabs") and given:
        return _of_library(values, node, name, given, frame)
    if (length := span(values, name, types, given, frame)) is not None:
        return length
    if name in libraries.reading() and given and not values.calls.functions(frame.cpp, node):
        return parameter(values, name, given, node, frame)
    if name == "from_rmw" and given:
        return values.value(given[0], frame)
    return _of_own(values, node, name, given, frame)


def _of_own(
    values: CppEvaluator, node: Node, name: str, given: tuple[Node, ...], frame: Frame
) -> Value:
    functions = values.calls.functions(frame.cpp, node)
    if functions:
        return returned(values, functions, node, given, frame)
    type_ = _constructed_type(values, node, name, frame)
    if type_:
        return constructed(values, type_, Use(frame.cpp, node, given, frame.function), frame)
    return values.unknown(f"what {name} gives", node, frame)


def _constructed_type(values: CppEvaluator, node: Node, name: str, frame: Frame) -> str:
    """The type that a call makes an object of, if its function is one."""
    text = "".join(text_of(part(node, "function")).split()).partition("<")[0]
    if name in ("string", "vector") or name in NUMBERS or name.endswith("Options"):
        return text
    if name in libraries.handles() or name in libraries.made_of_handles() or makes(name):
        return text
    if name in libraries.spans() or name in libraries.rates():
        return text
    return text if values.texts.class_near(name, frame.cpp) is not None else ""


def _of_ros(
    values: CppEvaluator, node: Node, scope: str, name: str, given: tuple[Node, ...], frame: Frame
) -> Value:
    first = values.value(given[0], frame)
    if scope == "param" and name in _PARAMETERS and len(given) == 2:
        return from_parameter(values, Handle(""), first, values.value(given[1], frame), node, frame)
    if scope == "names" and name == "append" and len(given) == 2:
        return pairs(_appended, first, values.value(given[1], frame))
    if scope == "names" and name in ("resolve", "clean"):
        return each(lambda v: tidy(v) if isinstance(v, str) else v, values.value(given[-1], frame))
    return values.unknown(f"what {scope}::{name} gives", node, frame)


def _appended(left: Value, right: Value) -> Value:
    match left, right:
        case str(), str():
            return tidy(f"{left}/{right}")
        case _:
            return Nothing()


def _of_library(
    values: CppEvaluator, node: Node, name: str, given: tuple[Node, ...], frame: Frame
) -> Value:
    found = [values.value(g, frame) for g in given]
    match name, found:
        case (("to_string" | "lexical_cast"), [bool() | int() as number]):
            return str(int(number))
        case (("to_string" | "lexical_cast"), [str() as text]):
            return text
        case (("abs" | "fabs"), [int() | float() as number]):
            return abs(number)
        case (("max" | "min"), [int() | float() as a, int() | float() as b]):
            return max(a, b) if name == "max" else min(a, b)
        case _:
            return values.unknown(f"what {name} gives", node, frame)


def returned(
    values: CppEvaluator,
    functions: list[CppFunction],
    node: Node,
    given: tuple[Node, ...],
    frame: Frame,
) -> Value:
    """What functions of the files return when they are called in a frame."""
    if frame.depth >= 6:
        return values.unknown("too many calls to follow", node, frame)
    use = Use(frame.cpp, node, given, frame.function)
    found: list[Value] = []
    if len(functions) > _MOST_FUNCTIONS:
        return values.unknown("too many functions may be called", node, frame)
    for function in functions:
        inner = Frame(function.cpp, function, use, frame)
        results = [values.value(r, inner) for r in _reached(values, function, inner)]
        found += results or [values.unknown(f"what {function.name} gives", node, frame)]
    return choice(found)


def _reached(values: CppEvaluator, function: CppFunction, frame: Frame) -> Iterator[Node]:
    """What a function returns, up to a return that is surely reached."""
    key = function.node.id
    if key not in values.returns:
        values.returns[key] = sorted(_returns(function.body), key=lambda n: n.start_byte)
    for result in values.returns[key]:
        sure = taken(result, lambda c: values.holds(c, frame))
        if sure is not False:
            yield result
        if sure:
            return


def _returns(body: Node | None) -> Iterator[Node]:
    waiting = [body] if body is not None else []
    while waiting:
        current = waiting.pop(0)
        if current.type == "return_statement":
            yield from named(current)[:1]
        elif current.type not in ("lambda_expression", "expression_statement", "declaration"):
            waiting += current.named_children


# --- methods ------------------------------------------------------------------------------------


def _of_method(
    values: CppEvaluator, node: Node, function: Node, given: tuple[Node, ...], frame: Frame
) -> Value:
    target = part(function, "argument")
    name = unscoped_member(part(function, "field"))
    if name in libraries.own_handles() and not given:
        return Handle(libraries.own_handles()[name])
    if name in libraries.own_names() and target.type == "this":
        return OWN_NAME
    if name == "str" and not given and is_stream(values.types.type_of(frame.cpp, target)):
        variable = values.types.variable(frame.cpp, target)
        if variable is not None:
            return streamed(values, variable, node, frame)
    if name in _SAME_OF and not given:
        return _inside(values, values.value(target, frame), node, name, frame)
    if name in ("empty", "size", "length", "toSec", "expectedCycleTime", "isEmpty"):
        return each(_measure(values, name, node, frame), values.value(target, frame))
    if name in ("getNamespace", "resolveName", *libraries.handle_methods()):
        handle = values.value(target, frame)
        if isinstance(handle, Handle):
            return _of_handle(values, handle, node, name, given, frame)
    if name in _PARAMETERS and len(given) == 2:
        handle = values.value(target, frame)
        first, default = values.value(given[0], frame), values.value(given[1], frame)
        return each(lambda h: from_parameter(values, h, first, default, node, frame), handle)
    functions = values.calls.functions(frame.cpp, node)
    if functions:
        return returned(values, functions, node, given, frame)
    return _of_ros2(values, node, name, target, given, frame)


def _of_ros2(
    values: CppEvaluator, node: Node, name: str, target: Node, given: tuple[Node, ...], frame: Frame
) -> Value:
    """What a method of a node, of a parameter or of a quality of service gives."""
    if name in libraries.reading() and given:
        return parameter(values, name, given, node, frame)
    if name in libraries.named(Kind.VALUE) and not given:
        held = values.value(target, frame)
        return held if not isinstance(held, Nothing) else values.unknown("a value", node, frame)
    if is_quality_method(name):
        return each(
            lambda v: changed(values, v, name, given, node, frame), values.value(target, frame)
        )
    return values.unknown(f"what {name} gives", node, frame)


def _inside(values: CppEvaluator, value: Value, node: Node, name: str, frame: Frame) -> Value:
    """A text's characters, a pointer's object."""
    if name in ("str", "value") and not isinstance(value, (str, Unresolved)):
        return values.unknown(f"what {name} gives", node, frame, "*")
    return value


def _measure(values: CppEvaluator, name: str, node: Node, frame: Frame) -> Callable[[Value], Value]:
    def measure(value: Value) -> Value:
        match value:
            case str():
                if name in ("empty", "isEmpty"):
                    return not value
                known = OWN_NAME not in value
                return len(value) if known else values.unknown("a length", node, frame)
            case Length(seconds, each_):
                return seconds if name == "toSec" else Length(seconds, each_)
            case Unresolved(why, place):
                return Unresolved(why, place)
            case _:
                return values.unknown(f"what {name} gives", node, frame)

    return measure


def _of_handle(
    values: CppEvaluator,
    handle: Value,
    node: Node,
    name: str,
    given: tuple[Node, ...],
    frame: Frame,
) -> Value:
    if not isinstance(handle, Handle):
        return Nothing()
    if name == "getNamespace":
        own = isinstance(handle.namespace, str) and handle.namespace[:1] in ("~", "/")
        return handle.namespace if own else values.unknown("the namespace", node, frame, "*")
    first = values.value(given[0], frame) if given else Nothing()
    if name == "resolveName":
        return each(lambda v: _name(values, handle, v, node, frame), first)
    if name in _PARAMETERS and len(given) == 2:
        default = values.value(given[1], frame)
        return from_parameter(values, handle, first, default, node, frame)
    return values.unknown(f"what {name} gives", node, frame)


def _name(values: CppEvaluator, handle: Handle, value: Value, node: Node, frame: Frame) -> Resolved:
    found = resolved(value, values.unknown("no text that is known", node, frame))
    return name_under(handle.namespace, found if found is not None else "")
