"""Objects of C++: addresses, copies and moves, construction and the end of their lifetime."""

from __future__ import annotations

from dataclasses import replace

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.classes import (
    copies_trivially,
    ends_silently,
    is_base,
    members,
)
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value
from rebsync.reverse.ir.cpp.conversions import converted
from rebsync.reverse.ir.cpp.symbols import ClassSymbol
from rebsync.reverse.ir.cpp.types import Declared, ReferenceKind
from rebsync.reverse.ir.operators import Conversion
from rebsync.reverse.libraries.outcome_classes import UNKNOWN_CLASS
from rebsync.source import Span

_WEAK = frozenset({"std::weak_ptr", "boost::weak_ptr"})


def dereferenced(pointer: e.Expression, type_: t.Type, place: Span) -> Value:
    """What a pointer or reference leads to."""
    if isinstance(pointer, e.AddressOf):
        return Value(pointer.target, type_, is_lvalue=True)
    return Value(e.Dereference(pointer, type_, type_ == t.UNKNOWN, place), type_, is_lvalue=True)


def address(context: Context, value: Value, place: Span) -> e.Expression:
    """A reference to an object; to a new temporary one for a value ([conv.rval])."""
    expression = value.expression
    type_ = t.Reference(value.type)
    if value.is_lvalue:
        if isinstance(expression, e.Dereference):
            if _may_be_nothing(getattr(expression.reference, "type", t.UNKNOWN)):
                context.emit(s.Evaluate(expression, place))
            return expression.reference
        if isinstance(expression, e.Local):
            context.shared.add(expression.name)
        if isinstance(expression, e.Lvalue):
            return e.AddressOf(expression, type_, place)
        if isinstance(expression, e.LibraryReference):
            return expression
        if value.type != t.UNKNOWN:
            raise Unlowered("a reference to what is not known as an object")
    target = context.stored(expression, value.type, place)
    return e.AddressOf(target, type_, place)


def _may_be_nothing(type_: t.Type) -> bool:
    """Whether what is dereferenced may lead to nothing by its type: no reference does."""
    is_pointer = isinstance(type_, t.Reference) and (type_.may_be_null or type_.ownership.value)
    return bool(is_pointer) or isinstance(type_, t.Optional | t.Unknown)


def as_value(context: Context, value: Value, place: Span) -> e.Expression:
    """A value of its own: of an lvalue or xvalue a copy, as its class makes copies."""
    if not value.is_lvalue and not is_xvalue(value):
        return value.expression
    match value.type:
        case t.Record() | t.Container() | t.Array() | t.Optional() | t.RosMessage() | t.Unknown():
            return _copied(context, value, place)
        case t.Reference() if value.type.ownership.value and not value.is_lvalue:
            return e.Move(value.expression, value.type, place)
        case _:
            return value.expression


def is_xvalue(value: Value) -> bool:
    """Whether it names an object that stays, which may be taken from ([basic.lval])."""
    expression = value.expression
    return isinstance(expression, e.Lvalue) and not isinstance(expression, e.Temporary)


def _copied(context: Context, value: Value, place: Span) -> e.Expression:
    if copies_trivially(context.world, value.type):
        made = e.Copy if value.is_lvalue else e.Move
        return made(value.expression, value.type, place)
    owner = class_of(context, value.type)
    if owner is None:
        return _copied_elements(context, value, place)
    target = context.temporary(value.type, place)
    context.world.construct(context, target, owner, [value], place)
    ended_later(context, target, value.type, place)
    return target


def _copied_elements(context: Context, value: Value, place: Span) -> e.Expression:
    """A sequence of copies that the elements' class makes."""
    match value.type:
        case t.Container(t.ContainerKind.SEQUENCE, (t.Record() as type_,)):
            owner = class_of(context, type_)
        case _:
            raise Unlowered("a container whose elements' class makes copies by itself")
    assert owner is not None, "what is of a library is copied by it"
    target = context.temporary(value.type, place)
    element, made = context.temporary(type_, place), context.temporary(type_, place)
    with context.body() as body:
        context.world.construct(context, made, owner, [Value(element, type_, True)], place)
        put = s.LibraryCallee("std::vector::push_back", target)
        context.emit(s.Call(None, put, (s.CallArgument(made),), place))
    context.emit(s.Assign(target, e.Build(value.type, (), place), place))
    context.emit(s.ForEach(element, value.expression, tuple(body), (), dynamic=False, place=place))
    return target


def class_of(context: Context, type_: t.Type) -> ClassSymbol | None:
    """The class of the program that objects of a type are of."""
    return context.world.symbols.classes.get(type_.name) if isinstance(type_, t.Record) else None


