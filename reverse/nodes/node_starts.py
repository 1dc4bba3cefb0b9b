"""What runs before a node serves messages: its constructors, and what `main` does with it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.effects.cpp_roots import identifiers_in
from rebsync.reverse.bodies.scope import Itself, Member, Outside, Stores
from rebsync.reverse.graph import TimerFact
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.models.rewriting import renamed
from rebsync.reverse.nodes.node_defaults import (
    Defaults,
    DefaultValues,
    all_of,
    base_of,
    in_order,
    member_of,
    ordered_defaults,
)
from rebsync.reverse.nodes.node_names import Names
from rebsync.reverse.nodes.node_reach import called_by
from rebsync.reverse.nodes.node_state import State
from rebsync.reverse.nodes.node_units import Start, Unit
from rebsync.reverse.syntax.cpp_calls import CppCall, calls_in
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_initialisers import hands_on
from rebsync.reverse.syntax.cpp_tree import Cpp, default_of, inside, named, text_of

_ENTRY = "onInit"


@dataclass(frozen=True, slots=True)
class StartStatements:
    """Statements of a function that run when a node starts.

    `arguments` are what the function's parameters get, with the file that says so.
    """

    function: CppFunction
    nodes: tuple[Node, ...]
    instead: Mapping[int, tuple[m.Statement | Stores | Node, ...]] = field(default_factory=dict)
    arguments: Mapping[str, tuple[Cpp, Node]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Opening:
    """All that runs before a node serves messages, in its order.

    `objects` are the names that `entry` has for the object itself, and for others.
    """

    steps: tuple[StartStatements | DefaultValues, ...]
    entry: CppFunction | None = None
    objects: Mapping[str, Member] = field(default_factory=dict)


def first_functions(code: Code, unit: Unit, starts: Sequence[Start]) -> list[CppFunction]:
    """The functions that run before a unit's node serves messages; `starts` are those of it."""
    found: dict[int, CppFunction] = {}
    waiting = list(_roots(unit, starts))
    with_bodies = {f.name for f in unit.functions if f.body is not None}
    callbacks = {
        c.function.node.id
        for f in unit.facts
        for c in getattr(f, "callbacks", ())
        if getattr(c, "function", None) is not None
    }
    while waiting:
        function = waiting.pop(0)
        if function.node.id in found or function.node.id in callbacks:
            continue
        found[function.node.id] = function
        names = called_by(code, function, with_bodies)
        waiting += [f for f in unit.functions if f.name in names and f.body is not None]
    return list(found.values())


def _roots(unit: Unit, starts: Sequence[Start]) -> Iterator[CppFunction]:
    if unit.program is not None:
        yield unit.program.main
    for owner in reversed(unit.lineage):
        yield from unit.constructors(owner)
    yield from (f for f in unit.functions if f.name == _ENTRY)
    for start in starts:
        if start.made is not None:
            for statement in used_in_main(start):
                called = {c.name for c in calls_in(statement)}
                yield from (f for f in unit.functions if f.name in called)


def used_in_main(start: Start) -> list[Node]:
    """The statements after an object is made that do something with it, or ask for its timers."""
    made, entry = start.made, start.entry
    if made is None or entry is None or made.statement is None or not made.variable:
        return []
    parent = made.statement.parent
    after = [n for n in named(parent) if n.start_byte >= made.statement.end_byte] if parent else []
    path = entry.cpp.source.path
    timers = [f.site for f in start.unit.facts if isinstance(f, TimerFact)]
    asked = [s.call.start_byte for s in timers if s.cpp.source.path == path]
    return [
        n
        for n in after
        if any(n.start_byte <= at < n.end_byte for at in asked)
        or (n.type.endswith("_statement") and _uses(n, made.variable))
    ]


def _uses(node: Node, variable: str) -> bool:
    """Whether a statement calls a method of an object, hands it on, or stores in it."""
    calls = list(calls_in(node))
    handed = [c for c in calls if not _is_client_library(c) and _names(c.arguments, variable)]
    if handed or any(c.on.removeprefix("this->") == variable for c in calls):
        return True
    stores = inside(node, "assignment_expression", "update_expression")
    return any(_names([n], variable) for n in stores)


def _is_client_library(call: CppCall) -> bool:
    """Whether a function makes an object serve messages, and does no more to it."""
    name = call.name.partition("<")[0].rpartition("::")[2]
    serving = libraries.waiting() | libraries.running_callbacks() | {"remove_node"}
    return call.name.startswith(libraries.scopes()) or name in serving


