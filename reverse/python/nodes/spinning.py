"""Whether a program lets its nodes serve what comes: it spins them, or lives on in rospy.

The model's rebecs always serve. A node that no executor gets never calls a callback, and a script
of rospy that runs to its end takes its node along.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import NodeFact, ServiceFact, SubscriptionFact, TimerFact
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.python.bodies.body_node_loops import forever
from rebsync.reverse.python.bodies.body_scope import PyUnit
from rebsync.reverse.python.bodies.body_units import scope_around
from rebsync.reverse.python.nodes.body_started import is_module
from rebsync.reverse.python.values.py_asks import is_node
from rebsync.reverse.python.values.py_evaluator import lineage
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import (
    Class,
    External,
    Function,
    Instance,
    Made,
    Module,
    Value,
)
from rebsync.reverse.syntax.ancestors import ancestors, climb
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import CLASS, LAMBDA, MODULE, Scope, arguments_of, last_name
from rebsync.reverse.syntax.py_tree import SCOPES, field, text_of

_SERVED = (SubscriptionFact, TimerFact, ServiceFact)
_LOOPS = frozenset({"while_statement", "for_statement"})
# What keeps a program of rospy alive beside `spin` and loops: windows, other threads, people.
_LIVING = frozenset(
    {"mainloop", "exec_", "exec", "pause", "join", "serve_forever", "input", "raw_input"}
    | {"run", "run_forever", "app_run", "show", "start"}
)
_LATE = "this publishes when nothing is served any more: the model ends before"
_UNSPUN = "nothing spins this node: it is not known to serve anything"
_REMOVED = "a node is taken out of its executor: this one is not known to serve anything"
_ENDING = "the program of this node runs to its end: nothing is served from then on"


@dataclass(frozen=True, eq=False, slots=True)
class _Spin:
    """A call that serves nodes: those that it is given, or those of an `executor`."""

    call: Node
    scope: Scope
    nodes: tuple[Value, ...]
    executor: tuple[Value, ...] | None = None


def list_unserved(
    units: Collection[PyUnit],
    values: PyValues,
    entries: Collection[tuple[str, str]],
    servers: Mapping[str, Mapping[int, Server]],
    findings: Findings,
) -> None:
    """Lists the nodes whose programs do not let them serve.

    `entries` are the functions that installed programs start, with their modules.
    """
    if not units:
        return
    running = _Running(values, entries)
    if any(unit.library.flat for unit in units):  # of others nothing comes once they are shut down
        for scope, node in _published_late(values, running):
            findings.unreadable(scope.py.source, Unread(scope.py.span(node), _LATE), scope.name)
    for unit in units:
        made = list(_making(values, unit))
        if unit.lineage and not made:
            continue  # a program of another package makes it
        if not any(isinstance(fact, _SERVED) for fact in unit.unit.facts):
            continue  # it only publishes, which nobody has to serve
        if unit.library.flat:
            unserved = _UNSPUN if not _is_spun(values, unit, running) else ""
            if any(running.reaches(s) for _, s in values.code.by_callee.get("remove_node", ())):
                unserved = _REMOVED
        else:
            callbacks = {s.body.id for s in servers[unit.name].values()}
            unserved = _ENDING if not _lives(values, unit, running, made, callbacks) else ""
        if unserved:
            scope, node = made[0] if made else (unit.module, unit.unit.facts[0].site.call)
            findings.unreadable(scope.py.source, Unread(scope.py.span(node), unserved), unit.name)


def _making(values: PyValues, unit: PyUnit) -> Iterator[tuple[Scope, Node]]:
    """Where objects of the class are made, or of one below it."""
    if not unit.lineage:
        return
    for calls in values.code.by_callee.values():
        for call, scope in calls:
            ways = values.ways(field(call, "function"), scope) if _may_make(unit, call) else ()
            if any(
                isinstance(w, Class) and unit.lineage[0] in lineage(values, w.scope) for w in ways
            ):
                yield scope, call


def _may_make(unit: PyUnit, call: Node) -> bool:
    name = last_name(field(call, "function"))
    return name == unit.lineage[0].name or name[:1].isupper()


# --- rclpy --------------------------------------------------------------------------------------


def _is_spun(values: PyValues, unit: PyUnit, running: _Running) -> bool:
    every = list(_spins(values, running))
    spins = [s for s in every if not any(_is_before(values, unit, o, s) for o in every)]
    if any(_is_of(values, unit, way) for spin in spins for way in spin.nodes):
        return True
    if spins and not _is_node(values, unit):
        return True  # a helper, of a node that another unit is
    executors = [spin.executor for spin in spins if spin.executor is not None]
    for call, scope in values.code.by_callee.get("add_node", ()):
        function = field(call, "function")
        if not executors or function.type != "attribute" or not running.reaches(scope):
            continue
        plain, keywords = arguments_of(call)
        given = [w for n in (*plain, *keywords.values()) for w in values.ways(n, scope)]
        to = values.ways(field(function, "object"), scope)
        if any(_is_of(values, unit, w) for w in given) and any(_meet(to, e) for e in executors):
            return True
    return False


def _is_before(values: PyValues, unit: PyUnit, one: _Spin, other: _Spin) -> bool:
    """Whether a call serves only other nodes than a unit's, and does not come to another call."""
    if one.scope is not other.scope or one.call.start_byte >= other.call.start_byte:
        return False
    spins = last_name(field(one.call, "function")) in libraries.named(Kind.SPIN)
    known = (isinstance(w, Instance) and not _is_of(values, unit, w) for w in one.nodes)
    return spins and one.executor is None and bool(one.nodes) and all(known)