# --- conversions that a class may have a part in --------------------------------------------------


def implicitly(context: Context, value: Value, to: t.Type, place: Span) -> Value:
    """A value converted to a type ([conv]); `Unlowered` where that is not known."""
    if value.type == to or to == t.UNKNOWN:
        return value
    owner = class_of(context, value.type)
    if owner is not None:
        if isinstance(to, t.Record) and context.world.symbols.descends(owner.name, to.name):
            return Value(value.expression, to, value.is_lvalue)
        result = context.world.conversion(context, value, owner, to, place)
        if result is not None:
            return result
    target = class_of(context, to)
    if target is not None and value.type != t.UNKNOWN:
        made = context.temporary(to, place)
        context.world.construct(context, made, target, [value], place)
        ended_later(context, made, to, place)
        return Value(made, to)
    if isinstance(to, t.Optional) and owner is not None:
        inner = as_value(context, implicitly(context, value, to.of, place), place)
        return Value(e.Convert(Conversion.WIDEN, inner, to, False, place), to)
    if owner is not None and not isinstance(to, t.Record | t.FunctionType):
        raise Unlowered("a conversion of an object that its class does not declare")
    if isinstance(to, t.Reference):
        if _is_reference(to) and value.is_lvalue and value.type == to.to:
            return Value(address(context, value, place), to)
        locked(context, value, place)
    if _is_reference(value.type) and value.type.to == to:  # type: ignore[union-attr]
        return dereferenced(value.expression, to, place)
    found = converted(value.expression, value.type, to, place)
    if found is not None:
        return Value(found, to, value.is_lvalue and found is value.expression)
    if isinstance(to, t.Record | t.FunctionType | t.RosHandle | t.RosMessage) or isinstance(
        value.type, t.Record | t.RosMessage | t.RosHandle
    ):
        made_value = e.Convert(Conversion.CAST, as_value(context, value, place), to, True, place)
        return Value(made_value, to)
    raise Unlowered("a conversion that is not known")


def _is_reference(type_: t.Type) -> bool:
    """Whether a type is a reference as a part of another: `pair<T&, U>`, `reference_wrapper<T>`."""
    is_plain = isinstance(type_, t.Reference) and type_.ownership is t.Ownership.NONE
    return is_plain and not type_.may_be_null  # type: ignore[union-attr]


def locked(context: Context, value: Value, place: Span, is_explicit: bool = False) -> None:
    """A shared pointer made of a weak one: it throws where the object is gone.

    What is not known may be one where the pointer is made of it by name: a weak one is not
    converted ([util.smartptr.shared.const]).
    """
    is_weak = isinstance(value.type, t.Record) and value.type.name.partition("<")[0] in _WEAK
    if is_weak or (is_explicit and value.type == t.UNKNOWN and not _is_made(context, value)):
        argument = s.CallArgument(value.expression)
        callee = s.LibraryCallee("std::shared_ptr::from_weak")
        context.emit(s.Call(None, callee, (argument,), place))


def _is_made(context: Context, value: Value) -> bool:
    """Whether a value is what a function gives that makes pointers: `make_shared`, casts."""
    calls = (c for c in context.out if isinstance(c, s.Call) and c.target == value.expression)
    names = [
        c.callee.name.partition("<")[0] for c in calls if isinstance(c.callee, s.LibraryCallee)
    ]
    return any(n.endswith(("make_shared", "allocate_shared", "_pointer_cast")) for n in names)


def passed(context: Context, value: Value, declared: Declared, place: Span) -> e.Expression:
    """An argument for a parameter: a value of its own, or a reference ([dcl.init.ref])."""
    if declared.reference is ReferenceKind.NONE:
        found = implicitly(context, value, declared.type, place)
        return as_value(context, found, place)
    same = declared.type in (value.type, t.UNKNOWN) or is_base(
        context.world, declared.type, value.type
    )
    if not same:
        value = implicitly(context, value, declared.type, place)
    if value.is_lvalue:
        return address(context, value, place)
    is_fresh = isinstance(value.expression, e.Temporary)
    found_address = address(context, value, place)
    if not is_fresh and isinstance(found_address, e.AddressOf):
        ended_later(context, found_address.target, value.type, place)
    return found_address


# --- beginning and end of lifetimes ---------------------------------------------------------------


def ending(context: Context, target: e.Lvalue, type_: t.Type, place: Span) -> s.Statement | None:
    """The end of an object's lifetime, where that runs anything."""
    if ends_silently(context.world, type_):
        return None
    return s.Destroy(target, type_.name if isinstance(type_, t.Record) else None, place)


def ended_later(context: Context, target: e.Lvalue, type_: t.Type, place: Span) -> None:
    """A temporary ends with the full-expression."""
    statement = ending(context, target, type_, place)
    if statement is not None:
        context.end_later(statement)


