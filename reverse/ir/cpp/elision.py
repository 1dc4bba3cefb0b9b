"""Copy-initialisation by a value; a temporary may be the object itself ([class.copy.elision])."""

from __future__ import annotations

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.context import Context, Value
from rebsync.reverse.ir.cpp.objects import as_value, class_of, implicitly
from rebsync.source import Span


def by_value(context: Context, target: e.Lvalue, type_: t.Type, value: Value, place: Span) -> None:
    """Copy-initialisation by a value; one that a call or constructor made is the object itself."""
    owner = class_of(context, type_)
    is_made = owner is not None and value.type == type_ and not value.is_lvalue
    if is_made and _elided(context, target, value.expression):
        return
    if owner is not None and value.type != t.UNKNOWN:
        context.world.construct(context, target, owner, [value], place)
        return
    converted = implicitly(context, value, type_, place)
    if not converted.is_lvalue and _elided(context, target, converted.expression):
        return
    context.emit(s.Assign(target, as_value(context, converted, place), place))


def _elided(context: Context, target: e.Lvalue, value: e.Expression) -> bool:
    """Copy elision ([class.copy.elision]): the temporary is made in the variable at once."""
    last = context.out[-1] if context.out else None
    if not isinstance(value, e.Temporary) or not isinstance(last, s.Call | s.Construct):
        return False
    if last.target != value:
        return False
    context.out[-1] = _with_target(last, target)
    context.pending = [
        p
        for p in context.pending
        if p.anchor is not last
        and not (isinstance(p.ending, s.Destroy) and p.ending.target == value)
    ]
    return True


def _with_target(statement: s.Call | s.Construct, target: e.Lvalue) -> s.Call | s.Construct:
    if isinstance(statement, s.Call):
        return s.Call(target, statement.callee, statement.arguments, statement.place)
    return s.Construct(
        target,
        statement.class_name,
        statement.arguments,
        statement.constructor,
        statement.place,
    )