def _is_node(values: PyValues, unit: PyUnit) -> bool:
    """Whether it is known which node a unit is."""
    if unit.lineage:
        return is_node(values, unit.lineage[0])
    return any(isinstance(f, NodeFact) for f in unit.unit.facts)


def _spins(values: PyValues, running: _Running) -> Iterator[_Spin]:
    """All calls that spin, and those that are given a function that does."""
    names = libraries.named(Kind.SERVE, Kind.SPIN) | {"spin_until_future_complete"}
    for name in sorted(names):
        for call, scope in values.code.by_callee.get(name, ()):
            is_once = name in libraries.named(Kind.SERVE)
            if not running.reaches(scope) or _is_optional(call) or _is_over(values, call, scope):
                continue
            if not is_once or _goes_round(values, call, scope):
                yield from _spin(values, field(call, "function"), call, scope)
    for call, scope in values.code.calls:
        plain, keywords = arguments_of(call)
        for argument in (*plain, *keywords.values()):
            if last_name(argument) in names and running.reaches(scope):
                yield from _spin(values, argument, call, scope)


def _spin(values: PyValues, function: Node, call: Node, scope: Scope) -> Iterator[_Spin]:
    ways = values.ways(function, scope)
    if any(isinstance(w, Function) for w in ways):
        return  # which has a call of its own
    given = tuple(
        w
        for node in nodes_in(field(call, "arguments"))
        if node.type in ("identifier", "attribute", "call")
        for w in values.ways(node, scope)
    )
    if any(isinstance(w, External) for w in ways):
        yield _Spin(call, scope, given)
    elif function.type == "attribute":
        on = values.ways(field(function, "object"), scope)
        yield _Spin(
            call, scope, on, on
        )  # of a library whose nodes spin themselves, or of an executor


def _published_late(values: PyValues, running: _Running) -> Iterator[tuple[Scope, Node]]:
    """The calls behind `spin`, in its function, that publish: the context may be valid still."""
    found: dict[int, tuple[Scope, Node]] = {}
    for name in sorted(libraries.named(Kind.SPIN)):
        for call, scope in values.code.by_callee.get(name, ()):
            around = [call, *ancestors(call, lambda n: n.type in SCOPES)]
            late = (n for at in around for n in _behind(at) for n in nodes_in(n))
            calls = [n for n in late if n.type == "call"] if running.reaches(scope) else []
            senders = _senders(values) if calls else frozenset()
            for node in calls:
                if last_name(field(node, "function")) in senders:
                    found[node.id] = scope, node
    yield from found.values()


def _behind(node: Node) -> Iterator[Node]:
    """The statements and clauses that follow a node in its block."""
    behind = node.next_named_sibling if node.type != "argument_list" else None
    while behind is not None:
        yield behind
        behind = behind.next_named_sibling


def _senders(values: PyValues) -> frozenset[str]:
    """What publishes, by names: methods of publishers, and functions that lead to these."""
    found = set(libraries.methods_of(Kind.PUBLISH))
    while True:
        more = {
            s.name for call, s in values.code.calls if last_name(field(call, "function")) in found
        }
        more.discard("")
        if more <= found:
            return frozenset(found)
        found |= more


def _goes_round(values: PyValues, call: Node, scope: Scope) -> bool:
    """Whether a call stands in a loop, or in a function that a loop calls."""
    if any(n.type in _LOOPS for n in ancestors(call, lambda n: n.type in SCOPES)):
        return True
    above = scope.function
    calls = values.code.by_callee.get(above.name, ()) if above is not None else ()
    return any(
        n.type in _LOOPS for other, _ in calls for n in ancestors(other, lambda n: n.type in SCOPES)
    )


def _is_over(values: PyValues, call: Node, scope: Scope) -> bool:
    """Whether the client library is shut down before a call in its function."""
    for name in ("shutdown", "try_shutdown", "signal_shutdown"):
        for other, of in values.code.by_callee.get(name, ()):
            if of is scope and other.start_byte < call.start_byte and not _is_left(other):
                return True
    return False


def _is_left(call: Node) -> bool:
    """Whether the block that a call stands in ends its function behind it."""
    block = climb(call, lambda n: n.type in ("block", "module"))
    behind = (n for n in block.named_children if n.start_byte > call.start_byte) if block else ()
    return any(
        n.type in ("return_statement", "raise_statement") or "exit(" in text_of(n) for n in behind
    )


