"""Draws whole models that are well typed, small, and use all of the language."""

from __future__ import annotations

from dataclasses import dataclass, field

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy

from rebsync import model as m
from tests.drawing import (
    PRIMITIVES,
    Scope,
    Signature,
    Variable,
    draw_expression,
    literal,
    type_of,
)
from tests.drawing_bodies import draw_block, draw_body

_WORDS = (
    *("pos", "speed", "maxSpeed", "max_speed", "obstacleDetected", "id", "x1", "_hidden"),
    *("moving", "fuelLevel", "X2", "data_", "class_id", "HTTPCode", "count", "goal"),
)
# Fine in Rebeca, taken in C++, Python or message definitions, or by locals that hold operands.
_AWKWARD = (
    *("template", "namespace", "lambda", "delete", "def", "signed", "None", "header", "pass"),
    *("left", "right", "place", "value", "first", "values", "index", "again", "case2"),
)


@dataclass
class _Class:
    """A class in the making: first its signatures, then its bodies."""

    name: str
    base: _Class | None = None
    abstract: bool = False
    robot: bool = False
    controller: bool = False
    known: list[tuple[str, str]] = field(default_factory=list)
    state: list[tuple[m.Type, str]] = field(default_factory=list)
    parameters: list[tuple[m.Type, str]] = field(default_factory=list)
    servers: list[tuple[Signature, tuple[m.Annotation, ...]]] = field(default_factory=list)
    methods: list[Signature] = field(default_factory=list)
    interface: str | None = None

    def line(self) -> list[_Class]:
        """The class and its ancestors, the oldest first."""
        return [*(self.base.line() if self.base else ()), self]


@dataclass
class _Drawing:
    """One model in the making."""

    draw: DrawFn
    names: list[str]
    interfaces: dict[str, list[Signature]] = field(default_factory=dict)
    classes: list[_Class] = field(default_factory=list)
    envs: list[Variable] = field(default_factory=list)
    overloads: int = 5

    def name(self) -> str:
        return self.names.pop(0)

    def flag(self, out_of: int = 2) -> bool:
        return self.draw(st.integers(0, out_of - 1)) == out_of - 1

    def up_to(self, most: int, least: int = 0) -> int:
        return self.draw(st.integers(least, most))

    def primitive(self) -> str:
        return self.draw(st.sampled_from(PRIMITIVES))

    def ancestors(self) -> dict[str, tuple[str, ...]]:
        found = {}
        for each in self.classes:
            line = each.line()
            interfaces = [c.interface for c in line if c.interface]
            found[each.name] = (*(c.name for c in line[:-1]), *interfaces)
        return found

    def receivers(self) -> dict[str, list[Signature]]:
        found = {name: list(servers) for name, servers in self.interfaces.items()}
        for each in self.classes:
            found[each.name] = [s for c in each.line() for s, _ in c.servers]
        return found


@st.composite
def models(draw: DrawFn, awkward_names: bool = True, least: int = 1, overloads: int = 5) -> m.Model:
    """A model that the static rules accept; warnings about it are possible.

    It has at least so many classes; one in `overloads` servers is overloaded.
    """
    words = [*_WORDS, *_AWKWARD] if awkward_names else list(_WORDS)
    shuffled = draw(st.permutations(words))
    numbered = [f"{word}{number}" for number in range(3, 9) for word in words]
    drawing = _Drawing(draw, [*shuffled, *numbered], overloads=overloads)
    heads = tuple(_env(drawing) for _ in range(drawing.up_to(2)))
    if drawing.flag(3):
        _outline_interface(drawing)
    for number in range(drawing.up_to(3, least=least)):
        _outline_class(drawing, number)
    for each in drawing.classes:
        _outline_known(drawing, each)
    interfaces = tuple(_interface(n, s) for n, s in drawing.interfaces.items())
    classes = tuple(_class(drawing, each) for each in drawing.classes)
    return m.Model(heads, (*interfaces, *classes), _main(drawing))


def expressions() -> SearchStrategy[m.Expression]:
    """An expression over a few free names; for syntax, not for types."""
    return _expressions()


def blocks() -> SearchStrategy[m.Block]:
    """A block over a few free names; for syntax, not for types."""
    return _blocks()


@st.composite
def _expressions(draw: DrawFn) -> m.Expression:
    return draw_expression(draw, _free_scope(), draw(st.sampled_from(PRIMITIVES)), 3)


@st.composite
def _blocks(draw: DrawFn) -> m.Block:
    return draw_block(draw, _free_scope(), 3)


def _free_scope() -> Scope:
    variables = [Variable(m.Name(f"{kind}_"), type_of(kind)) for kind in PRIMITIVES]
    variables.append(Variable(m.Name("grid"), type_of("int", 2, 3)))
    servers = {"C": [Signature("serve", (type_of("int"),)), Signature("rest", ())]}
    return Scope("C", "server", variables, servers, [], {}, robot=True, sender=True)


