"""Stores to attributes of what the client libraries own: timers, subscriptions, publishers, nodes.

`timer.callback = other` or `timer.timer_period_ns *= 5` changes what the library does from then on,
and so does a class that replaces what `Node` has. The model has no such change: it is listed.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import NodeFact, Unresolved
from rebsync.reverse.python.bodies.body_scope import PyUnit
from rebsync.reverse.python.bodies.body_units import scope_around
from rebsync.reverse.python.values.py_asks import is_node
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import Bound, Instance, Made, Value, Ways
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_bindings import BINDING, bindings_of
from rebsync.reverse.syntax.py_index import Scope, arguments_of
from rebsync.reverse.syntax.py_tree import field, named, text_of

_BY_NAME = ("setattr", "delattr", "__setattr__", "__delattr__", "vars")
# Attributes of handles in rclpy and rospy: of an object of which nothing is known they count.
_OF_HANDLES = frozenset(
    {"callback", "_callback", "callbacks", "timer_period_ns", "callback_group", "sleep_dur", "impl"}
)
_LISTS = ("publishers", "subscriptions", "clients", "services", "timers", "guards", "waitables")
_PRIVATE = frozenset({f"_{name}" for name in _LISTS} | {"_context", "_default_callback_group"})
_ENDS = ("publisher", "subscription", "timer", "service", "client", "rate", "guard_condition")
# What `rclpy.node.Node` and the executor that serves it use of a node.
_OF_NODES = _PRIVATE.union(
    _LISTS,
    ("executor", "handle", "context", "default_callback_group", "_parameters"),
    ("add_waitable", "remove_waitable"),
    (f"{verb}_{end}" for verb in ("create", "destroy") for end in _ENDS),
)


@dataclass(frozen=True, eq=False, slots=True)
class HandleStore:
    """A store to the attribute `name` of what may be any of `holders`; "" is any attribute."""

    scope: Scope
    node: Node
    holders: Ways
    name: str


def list_handle_stores(units: Collection[PyUnit], values: PyValues, findings: Findings) -> None:
    """Lists what changes the handles and the nodes of some units behind the library's back."""
    stores = list(_stores(values))
    for unit in units:
        for store in stores:
            if _changes_handle(unit, store):
                why = "this changes what the client library does with a handle: that is not read"
                _list(unit, store.scope, store.node, why, findings)
        if unit.lineage and is_node(values, unit.lineage[0]):
            for scope, node, name in _of_node(unit, values, stores):
                why = f'"{name}" is what the client library uses of a node: its change is not read'
                _list(unit, scope, node, why, findings)


def _list(unit: PyUnit, scope: Scope, node: Node, why: str, findings: Findings) -> None:
    findings.unreadable(scope.py.source, Unread(scope.py.span(node), why), unit.name)


# --- stores -------------------------------------------------------------------------------------


def _stores(values: PyValues) -> Iterator[HandleStore]:
    """All stores to attributes, deletions and stores by computed names included."""
    for path, module in values.code.modules.items():
        for node in nodes_in(module.node):
            for target in _targets(node):
                holder = _holder(target)
                if holder is not None:
                    scope = scope_around(values.code, node, path)
                    ways = values.ways(field(holder, "object"), scope)
                    yield HandleStore(scope, node, ways, text_of(field(holder, "attribute")))
    for callee in _BY_NAME:
        for call, scope in values.code.by_callee.get(callee, ()):
            yield from _by_name(values, call, scope)


def _targets(node: Node) -> Iterator[Node]:
    if node.type == "delete_statement":
        for inner in named(node):
            yield from named(inner) if inner.type == "expression_list" else (inner,)
    elif node.type in BINDING and not node.type.startswith("import"):
        yield from (target for target, _ in bindings_of(node))


def _holder(target: Node) -> Node | None:
    """The attribute that a store to it, or to an element of it, changes."""
    while target.type in ("subscript", "list_splat_pattern", "parenthesized_expression"):
        inner = target.child_by_field_name("value") or next(iter(named(target)), None)
        if inner is None:
            return None
        target = inner
    return target if target.type == "attribute" else None


def _by_name(values: PyValues, call: Node, scope: Scope) -> Iterator[HandleStore]:
    """`setattr(timer, "callback", f)`, and the same as a method."""
    plain, _ = arguments_of(call)
    function = field(call, "function")
    holders = plain[:1]
    if function.type == "attribute":
        holders = [*holders, field(function, "object")]
    known = [t for n in plain[:2] if (t := values.text(n, scope)) is not None]
    for holder in holders:
        yield HandleStore(scope, call, values.ways(holder, scope), known[0] if known else "")


# --- handles ------------------------------------------------------------------------------------


def _changes_handle(unit: PyUnit, store: HandleStore) -> bool:
    for way in store.holders:
        if isinstance(way, Unresolved) and store.name in _OF_HANDLES:
            return True
        root = _root(way)
        number = unit.calls.get((root.scope.py.source.path, root.call.id)) if root else None
        if number is not None and (
            not isinstance(unit.unit.facts[number], NodeFact)
            or store.name in _OF_NODES
            or not store.name
        ):
            return True
    return False


def _root(way: Value) -> Made | None:
    """The call that made what a value is, or is an attribute of."""
    while isinstance(way, Bound):
        way = way.holder
    return way if isinstance(way, Made) else None


# --- nodes --------------------------------------------------------------------------------------


def _of_node(
    unit: PyUnit, values: PyValues, stores: Collection[HandleStore]
) -> Iterator[tuple[Scope, Node, str]]:
    """Where a class, or code beside it, replaces or takes what the library has of a node."""
    for scope in unit.lineage:
        for name in _OF_NODES.intersection(scope.names):
            yield scope, scope.names[name][0].node, name
    for store in stores:
        if store.name in _OF_NODES and any(_is_own(unit, way) for way in store.holders):
            yield store.scope, store.node, store.name
    for call, scope in values.code.calls:
        function = field(call, "function")
        inner = field(function, "object")
        if function.type != "attribute" or inner.type != "attribute":
            continue
        name = text_of(field(inner, "attribute"))
        ways = values.ways(field(inner, "object"), scope) if name in _PRIVATE else ()
        if any(_is_own(unit, way) for way in ways):
            yield scope, call, name


def _is_own(unit: PyUnit, way: Value) -> bool:
    return isinstance(way, Instance) and way.scope in unit.lineage
