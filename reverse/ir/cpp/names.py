"""What names mean in a body ([basic.lookup]): locals, members, variables, functions."""

from __future__ import annotations

from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.classes import (
    field_key,
    field_type,
    find_member,
    has_unknown_base,
    methods_named,
)
from rebsync.reverse.ir.cpp.context import (
    Context,
    Unlowered,
    Value,
    World,
    lower_value,
    lowers_expression,
)
from rebsync.reverse.ir.cpp.objects import class_of, dereferenced
from rebsync.reverse.ir.cpp.overloads import signature
from rebsync.reverse.ir.cpp.symbols import ClassSymbol, EnumSymbol, FieldSymbol, VariableSymbol
from rebsync.reverse.ir.cpp.types import ReferenceKind
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of
from rebsync.source import NOWHERE, Span

_OPERATIONS = frozenset({"binary_expression", "unary_expression", "conditional_expression"})


@lowers_expression("this")
def this_pointer(context: Context, node: Node) -> Value:
    """`this`, the address of the object."""
    this = this_object(context)
    if not isinstance(this.expression, e.Lvalue):
        raise Unlowered("this")
    type_ = t.Reference(this.type, may_be_null=True)
    return Value(e.AddressOf(this.expression, type_, context.place(node)), type_)


def this_object(context: Context) -> Value:
    """The object that a member function is called on, as it is or as a lambda captured it."""
    found = context.local("this")
    if found is None or context.owner is None:
        # Of a class that was not read: a function that is no member has no such name.
        this = e.Local("this", t.UNKNOWN, NOWHERE)
        return Value(e.Dereference(this, t.UNKNOWN, True, NOWHERE), t.UNKNOWN, is_lvalue=True)
    return found


@lowers_expression("identifier", "type_identifier")
def identifier(context: Context, node: Node) -> Value:
    """An unqualified name."""
    name, place = text_of(node), context.place(node)
    local = context.local(name)
    if local is not None:
        return local
    if context.owner is not None:
        found = find_member(context.world, context.owner.name, name)
        if found is not None:
            return _own_member(context, *found, place)
    return _named(context, node, name, place)


@lowers_expression("qualified_identifier")
def qualified(context: Context, node: Node) -> Value:
    """A qualified name: an enumerator, a static member, a variable, a member of a base."""
    name, place = "".join(text_of(node).split()), context.place(node)
    outer, _, last = name.rpartition("::")
    path = context.cpp.source.path
    owner = context.world.symbols.type_named(outer, context.scope, path) if outer else None
    if isinstance(owner, ClassSymbol):
        found = find_member(context.world, owner.name, last)
        if found is not None:
            return _own_member(context, *found, place)
    return _named(context, node, name, place)


def _own_member(context: Context, owner: ClassSymbol, symbol: FieldSymbol, place: Span) -> Value:
    if symbol.is_static:
        return static_member(context.world, owner, symbol, place)
    return member_of(context, this_object(context), owner, symbol, place)


def static_member(world: World, owner: ClassSymbol, symbol: FieldSymbol, place: Span) -> Value:
    """A member that all objects of a class share."""
    type_ = field_type(world, owner, symbol).type
    found = e.Attribute(e.ClassReference(owner.name, place), symbol.name, type_, False, place)
    return Value(found, type_, is_lvalue=True)


def member_of(
    context: Context, of: Value, owner: ClassSymbol, symbol: FieldSymbol, place: Span
) -> Value:
    """A field of an object; what a reference member refers to."""
    declared = field_type(context.world, owner, symbol)
    key = field_key(context.world, owner, symbol.name)
    found = e.Attribute(of.expression, key, declared.form, False, place)
    if declared.reference is not ReferenceKind.NONE:
        return dereferenced(found, declared.type, place)
    return Value(found, declared.type, of.is_lvalue)