# --- outlines: all signatures before any body --------------------------------------------------


def _env(drawing: _Drawing) -> m.Env:
    kind, name = drawing.primitive(), drawing.name()
    drawing.envs.append(Variable(m.Name(name), type_of(kind), assignable=False))
    declarator = m.Declarator(name, literal(drawing.draw, kind))
    return m.Env(m.Declaration(type_of(kind), (declarator,)))


def _outline_interface(drawing: _Drawing) -> None:
    servers = [_signature(drawing) for _ in range(drawing.up_to(2, least=1))]
    drawing.interfaces["Movable"] = servers


def _outline_class(drawing: _Drawing, number: int) -> None:
    each = _Class(("Robot", "ControlNode", "Base_3")[number])
    bases = [c for c in drawing.classes if not c.controller]
    if bases and drawing.flag(3):
        each.base = drawing.draw(st.sampled_from(bases))
        each.robot = each.base.robot
    elif number == 0:
        each.robot = drawing.flag()
        each.abstract = drawing.flag(6)
    else:
        each.controller = drawing.flag(3)
    inherits = each.base and any(c.interface for c in each.base.line())
    if drawing.interfaces and not inherits and drawing.flag():
        each.interface = "Movable"
        each.servers += [(s, ()) for s in drawing.interfaces["Movable"]]
    each.state = [(_type(drawing, 4), drawing.name()) for _ in range(drawing.up_to(3))]
    each.parameters = [
        (type_of(drawing.primitive()), drawing.name()) for _ in range(drawing.up_to(2))
    ]
    for _ in range(drawing.up_to(2, least=1)):
        each.servers += _outline_server(drawing, each)
    each.methods = [_method(drawing) for _ in range(drawing.up_to(1))]
    drawing.classes.append(each)


def _outline_server(
    drawing: _Drawing, each: _Class
) -> list[tuple[Signature, tuple[m.Annotation, ...]]]:
    server = _signature(drawing)
    notes: tuple[m.Annotation, ...] = ()
    if each.robot and drawing.flag(3):
        if drawing.flag():
            return [(Signature(server.name, ()), (m.Annotation("Sensor"),))]
        notes = (m.Annotation("Port"),)
    elif drawing.flag(4):
        notes = (m.Annotation("priority", (m.IntLiteral(drawing.up_to(3)),)),)
    if not drawing.flag(drawing.overloads):
        return [(server, notes)]
    return [(server, notes), (Signature(server.name, _other_types(drawing, server)), ())]


def _other_types(drawing: _Drawing, server: Signature) -> tuple[m.Type, ...]:
    """The types of an overload: one more, or another one.

    Rebecs stand for those of classes above them too: then only truth values are told from numbers.
    """
    if not server.types or drawing.flag():
        return (*server.types, type_of("boolean"))
    *same, last = server.types
    is_exact = all(t.name in PRIMITIVES for t in same)
    others = PRIMITIVES if is_exact or last.name == "boolean" else ("boolean",)
    kinds = [type_of(k) for k in others if k != last.name or last.dimensions]
    return (*same, drawing.draw(st.sampled_from(kinds)))


def _outline_known(drawing: _Drawing, each: _Class) -> None:
    """Known rebecs have types of which `main` has an instance."""
    concrete = [c for c in drawing.classes if not c.abstract]
    if not concrete:
        return
    types = {name for c in concrete for name in (c.name, *drawing.ancestors()[c.name])}
    for _ in range(drawing.up_to(2)):
        each.known.append((drawing.draw(st.sampled_from(sorted(types))), drawing.name()))


def _type(drawing: _Drawing, arrays: int) -> m.Type:
    names = [*PRIMITIVES, *PRIMITIVES, *(c.name for c in drawing.classes)]
    name = drawing.draw(st.sampled_from(names))
    if name in PRIMITIVES and drawing.flag(arrays):
        return m.Type(name, tuple(drawing.up_to(3, least=1) for _ in range(drawing.up_to(2, 1))))
    return type_of(name)


def _signature(drawing: _Drawing) -> Signature:
    types = tuple(_type(drawing, 8) for _ in range(drawing.up_to(3)))
    return Signature(drawing.name(), types)


def _method(drawing: _Drawing) -> Signature:
    types = tuple(type_of(drawing.primitive()) for _ in range(drawing.up_to(2)))
    result = drawing.draw(st.sampled_from(("void", *PRIMITIVES)))
    return Signature(drawing.name(), types, result)


# --- classes and main --------------------------------------------------------------------------


