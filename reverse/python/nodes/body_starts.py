"""What runs before a node serves messages, as the statements of a constructor."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.literals import exact_literal_of
from rebsync.reverse.models.texts import no_text
from rebsync.reverse.python.bodies.body_methods import kept_names
from rebsync.reverse.python.bodies.body_node_loops import EndlessLoop
from rebsync.reverse.python.bodies.body_presence import presence_key
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import Frame, Nobody
from rebsync.reverse.python.bodies.body_statements import PyStatements
from rebsync.reverse.python.bodies.body_units import scope_around
from rebsync.reverse.python.expressions.values import (
    OTHER,
    REAL,
    STRING,
    TRUTH,
    TYPES,
    WHOLE,
    Value,
)
from rebsync.reverse.python.nodes.body_entries import entries
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.python.values.py_worth import Class
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import MODULE, Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of


def constructor(reading: Reading, loops: list[EndlessLoop]) -> tuple[m.Statement, ...]:
    """All that starts a node; the loops that keep it running are put into `loops`."""
    unit = reading.unit
    if not unit.lineage:
        found = _read(reading, unit.module, named(unit.module.node), loops)
        for entry in entries(reading, unit.name):
            found += _read(reading, entry, body_of(entry), loops)
        return found
    made = list(_made(reading))
    if len(made) == 1:
        call, scope = made[0]
        nodes = named(scope.node) if scope.kind == MODULE else body_of(scope)
        words = (f"{unit.lineage[0].name}(", "sleep", *_aliases(nodes, _variable(call)))
        return _read(reading, scope, nodes, loops, words)
    own = reading.method("__init__", 0)
    return _read(reading, own, body_of(own), loops) if own is not None else ()


def _read(
    reading: Reading,
    scope: Scope,
    nodes: list[Node],
    loops: list[EndlessLoop],
    only: tuple[str, ...] = (),
) -> tuple[m.Statement, ...]:
    kept = kept_names(reading, scope) if scope.kind != MODULE else frozenset()
    frame = Frame(scope, is_start=True, kept=kept)
    for number, parameter in enumerate(scope.parameters if scope.kind != MODULE else ()):
        if number or scope.self_name is None:
            frame.bound[parameter.name] = _given(reading, scope, number)
    within = f"{reading.unit.name}.{scope.name or 'start'}"
    running = (scope.node.id,)
    reader = PyStatements(reading, frame, within, scope.node, running, loops, only)
    return reader.body(nodes)


def _given(reading: Reading, scope: Scope, number: int) -> Value | Nobody:
    """What a parameter of the function that starts a node is."""
    from rebsync.reverse.python.values.py_callers import argument

    return reading.constant(argument(reading.values, scope, number)) or Nobody()


def _made(reading: Reading) -> Iterator[tuple[Node, Scope]]:
    """Where objects of the class are made."""
    owner = reading.unit.lineage[0]
    for call, scope in reading.code.by_callee.get(owner.name, []):
        ways = reading.values.ways(field(call, "function"), scope)
        if any(isinstance(w, Class) and w.scope is owner for w in ways):
            yield call, scope_around(reading.code, call, scope.py.source.path)


def _variable(call: Node) -> tuple[str, ...]:
    """The variable that an object is put into."""
    above = call.parent
    if above is not None and above.type == "assignment":
        target = field(above, "left")
        return (text_of(target),) if target.type == "identifier" else ()
    return ()


def declared(reading: Reading) -> Iterator[m.Statement]:
    """What variables of the module and of the class hold at first."""
    unit = reading.unit
    for name, (where, _, text) in list(reading.state.items()):
        if where not in ("module", "self") or (where == "module" and not unit.lineage):
            continue
        scopes = unit.lineage if where == "self" else (unit.module,)
        bindings = [(b, s) for s in scopes for b in s.names.get(text, []) if _is_at(reading, b, s)]
        if not bindings:
            continue
        binding, scope = bindings[0]
        if where == "module" and _is_set_otherwise(reading, text):
            reading.learnt.join(reading.state[name], OTHER)
            continue
        if binding.value.type == "none" and len(bindings) == 1:
            reading.learnt.join(presence_key(reading.state[name]), TRUTH)
            kind = reading.learnt.kind(reading.state[name])
            if kind in (TRUTH, WHOLE, REAL):  # of which none is None
                reading.learnt.join(reading.state[name], OTHER)
            elif kind == STRING:
                reading.learnt.mix(reading.state[name])
                yield m.ExpressionStatement(m.Assign("=", m.Name(name), no_text()))
            continue
        value = reading.constant(reading.values.ways(binding.value, scope))
        own = value.kind if value is not None and len(bindings) == 1 else OTHER
        reading.learnt.join(reading.state[name], own)
        found = reading.learnt.kind(reading.state[name])
        if value is None or found is None or found not in TYPES:
            continue
        if found == WHOLE:
            reading.wide.add(name)
        stored = value.expression
        if found == REAL and isinstance(stored, m.IntLiteral):
            stored = exact_literal_of(float(stored.value))
        yield m.ExpressionStatement(m.Assign("=", m.Name(name), stored))


def _is_at(reading: Reading, binding: Binding, scope: Scope) -> bool:
    """Whether a name is bound in a scope itself, not by a function in it."""
    path = scope.py.source.path
    return binding.how == "value" and scope_around(reading.code, binding.node, path) is scope


def _is_set_otherwise(reading: Reading, name: str) -> bool:
    """Whether a statement at the top of the module sets a variable, that is no assignment of it."""
    module = reading.unit.module
    path = module.py.source.path
    others = (b.node for b in module.names.get(name, ()) if b.how != "value")
    return any(scope_around(reading.code, node, path) is module for node in others)


def _aliases(nodes: Sequence[Node], names: tuple[str, ...]) -> tuple[str, ...]:
    """Some variables, and those that get a value which some of them are named in."""
    found = names
    for node in nodes if names else ():
        for inner in nodes_in(node):
            if inner.type != "assignment" or inner.child_by_field_name("right") is None:
                continue
            target, used = field(inner, "left"), nodes_in(field(inner, "right"))
            if target.type == "identifier" and any(text_of(n) in found for n in used):
                found = (*found, text_of(target))
    return tuple(dict.fromkeys(found))