def ends_with_scope(context: Context, target: e.Lvalue, type_: t.Type, place: Span) -> None:
    """A variable ends with the scope around."""
    statement = ending(context, target, type_, place)
    if statement is not None:
        context.objects.append(statement)


def default_value(context: Context, type_: t.Type, place: Span) -> e.Expression | None:
    """What `T()` and `T{}` are ([dcl.init] value-initialisation); None where a constructor runs."""
    match type_:
        case t.Integer() | t.Enumeration():
            return e.Literal(0, type_, place=place)
        case t.Float():
            return e.Literal(0.0, type_, place=place)
        case t.Truth():
            return e.Literal(False, type_, place=place)
        case t.Text():
            return e.Literal("", type_, place=place)
        case t.Reference() | t.Optional() | t.FunctionType():
            return e.Literal(None, type_, place=place)
        case t.Container(t.ContainerKind.MAPPING):
            return e.BuildMapping(type_, (), place)
        case t.Container():
            return e.Build(type_, (), place)
        case t.Array(element, length):
            values = [default_value(context, element, place) for _ in range(min(length, 256))]
            if length > 256 or None in values:
                return None
            return e.Build(type_, tuple(v for v in values if v is not None), place)
        case t.Record(name) if name in context.world.types.tuples:
            return _tuple_value(context, type_, place)
        case _:
            return None


def _tuple_value(context: Context, type_: t.Record, place: Span) -> e.Expression | None:
    fields: list[tuple[str, e.Expression]] = []
    for name, inner in context.world.types.tuples[type_.name]:
        value = default_value(context, inner, place)
        if value is None:
            return None
        fields.append((name, value))
    return e.BuildRecord(type_, tuple(fields), place)


def default_constructed(context: Context, target: e.Lvalue, type_: t.Type, place: Span) -> None:
    """`T x;` ([dcl.init] default-initialisation): numbers and pointers hold nothing yet."""
    owner = class_of(context, type_)
    if owner is not None:
        context.world.construct(context, target, owner, [], place)
        return
    if isinstance(type_, t.Integer | t.Float | t.Truth | t.Enumeration):
        return
    if type_ == t.UNKNOWN:
        context.emit(s.Call(target, s.LibraryCallee(UNKNOWN_CLASS), (), place))
        return
    if isinstance(type_, t.Reference) and type_.ownership is t.Ownership.NONE:
        return
    if isinstance(type_, t.Array) and class_of(context, type_.element) is not None:
        elements = []
        for _ in range(type_.length):
            element = context.temporary(type_.element, place)
            default_constructed(context, element, type_.element, place)
            elements.append(element)
        context.emit(s.Assign(target, e.Build(type_, tuple(elements), place), place))
        return
    value = default_value(context, type_, place)
    if value is not None:
        context.emit(s.Assign(target, value, place))
    elif isinstance(type_, t.Record | t.RosMessage):
        context.emit(s.Call(target, s.LibraryCallee(type_.name), (), place))


def _assigned_part(
    context: Context, owner: ClassSymbol, target: e.Expression, value: Value, place: Span
) -> None:
    """A base or a field, as its class assigns it."""
    type_ = t.Record(owner.name)
    operands = [Value(target, type_, is_lvalue=True), replace(value, type=type_)]
    if context.world.operator(context, "operator=", operands, place) is None:
        assigned_memberwise(context, owner, target, value, place)


def assigned_memberwise(
    context: Context, owner: ClassSymbol, target: e.Expression, value: Value, place: Span
) -> None:
    """The implicit assignment ([class.copy.assign]): bases first, then fields in order.

    It is that of copies of an lvalue, else that of moves.
    """
    for name, base in context.world.symbols.bases(owner):
        if base is not None:
            _assigned_part(context, base, target, value, place)
        else:
            full = context.world.types.imported(owner.cpp, name)
            callee = s.LibraryCallee(f"{full}::operator=", target)
            context.emit(s.Call(None, callee, (s.CallArgument(value.expression),), place))
    for member in members(context.world, owner):
        type_ = member.declared.type
        if member.declared.reference is not ReferenceKind.NONE:
            raise Unlowered("an assignment of an object with a reference")
        to = e.Attribute(target, member.key, type_, False, place)
        from_ = e.Attribute(value.expression, member.key, type_, False, place)
        inner = class_of(context, type_)
        if inner is not None:
            _assigned_part(context, inner, to, Value(from_, type_, value.is_lvalue), place)
        else:
            copy = as_value(context, Value(from_, type_, value.is_lvalue), place)
            context.emit(s.Assign(to, copy, place))
