"""What the reference makes of env and `main`: constants and instances."""

from __future__ import annotations

from dataclasses import dataclass

from rebsync import model as m
from rebsync.static import Analysis, ClassInfo
from tests.checker.reference_frames import Variables
from tests.checker.reference_values import Value, convert, tag

UNRANKED = 2**31 - 1


@dataclass(frozen=True)
class Instance:
    """What `main` says of an instance."""

    name: str
    info: ClassInfo
    capacity: int
    rank: int
    known: Variables
    arguments: tuple[Value, ...]
    constructor: m.Constructor | None


def priority(annotations: tuple[m.Annotation, ...]) -> int:
    for note in annotations:
        if note.name in ("priority", "globalPriority") and note.arguments:
            value = note.arguments[0]
            sign = -1 if isinstance(value, m.Unary) else 1
            value = value.operand if isinstance(value, m.Unary) else value
            assert isinstance(value, m.IntLiteral)
            return sign * value.value
    return UNRANKED


def _constant(
    analysis: Analysis, initial: m.Initializer, type_: m.Type, rebecs: Variables
) -> Value:
    """A constant as written: floating ones are computed in double."""
    if isinstance(initial, m.ArrayInitializer):
        return tuple(_constant(analysis, v, type_, rebecs) for v in initial.values)
    value = analysis.value_of(initial)
    if value is not None:
        return convert(value, tag(type_))
    while isinstance(initial, m.Paren):
        initial = initial.inner
    symbol = analysis.symbol_of(initial)
    return rebecs[symbol] if symbol is not None else None


def environment(analysis: Analysis) -> Variables:
    """The constants of the model, rebecs by their place in `main` among them."""
    env: Variables = {}
    for head in analysis.model.heads:
        if isinstance(head, m.Env):
            for declarator in head.declaration.declarators:
                symbol = analysis.env[declarator.name]
                assert declarator.initial is not None
                env[symbol] = _constant(analysis, declarator.initial, head.declaration.type, {})
    main = analysis.model.main
    assert main is not None
    for index, rebec in enumerate(main.rebecs):
        named = analysis.symbol_of(rebec)
        assert named is not None
        env[named] = index
    return env


def instances(analysis: Analysis, env: Variables) -> tuple[Instance, ...]:
    main = analysis.model.main
    assert main is not None
    return tuple(_instance(analysis, env, rebec) for rebec in main.rebecs)


def _instance(analysis: Analysis, env: Variables, rebec: m.Rebec) -> Instance:
    info = analysis.classes[rebec.type.name]
    assert isinstance(info.declaration, m.ReactiveClass)
    bound = [_constant(analysis, binding, rebec.type, env) for binding in rebec.bindings]
    constructor = analysis.constructor_of(rebec)
    types = [p.type for p in constructor.parameters] if constructor else []
    arguments = [
        _constant(analysis, argument, type_, env)
        for argument, type_ in zip(rebec.arguments, types, strict=True)
    ]
    return Instance(
        rebec.name,
        info,
        info.declaration.queue_length,
        priority(rebec.annotations),
        dict(zip(info.known, bound, strict=True)),
        tuple(arguments),
        constructor,
    )
