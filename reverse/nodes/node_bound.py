"""Members that refer to what the model has: what is done through them is done to the model."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import field, replace
from itertools import count
from operator import itemgetter
from typing import TypeAlias

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.analysis.outcomes.outcomes import RECURSES
from rebsync.reverse.bodies.effects.calm import Calm
from rebsync.reverse.bodies.effects.cpp_call_effects import check_read
from rebsync.reverse.bodies.effects.cpp_effects import Effects
from rebsync.reverse.bodies.effects.cpp_roots import is_modelled, root
from rebsync.reverse.bodies.effects.known_functions import may_change
from rebsync.reverse.bodies.effects.touches import Touches
from rebsync.reverse.bodies.scope import (
    Called,
    Function,
    Inline,
    Itself,
    Outside,
    Publishes,
    Scope,
    Variable,
)
from rebsync.reverse.calls.beside import used_names
from rebsync.reverse.findings import Unread
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.nodes.node_bodies import Bodies
from rebsync.reverse.nodes.node_reach import called_by
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of
from rebsync.reverse.syntax.cpp_declarations import CppField
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, text_of

_PLACES = frozenset(
    {"identifier", "this", "pointer_expression", "field_expression", "subscript_expression"}
)
_TIMES = frozenset({"Time", "Duration", "WallTime", "WallDuration", "Rate", "WallRate"})
_MAKING = ("call_expression", "new_expression")
_REFERS = ("reference_declarator", "pointer_declarator")
# A function of a class, with its number in the order of all.
Helper: TypeAlias = "tuple[int, CppClass, CppFunction]"


def note_bound(bodies: Bodies) -> None:
    """Lists what gives members of a unit other names for what the model has, from the start."""
    for owner in bodies.unit.lineage:
        members = {f.name: f for f in (*owner.fields, *owner.others)}
        for member, cpp, function, value in _values(bodies.unit, owner, members):
            scope = bodies.scope(cpp, function)
            for place in _given(bodies.code, member, scope, value):
                why = f'"{member.name}" may use or change "{text_of(place)}" where it is not seen'
                bodies.unread(cpp, place, why)
            if isinstance(scope.members.get(member.name), Outside):
                for touches in _made_by(bodies.code, Effects(cpp, scope), value):
                    bodies.findings.unreadable(cpp.source, touches, bodies.unit.name)
        for member in members.values():
            scope = bodies.scope(member.cpp, None)
            if isinstance(scope.members.get(member.name), Outside) and not _refers(member):
                try:
                    check_read(Effects(member.cpp, scope), member.node)
                except Touches as touches:
                    bodies.findings.unreadable(member.cpp.source, touches, bodies.unit.name)
            _note_making(bodies, owner, member, scope)


def _note_making(bodies: Bodies, owner: CppClass, member: CppField, scope: Scope) -> None:
    """Lists a member that may throw where it is made, before the node serves anything."""
    if scope.form is None or not scope.open or not _is_made(bodies.code, member):
        return
    if (why := scope.form.raised_at_start(owner, member.name)) is not None:
        bodies.unread(member.cpp, member.node, why)


def _made_before(code: Code) -> Iterator[CppField]:
    """The variables outside of objects: of files, and of classes."""
    for each in code.variables.values():
        yield from each
    for owner in code.classes.values():
        fields = (*owner.fields, *owner.others)
        yield from (f for f in fields if "static" in map(text_of, f.node.named_children))


def _is_made(code: Code, member: CppField) -> bool:
    """Whether a variable is made by a call, or is an object of a class of the files."""
    if member.value is not None and any(True for _ in inside(member.value, *_MAKING)):
        return True
    words = {text_of(n) for n in inside(member.type, "type_identifier")}
    is_own = words & code.classes.keys() or words & code.aliases.keys()
    is_of_time = words & _TIMES and member.value is not None
    return bool(is_own or is_of_time) and not _refers(member)


def note_statics(bodies: Bodies) -> None:
    """Lists objects outside of classes that are made, before `main` runs, by what was not read."""
    for variable in _made_before(bodies.code):
        is_near = variable.cpp.source.path in bodies.unit.files
        is_made = not any(text_of(c) == "extern" for c in variable.node.named_children)
        if is_near and is_made and not _refers(variable):
            try:
                effects = Effects(variable.cpp, bodies.scope(variable.cpp, None))
                check_read(effects, variable.node)
            except Touches as touches:
                bodies.findings.unreadable(variable.cpp.source, touches, bodies.unit.name)
            form = effects.scope.form if _is_made(bodies.code, variable) else None
            why = form.raised_before(variable.cpp, variable.name) if form is not None else None
            if why is not None:
                bodies.unread(variable.cpp, variable.node, why)


@dataclass(slots=True)
class Helpers:
    """The functions of classes that are none of the `units`, which are the same for all of these.

    By the ids of codes, and the paths of files there: the classes in their order, with functions.
    """

    units: Collection[str]
    _known: dict[int, tuple[Code, dict[str, list[Helper]]]] = field(default_factory=dict)

    def near(self, unit: Unit) -> list[Helper]:
        """Those in the files of a unit, without those that it inherits."""
        if id(unit.code) not in self._known:
            by_path: dict[str, list[Helper]] = {}
            for helper in self._all(unit.code):
                by_path.setdefault(helper[2].cpp.source.path, []).append(helper)
            self._known[id(unit.code)] = unit.code, by_path
        by_path = self._known[id(unit.code)][1]
        found = (h for path in unit.files for h in by_path.get(path, ()))
        return sorted((h for h in found if h[1].name not in unit.names), key=itemgetter(0))

    def _all(self, code: Code) -> Iterator[Helper]:
        number = count()
        used = used_names(code.files)
        for owner in code.classes.values():
            if owner.cpp.is_beside and owner.name.encode() not in used:
                continue
            for function in code.functions_of(owner) if owner.name not in self.units else ():
                if function.body is not None:
                    yield next(number), owner, function


def note_helpers(bodies: Bodies, helpers: Helpers) -> None:
    """Lists functions of other classes that act on what the model has outside of classes."""
    unit, code = bodies.unit, bodies.code
    near = [(owner, function) for _, owner, function in helpers.near(unit)]
    callers = (*unit.functions, *(f for _, f in near)) if near else ()
    names = {function.name for _, function in near}
    called = frozenset[str]().union(*(called_by(code, caller, names) for caller in callers))
    for owner, function in near:
        # Objects are made and destroyed, and operators run, without a call of that name.
        is_implicit = function.name.lstrip("~") == owner.name
        is_implicit = is_implicit or function.name.startswith("operator")
        runs = function.name in called or is_implicit
        touched = _touched(bodies, owner, function) if runs else None
        if touched is not None:
            why = f'what "{owner.name}::{function.name}" does where it is called is not read'
            unread = Unread(touched.span, f"{why}: {touched.why}")
            bodies.findings.unreadable(function.cpp.source, unread, unit.name)


def _touched(bodies: Bodies, owner: CppClass, function: CppFunction) -> Touches | None:
    """What a function of another class does to the model, if it does anything."""
    whole = bodies.scope(function.cpp, None)
    own = {f.name for f in (*owner.fields, *owner.others)} | {p.name for p in function.parameters}
    shared = whole.members.keys() & bodies.code.variables.keys() - own
    members = {n: whole.members[n] for n in shared}
    free = {n: f for n, f in whole.functions.items() if _is_free(f)}
    scope = replace(whole, members=members, functions=free, calm=Calm())
    effects = Effects(function.cpp, scope, returning=True)
    if scope.form is not None and scope.form.recurses(function):
        return effects.touches(function.node, RECURSES)
    try:
        if function.initialisers is not None:
            effects.check(function.initialisers)
        effects.check(function.body or function.node)
    except Touches as touches:
        return touches.with_traceback(None)
    return None


def _is_free(function: Function) -> bool:
    known = function.function if isinstance(function, Called | Inline) else None
    return known is not None and not known.owner


def _values(
    unit: Unit, owner: CppClass, members: Mapping[str, CppField]
) -> Iterator[tuple[CppField, Cpp, CppFunction | None, Node]]:
    """What members are made with."""
    for member in members.values():
        if member.value is not None:
            yield member, member.cpp, None, member.value
    for constructor in unit.constructors(owner):
        entries = constructor.initialisers
        for entry in named(entries) if entries is not None else ():
            inner = named(entry)
            if len(inner) > 1 and text_of(inner[0]) in members:
                yield members[text_of(inner[0])], constructor.cpp, constructor, inner[-1]


def _given(code: Code, member: CppField, scope: Scope, value: Node) -> Iterator[Node]:
    """The places of the model that an object outside of it can reach from then on."""
    if not isinstance(scope.members.get(member.name), Outside) or _is_constant(member):
        return
    refers = _refers(member) or _may_refer(code, member)
    for argument in _arguments(value):
        place = _place(argument)
        meaning = root(scope, (), place)[1]
        match meaning:
            case Itself():
                reached = place.type == "this"
            case Publishes(targets):
                reached = bool(targets)
            case Variable():
                reached = refers or place is not argument
            case _:
                reached = False
        if reached or (refers and is_modelled(place, meaning)):
            yield place


def _made_by(code: Code, effects: Effects, value: Node) -> Iterator[Touches]:
    """What the calls do that make a member, and the functions that these get."""
    if value.type in ("argument_list", "initializer_list"):
        for each in named(value):
            yield from _made_by(code, effects, each)
    elif value.type in ("call_expression", "new_expression", "lambda_expression"):
        call = call_of(value)
        given = [value]
        if call is not None and _is_made_with_node(code, call):
            given = [each for each in call.arguments if each.type != "this"]
        try:
            effects.arguments(given)
        except Touches as touches:
            yield touches.with_traceback(None)


def _is_made_with_node(code: Code, call: CppCall) -> bool:
    """Whether a call makes an object of a class of the files that takes any node of the library.

    Such an object knows nothing of the variables of the node that it gets.
    """
    name = call.name.partition("<")[2].removesuffix(">") or call.name
    made = code.classes.get(name.rpartition("::")[2])
    constructors = [f for f in code.functions_of(made) if f.name == made.name] if made else []
    places = [n for n, each in enumerate(call.arguments) if each.type == "this"]
    given = [f.parameters[n].type for f in constructors for n in places if n < len(f.parameters)]
    return bool(given) and all(text_of(type_) in libraries.roots() for type_ in given)


def _is_constant(member: CppField) -> bool:
    return any(text_of(c) == "const" for c in member.node.named_children)


def _refers(member: CppField) -> bool:
    return any(True for _ in inside(member.node, *_REFERS))


def _may_refer(code: Code, member: CppField) -> bool:
    """Whether an object may keep references to what its constructor gets."""
    type_ = text_of(member.type)
    made = code.classes.get(type_.rpartition("::")[2])
    if made is None:
        return False
    constructors = (f for f in code.functions_of(made) if f.name == made.name)
    return any(may_change(p) for f in constructors for p in f.parameters)


def _arguments(value: Node) -> list[Node]:
    """`x` of `(x)`, `{x}` and `new C(x)`, where it is a place."""
    if value.type == "new_expression":
        arguments = value.child_by_field_name("arguments")
        return _arguments(arguments) if arguments is not None else []
    if value.type in ("argument_list", "initializer_list"):
        return [a for v in named(value) for a in _arguments(v)]
    return [value] if value.type in _PLACES else []


def _place(value: Node) -> Node:
    """`x` of `&x`."""
    if value.type == "pointer_expression" and text_of(value).startswith("&"):
        return value.children_by_field_name("argument")[0]
    return value
