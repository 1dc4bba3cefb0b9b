"""Overload resolution ([over.match]): the function that arguments of some types choose."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TypeAlias

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.classes import is_base
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value, World
from rebsync.reverse.ir.cpp.conversions import is_arithmetic, rank
from rebsync.reverse.ir.cpp.symbols import ClassSymbol, FunctionSymbol
from rebsync.reverse.ir.cpp.types import Declared, ReferenceKind
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, text_of

_OF_A_PACK = 100  # worse than any conversion
_PACK = re.compile(r"&\s*\.\.\.")


@dataclass(frozen=True, slots=True)
class Braces:
    """An argument that is a list in braces; what it is is up to the parameter."""

    node: Node


class Ambiguous(Unlowered):
    """A call of which types do not say which of some functions it is of."""

    def __init__(self, reason: str, functions: Sequence[FunctionSymbol]) -> None:
        super().__init__(reason)
        self.functions = functions


ArgumentValue: TypeAlias = Value | Braces


@dataclass(frozen=True, slots=True)
class ParameterSignature:
    """A parameter with what it is by default, and the file that says so."""

    name: str
    declared: Declared
    default: tuple[Cpp, Node] | None = None


@dataclass(frozen=True, slots=True)
class CallSignature:
    """The parameters and the result of a function."""

    parameters: tuple[ParameterSignature, ...]
    result: Declared


def signature(world: World, function: FunctionSymbol) -> CallSignature:
    """The types of a function, read once."""
    cached: dict[str, CallSignature] = world.symbols.__dict__.setdefault("signatures", {})
    if function.name not in cached:
        cached[function.name] = _signature(world, function)
    return cached[function.name]


def _signature(world: World, function: FunctionSymbol) -> CallSignature:
    code = function.code
    parameters: list[ParameterSignature] = []
    for number, parameter in enumerate(code.parameters):
        declarator = parameter.node.child_by_field_name("declarator")
        declared = world.types.declared(code.cpp, function.scope, parameter.type, declarator)
        if declared.type == t.NOTHING and declarator is None:
            continue
        is_plain = declared.reference is ReferenceKind.NONE and "<" not in text_of(parameter.type)
        if is_plain and isinstance(declared.type, t.Array):  # it decays to a pointer ([dcl.fct])
            declared = Declared(t.Reference(declared.type.element, may_be_null=True))
        parameters.append(ParameterSignature(parameter.name, declared, _default(function, number)))
    return CallSignature(tuple(parameters), _result(world, function))


def _default(function: FunctionSymbol, number: int) -> tuple[Cpp, Node] | None:
    for code in function.declarations:
        value = code.parameters[number].node.child_by_field_name("default_value")
        if value is not None:
            return code.cpp, value
    return None


def _result(world: World, function: FunctionSymbol) -> Declared:
    code = function.code
    if function.converts_to is not None:
        return Declared(world.types.of(code.cpp, function.scope, function.converts_to))
    if code.result is None:
        return Declared(t.NOTHING)
    declarator = code.node.child_by_field_name("declarator")
    if declarator is not None and declarator.type == "function_declarator":
        trailing = next((c for c in declarator.children if c.type == "trailing_return_type"), None)
        if trailing is not None and trailing.named_children:
            return world.types.descriptor(code.cpp, function.scope, trailing.named_children[0])
        declarator = None
    return world.types.declared(code.cpp, function.scope, code.result, declarator)


def resolve(
    context: Context, candidates: Sequence[FunctionSymbol], arguments: Sequence[ArgumentValue]
) -> FunctionSymbol:
    """The best viable function; `Unlowered` where none, or no single one, is known to be."""
    ranked: list[tuple[list[int], FunctionSymbol]] = []
    usable = [f for f in candidates if _takes(context.world, f, len(arguments))]
    distinct = _without_redeclared(context.world, usable)
    if len(distinct) == 1:
        return _callable(distinct[0])
    may_be = [f for f in distinct if not f.is_deleted]
    for function in distinct:
        try:
            ranks = _ranks(context, function, arguments)
        except Unlowered as error:
            raise Ambiguous(str(error), may_be) from None
        if ranks is not None:
            ranked.append((ranks, function))
    best = [f for r, f in ranked if all(_is_better(r, other) for other, g in ranked if g is not f)]
    if len(best) != 1:
        reason = "a call whose overload is not known"
        raise Ambiguous(reason, may_be) if may_be else Unlowered(reason)
    return _callable(best[0])


def _callable(function: FunctionSymbol) -> FunctionSymbol:
    if function.is_deleted:
        raise Unlowered("a call of a deleted function")
    return function


def _without_redeclared(world: World, functions: Sequence[FunctionSymbol]) -> list[FunctionSymbol]:
    """Of functions that only differ in `const` the one that is not: most objects are not constant.

    Their bodies would differ if they did not mean the same; where they have two, both stay.
    """
    found: dict[tuple[Declared, ...], FunctionSymbol] = {}
    rest: list[FunctionSymbol] = []
    for function in functions:
        key = tuple(p.declared for p in signature(world, function).parameters)
        known = found.get(key)
        if known is None or (known.code.body is None and function.code.body is not None):
            found[key] = function
        elif function.code.body is None:
            continue
        elif _body(known) != _body(function):
            rest.append(function)
        elif known.is_const:
            found[key] = function
    return [*found.values(), *rest]


def _body(function: FunctionSymbol) -> bytes | None:
    return None if function.code.body is None else function.code.body.text


def _takes(world: World, function: FunctionSymbol, count: int) -> bool:
    parameters = signature(world, function).parameters
    needed = sum(p.default is None for p in parameters)
    return needed <= count and (count <= len(parameters) or has_pack(function))


def has_pack(function: FunctionSymbol) -> bool:
    """Whether a function takes references to however many values: `const Values&... values`."""
    lists = inside(function.code.node, "parameter_list")
    return next((_PACK.search(text_of(each)) for each in lists), None) is not None


def _is_better(ranks: list[int], other: list[int]) -> bool:
    return all(a <= b for a, b in zip(ranks, other, strict=True)) and ranks != other


def _ranks(
    context: Context, function: FunctionSymbol, arguments: Sequence[ArgumentValue]
) -> list[int] | None:
    """How good each argument's conversion is; None if one cannot be made."""
    found: list[int] = []
    parameters = signature(context.world, function).parameters
    for argument, parameter in zip(arguments, parameters, strict=False):
        one = _rank(context, argument, parameter.declared)
        if one is None:
            return None
        found.append(one)
    return [*found, *[_OF_A_PACK] * (len(arguments) - len(found))]