def _named(context: Context, node: Node, name: str, place: Span) -> Value:
    """A name of a namespace."""
    symbols, path = context.world.symbols, context.cpp.source.path
    enumerator = symbols.enumerator_named(name, context.scope, path)
    if enumerator is not None:
        return enumerator_value(context.world, *enumerator, text_of(node), place)
    variable = symbols.variable_named(name, context.scope, path)
    if variable is not None:
        return global_value(context.world, variable, place)
    macro = symbols.code.constant(context.cpp, name) or symbols.code.constants_for(context.cpp).get(
        name
    )
    if macro is not None and name.rpartition("::")[2].isupper():
        return _macro(context, node, macro)
    functions = symbols.functions_named(name, context.scope, path)
    if len(functions) == 1:
        return function_value(context, functions[0].name, place)
    if functions:
        raise Unlowered("the address of an overloaded function")
    if name in ("NULL", "nullptr"):
        return Value(e.Literal(None, t.NOTHING, name, place), t.NOTHING)
    if "::" not in name and _may_be_inherited(context):
        return Value(_inherited(context, name, place), t.UNKNOWN, is_lvalue=True)
    full = context.world.types.imported(context.cpp, name)
    if full == "std::nullopt":
        return Value(e.Literal(None, t.NOTHING, name, place), t.NOTHING)
    return Value(e.LibraryReference(full, t.UNKNOWN, place), t.UNKNOWN, is_lvalue=True)


def _may_be_inherited(context: Context) -> bool:
    """Whether a name that nobody declares may be a member of a base that is not known."""
    owner = context.owner
    return owner is not None and has_unknown_base(context.world, owner.name) and _has_this(context)


def _has_this(context: Context) -> bool:
    return context.local("this") is not None


def _inherited(context: Context, name: str, place: Span) -> e.Expression:
    return e.Attribute(this_object(context).expression, name, t.UNKNOWN, True, place)


def function_value(context: Context, name: str, place: Span) -> Value:
    """A function as a value."""
    found = signature(context.world, context.world.symbols.functions[name])
    type_ = t.FunctionType(tuple(p.declared.form for p in found.parameters), found.result.form)
    return Value(e.FunctionReference(name, type_, place), type_)


def global_value(world: World, variable: VariableSymbol, place: Span) -> Value:
    """A variable of a namespace, in the module that its file is; or a static member."""
    owner, _, last = variable.name.rpartition("::")
    class_ = world.symbols.classes.get(owner)
    if class_ is not None:
        for symbol in class_.fields:
            if symbol.name == last:
                return static_member(world, class_, symbol, place)
    declared = world.types.declared(
        variable.cpp, variable.scope, variable.type, variable.declarator
    )
    if declared.type == t.UNKNOWN and variable.value is not None:
        declared = replace(declared, type=_deduced(world, variable))
    found = e.Global(variable.cpp.source.path, variable.name, declared.form, place)
    if declared.reference is not ReferenceKind.NONE:
        return dereferenced(found, declared.type, place)
    return Value(found, declared.type, is_lvalue=True)


def _deduced(world: World, variable: VariableSymbol) -> t.Type:
    """The type of an `auto` variable of a namespace by its initialiser, where that is simple."""
    node = variable.value
    if node is None or text_of(variable.type) != "auto" or node.type == "initializer_list":
        return t.UNKNOWN
    context = Context(world, variable.cpp, variable.name, variable.scope)
    try:
        return lower_value(context, node).type
    except Unlowered:
        return t.UNKNOWN


def enumerator_value(world: World, enum: EnumSymbol, name: str, text: str, place: Span) -> Value:
    """An enumerator as a constant of its enumeration."""
    number = enumerators(world, enum).get(name)
    if number is None:
        raise Unlowered("an enumerator whose value is not known")
    type_ = t.Enumeration(enum.name, world.types.underlying(enum))
    return Value(e.Literal(number, type_, text, place), type_)


