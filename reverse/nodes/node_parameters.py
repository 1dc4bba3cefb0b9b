"""Parameters that a node reads while it is set up, as parameters of the constructor."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.package import Value
from rebsync.records import dataclass
from rebsync.reverse.graph import Fact, ParameterFact, Resolved, Unresolved
from rebsync.reverse.libraries.routines import Access
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.nodes.node_values import Instance
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of
from rebsync.reverse.syntax.cpp_tree import text_of
from rebsync.static.values import converted

_DECLARES = "declare_parameter"
_MOST_DECLARED = 3  # the next one is `ignore_override`

_TYPES = {bool: "boolean", int: "int", float: "double", str: TEXT.name}
TypeOf = Callable[[Node], m.Type | None]


@dataclass(frozen=True, slots=True)
class ConstructorParameter:
    """A parameter of the constructor, with its value for each rebec (None: not known)."""

    name: str
    type: m.Type
    values: tuple[Value | None, ...]


@dataclass(frozen=True, slots=True)
class ParameterRequest:
    """What a call asks: the node that is set (None: the call itself is the value), and whether
    there is such a parameter (None: in some of the rebecs).
    """

    call: CppCall
    target: Node | None
    type: m.Type | None
    values: tuple[Value | None, ...]
    found: bool | None


def asked(
    fact: ParameterFact,
    instances: Sequence[Instance],
    type_of: TypeOf,
    facts: Sequence[Fact] = (),
) -> ParameterRequest | None:
    """What a call that reads a parameter asks; None where it is no such call.

    `facts` may declare it with a default.
    """
    call = call_of(fact.site.call)
    if call is None or fact.access not in (Access.GET, Access.HAS, Access.DECLARE):
        return None
    target = _target(call) if fact.access is Access.GET else None
    here = [i.parameter(fact.name) for i in instances]
    there = {p is not None for p in here}
    found = None if len(there) > 1 else next(iter(there), False)
    if _declared(fact, facts) is not None:
        found = True
    default = fact.default if (declared := _declared(fact, facts)) is None else declared
    others = [None if default is None else i.value(default) for i in instances]
    if not instances and isinstance(default, bool | int | float):
        others = [default]
    raw = [
        p.value if p is not None else d
        for p, d in zip(here or [None] * len(others), others, strict=True)
    ]
    type_ = type_of(target) if target is not None else _of_values(raw, call)
    values = tuple(_as(v, type_) if type_ is not None else None for v in raw)
    return ParameterRequest(call, target, type_, values, found)


def _declared(fact: ParameterFact, facts: Sequence[Fact]) -> Resolved | None:
    """The default that a parameter is declared with, which then is always there."""
    if fact.access is Access.DECLARE:
        return None
    same = (f for f in facts if isinstance(f, ParameterFact) and f.name == fact.name)
    return next((f.default for f in same if f.access is Access.DECLARE), None)


def _target(call: CppCall) -> Node | None:
    """The variable that gets the value, if one is handed over."""
    count = len(call.arguments)
    if call.name.rpartition("::")[2] == "get_parameter_or":
        return call.arguments[1] if count == 3 else None
    if call.name.startswith("get") and count == 2:
        return call.arguments[1]
    if call.name.startswith("param") and count == 3:
        return call.arguments[1]
    return None


def _of_values(raw: Sequence[object], call: CppCall) -> m.Type | None:
    """The type of the value that a call gives."""
    spelled = {"int": "int", "double": "double", "float": "float", "bool": "boolean"}
    spelled |= dict.fromkeys(("std::string", "string"), TEXT.name)
    if call.types and text_of(call.types[0]) in spelled:
        return m.Type(spelled[text_of(call.types[0])])
    if len(call.arguments) == 2:
        if call.arguments[1].type in ("true", "false"):
            return m.Type("boolean")
        if call.arguments[1].type == "number_literal":
            text = text_of(call.arguments[1])
            return m.Type("double" if "." in text or "e" in text else "int")
    found = {_TYPES.get(type(v)) for v in raw if v is not None}
    only = next(iter(found), None)
    return m.Type(only) if len(found) == 1 and only is not None else None


def _as(value: object, type_: m.Type) -> Value | None:
    match value:
        case str():
            return value if type_ == TEXT else None
        case bool() | int() | float():
            return converted(value, type_) if type_ != TEXT else None
        case _:
            return None


def list_given_otherwise(
    fact: ParameterFact, facts: Iterable[Fact], listed: Callable[[ParameterFact, str], None]
) -> None:
    """Lists that a parameter may have another value than who starts the node gives it.

    The code sets what it reads as well, or declares it with `ignore_override`.
    """
    call = call_of(fact.site.call)
    is_declared = fact.access is Access.DECLARE and call is not None and call.name == _DECLARES
    if is_declared and call is not None and len(call.arguments) > _MOST_DECLARED:
        listed(fact, "nobody else gives this parameter a value")
    if fact.access is Access.SET:
        read = (f for f in facts if isinstance(f, ParameterFact) and f.access is Access.GET)
        if any(Unresolved in (type(f.name), type(fact.name)) or f.name == fact.name for f in read):
            listed(fact, "the code sets this parameter, and reads it")