def _scope(drawing: _Drawing, each: _Class, kind: str) -> Scope:
    line = each.line()
    variables = list(drawing.envs)
    for ancestor in line:
        for type_, name in ancestor.state:
            read = m.Member(m.Self(), name) if drawing.flag(3) else m.Name(name)
            variables.append(Variable(read, type_))
        if kind != "constructor":
            known = ((m.Name(name), type_of(of)) for of, name in ancestor.known)
            variables += [Variable(read, type_, assignable=False) for read, type_ in known]
    if kind == "server":
        variables.append(Variable(m.Name("now"), type_of("int"), assignable=False))
    servers = drawing.receivers()
    methods = list(each.methods)
    sender = kind == "server"
    scope = Scope(each.name, kind, variables, servers, methods, drawing.ancestors())
    scope.robot, scope.sender = each.robot, sender
    return scope


def _body(
    drawing: _Drawing, scope: Scope, types: tuple[m.Type, ...]
) -> tuple[tuple[m.Parameter, ...], m.Block]:
    parameters = tuple(m.Parameter(t, drawing.name()) for t in types)
    scope.variables += [Variable(m.Name(p.name), p.type) for p in parameters]
    return parameters, draw_body(drawing.draw, scope)


def _class(drawing: _Drawing, each: _Class) -> m.ReactiveClass:
    members: list[m.ClassMember] = []
    if each.known or drawing.flag(3):
        members.append(m.KnownRebecs(tuple(_declared(type_of(t), n) for t, n in each.known)))
    if each.state or drawing.flag(3):
        members.append(m.StateVars(tuple(_declared(t, n) for t, n in each.state)))
    members.append(_constructor(drawing, each))
    members += [_server(drawing, each, server, notes) for server, notes in each.servers]
    members += [_local_method(drawing, each, method) for method in each.methods]
    notes = ("Robot",) if each.robot else ("Controller",) if each.controller else ()
    return m.ReactiveClass(
        each.name,
        drawing.up_to(9, least=3),
        tuple(members),
        abstract=each.abstract,
        extends=each.base.name if each.base else None,
        implements=(each.interface,) if each.interface else (),
        annotations=tuple(m.Annotation(note) for note in notes),
    )


def _declared(type_: m.Type, name: str) -> m.Declaration:
    return m.Declaration(type_, (m.Declarator(name),))


def _constructor(drawing: _Drawing, each: _Class) -> m.Constructor:
    scope = _scope(drawing, each, "constructor")
    parameters = tuple(m.Parameter(t, n) for t, n in each.parameters)
    scope.variables += [Variable(m.Name(p.name), p.type) for p in parameters]
    return m.Constructor(each.name, parameters, draw_body(drawing.draw, scope))


def _server(
    drawing: _Drawing, each: _Class, server: Signature, notes: tuple[m.Annotation, ...]
) -> m.MessageServer:
    parameters, body = _body(drawing, _scope(drawing, each, "server"), server.types)
    if any(note.name == "Sensor" for note in notes):
        again = m.Call(m.Self(), server.name, (), m.IntLiteral(drawing.up_to(9, least=1)))
        body = m.Block((*body.statements, m.ExpressionStatement(again)))
    return m.MessageServer(server.name, parameters, body, annotations=notes)


def _local_method(drawing: _Drawing, each: _Class, method: Signature) -> m.Method:
    scope = _scope(drawing, each, "method")
    scope.result = method.result
    parameters, body = _body(drawing, scope, method.types)
    return m.Method(type_of(method.result), method.name, parameters, body)


def _interface(name: str, servers: list[Signature]) -> m.Interface:
    return m.Interface(
        name,
        tuple(
            m.MessageServer(
                s.name, tuple(m.Parameter(t, f"p{i}") for i, t in enumerate(s.types)), None
            )
            for s in servers
        ),
    )


def _main(drawing: _Drawing) -> m.Main:
    concrete = [c for c in drawing.classes if not c.abstract]
    chosen = [*concrete, *(c for c in concrete if drawing.flag(3))]
    instances = [(each, f"{each.name.lower()}{i}") for i, each in enumerate(chosen)]
    return m.Main(tuple(_rebec(drawing, each, name, instances) for each, name in instances))


def _rebec(
    drawing: _Drawing, each: _Class, name: str, instances: list[tuple[_Class, str]]
) -> m.Rebec:
    ancestors = drawing.ancestors()
    bindings = []
    for wanted in (of for ancestor in each.line() for of, _ in ancestor.known):
        fitting = [n for c, n in instances if wanted in (c.name, *ancestors[c.name])]
        bindings.append(m.Name(drawing.draw(st.sampled_from(fitting))))
    arguments = tuple(literal(drawing.draw, t.name) for t, _ in each.parameters)
    notes = (m.Annotation("priority", (m.IntLiteral(1),)),) if drawing.flag(6) else ()
    return m.Rebec(type_of(each.name), name, tuple(bindings), arguments, notes)