def _names(nodes: Iterable[Node], variable: str) -> bool:
    return any(text_of(n) == variable for each in nodes for n in identifiers_in(each))


def opening(unit: Unit, state: State, start: Start | None, together: Sequence[Start]) -> Opening:
    """What runs when a rebec of a unit starts, `together` with others in one program."""
    if unit.program is not None:
        main = unit.program.main
        return Opening(
            (StartStatements(main, _statements(main), _arguments(main)),), main, _objects(together)
        )
    steps: list[StartStatements | DefaultValues] = []
    defaults = ordered_defaults(state)
    given: dict[str, list[tuple[Cpp, Node]]] = {}
    for owner in unit.lineage:  # each says what its bases get, which are made before it
        made = start.made if start is not None and owner is unit.lineage[0] else None
        count = len(made.arguments) if made is not None else len(given.get(owner.name, ()))
        constructor = _constructor(unit, owner, count)
        if constructor is not None:
            passed = _passed(constructor, start if made is not None else None)
            values = zip(constructor.parameters, given.get(owner.name, ()), strict=False)
            passed |= {p.name: value for p, value in values}
            own = list(_constructed(owner, constructor, state, defaults, passed))
            found = [step for step in own if isinstance(step, StartStatements)]
            given |= {n: v for step in found for n, v in _to_bases(step)}
            steps = [*own, *steps]
        else:
            steps = [*all_of(owner, defaults), *steps]
    steps += [StartStatements(f, _statements(f)) for f in unit.functions if f.name == _ENTRY]
    if start is None or start.entry is None or start.made is None:
        return Opening(tuple(steps))
    steps += [StartStatements(start.entry, (statement,)) for statement in used_in_main(start)]
    objects = _objects(together)
    if start.made.variable:
        objects[start.made.variable] = Itself()
    return Opening(tuple(steps), start.entry, objects)


def _objects(starts: Sequence[Start]) -> dict[str, Member]:
    """The objects of a program, each of which is another rebec."""
    return {
        s.made.variable: Outside(reaches=True)
        for s in starts
        if s.made is not None and s.made.variable
    }


def _arguments(main: CppFunction) -> dict[int, tuple[m.Statement, ...]]:
    """Checks of the command line are nothing to the model: the node is started as it should be."""
    if not main.parameters:
        return {}
    count = main.parameters[0].name
    return {
        n.id: ()
        for n in _statements(main)
        if n.type == "if_statement"
        and (condition := n.child_by_field_name("condition")) is not None
        and any(text_of(i) == count for i in identifiers_in(condition))
    }


def _statements(function: CppFunction) -> tuple[Node, ...]:
    return tuple(function.body.named_children) if function.body is not None else ()


def _constructor(unit: Unit, owner: CppClass, count: int) -> CppFunction | None:
    """The constructor that makes the object: by the number of its arguments, if that tells."""
    found = unit.constructors(owner)
    if len(found) > 1:
        found = [f for f in found if len(f.parameters) == count] or found
    return found[0] if found else None


def _to_bases(step: StartStatements) -> Iterator[tuple[str, list[tuple[Cpp, Node]]]]:
    """What the initialisers of a constructor give to those of others, by their classes."""
    for entry in step.nodes:
        inner = named(entry)
        if entry.type == "field_initializer" and len(inner) > 1:
            cpp = step.function.cpp
            values = [step.arguments.get(text_of(v), (cpp, v)) for v in named(inner[-1])]
            yield base_of(entry), values


def _passed(function: CppFunction, start: Start | None) -> dict[str, tuple[Cpp, Node]]:
    """What the object's constructor gets, or what it takes without."""
    found = {}
    for parameter in function.parameters:
        default = default_of(parameter.node)
        if default is not None:
            found[parameter.name] = function.cpp, default
    made = start.made if start is not None else None
    entry = start.entry if start is not None else None
    if made is not None and entry is not None and made.owner == function.owner:
        pairs = zip(function.parameters, made.arguments, strict=False)
        found |= {p.name: (entry.cpp, node) for p, node in pairs}
    return found


