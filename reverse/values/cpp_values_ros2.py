"""Values that only code for ROS 2 has: spans of `std::chrono`, qualities of service, parameters."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import partial, reduce

from tree_sitter import Node

from rebsync.reverse.graph import FromParameter, Resolved, Unresolved
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.libraries.tables.standard import RATIOS, SUFFIXES, UNITS
from rebsync.reverse.policies import NOT_KNOWN, UNKNOWN, USUAL, Period, either, policy_of
from rebsync.reverse.syntax.cpp_calls import call_around, string_of
from rebsync.reverse.syntax.cpp_tree import named, part, text_of, unqualified
from rebsync.reverse.values.cpp_evaluator import CppEvaluator
from rebsync.reverse.values.cpp_flow_definitions import Definition
from rebsync.reverse.values.cpp_values_names import resolved
from rebsync.reverse.values.cpp_values_numbers import used
from rebsync.reverse.values.cpp_values_parameters import from_parameter
from rebsync.reverse.values.cpp_values_plain import (
    Frame,
    Handle,
    Length,
    Nothing,
    Quality,
    Use,
    Value,
    choice,
    each,
    ways,
)

_KEPT = re.compile(r"(?:TransientLocal|TRANSIENT_LOCAL)\Z")
_LOST = re.compile(r"(?:Volatile|VOLATILE)\Z")
_TYPE = re.compile(r"\b\w+::PARAMETER_[A-Z_]+\Z")


def makes(name: str) -> bool:
    """Whether this makes values of a class."""
    return name in UNITS or name in libraries.qualities() or name in libraries.value_classes()


def literal(values: CppEvaluator, node: Node, frame: Frame) -> Value:
    """`500ms`, `"topic"s`."""
    children = named(node)
    if len(children) == 2:
        suffix = text_of(children[1])
        inner = values.value(children[0], frame)
        if children[0].type == "number_literal" and suffix in SUFFIXES:
            return each(lambda v: _times(v, float(SUFFIXES[suffix])), inner)
        if suffix == "s" and isinstance(inner, str):
            return inner
    return values.unknown("a literal of its own kind", node, frame)


def made(values: CppEvaluator, type_: str, use: Use, frame: Frame) -> Value | None:
    """An object of a class of ROS 2 or `std::chrono`, made of arguments; None for other classes."""
    name = type_.rpartition("::")[2]
    given = use.arguments
    if name in libraries.qualities():
        return _quality(values, name, use, frame)
    if name in UNITS and given:
        return each(lambda v: _times(v, float(UNITS[name])), values.value(given[0], frame))
    if (unit := libraries.spans().get(type_)) is not None and "::" in type_ and len(given) == 1:
        return each(lambda v: _times(v, unit), values.value(given[0], frame))
    if name in libraries.value_classes() and len(given) == 1:
        return values.value(given[0], frame)
    if name == "duration" and type_ == "std::chrono::duration":
        return span(values, name, _declared_types(use.node), given, frame)
    return None


def _declared_types(declarator: Node) -> tuple[Node, ...]:
    """The arguments of the template that a declared variable is an object of."""
    written = declarator.parent.child_by_field_name("type") if declarator.parent else None
    type_ = unqualified(written) if written is not None else None
    if type_ is None or type_.type != "template_type":
        return ()
    return tuple(named(part(type_, "arguments")))


def unset(type_: str) -> Quality | None:
    """What a variable of a quality of service is that is declared without a value."""
    name = type_.rpartition("::")[2]
    depth = libraries.qualities().get(name)
    return _named(name, depth) if depth is not None else None


# --- time ---------------------------------------------------------------------------------------


def span(
    values: CppEvaluator, name: str, types: tuple[Node, ...], given: tuple[Node, ...], frame: Frame
) -> Value | None:
    """What `duration<double>(x)`, `duration_cast<T>(x)` or `Duration::from_seconds(x)` is."""
    if len(given) != 1:
        return None
    if name == "duration_cast":
        return values.value(given[0], frame)
    unit = libraries.spans().get(name) if not name[:1].isupper() else None
    if name == "duration" and types:
        ratio = "".join(text_of(types[1]).split()) if len(types) > 1 else ""
        unit = 1.0
        if ratio:
            known = RATIOS.get(ratio)
            unit = float(known) if known is not None else None
    if unit is None:
        return None
    return each(lambda v: _times(v, unit), values.value(given[0], frame))


def _times(value: Value, unit: float) -> Value:
    """A number of units as a span of time; a span is one already."""
    match value:
        case bool() | int() | float():
            return Length(value * unit if unit >= 1 else value / round(1 / unit))
        case FromParameter():
            if unit == 1:
                return Length(value)
            return Length(used(value, f"value/{round(1 / unit)}", lambda v: _divided(v, unit)))
        case Unresolved():
            return Length(value)
        case Length():
            return value
        case _:
            return Nothing()


def _divided(value: Value, unit: float) -> Value:
    return value * unit if isinstance(value, (int, float)) else Nothing()


# --- quality of service -------------------------------------------------------------------------


def _quality(values: CppEvaluator, name: str, use: Use, frame: Frame) -> Value:
    given = use.arguments
    if name == "QoSInitialization" and len(given) > 1:
        given = given[1:]
    if not given:
        depth = libraries.qualities()[name]
        unknown = values.unknown("a quality without a depth", use.node, frame)
        return _named(name, depth if depth is not None else unknown)
    own = name if name in libraries.policies() else ""
    found = each(lambda v: _deep(values, v, use.node, frame, own), values.value(given[0], frame))
    return found if len(given) == 1 else _of_profile(values, found, given[1], frame)


def _of_profile(values: CppEvaluator, found: Value, profile: Node, frame: Frame) -> Value:
    """A quality with the policies of the profile that its constructor is given behind the depth."""
    given = ways(values.value(profile, frame))
    kinds = [v.policies if isinstance(v, Quality) else NOT_KNOWN for v in given]
    policies = reduce(either, kinds) if kinds else NOT_KNOWN
    return each(lambda v: replace(v, policies=policies) if isinstance(v, Quality) else v, found)


def _named(name: str, depth: Resolved) -> Quality:
    """What a class or a constant of a library stands for."""
    reliability, durability = libraries.policies().get(name, (USUAL.reliability, USUAL.durability))
    policies = replace(USUAL, reliability=reliability, durability=durability)
    return Quality(depth, durability == "transient_local", policies)


def _deep(values: CppEvaluator, value: Value, node: Node, frame: Frame, name: str = "") -> Value:
    """A quality whose depth is a value, or that is copied from another.

    `name` is the class that is made, if that has policies of its own.
    """
    if isinstance(value, Quality):
        return _named(name, value.depth) if name else value
    if isinstance(value, Nothing):
        return value
    unknown = values.unknown("a depth that is not known", node, frame)
    depth = resolved(value, unknown)
    found = _named(name, depth if depth is not None else unknown)
    # What is not known may be another quality as well as a depth.
    known = isinstance(value, (int, FromParameter))
    return found if known else replace(found, policies=NOT_KNOWN)


def named_by_ros2(text: str) -> Value | None:
    """What a name of a library is: a quality, or a type of parameters that have no value."""
    name = text.rpartition("::")[2]
    if name in libraries.profiles():
        return _named(name, libraries.profiles()[name])
    return Nothing() if _TYPE.search(text) else None


def changed(
    values: CppEvaluator, value: Value, name: str, given: tuple[Node, ...], node: Node, frame: Frame
) -> Value:
    """A quality of service after a method was called on it."""
    if not isinstance(value, Quality) or name in libraries.named(Kind.QUALITY):
        return value
    match name:
        case "keep_last" if given:
            deep = [_deep(values, v, node, frame) for v in [values.value(given[0], frame)]]
            depth = next((q.depth for q in deep if isinstance(q, Quality)), value.depth)
            return replace(value, depth=depth)
        case "keep_all":
            return replace(value, depth=0)
        case "history":
            why = "a depth that goes by the history"
            return replace(value, depth=values.unknown(why, node, frame))
        case "durability" if given:
            return _durable(values, value, given[0], frame)
        case _:
            return _with_policy(values, value, name, given, frame)


def _durable(values: CppEvaluator, value: Quality, given: Node, frame: Frame) -> Quality:
    text = text_of(given)
    policies = replace(value.policies, durability=policy_of(text))
    if _KEPT.search(text) or _LOST.search(text):
        return Quality(value.depth, _KEPT.search(text) is not None, policies)
    why = "a durability that is not known"
    return Quality(value.depth, values.unknown(why, given, frame), policies)


def _with_policy(
    values: CppEvaluator, value: Quality, name: str, given: tuple[Node, ...], frame: Frame
) -> Quality:
    """A quality after a method that sets one of the policies that must fit the other end."""
    policies = value.policies
    match name:
        case "transient_local":
            return Quality(value.depth, True, replace(policies, durability=name))
        case "durability_volatile":
            return Quality(value.depth, False, replace(policies, durability="volatile"))
        case "durability_best_available":
            return replace(value, policies=replace(policies, durability="best_available"))
        case "reliable" | "best_effort":
            return replace(value, policies=replace(policies, reliability=name))
        case "reliability_best_available":
            return replace(value, policies=replace(policies, reliability="best_available"))
        case "reliability" if given:
            word = policy_of(text_of(given[0]))
            return replace(value, policies=replace(policies, reliability=word))
        case "liveliness" if given:
            word = policy_of(text_of(given[0]))
            return replace(value, policies=replace(policies, liveliness=word))
        case "deadline" if given:
            period = _period(values, given, frame)
            return replace(value, policies=replace(policies, deadline=period))
        case "liveliness_lease_duration" if given:
            period = _period(values, given, frame)
            return replace(value, policies=replace(policies, lease=period))
        case _:
            return value


def _period(values: CppEvaluator, given: tuple[Node, ...], frame: Frame) -> Period:
    """A span of time in seconds, which may be given as seconds and nanoseconds."""
    if len(given) != 1:
        return UNKNOWN
    value = values.value(given[0], frame)
    seconds = value.seconds if isinstance(value, Length) else None
    known = isinstance(seconds, (int, float)) and not isinstance(seconds, bool)
    return float(seconds) if known and isinstance(seconds, (int, float)) else UNKNOWN


def adjusted(values: CppEvaluator, before: Value, definition: Definition, frame: Frame) -> Value:
    """The same, for a call that stands by itself."""
    call = definition.node
    given = tuple(named(part(call, "arguments")))
    return each(lambda v: changed(values, v, definition.text, given, call, frame), before)


def is_quality_method(name: str) -> bool:
    """Whether a method of this name gives the quality of service that it is called on."""
    return name in libraries.named(Kind.CHANGE) or name in libraries.named(Kind.QUALITY)


# --- parameters ---------------------------------------------------------------------------------


def parameter(
    values: CppEvaluator, name: str, given: tuple[Node, ...], node: Node, frame: Frame
) -> Value:
    """What `declare_parameter` or `get_parameter` gives."""
    key = values.value(given[0], frame)
    if name in libraries.declaring() and len(given) > 1:
        default = values.value(given[1], frame)
    else:
        default = declared(values, given[0], frame)
    found = from_parameter(values, Handle(""), key, default, node, frame)
    if isinstance(default, Unresolved):  # there is one, though nobody can tell
        return each(partial(_standing_in, default), found)
    return found


def _standing_in(default: Unresolved, value: Value) -> Value:
    if not isinstance(value, FromParameter):
        return value
    return FromParameter(value.name, default, value.expression, value.search, value.within)


def declared(values: CppEvaluator, name: Node, frame: Frame) -> Value:
    """The default that the same file, or another, declares a parameter with."""
    text = string_of(name) if name.type == "string_literal" else values.value(name, frame)
    found: list[Value] = []
    names = libraries.declaring() if isinstance(text, str) else ()
    for cpp, place in (found for n in sorted(names) for found in values.texts.everywhere(n)):
        if (call := call_around(place)) is None:
            continue
        given = named(part(call, "arguments"))
        if len(given) > 1 and given[0].type == "string_literal" and string_of(given[0]) == text:
            around = values.texts.function_around(cpp, call)
            found.append(values.value(given[1], Frame(cpp, around, outside=True)))
    known = choice(found)
    return known if isinstance(known, (bool, int, float, str)) else Nothing()


def uses_flat(values: CppEvaluator) -> bool:
    """Whether some file of the code is for a library whose nodes have their own parameters."""
    return any(libraries.is_flat(cpp.original) for cpp in values.code.files)
