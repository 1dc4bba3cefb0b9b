"""How many messages a queue holds, and whether the last is kept for those that come later."""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce

from tree_sitter import Node

from rebsync.reverse.graph import FromParameter, Resolved, Unresolved
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.policies import (
    FOR_EVER,
    NOT_KNOWN,
    UNKNOWN,
    USUAL,
    Period,
    Policies,
    either,
    policy_of,
)
from rebsync.reverse.python.values.py_asks import PyRosCall
from rebsync.reverse.python.values.py_lookup import bound
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import (
    Duration,
    External,
    Made,
    NoneValue,
    Value,
    Ways,
    distinct,
    resolved,
)
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.py_bindings import reaching
from rebsync.reverse.syntax.py_index import Scope, arguments_of
from rebsync.reverse.syntax.py_tree import text_of

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


def policies_of(values: PyValues, asked: PyRosCall) -> Policies | None:
    """The policies of its quality of service; None for a library that has none."""
    if not asked.ask.flat or not libraries.client_in(asked.scope.py.source.text).flat:
        return None
    node = asked.given.get("depth")
    if node is None:
        return NOT_KNOWN
    found = [_policies(values, way, node, asked.scope) for way in values.ways(node, asked.scope)]
    return reduce(either, found) if found else NOT_KNOWN


def _policies(values: PyValues, way: Value, node: Node, scope: Scope) -> Policies:
    match way:
        case Made(by) if by.endswith("QoSProfile"):
            return Policies(
                _policy(values, way, "reliability", USUAL.reliability, node, scope),
                _policy(values, way, "durability", USUAL.durability, node, scope),
                _policy(values, way, "liveliness", USUAL.liveliness, node, scope),
                _period(values, way, "deadline", node, scope),
                _period(values, way, "liveliness_lease_duration", node, scope),
            )
        case External(name):
            parts = name.removesuffix(".value").split(".")
            named_ = libraries.policies()
            last = next(
                (n for n in (".".join(parts[-2:]), parts[-1]) if n in libraries.profiles()), ""
            )
            if not last:
                return NOT_KNOWN
            reliability, durability = named_.get(last, (USUAL.reliability, USUAL.durability))
            return Policies(reliability, durability)
        case int() | FromParameter():
            return USUAL
        case _:
            return NOT_KNOWN


def _policy(values: PyValues, made: Made, key: str, usual: str, node: Node, scope: Scope) -> str:
    """One policy of a profile: the usual one where nothing gives it."""
    given = _of_profile(values, made, key, node, scope, (External(usual),))
    words = {policy_of(w.name) if isinstance(w, External) else UNKNOWN for w in given}
    return words.pop() if len(words) == 1 else UNKNOWN


def _period(values: PyValues, made: Made, key: str, node: Node, scope: Scope) -> Period:
    """A span of time of a profile, in seconds."""
    given = _of_profile(values, made, key, node, scope, (Duration(FOR_EVER),))
    seconds = given[0].seconds if len(given) == 1 and isinstance(given[0], Duration) else None
    known = isinstance(seconds, (int, float)) and not isinstance(seconds, bool)
    return float(seconds) if known and isinstance(seconds, (int, float)) else UNKNOWN


def _keeps(values: PyValues, way: Value, node: Node, scope: Scope) -> Value:
    match way:
        case External(name):
            return name.endswith(_KEPT)
        case Unresolved():
            return way
        case _:
            return values.unknown("the durability is not known", node, scope)


def _of_profile(
    values: PyValues, made: Made, key: str, node: Node, scope: Scope, usual: Ways = ()
) -> Ways:
    """A key of a profile: set after it was made, or given when it was, or else `usual`."""
    stored = scope.stores.get((text_of(node), key), [])
    seen = reaching(stored, node)
    later = [w for b in seen for w in bound(values, b, key, scope)]
    _, keywords = arguments_of(made.call)
    first = values.ways(keywords[key], made.scope) if key in keywords else usual
    if seen and reaching([seen[0]], node) and _always(seen[0].node, node):
        return distinct(later)
    return distinct([*first, *later])


def _always(statement: Node, use: Node) -> bool:
    """Whether a statement stands in a block that the use is in as well."""
    block = climb(statement, lambda n: n.type != "expression_statement")
    return block is not None and block.start_byte <= use.start_byte <= block.end_byte
