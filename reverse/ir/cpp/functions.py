"""Functions of C++: parameters, bodies, and what constructors initialise ([class.base.init])."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.classes import (
    DataMember,
    called_implicitly,
    implicit_constructor,
    members,
    needs_constructor,
)
from rebsync.reverse.ir.cpp.context import (
    Context,
    Unlowered,
    Value,
    World,
    lower_value,
    unsupported,
)
from rebsync.reverse.ir.cpp.functions_called import (
    argument_values,
    call_function,
    library_arguments,
)
from rebsync.reverse.ir.cpp.initialisation import initialised
from rebsync.reverse.ir.cpp.objects import address, default_constructed, dereferenced
from rebsync.reverse.ir.cpp.overloads import resolve, signature
from rebsync.reverse.ir.cpp.sequencing import exposed_in
from rebsync.reverse.ir.cpp.statements import scope
from rebsync.reverse.ir.cpp.symbols import ClassSymbol, FunctionSymbol
from rebsync.reverse.ir.cpp.types import Declared, ReferenceKind
from rebsync.reverse.ir.program import Function, FunctionKind, Parameter
from rebsync.reverse.syntax.cpp_exceptions import is_noexcept
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, text_of
from rebsync.source import NOWHERE, Span

_THIS = "this"


def lambda_names(function: FunctionSymbol, owner: ClassSymbol | None) -> dict[int, str]:
    """The names of the lambdas in a function; a constructor has those of the fields' own values."""
    nodes = [function.code.initialisers, function.code.body]
    if owner is not None and function.simple == owner.simple:
        nodes += [field.value for field in owner.fields if not field.is_static]
    return names_of_lambdas(function.name, nodes)


def names_of_lambdas(around: str, nodes: Iterable[Node | None]) -> dict[int, str]:
    """The names of the lambdas in some code, by their nodes."""
    found: dict[int, str] = {}
    # A text is searched faster than its tree.
    for node in (n for n in nodes if n is not None and b"[" in (n.text or b"")):
        for each in inside(node, "lambda_expression"):
            found[each.id] = f"{around}::lambda{len(found) + 1}"
    return found


def lower_function(world: World, symbol: FunctionSymbol) -> tuple[Function, list[Function]]:
    """A function, and the lambdas in it."""
    code = symbol.code
    owner = world.symbols.classes.get(symbol.owner or "")
    context = Context(world, code.cpp, symbol.name, symbol.scope, owner)
    context.lambdas = lambda_names(symbol, owner)
    context.exposed = exposed_in(code.body) if code.body is not None else frozenset()
    context.result = signature(world, symbol).result
    place = context.place(code.node)
    is_member = owner is not None and not symbol.is_static
    parameters = [_bind_this(context, owner, place)] if owner is not None and is_member else []
    taken = [(p.name, p.declared) for p in signature(world, symbol).parameters]
    parameters += bound_parameters(context, taken, place)
    kind = _kind(symbol, owner)
    context.in_constructor = kind is not FunctionKind.FUNCTION
    body: s.Body = ()
    if kind is FunctionKind.CONSTRUCTOR and owner is not None:
        with context.body() as start:
            initialise_parts(context, owner, code.initialisers)
        body = tuple(start)
    if code.body is not None:
        body = (*body, *body_of(context, code.body))
    found = Function(
        symbol.name,
        tuple(parameters),
        body,
        context.result.form,
        kind,
        _THIS if is_member else None,
        symbol.owner if owner is not None else None,
        frozenset(context.shared),
        place,
        is_noexcept(code.node, implied=kind is FunctionKind.DESTRUCTOR),
    )
    return found, context.closures


def _kind(symbol: FunctionSymbol, owner: ClassSymbol | None) -> FunctionKind:
    if owner is not None and symbol.simple == owner.simple:
        return FunctionKind.CONSTRUCTOR
    is_destructor = owner is not None and symbol.simple.startswith("~")
    return FunctionKind.DESTRUCTOR if is_destructor else FunctionKind.FUNCTION


def lower_implicit_constructor(world: World, owner: ClassSymbol) -> tuple[Function, list[Function]]:
    """The default constructor that the language declares ([class.default.ctor])."""
    name = implicit_constructor(owner)
    context = Context(world, owner.cpp, name, owner.name, owner)
    context.lambdas = names_of_lambdas(name, [f.value for f in owner.fields if not f.is_static])
    place = context.place(owner.node)
    context.in_constructor = True
    parameters = (_bind_this(context, owner, place),)
    with context.body() as body:
        initialise_parts(context, owner, None)
    kind = FunctionKind.CONSTRUCTOR
    captured = frozenset(context.shared)
    found = Function(
        name, parameters, tuple(body), t.NOTHING, kind, _THIS, owner.name, captured, place
    )
    return found, context.closures


def _bind_this(context: Context, owner: ClassSymbol, place: Span) -> Parameter:
    type_ = t.Record(owner.name)
    context.this = e.Local(context.unique(_THIS), type_, place)
    context.bind(_THIS, Value(context.this, type_, is_lvalue=True))
    return Parameter(_THIS, type_, place=place)


def bound_parameters(
    context: Context, taken: Sequence[tuple[str, Declared]], place: Span
) -> tuple[Parameter, ...]:
    """Parameters as variables of the function."""
    found: list[Parameter] = []
    for number, (name, declared) in enumerate(taken):
        own = context.unique(name or f"unnamed~{number + 1}")
        local = e.Local(own, declared.form, place)
        if declared.reference is not ReferenceKind.NONE:
            context.bind(name, dereferenced(local, declared.type, place))
        else:
            context.bind(name, Value(local, declared.type, is_lvalue=True))
        found.append(Parameter(own, declared.form, place=place))
    return tuple(found)


