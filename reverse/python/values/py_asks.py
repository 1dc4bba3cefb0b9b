"""Which calls ask ROS for something, and which argument has which role."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Kind, Routine
from rebsync.reverse.python.values.py_evaluator import lineage
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import (
    Bound,
    Class,
    External,
    Function,
    Instance,
    Made,
    Value,
)
from rebsync.reverse.syntax.py_index import Scope, arguments_of, last_name
from rebsync.reverse.syntax.py_tree import field, text_of


@dataclass(frozen=True, eq=False, slots=True)
class PyRosCall:
    """A call that asks for something; `given` are its arguments by their roles."""

    ask: Routine
    call: Node
    scope: Scope
    given: dict[str, Node]

    @property
    def name(self) -> Node:
        """The name of what is called, at which the call is said to stand."""
        called = field(self.call, "function")
        return field(called, "attribute") if called.type == "attribute" else called


def asked_in(values: PyValues) -> Iterator[PyRosCall]:
    """All such calls, in the order of files and places."""
    for call, scope in values.code.calls:
        name = last_name(field(call, "function"))
        ask = _ask(values, name, call, scope)
        if ask is not None:
            yield PyRosCall(ask, call, scope, roles(ask, call))


def roles(ask: Routine, call: Node) -> dict[str, Node]:
    """The arguments of a call by their roles."""
    plain, keywords = arguments_of(call)
    given = {role: node for role, node in zip(ask.arguments, plain, strict=False) if role}
    return given | {ask.role_of(k): v for k, v in keywords.items()}


def _ask(values: PyValues, name: str, call: Node, scope: Scope) -> Routine | None:
    if name == "__init__":
        return _constructor(values, call, scope)
    if name not in libraries.asking_names() and not _may_be_renamed(name, scope):
        return None
    for value in values.ways(field(call, "function"), scope):
        ask = _of(values, value, call)
        if ask is not None:
            return ask
    return _by_shape(values, name, call, scope)


def _may_be_renamed(name: str, scope: Scope) -> bool:
    """Whether a name is bound in its module otherwise than by a definition: `Pub = rospy.X`."""
    bindings = scope.module.names.get(name, ())
    return any(b.how in ("import", "value") for b in bindings)


def _of(values: PyValues, value: Value, call: Node) -> Routine | None:
    match value:
        case External(name):
            plain, keywords = arguments_of(call)
            return libraries.asks(name, len(plain), keywords)
        case Bound(Instance(owner), name):
            classes = set(_names(lineage(values, owner))) & libraries.node_classes()
            found = (libraries.node_method(name, of) for of in sorted(classes))
            return next((ask for ask in found if ask is not None), None)
        case Bound(Made(by), name) if _makes_node(by):
            return libraries.node_method(name, by)
        case _:
            return None


def _makes_node(name: str) -> bool:
    """Whether a call of a function gives a node that is an object."""
    return name in libraries.node_classes() or (
        libraries.kind_of(name) is Kind.NODE and libraries.of_nodes(name)
    )


def _by_shape(values: PyValues, name: str, call: Node, scope: Scope) -> Routine | None:
    """A call of a node's method on an object of which nothing is known."""
    called = field(call, "function")
    ask = libraries.node_method(name)
    if ask is None or called.type != "attribute":
        return None
    plain, keywords = arguments_of(call)
    if len(plain) + len(keywords) < ask.least:
        return None
    ways = values.ways(called, scope)
    if any(isinstance(w, (Function, Class, External)) for w in ways):
        return None
    holders = values.ways(field(called, "object"), scope)
    known = [h for h in holders if isinstance(h, (Made, External)) and not _is_ros(h)]
    return None if known else ask


def _is_ros(value: Made | External) -> bool:
    name = value.by if isinstance(value, Made) else value.name
    return libraries.of_nodes(name)


def _constructor(values: PyValues, call: Node, scope: Scope) -> Routine | None:
    """`super().__init__(name)` in a class that is a node by what is directly above it."""
    owner, called = scope.owner, field(call, "function")
    if owner is None or called.type != "attribute":
        return None
    above = lineage(values, owner)[1:]
    nearest = next((c for c in above if not isinstance(c, Scope) or "__init__" in c.names), None)
    if not isinstance(nearest, External) or not (set(_names(above)) & libraries.node_classes()):
        return None
    holder = field(called, "object")
    if holder.type == "call" and text_of(field(holder, "function")) == "super":
        return _made(nearest.name)
    ways = values.ways(holder, scope)
    if any(isinstance(w, External) and w.name in libraries.node_classes() for w in ways):
        ask = _made(nearest.name)
        return Routine(ask.kind, ("", *ask.arguments), ask.keywords)
    return None


def _made(name: str) -> Routine:
    """What makes an object of a class of nodes, or of one above it, asks for."""
    found = libraries.asks(name, 0, ())
    return found or libraries.function(libraries.node_class()) or Routine(Kind.NODE, ("name",))


def _names(above: list[Scope | External]) -> Iterator[str]:
    return (c.name for c in above if isinstance(c, External))


def is_node(values: PyValues, owner: Scope) -> bool:
    """Whether the objects of a class are nodes."""
    return bool(set(_names(lineage(values, owner))) & libraries.node_classes())