def _constructed(
    owner: CppClass,
    function: CppFunction,
    state: State,
    defaults: Defaults,
    arguments: Mapping[str, tuple[Cpp, Node]],
) -> Iterator[StartStatements | DefaultValues]:
    """The initialisers of a constructor, then its body; first another that it hands on to."""
    entries = named(function.initialisers) if function.initialisers is not None else []
    own = next((e for e in entries if hands_on(owner, e)), None)
    if own is not None:
        yield from _handed_on(owner, function, own, state, defaults, arguments)
        entries = []
    nodes: list[Node] = []
    instead: dict[int, tuple[Stores, ...]] = {}
    for entry in entries if own is not None else in_order(owner, entries, defaults):
        if isinstance(entry, DefaultValues):
            yield StartStatements(function, tuple(nodes), instead, arguments)
            yield entry
            nodes, instead = [], {}
            continue
        values = _values_of(entry)
        meaning = state.members.get(member_of(entry))
        nodes.append(entry)
        stores = state.stored(meaning, values)
        instead[entry.id] = stores
        if not stores and not values:
            instead[entry.id] = state.zeros(meaning)
    yield StartStatements(function, tuple(nodes), instead, arguments)
    yield StartStatements(function, _statements(function), {}, arguments)


def _handed_on(
    owner: CppClass,
    function: CppFunction,
    entry: Node,
    state: State,
    defaults: Defaults,
    arguments: Mapping[str, tuple[Cpp, Node]],
) -> Iterator[StartStatements | DefaultValues]:
    """What another constructor does that this one hands on to; the node itself if it is not known.

    That other is the only one that takes as many arguments.
    """
    values = _values_of(entry)
    others = [f for f in state.unit.constructors(owner) if f.node.id != function.node.id]
    exact = [f for f in others if len(f.parameters) == len(values)]
    fitting = exact or [f for f in others if _takes(f, len(values))]
    if len(fitting) != 1:
        yield StartStatements(function, (entry,), {}, arguments)
        return
    (other,) = fitting
    pairs = zip(other.parameters, values, strict=False)
    given = {p.name: arguments.get(text_of(v), (function.cpp, v)) for p, v in pairs}
    yield from _constructed(owner, other, state, defaults, {**_passed(other, None), **given})


def _takes(function: CppFunction, count: int) -> bool:
    """Whether a call may leave out all parameters behind the first ones."""
    left = function.parameters[count:]
    return count < len(function.parameters) and all(default_of(p.node) is not None for p in left)


def _values_of(entry: Node) -> list[Node]:
    inner = named(entry)
    return named(inner[-1]) if len(inner) > 1 else []


# --- starting late ------------------------------------------------------------------------------


def started_late(
    body: m.Block, parameters: Sequence[m.Parameter], names: Names
) -> tuple[m.Block, list[m.MessageServer], dict[str, m.Type]]:
    """A constructor without what only a server can do: to send to others, to wait, to choose.

    From the first such statement on, the rest is a server of its own, which the constructor sends
    to first of all. What it needs of the constructor's parameters and locals becomes state.
    """
    at = next((n for n, s in enumerate(body.statements) if _is_late(s)), None)
    if at is None:
        return body, [], {}
    first, rest = body.statements[:at], body.statements[at:]
    needed = {n.name for s in rest for n in m.walk(s) if isinstance(n, m.Name)}
    variables: dict[str, m.Type] = {}
    kept: list[m.Statement] = []
    for parameter in parameters:
        if parameter.name in needed:
            variable = names.give(f"{parameter.name}_kept")
            variables[variable] = parameter.type
            kept.append(_stored(variable, m.Name(parameter.name)))
            rest = tuple(renamed(s, parameter.name, variable) for s in rest)
    done: list[m.Statement] = []
    for statement in first:
        if isinstance(statement, m.Local) and needed & _locals(statement):
            for declarator in statement.declaration.declarators:
                variables[declarator.name] = statement.declaration.type
                if declarator.initial is not None and not isinstance(
                    declarator.initial, m.ArrayInitializer
                ):
                    done.append(_stored(declarator.name, declarator.initial))
        else:
            done.append(statement)
    name = names.give("start")
    go = m.ExpressionStatement(m.Call(m.Self(), name))
    server = m.MessageServer(name, (), m.Block(rest))
    return m.Block((*kept, *done, go)), [server], variables


def _is_late(statement: m.Statement) -> bool:
    for node in m.walk(statement):
        match node:
            case m.Choice():
                return True
            case m.Call(target, name):
                if name == "delay" or (target is not None and not isinstance(target, m.Self)):
                    return True
    return False


def _locals(statement: m.Local) -> set[str]:
    return {d.name for d in statement.declaration.declarators}


def _stored(variable: str, value: m.Expression) -> m.Statement:
    return m.ExpressionStatement(m.Assign("=", m.Name(variable), value))
