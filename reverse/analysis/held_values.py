"""What a variable may hold: all that the program stores in it, if nothing else may store there."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.origins import ClassOrigin, Origins
from rebsync.reverse.analysis.stores import ANY_VALUE, AnyValue, Member, Stored, Value, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.program import Function
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.routines import Language


def held_by(origins: Origins, value: e.Expression, function: str) -> list[Stored]:
    """All that is ever stored in what an expression of a function names, and by which functions.

    Attributes are told apart by names. Those of an object that the program did not make, as a
    message that came, may hold anything. Empty for what is no variable, or is stored nowhere.
    """
    key = key_of(value, function)
    if key is None:
        return []
    if isinstance(value, e.Attribute) and not is_own(origins, value.object, function):
        return [(function, ANY_VALUE)]
    return origins.graph.stores.of(key)


def texts_of(origins: Origins, value: e.Expression, function: str) -> list[str]:
    """The texts that a value may be; none if that is not known."""
    is_variable = key_of(value, function) is not None
    stored = [v for _, v in held_by(origins, value, function)] if is_variable else [value]
    held = [each for v in stored for each in _ways(v)]
    texts = [v.value for v in held if isinstance(v, e.Literal) and isinstance(v.value, str)]
    return texts if len(texts) == len(held) else []


def _ways(value: Value) -> list[Value]:
    """What a value is: of `a if x else b` both."""
    if not isinstance(value, e.Conditional):
        return [value]
    return [*_ways(value.then), *_ways(value.otherwise)]


def all_held(origins: Origins, value: e.Expression, function: str) -> list[Stored]:
    """The same of C++, where a variable whose address is only looked at holds nothing by that."""
    stored, key = held_by(origins, value, function), key_of(value, function)
    others = [each for each in stored if isinstance(each[1], AnyValue)]
    if not others or key is None or origins.table.language is not Language.CPP:
        return stored
    if key in origins.of_cpp.stored_through:
        return stored
    looked_at = origins.of_cpp.unchanging_addresses.get(key, 0)
    return [each for each in stored if each not in others] + others[looked_at:]


def is_own(origins: Origins, value: e.Expression, function: str) -> bool:
    """Whether a value is a class of the program, or an object of one: nothing else stores there."""
    type_ = getattr(value, "type", t.UNKNOWN)
    type_ = type_.to if isinstance(type_, t.Reference) else type_
    if type_ != t.UNKNOWN:
        return isinstance(type_, t.Record) and type_.name in origins.graph.program.classes
    if isinstance(value, e.ModuleReference):
        return True
    match value:
        case e.Local(name) if name == origins.object_of.get(function):
            return True
        case e.Captured(around, name) if name == origins.object_of.get(around):
            return True
        case _:
            pass
    held = origins.of(value, function)
    return bool(held) and all(isinstance(o, ClassOrigin) for o in held)


def is_of_other(
    graph: CallGraph, here: Function, value: e.Expression, key: object, function: str
) -> bool:
    """Whether what a function stores is an attribute of objects of another class.

    It is none of the objects whose attribute `value` the function `here` asks.
    """
    if not (isinstance(key, Member) and isinstance(value, e.Attribute)):
        return False
    owner = _class_of(graph, value, here)
    return owner is not None and is_of_other_class(graph, owner, key, function)


def is_of_other_class(graph: CallGraph, owner: str, key: Member, function: str) -> bool:
    """Whether what a function stores is an attribute of objects of other classes than one."""
    there, family = graph.program.function(function), graph.family(owner)
    asked = [n for n in _stored_in(there) if isinstance(n, e.Attribute) and n.name == key.name]
    classes = {_class_of(graph, n, there) for n in asked}
    return bool(classes) and None not in classes and classes.isdisjoint(family)


def _class_of(graph: CallGraph, of: e.Attribute, function: Function) -> str | None:
    """The class of the program that the object is of whose attribute is named, as declared.

    Without declarations it is that of a method whose own object it is. Attributes that such a class
    is not known to have may be of another, which it extends as the argument of a template.
    """
    type_ = getattr(of.object, "type", t.UNKNOWN)
    type_ = type_.to if isinstance(type_, t.Reference) else type_
    if isinstance(type_, t.Record):
        return type_.name if type_.name in graph.program.classes and not of.dynamic else None
    is_own = isinstance(of.object, e.Local) and of.object.name == function.receiver
    return function.owner if is_own else None


def _stored_in(function: Function) -> Iterator[e.Expression | None]:
    """What a function stores in, or lets others store in by its address."""
    for node in walk(function):
        match node:
            case s.Unsupported(target=target, writes=writes):
                yield from (target, *writes)
            case _ if hasattr(node, "target"):
                yield node.target
            case _:
                pass