def _is_of(values: PyValues, unit: PyUnit, way: Value) -> bool:
    """Whether a value is the node of a unit."""
    match way:
        case Instance(scope):
            return scope in unit.lineage or bool(
                unit.lineage and unit.lineage[0] in lineage(values, scope)
            )
        case Made(_, call, scope):
            number = unit.calls.get((scope.py.source.path, call.id))
            return number is not None and isinstance(unit.unit.facts[number], NodeFact)
        case _:
            return False


def _meet(one: tuple[Value, ...], other: tuple[Value, ...]) -> bool:
    """Whether two expressions may be the same executor."""
    ids = [
        {
            w.call.id if isinstance(w, Made) else w.scope.node.id if isinstance(w, Instance) else -1
            for w in ways
        }
        for ways in (one, other)
    ]
    return -1 in ids[0] | ids[1] or not ids[0].isdisjoint(ids[1])


def _is_optional(node: Node) -> bool:
    """Whether an `if` without an else may skip a node; `__name__` says that a file is run."""
    return any(
        above.type == "if_statement"
        and "__name__" not in text_of(field(above, "condition"))
        and above.child_by_field_name("alternative") is None
        for above in ancestors(node, lambda n: n.type in SCOPES)
    )


# --- rospy --------------------------------------------------------------------------------------


def _lives(
    values: PyValues,
    unit: PyUnit,
    running: _Running,
    made: Collection[tuple[Scope, Node]],
    callbacks: Collection[int],
) -> bool:
    """Whether a program of a unit goes on: what serves messages does not keep it alive."""
    own = {unit.module, *(s.module for s in unit.lineage), *(s.module for s, _ in made)}
    users = {m for m in values.code.modules.values() if _imports(values, m, own)}
    program = own | users
    program |= {
        m for m in values.code.modules.values() if any(_imports(values, p, {m}) for p in program)
    }
    for module in program:
        for node in nodes_in(module.node):
            if node.type not in ("call", "while_statement"):
                continue
            scope = scope_around(values.code, node, module.py.source.path)
            if not running.reaches(scope) or scope.node.id in callbacks or _is_optional(node):
                continue
            if forever(node) or (node.type == "call" and _keeps(values, node, scope)):
                return True
    return False


def _keeps(values: PyValues, call: Node, scope: Scope) -> bool:
    function = field(call, "function")
    name = last_name(function)
    if name not in _LIVING and "spin" not in name:
        return False
    ways = values.ways(function, scope)
    if any(isinstance(w, Function) for w in ways):
        return False  # whose body says so
    known = [w.name for w in ways if isinstance(w, External)]
    if _is_over(values, call, scope):
        return False
    return name in _LIVING or not known or any(libraries.kind_of(n) is Kind.SPIN for n in known)


def _imports(values: PyValues, module: Scope, wanted: Collection[Scope]) -> bool:
    """Whether a file imports another, or something of it."""
    for name, bindings in module.names.items():
        for binding in bindings:
            if binding.how != "import":
                continue
            for way in values.bound(binding, name, module):
                if isinstance(way, Module | Class | Function) and way.scope.module in wanted:
                    return True
    return False


# --- what runs ----------------------------------------------------------------------------------


class _Running:
    """The functions that may run: those that code at the top of files leads to, by their names."""

    def __init__(self, values: PyValues, entries: Collection[tuple[str, str]]) -> None:
        code = values.code
        self._reached: set[int] = set()
        by_name: dict[str, list[Scope]] = {}
        for scope in code.scopes.values():
            by_name.setdefault(scope.name, []).append(scope)
        waiting = list(code.modules.values())
        waiting += [s for s in code.scopes.values() if is_entry(s, entries)]
        while waiting:
            scope = waiting.pop()
            if id(scope) in self._reached:
                continue
            self._reached.add(id(scope))
            for node in own_nodes(scope):
                if node.type in ("lambda", "class_definition"):
                    waiting.append(code.scope_of(node, scope.py))
                elif node.type == "identifier":
                    waiting += by_name.get(text_of(node), ())
            if scope.kind == CLASS:
                waiting += [
                    s for s in code.scopes.values() if s.parent is scope and s.name[:2] == "__"
                ]

    def reaches(self, scope: Scope) -> bool:
        return scope.kind == MODULE or id(scope) in self._reached


def is_entry(scope: Scope, entries: Collection[tuple[str, str]]) -> bool:
    """Whether a program starts with a function; where none is known it may be each `main`."""
    if scope.parent is None or scope.parent.kind != MODULE:
        return False
    path = scope.py.source.path
    started = any(scope.name == name and is_module(path, module) for module, name in entries)
    return started or (not entries and scope.name == "main")


def own_nodes(scope: Scope) -> Iterator[Node]:
    """The nodes of a scope but for those of the functions and classes in it."""
    waiting = list(scope.node.named_children)
    if scope.kind not in (MODULE, LAMBDA):
        waiting = [c for c in waiting if c != scope.node.child_by_field_name("name")]
    for node in waiting:
        yield from nodes_in(node, *SCOPES)
