"""How many messages a queue holds, and whether the last is kept for those that come later."""

from __future__ import annotations

from collections.abc import Iterable

from tree_sitter import Node

from rebsync.reverse.graph import Resolved, Unresolved
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.python.py_asks import PyRosCall
from rebsync.reverse.python.py_bindings import reaching
from rebsync.reverse.python.py_index import Scope, arguments_of
from rebsync.reverse.python.py_lookup import bound
from rebsync.reverse.python.py_tree import text_of
from rebsync.reverse.python.py_values import PyValues
from rebsync.reverse.python.py_worth import (
    External,
    Made,
    NoneValue,
    Value,
    Ways,
    distinct,
    resolved,
)
from rebsync.reverse.syntax.ancestors import climb

_NO_BOUND = "without `queue_size` there is no bound that the code gives"
_KEPT = ("TRANSIENT_LOCAL", "RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL")


def depth_of(values: PyValues, asked: PyRosCall) -> Resolved:
    """How many messages wait at most."""
    node = asked.given.get("depth")
    if node is None:
        return values.unknown(_NO_BOUND, asked.name, asked.scope)
    ways = values.ways(node, asked.scope)
    found = [d for way in ways for d in _depths(values, way, node, asked)]
    is_none = any(isinstance(way, NoneValue) for way in ways)
    why = _NO_BOUND if is_none else "the depth is computed"
    return resolved(distinct(found), values.unknown(why, node, asked.scope))


def _depths(values: PyValues, way: Value, node: Node, asked: PyRosCall) -> Iterable[Value]:
    match way:
        case Made(by) if by.endswith(("QoSProfile", "QoSProfile.get_from_short_key")):
            given = _of_profile(values, way, "depth", node, asked.scope)
            return given or [values.unknown("a profile without a depth", node, asked.scope)]
        case External(name):
            parts = name.removesuffix(".value").split(".")
            known = libraries.profiles()
            unknown = values.unknown("a profile that is not known", node, asked.scope)
            return [known.get(".".join(parts[-2:]), known.get(parts[-1], unknown))]
        case NoneValue():
            return []
        case _:
            return [way]


def latched_of(values: PyValues, asked: PyRosCall) -> Resolved:
    """Whether a publisher keeps its last message."""
    if "latched" in asked.given:
        return values.value(asked.given["latched"], asked.scope)
    node = asked.given.get("depth")
    ways = values.ways(node, asked.scope) if node is not None else ()
    found: list[Value] = []
    for way in ways:
        if node is not None and isinstance(way, Made) and way.by.endswith("QoSProfile"):
            given = _of_profile(values, way, "durability", node, asked.scope)
            found += [_keeps(values, g, node, asked.scope) for g in given] or [False]
        else:
            found.append(False)
    unknown = Unresolved(
        "the durability is not known", values.unknown("", asked.name, asked.scope).place
    )
    return resolved(distinct(found), unknown) if found else False


def _keeps(values: PyValues, way: Value, node: Node, scope: Scope) -> Value:
    match way:
        case External(name):
            return name.endswith(_KEPT)
        case Unresolved():
            return way
        case _:
            return values.unknown("the durability is not known", node, scope)


def _of_profile(values: PyValues, made: Made, key: str, node: Node, scope: Scope) -> Ways:
    """A key of a profile: set after it was made, or given when it was."""
    stored = scope.stores.get((text_of(node), key), [])
    seen = reaching(stored, node)
    later = [w for b in seen for w in bound(values, b, key, scope)]
    _, keywords = arguments_of(made.call)
    first = values.ways(keywords[key], made.scope) if key in keywords else ()
    if seen and reaching([seen[0]], node) and _always(seen[0].node, node):
        return distinct(later)
    return distinct([*first, *later])


def _always(statement: Node, use: Node) -> bool:
    """Whether a statement stands in a block that the use is in as well."""
    block = climb(statement, lambda n: n.type != "expression_statement")
    return block is not None and block.start_byte <= use.start_byte <= block.end_byte
