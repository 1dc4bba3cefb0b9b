"""Which values of Python act on a node: its object, its handles, and functions that use these.

A side-effect analysis over the call graph ("interprocedural side effects", Banning, POPL 1979): a
function acts if it, or one that it may call, sets attributes of a node's object or variables of a
module, or uses a publisher or a timer.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import cache

from tree_sitter import Node

from rebsync.reverse.graph import Unresolved
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.python.values.py_evaluator import PyEvaluator, lineage
from rebsync.reverse.python.values.py_worth import (
    Bound,
    Class,
    Function,
    Instance,
    Items,
    Made,
    Table,
    Value,
    Ways,
)
from rebsync.reverse.syntax.py_index import CLASS, Scope, last_name
from rebsync.reverse.syntax.py_tree import field, text_of

_HANDLES = frozenset({Kind.PUBLISHER, Kind.TIMER})
_STORES = frozenset({"assignment", "augmented_assignment"})


class NodeEffects:
    """What acts on nodes in some files; `nodes` are the classes of all units."""

    def __init__(self, values: PyEvaluator, nodes: Collection[Scope]) -> None:
        self._values = values
        self.nodes = frozenset(nodes)
        self.of_function = cache(self._of_function)
        self.of_class = cache(self._of_class)

    def any_acts(self, ways: Ways) -> bool:
        """Whether some of these values act on a node for who gets them."""
        return any(map(self.acts, ways))

    def acts(self, way: Value) -> bool:
        """Whether a value acts on a node for who calls it, or its methods."""
        match way:
            case Made(by):
                return _is_handle(by)
            case Bound(holder, name):
                return name in libraries.acting_methods() and self.acts(holder)
            case Function(scope):
                return self.of_function(scope)
            case Instance(scope) | Class(scope):
                return scope in self.nodes or self.of_class(scope)
            case Items(each):
                return any(map(self.any_acts, each))
            case Table(pairs):
                return any(self.any_acts(ways) for _, ways in pairs)
            case _:
                return False

    def _of_class(self, owner: Scope) -> bool:
        """Whether a method of a class, or of one above it, acts."""
        family = [c for c in lineage(self._values, owner) if isinstance(c, Scope)]
        bound = (b.node for c in family for of in c.names.values() for b in of if b.how == "scope")
        scopes = (self._scope(node, owner) for node in bound)
        return any(s.kind != CLASS and self.of_function(s) for s in scopes if s is not None)

    def of_construction(self, owner: Scope) -> bool:
        """Whether to make an object of a class acts."""
        family = [c for c in lineage(self._values, owner) if isinstance(c, Scope)]
        bound = (b.node for c in family for b in c.names.get("__init__", ()))
        scopes = (self._scope(node, owner) for node in bound)
        return any(self.of_function(s) for s in scopes if s is not None)

    def _scope(self, node: Node, near: Scope) -> Scope | None:
        found = self._values.code.scopes.get((near.py.source.path, node.id))
        if found is not None:
            return found
        return next((s for (_, i), s in self._values.code.scopes.items() if i == node.id), None)

    def _of_function(self, function: Scope) -> bool:
        """Whether a function acts, or one that it may call."""
        waiting, seen = [function], {function.node.id}
        while waiting:
            scope = waiting.pop()
            for node, within in self._nodes_of(scope):
                if self._is_store(node, within):
                    return True
                if node.type != "call":
                    continue
                if self._is_use(node, within):
                    return True
                called = [s for s in self._called(node, within) if s.node.id not in seen]
                seen |= {s.node.id for s in called}
                waiting += called
        return False

    def _nodes_of(self, scope: Scope) -> Iterator[tuple[Node, Scope]]:
        """All nodes of a function, each with the function or lambda that it stands in."""
        path = scope.py.source.path
        waiting = [(child, scope) for child in scope.node.named_children]
        while waiting:
            node, within = waiting.pop()
            yield node, within
            within = self._values.code.scopes.get((path, node.id), within)
            waiting += [(child, within) for child in node.named_children]

    def _is_store(self, node: Node, scope: Scope) -> bool:
        """Whether a statement sets what may be a state variable."""
        if node.type not in _STORES:
            return False
        target = field(node, "left")
        if target.type == "identifier":
            return text_of(target) in scope.outer
        if target.type != "attribute":
            return False
        return any(
            isinstance(w, Instance) and w.scope in self.nodes
            for w in self._values.ways(field(target, "object"), scope)
        )

    def _is_use(self, call: Node, scope: Scope) -> bool:
        """Whether a call uses a publisher or a timer."""
        function = field(call, "function")
        name = last_name(function)
        if name not in libraries.acting_methods() and name not in libraries.methods_of(
            Kind.PUBLISH
        ):
            return False
        ways = self._values.ways(function, scope)
        is_unknown = not ways or any(isinstance(w, Unresolved) for w in ways)
        return self.any_acts(ways) or (is_unknown and name in libraries.methods_of(Kind.PUBLISH))

    def _called(self, call: Node, scope: Scope) -> Iterator[Scope]:
        """The functions that a call may run; of a method of an unknown object those of nodes."""
        function = field(call, "function")
        ways = self._values.ways(function, scope)
        for way in ways:
            if isinstance(way, Function):
                yield way.scope
            elif isinstance(way, Class):
                for binding in way.scope.names.get("__init__", []):
                    found = self._scope(binding.node, way.scope)
                    yield from () if found is None else (found,)
        if function.type == "attribute" and all(isinstance(w, Unresolved) for w in ways):
            methods = self._values.code.methods.get(last_name(function), ())
            yield from (s for s in methods if s.parent in self.nodes)


def _is_handle(made_by: str) -> bool:
    """Whether a function, by its full name, makes a publisher or a timer."""
    if libraries.kind_of(made_by) in _HANDLES:
        return True
    found = libraries.node_method(made_by.rpartition(".")[2]) if "." in made_by else None
    return found is not None and found.kind in _HANDLES
