"""The program that files of Python are: functions and classes by name, lowered when asked for."""

from __future__ import annotations

from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import (
    Class,
    Function,
    FunctionKind,
    Parameter,
    Program,
)
from rebsync.reverse.ir.python.classes import class_of
from rebsync.reverse.ir.python.comprehensions import FIRST, generator_body
from rebsync.reverse.ir.python.context import Lowering, NoLowering, Rules
from rebsync.reverse.ir.python.expressions import lower_value
from rebsync.reverse.ir.python.functions import parameters_of
from rebsync.reverse.ir.python.names import NameLookup, captured_locals
from rebsync.reverse.ir.python.references import unsupported
from rebsync.reverse.ir.python.statements import lower_statement
from rebsync.reverse.ir.python.symbols import Binder, ScopeKind, Symbols
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import decorators_of, field, named


def python_program(code: PyCode) -> Program:
    """The program of some files; a module's name is its path, and it has a body like a function."""
    names = NameLookup(code)
    scopes: dict[str, tuple[Binder, Symbols]] = {}
    classes: list[Class] = []
    for path in code.modules:
        binder = names.binder(path)
        for scope in binder.scopes.values():
            if scope.kind is not ScopeKind.COMPREHENSION:
                scopes[scope.name] = binder, scope
    for binder, scope in scopes.values():
        if scope.kind is ScopeKind.CLASS:
            classes.append(class_of(names, binder, scope))
    modules = [(path, path) for path in code.modules]
    return Program(scopes, classes, lambda name: lower(names, *scopes[name]), modules)


def lower(names: NameLookup, binder: Binder, scope: Symbols) -> Function:
    """One function, module body or class body."""
    ctx = Lowering(names, binder, scope, Rules(lower_value, lower_statement))
    ctx.captured = captured_locals(scope)
    parameters: tuple[Parameter, ...] = ()
    try:
        parameters = _parameters(ctx, scope)
        _fill(ctx, scope)
    except NoLowering as failure:
        ctx.out = []
        unsupported(ctx, scope.node, failure.reason)
    owner = _owner(scope)
    receiver = parameters[0].name if owner and parameters and _is_bound(scope) else None
    return Function(
        scope.name,
        parameters,
        tuple(ctx.out),
        kind=_kind(scope),
        receiver=receiver,
        owner=owner,
        captured=ctx.captured,
        place=ctx.place(scope.node),
    )


def _parameters(ctx: Lowering, scope: Symbols) -> tuple[Parameter, ...]:
    match scope.kind:
        case ScopeKind.FUNCTION | ScopeKind.LAMBDA:
            return tuple(p for p, _ in parameters_of(ctx, scope.node))
        case ScopeKind.GENERATOR:
            return (Parameter(FIRST),)
        case _:
            return ()


def _fill(ctx: Lowering, scope: Symbols) -> None:
    match scope.kind:
        case ScopeKind.GENERATOR:
            generator_body(ctx, scope.node)
        case ScopeKind.LAMBDA:
            value = ctx.value(field(scope.node, "body"))
            ctx.emit(s.Return(value, ctx.place(scope.node)))
        case ScopeKind.MODULE:
            ctx.lower_all(named(scope.node))
        case _:
            ctx.lower_all(named(field(scope.node, "body")))


def _kind(scope: Symbols) -> FunctionKind:
    if scope.kind is ScopeKind.MODULE:
        return FunctionKind.MODULE
    if scope.kind is ScopeKind.CLASS:
        return FunctionKind.CLASS
    if scope.kind is ScopeKind.GENERATOR or scope.has_yield:
        return FunctionKind.GENERATOR
    if any(c.type == "async" for c in scope.node.children):
        return FunctionKind.COROUTINE
    is_constructor = scope.parent is not None and scope.parent.kind is ScopeKind.CLASS
    if is_constructor and scope.name.rpartition(".")[2] == "__init__":
        return FunctionKind.CONSTRUCTOR
    return FunctionKind.FUNCTION


def _owner(scope: Symbols) -> str | None:
    """The class whose method a function is."""
    parent = scope.parent
    if scope.kind is not ScopeKind.FUNCTION or parent is None:
        return None
    return parent.name if parent.kind is ScopeKind.CLASS else None


def _is_bound(scope: Symbols) -> bool:
    """Whether a method is called on an object, which is its first argument."""
    return {"staticmethod", "classmethod"}.isdisjoint(decorators_of(scope.node))
