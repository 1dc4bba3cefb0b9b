"""Where something that acts on a node gets to code that is not read: escape analysis.

After "Escape Analysis for Java" (Choi et al., OOPSLA 1999): what is handed to a function that is
not in the files, stored in an object that is not of the files, or known to a class above that is
not in them, may be used there at any time. Of what a library makes without any of that it is
trusted that it leaves the node alone.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import Unresolved
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.python.bodies.body_effects import is_log
from rebsync.reverse.python.bodies.body_scope import PyUnit
from rebsync.reverse.python.bodies.body_units import scope_around
from rebsync.reverse.python.values.node_effects import NodeEffects
from rebsync.reverse.python.values.py_evaluator import lineage
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import (
    Bound,
    Class,
    External,
    Function,
    Instance,
    Items,
    Made,
    Module,
    Table,
    Value,
)
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import CLASS, FUNCTION, Scope, last_name
from rebsync.reverse.syntax.py_tree import decorating, field, named

_HANDED = "this hands over what acts on the node, to code that is not read"
_KEPT = "what acts on the node is kept here by an object of another library"
_DECORATED = "what decorates this may call it at any time, and it acts on the node"
_BASE = "a class above this one is not read: it may call what acts on the node"
_ENDS = "this runs when nothing has an object any more, and it acts on the node"
# Modules of Python whose classes and decorators call nothing by themselves.
_PLAIN = frozenset(
    {"builtins", "abc", "typing", "typing_extensions", "enum", "collections", "dataclasses"}
    | {"functools", "contextlib", "itertools", "types"}
)
# Functions that look at what they get, or give it back as it is.
_LOOKING = frozenset(
    {"isinstance", "issubclass", "len", "print", "str", "repr", "type", "id", "hasattr", "bool"}
    | {"callable", "enumerate", "zip", "list", "tuple", "reversed", "super", "getattr", "any"}
    | {"all", "range", "partial", "wraps"}
)
_FILLING = frozenset(
    {"append", "appendleft", "add", "insert", "extend", "update", "setdefault", "__setitem__"}
)
_WITHIN = frozenset(
    {"list", "tuple", "set", "dictionary", "pair", "parenthesized_expression", "list_splat"}
    | {"conditional_expression", "boolean_operator", "dictionary_splat", "expression_list"}
    | {"list_comprehension", "generator_expression", "named_expression"}
)


def list_escapes(
    units: Collection[PyUnit],
    values: PyValues,
    effects: NodeEffects,
    skipped: Collection[str],
    findings: Findings,
) -> None:
    """Lists where what acts on some units' nodes escapes; files with `skipped` paths are left out.

    What is listed for another reason already is left as it is.
    """
    for scope, node, why in _Escapes(values, effects, frozenset(skipped)).all():
        source, span = scope.py.source, scope.py.span(node)
        is_listed = findings.has_unreadable(source, span)
        near = [u for u in units if u.module is scope.module] or list(units)
        if not is_listed and near:
            findings.unreadable(source, Unread(span, why), near[0].name)


class _Escapes:
    def __init__(self, values: PyValues, effects: NodeEffects, skipped: frozenset[str]) -> None:
        self._values = values
        self._effects = effects
        self._skipped = skipped

    def all(self) -> Iterator[tuple[Scope, Node, str]]:
        """All places, each with the scope that it stands in, and why."""
        code = self._values.code
        for call, scope in code.calls:
            if scope.py.source.path not in self._skipped and self._hands_over(call, scope):
                yield scope, call, _HANDED
        for scope in (*code.modules.values(), *code.scopes.values()):
            if scope.py.source.path in self._skipped:
                continue
            for bindings in scope.stores.values():
                for binding in bindings:
                    if self._keeps(binding.node, scope):
                        yield scope, binding.node, _KEPT
            if scope.kind == FUNCTION and self._is_decorated(scope):
                yield scope, field(scope.node, "name"), _DECORATED
            if scope.name == "__del__" and self._effects.of_function(scope):
                yield scope, field(scope.node, "name"), _ENDS
            if scope.kind == CLASS and self._is_called_above(scope):
                yield scope, field(scope.node, "name"), _BASE

    # --- calls and stores ------------------------------------------------------------------------

    def _hands_over(self, call: Node, scope: Scope) -> bool:
        """Whether a call hands what acts to a function that is not in the files."""
        function = field(call, "function")
        if is_log(call) or last_name(function) in _LOOKING or _is_of_super(function):
            return False
        if self._is_own_container(function, scope):
            return False
        given = [n for n in self._given(field(call, "arguments")) if self._is_acting(n, scope)]
        if not given:
            return False
        ways = self._values.ways(function, scope)
        return not ways or not all(map(self._is_read, ways))

    def _is_acting(self, node: Node, scope: Scope) -> bool:
        """Whether a value acts, or is a container of a name that something puts such a one into."""
        return self._acts(node, scope) or last_name(node) in self._filled

    def _acts(self, node: Node, scope: Scope) -> bool:
        return self._effects.any_acts(self._values.ways(node, scope))

    @cached_property
    def _filled(self) -> frozenset[str]:
        """The names of containers that get what acts after they were made."""
        found = set[str]()
        for name in _FILLING:
            for call, scope in self._values.code.by_callee.get(name, ()):
                holder = field(call, "function").child_by_field_name("object")
                given = self._given(field(call, "arguments"))
                if holder is not None and any(self._acts(n, scope) for n in given):
                    found.add(last_name(holder))
        for path, module in self._values.code.modules.items():
            for node in nodes_in(module.node):
                target = node.child_by_field_name("left") if node.type == "assignment" else None
                value = node.child_by_field_name("right")
                if target is None or value is None or target.type != "subscript":
                    continue
                if self._acts(value, scope_around(self._values.code, node, path)):
                    found.add(last_name(field(target, "value")))
        return frozenset(found - {""})

    def _is_own_container(self, function: Node, scope: Scope) -> bool:
        """Whether a call fills a container, which no library made that may look at it."""
        holder = function.child_by_field_name("object")
        if holder is None or last_name(function) not in _FILLING:
            return False
        ways = self._values.ways(holder, scope)
        return all(isinstance(w, (Items, Table, Unresolved)) for w in ways)

    def _given(self, node: Node) -> Iterator[Node]:
        """The values that arguments hold, those in containers among them."""
        for inner in named(node):
            value = field(inner, "value") if inner.type in ("keyword_argument", "pair") else inner
            if value.type in _WITHIN:
                yield from self._given(value)
            else:
                yield value

    def _is_read(self, way: Value) -> bool:
        """Whether it is read, or known from tables, what a function does with its arguments."""
        match way:
            case Function():
                return True
            case Class(scope):
                return self._has_constructor(scope)
            case External(name):
                return libraries.is_of_client(name) or name in _listening()
            case Bound(Instance(scope), _):
                return not self._unknown_bases(scope)
            case Bound(Made(by), _):
                return libraries.is_of_client(by)
            case _:
                return False

    def _has_constructor(self, owner: Scope) -> bool:
        """Whether the files have what makes objects of a class."""
        family = [c for c in lineage(self._values, owner) if isinstance(c, Scope)]
        return any("__init__" in c.names for c in family)

    def _keeps(self, store: Node, scope: Scope) -> bool:
        """Whether a store puts what acts into an object that a library made."""
        target, value = field(store, "left"), store.child_by_field_name("right")
        if target.type != "attribute" or value is None:
            return False
        holders = self._values.ways(field(target, "object"), scope)
        if all(isinstance(w, (Instance, Class, Module)) for w in holders) and holders:
            return False
        if value.type in _WITHIN:
            return any(self._is_acting(n, scope) for n in self._given(value))
        return self._is_acting(value, scope)

    # --- functions and classes -------------------------------------------------------------------

    def _is_decorated(self, scope: Scope) -> bool:
        """Whether something decorates a function that may call it, and it acts."""
        every = [named(d)[0] for d in decorating(scope.node)]
        unknown = [n for n in every if not self._is_plain(n, scope.parent or scope)]
        return bool(unknown) and self._effects.of_function(scope)

    def _is_plain(self, decorator: Node, scope: Scope) -> bool:
        """Whether a decorator is one of Python's, which call nothing by themselves."""
        called = field(decorator, "function") if decorator.type == "call" else decorator
        if called.type == "attribute" and last_name(called) in ("setter", "getter", "deleter"):
            return True
        ways = self._values.ways(called, scope)
        return bool(ways) and all(isinstance(w, External) and w.root in _PLAIN for w in ways)

    def _is_called_above(self, scope: Scope) -> bool:
        """Whether a class that is not in the files is above one that has what acts."""
        code = self._values.code
        is_made = bool(code.by_callee.get(scope.name))
        is_node = scope in self._effects.nodes  # of which it is listed as well
        is_unknown = is_made and not is_node and self._unknown_bases(scope)
        return is_unknown and self._effects.of_class(scope)

    def _unknown_bases(self, scope: Scope) -> bool:
        """Whether a class has one above it of which nothing is known."""
        above = [c for c in lineage(self._values, scope) if isinstance(c, External)]
        return not all(c.root in _PLAIN or libraries.is_of_client(c.name) for c in above)


def _is_of_super(function: Node) -> bool:
    """Whether a function is one of the class above: that it is not read is said of the class."""
    holder = function.child_by_field_name("object")
    is_super = holder is not None and (holder.text or b"").startswith(b"super(")
    return is_super or last_name(function) == "__init__"


def _listening() -> Collection[str]:
    """What of the client libraries and their kin gets a node to listen or to send by itself."""
    return libraries.unmodelled()