def enumerators(world: World, enum: EnumSymbol) -> dict[str, int | None]:
    """The enumerators of an enumeration with their values."""
    cached: dict[int, dict[str, int | None]]
    cached = world.symbols.__dict__.setdefault("enumerator values", {})
    if enum.node.id in cached:  # perhaps those before the one that is asked from
        return cached[enum.node.id]
    found: dict[str, int | None] = {}
    cached[enum.node.id] = found
    body = enum.node.child_by_field_name("body")
    next_: int | None = 0
    for child in body.named_children if body is not None else ():
        name = child.child_by_field_name("name") if child.type == "enumerator" else None
        if name is None:
            continue
        value = child.child_by_field_name("value")
        if value is not None:
            next_ = _of_own(found, value)
            if next_ is None:
                next_ = world.types.constant(value, enum.name, enum.cpp)
        found[text_of(name)] = next_
        next_ = next_ + 1 if next_ is not None else None
    return found


def _of_own(found: dict[str, int | None], value: Node) -> int | None:
    """An enumerator that is another of the same enumeration."""
    return found.get(text_of(value)) if value.type == "identifier" else None


def _macro(context: Context, node: Node, macro: tuple[Cpp, Node]) -> Value:
    """The expression that a macro without arguments stands for."""
    cpp, value = macro
    around = node.parent.type if node.parent is not None else ""
    is_text = cpp.source.text.startswith("const auto x =")
    if is_text and value.type in _OPERATIONS and around in _OPERATIONS:
        raise Unlowered("a macro whose text may bind otherwise than it looks")
    with context.reading(cpp, context.scope, context.place(node)):
        return lower_value(context, value)


# --- members of objects ---------------------------------------------------------------------------


@lowers_expression("field_expression")
def field_expression(context: Context, node: Node) -> Value:
    """`a.b` and `a->b`, where `b` is no function that is called."""
    field = node.child_by_field_name("field")
    if field is None or field.type not in ("field_identifier", "qualified_identifier"):
        raise Unlowered("a member that is no name")
    of = object_of(context, node)
    return field_of(context, of, text_of(field).rpartition("::")[2], context.place(node))


def field_of(context: Context, of: Value, name: str, place: Span) -> Value:
    """A field of an object by its name."""
    owner = class_of(context, of.type)
    if owner is not None:
        found = find_member(context.world, owner.name, name)
        if found is not None and found[1].is_static:
            return static_member(context.world, *found, place)
        if found is not None:
            return member_of(context, of, *found, place)
        if methods_named(context.world, owner.name, name):
            raise Unlowered("a member function as a value")
    tuples = context.world.types.tuples
    if isinstance(of.type, t.Record) and of.type.name in tuples:
        type_ = dict(tuples[of.type.name]).get(name, t.UNKNOWN)
        known = e.Attribute(of.expression, name, type_, type_ == t.UNKNOWN, place)
        if isinstance(type_, t.Reference) and not type_.may_be_null:
            return dereferenced(known, type_.to, place)
        return Value(known, type_, of.is_lvalue)
    is_message = isinstance(of.type, t.RosMessage)
    found_field = e.Attribute(of.expression, name, t.UNKNOWN, not is_message, place)
    return Value(found_field, t.UNKNOWN, of.is_lvalue or not is_message)


def object_of(context: Context, node: Node) -> Value:
    """The object before `.`, or the one that what stands before `->` leads to."""
    argument = node.child_by_field_name("argument")
    if argument is None:
        raise Unlowered("a member of nothing")
    value = lower_value(context, argument)
    if not any(child.type == "->" for child in node.children):
        return value
    return pointed(context, value, context.place(node))


def pointed(context: Context, value: Value, place: Span) -> Value:
    """What a pointer or smart pointer leads to, or an object through its `operator->`."""
    match value.type:
        case t.Reference(to):
            return dereferenced(value.expression, to, place)
        case t.Optional(of):
            return dereferenced(value.expression, of, place)
        case t.Record(name) if name in context.world.symbols.classes:
            result = context.world.operator(context, "operator->", [value], place)
            if result is None:
                raise Unlowered("an arrow without an operator")
            return pointed(context, result, place)
        case _:
            return dereferenced(value.expression, t.UNKNOWN, place)