def _rank(context: Context, argument: ArgumentValue, declared: Declared) -> int | None:
    """Ten for each step of conversions, and what tells references apart ([over.ics.rank])."""
    if isinstance(argument, Braces):
        return None if is_arithmetic(declared.type) else 30
    if t.UNKNOWN in (argument.type, declared.type):
        raise Unlowered("a call whose overload is up to types that are not known")
    found = rank(argument.type, declared.type)
    if found is None:
        found = _rank_of_class(context, argument.type, declared.type)
    if found is None:
        return None
    match declared.reference:
        case ReferenceKind.LVALUE:
            return 10 * found if argument.is_lvalue and found in (0, 2) else None
        case ReferenceKind.RVALUE:
            return None if argument.is_lvalue and found == 0 else 10 * found
        case ReferenceKind.CONSTANT:
            return 10 * found + 1
        case _:
            return 10 * found


def _rank_of_class(context: Context, from_: t.Type, to: t.Type) -> int | None:
    symbols = context.world.symbols
    if is_base(context.world, to, from_):
        return 2
    if isinstance(to, t.Record):
        owner = symbols.classes.get(to.name)
        if owner is None:
            return 3 if to.name not in context.world.types.tuples else None
        return 3 if any(_converts(context, f, from_) for f in owner.constructors) else None
    if isinstance(from_, t.Record):
        source = symbols.classes.get(from_.name)
        if source is None:
            return 3
        return 3 if any(f.converts_to is not None for f in source.functions) else None
    if isinstance(to, t.FunctionType):
        return 3
    return None


def _converts(context: Context, function: FunctionSymbol, from_: t.Type) -> bool:
    """Whether a constructor makes an object of a value by itself ([class.conv.ctor])."""
    if function.is_explicit or function.is_deleted:
        return False
    parameters = signature(context.world, function).parameters
    if not parameters or any(p.default is None for p in parameters[1:]):
        return False
    return (
        from_ == parameters[0].declared.type or rank(from_, parameters[0].declared.type) is not None
    )


def conversion_function(owner: ClassSymbol, world: World, to: t.Type) -> FunctionSymbol | None:
    """The function of a class that makes its objects values of a type ([class.conv.fct])."""
    for class_ in world.symbols.lineage(owner.name):
        for function in class_.functions:
            if function.converts_to is not None:
                result = signature(world, function).result.type
                if result == to or rank(result, to) is not None:
                    return function
    return None
