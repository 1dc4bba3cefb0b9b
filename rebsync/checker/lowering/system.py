"""The whole model: instances, classes as they run, and the formulas of its properties."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from rebsync import properties as p
from rebsync.checker import formulas as f
from rebsync.checker.look import Look, unwatched
from rebsync.checker.lowering import waiting
from rebsync.checker.lowering.defines import Defines
from rebsync.checker.lowering.emitter import Declared, Emitter, World, kind_of, size_of
from rebsync.checker.lowering.predicates import Predicates
from rebsync.checker.lowering.statements import statements
from rebsync.checker.lowering.temporal import temporal
from rebsync.checker.program import (
    NULL,
    UNRANKED,
    Body,
    Cell,
    Program,
    RebecInfo,
    Server,
    Slot,
)
from rebsync.checker.values import stored
from rebsync.model import Annotation, Constructor, Method, Paren, ReactiveClass, Rebec
from rebsync.reserved import KEEP_LAST
from rebsync.source import Span
from rebsync.static import Analysis
from rebsync.static.symbols import ClassInfo, RebecSymbol, ServerSymbol
from rebsync.static.types import BOOLEAN, VOID

_NO_PROPERTIES = p.Properties()


def lower(
    analysis: Analysis,
    properties: p.Properties = _NO_PROPERTIES,
    look: Look = unwatched,
    moves: bool = False,
    measures: tuple[p.Measure, ...] = (),
    between: tuple[p.TimeBetween, ...] = (),
) -> tuple[Program, tuple[f.NamedFormula, ...]]:
    """The program of a model without errors, and the entries of its properties in file order.

    The predicates of the program are the largest parts of the formulas without temporal
    operators; an assertion is one predicate; the `measures` are bodies of their own; the two
    events of each in `between` are the last predicates. `look` is called now and then, and may
    raise. With `moves` the program also tells what `@Move` says, which only the interpreter runs:
    its steps are those of the program without.
    """
    main = analysis.model.main
    assert main is not None and not analysis.errors
    world = World(analysis, look, moves, waiting.is_asked(analysis))
    for rebec in main.rebecs:
        world.class_numbers.setdefault(rebec.type.name, len(world.class_numbers))
        world.rebec_numbers[rebec.name] = len(world.rebec_numbers)
    servers = list(_servers(world))
    drafts = [_rebec(rebec, world) for rebec in main.rebecs]
    while world.waiting:
        _body(*world.waiting.popleft(), world)
    numbers = {(s.class_name, id(symbol)): n for n, (s, symbol) in enumerate(servers)}
    rebecs = tuple(_dispatching(r, world, numbers) for r in drafts)
    formulas, predicates, measured = _properties(world, rebecs, properties, measures, between)
    ops = {i.op for i in world.code}
    program = Program(
        tuple(world.code),
        tuple(world.spans),
        tuple(b for b in world.bodies if b is not None),
        rebecs,
        tuple(s for s, _ in servers),
        predicates,
        tuple(world.texts),
        any(a.name == "globalPriority" for s, y in servers for a in y.declaration.annotations),
        "DELAY" in ops,
        not ops.isdisjoint(("NOW", "ARRIVAL", "DEADLINE")),
        sum(rebec.capacity for rebec in rebecs),
        measured,
    )
    return program, formulas


# --- classes -----------------------------------------------------------------------------------


def _slots(info: ClassInfo) -> dict[str, Slot]:
    """The state variables by `Class.name`, each with its cells."""
    slots: dict[str, Slot] = {}
    offset = 0
    for symbol in info.state:
        assert symbol.type is not None
        size = size_of(symbol.type)
        slot = Slot(symbol.name, symbol.type, kind_of(symbol.type), offset, size)
        slots[f"{symbol.owner}.{symbol.name}"] = slot
        offset += size
    return slots


def _known(info: ClassInfo) -> dict[str, int]:
    return {f"{k.owner}.{k.name}": i for i, k in enumerate(info.known)}


def _servers(world: World) -> Iterator[tuple[Server, ServerSymbol]]:
    for name in world.class_numbers:
        info = world.analysis.classes[name]
        for symbol in info.servers:
            declared = symbol.declaration
            body = world.body_of(info, declared)
            rank = _priority(declared.annotations, world.analysis)
            depth = _depth(declared.annotations, world.analysis)
            yield Server(symbol.name, name, body, rank, declared.name_span, depth), symbol


def _priority(annotations: tuple[Annotation, ...], analysis: Analysis) -> int:
    return _number(annotations, ("priority", "globalPriority"), analysis, UNRANKED)


def _depth(annotations: tuple[Annotation, ...], analysis: Analysis) -> int:
    return _number(annotations, (KEEP_LAST,), analysis, 0)


def _number(
    annotations: tuple[Annotation, ...], names: Collection[str], analysis: Analysis, default: int
) -> int:
    """The argument of the first annotation of some name."""
    for annotation in annotations:
        if annotation.name in names and annotation.arguments:
            value = analysis.value_of(annotation.arguments[0])
            if isinstance(value, int):
                return value
    return default


def _body(number: int, info: ClassInfo, declared: Declared, world: World) -> None:
    returns = VOID
    if isinstance(declared, Method) and declared.type.name != "void":
        returns = declared.type
    e = Emitter(world, info, returns, _slots(info), _known(info), span=declared.span)
    entry = e.here
    parameters = tuple(e.declare(q, q.name, q.type) for q in declared.parameters)
    parameters = waiting.begin(declared, parameters, e)
    if declared.body is not None:
        statements(declared.body.statements, e)
    e.span = Span(declared.span.end, declared.span.end)
    for _ in range(size_of(returns)):
        e.emit("CONST", NULL if kind_of(returns) == "rebec" else 0)
    e.emit("RET", size_of(returns))
    name = f"{info.name}.{declared.name}"
    world.bodies[number] = Body(name, entry, e.here, parameters, e.frame)


# --- instances ---------------------------------------------------------------------------------


def _rebec(rebec: Rebec, world: World) -> RebecInfo:
    analysis, info = world.analysis, world.analysis.classes[rebec.type.name]
    declaration = info.declaration
    assert isinstance(declaration, ReactiveClass)
    constructor = analysis.constructor_of(rebec)
    slots = _slots(info)
    return RebecInfo(
        rebec.name,
        info.name,
        world.class_numbers[info.name],
        declaration.queue_length,
        _priority(rebec.annotations, analysis),
        tuple(_bound(b, world) for b in rebec.bindings),
        tuple(slots.values()),
        sum(s.size for s in slots.values()),
        world.body_of(info, constructor) if constructor is not None else -1,
        tuple(_arguments(rebec, constructor, world)),
        (),
        rebec.span,
    )


def _bound(binding: object, world: World) -> int:
    while isinstance(binding, Paren):
        binding = binding.inner
    symbol = world.analysis.symbol_of(binding)
    return world.rebec_numbers[symbol.name] if isinstance(symbol, RebecSymbol) else NULL


def _arguments(rebec: Rebec, constructor: Constructor | None, world: World) -> Iterator[Cell]:
    if constructor is None:
        return
    for argument, parameter in zip(rebec.arguments, constructor.parameters, strict=True):
        inner = argument
        while isinstance(inner, Paren):
            inner = inner.inner
        kind = kind_of(parameter.type)
        if kind == "rebec":
            yield _bound(inner, world)
            continue
        value = world.analysis.value_of(inner)
        assert value is not None, f"{rebec.name}: {argument}"
        yield stored(value, kind)


def _dispatching(rebec: RebecInfo, world: World, numbers: dict[tuple[str, int], int]) -> RebecInfo:
    """The rebec with the server that it runs for each selector."""
    info = world.analysis.classes[rebec.class_name]
    answers = {(s.name, s.signature): numbers[info.name, id(s)] for s in info.servers}
    return replace(rebec, dispatch=tuple(answers.get(s, -1) for s in world.selectors))


# --- properties --------------------------------------------------------------------------------


def _properties(
    world: World,
    rebecs: tuple[RebecInfo, ...],
    properties: p.Properties,
    measures: tuple[p.Measure, ...],
    between: tuple[p.TimeBetween, ...],
) -> tuple[tuple[f.NamedFormula, ...], tuple[int, ...], tuple[int, ...]]:
    """The formulas, and the bodies of their predicates and of the measures."""
    numbers: list[int] = []
    by_name = {r.name: (i, r) for i, r in enumerate(rebecs)}
    known = Defines({d.name: d.value for d in properties.defines})

    def observer(formula: p.Formula, name: str) -> int:
        e = Emitter(world, None, BOOLEAN, {}, {}, span=formula.span)
        entry = e.here
        Predicates(e, by_name, known).whole(formula)
        e.emit("RET", 1)
        world.bodies.append(Body(name, entry, e.here, (), e.frame))
        return len(world.bodies) - 1

    def predicate(formula: p.Formula) -> int:
        numbers.append(observer(formula, f"predicate {len(numbers) + 1}"))
        return len(numbers) - 1

    formulas = tuple(
        f.NamedFormula(each.name, temporal(each.formula, predicate, world.analysis))
        for each in properties.all
    )
    for each in between:
        predicate(each.start)
        predicate(each.end)
    return formulas, tuple(numbers), tuple(observer(m.value, m.text) for m in measures)