def body_of(context: Context, body: Node) -> s.Body:
    """The statements of a body; `goto` may lead anywhere in it, so that it is one statement."""
    nodes = named(body)
    if body.type == "try_statement" or _jumps(context.cpp, body):
        return (unsupported(context, body, "goto, or a body that is a try"),)
    return scope(context, nodes)


def _jumps(cpp: Cpp, body: Node) -> bool:
    return b"goto" in cpp.words and bool(inside(body, "goto_statement"))


# --- bases and members ----------------------------------------------------------------------------


def initialise_parts(context: Context, owner: ClassSymbol, list_: Node | None) -> None:
    """Bases first, then members, in the order of their declarations whatever the list's is."""
    given = _initialisers(list_)
    if owner.simple in given and owner.simple not in {n.rpartition("::")[2] for n in owner.bases}:
        _guarded(context, given[owner.simple], None, lambda: _delegate(context, owner, given))
        return
    for name, base in context.world.symbols.bases(owner):
        node = given.get(name.rpartition("::")[2])
        _guarded(context, node, None, partial(_base, context, name, base, node))
    for member in members(context.world, owner):
        node = given.get(member.symbol.name)
        target = _target(context, member, node)
        where = node if node is not None else member.symbol.value
        _guarded(
            context,
            where,
            target,
            partial(_member, context, owner, member, target, node),
        )


def _guarded(
    context: Context, node: Node | None, target: e.Lvalue | None, lower: Callable[[], None]
) -> None:
    """One initialisation, which is a full-expression."""
    mark = len(context.out)
    try:
        with context.full_expression():
            lower()
    except Unlowered as error:
        del context.out[mark:]
        if node is not None and node.parent is not None and node.parent.type == "field_initializer":
            context.emit(unsupported(context, node, str(error), target))
        else:
            context.emit(s.Unsupported(str(error), (), (), target, NOWHERE))


def _initialisers(list_: Node | None) -> dict[str, Node]:
    """What a constructor gives its bases and members, by their last names."""
    found: dict[str, Node] = {}
    for child in named(list_) if list_ is not None else ():
        inner = named(child)
        if child.type == "field_initializer" and len(inner) >= 2:
            name = "".join(text_of(inner[0]).split()).partition("<")[0]
            found[name.rpartition("::")[2]] = inner[-1]
    return found


def _this(context: Context) -> e.Expression:
    if context.this is None:
        raise Unlowered("a constructor without an object")
    return context.this


def _delegate(context: Context, owner: ClassSymbol, given: dict[str, Node]) -> None:
    """Another constructor of the class does it all."""
    nodes = named(given[owner.simple])
    function = resolve(context, owner.constructors, argument_values(context, nodes))
    receiver = Value(_this(context), t.Record(owner.name), is_lvalue=True)
    call_function(context, function, nodes, context.place(given[owner.simple]), receiver, True)


def _base(context: Context, name: str, base: ClassSymbol | None, node: Node | None) -> None:
    place = context.place(node) if node is not None else NOWHERE
    nodes = named(node) if node is not None else []
    this = _this(context)
    if base is None:
        arguments = library_arguments(context, nodes, place, is_pure=False)
        full = context.world.types.imported(context.cpp, name)
        context.emit(s.Call(None, s.LibraryCallee(full, this), arguments, place))
        return
    written = [f for f in base.constructors if not f.is_default]
    if not written:
        if nodes:
            raise Unlowered("a base that is copied or made of values")
        if needs_constructor(context.world, base):
            callee = s.FunctionCallee(called_implicitly(base))
            context.emit(s.Call(None, callee, (s.CallArgument(this),), place))
        return
    function = resolve(context, base.constructors, argument_values(context, nodes))
    if function.is_default:
        callee = s.FunctionCallee(called_implicitly(base))
        context.emit(s.Call(None, callee, (s.CallArgument(this),), place))
        return
    receiver = Value(this, t.Record(base.name), is_lvalue=True)
    call_function(context, function, nodes, place, receiver, True)


def _target(context: Context, member: DataMember, node: Node | None) -> e.Lvalue:
    place = context.place(node) if node is not None else NOWHERE
    return e.Attribute(_this(context), member.key, member.declared.form, False, place)


def _member(
    context: Context, owner: ClassSymbol, member: DataMember, target: e.Lvalue, node: Node | None
) -> None:
    """A member by the constructor's list, by its own initialiser, or by default."""
    declared = member.declared
    if node is None and member.symbol.value is not None:
        with context.reading(member.symbol.cpp, owner.name):
            this = Value(_this(context), t.Record(owner.name), is_lvalue=True)
            context.bind(_THIS, this)
            _initialise(context, declared, target, member.symbol.value)
        return
    if node is not None:
        _initialise(context, declared, target, node)
    else:
        place = member.symbol.cpp.span(member.symbol.declarator)
        default_constructed(context, target, declared.type, place)


def _initialise(context: Context, declared: Declared, target: e.Lvalue, node: Node) -> None:
    if declared.reference is ReferenceKind.NONE:
        initialised(context, target, declared.type, node)
        return
    inner = named(node) if node.type in ("argument_list", "initializer_list") else [node]
    if len(inner) != 1:
        raise Unlowered("a reference that is made of other than one object")
    value = lower_value(context, inner[0])
    if not value.is_lvalue:
        raise Unlowered("a member that refers to a temporary")
    place = context.place(node)
    context.emit(s.Assign(target, address(context, value, place), place))
