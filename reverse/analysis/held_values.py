"""What a variable may hold: all that the program stores in it, if nothing else may store there."""

from __future__ import annotations

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
    """Whether what a function stores is an attribute of its own object, of another class.

    It is none of the objects whose attribute `value` the function `here` asks, its own too.
    """
    if not (isinstance(key, Member) and isinstance(value, e.Attribute)):
        return False
    if not (isinstance(value.object, e.Local) and value.object.name == here.receiver):
        return False
    return here.owner is not None and is_of_other_class(graph, here.owner, key, function)


def is_of_other_class(graph: CallGraph, owner: str, key: Member, function: str) -> bool:
    """Whether what a function stores is an attribute of its own object, and not of a class."""
    there = graph.program.function(function)
    if there.owner is None or there.owner in graph.family(owner):
        return False
    targets = [n.target for n in walk(there) if isinstance(n, s.Assign | s.Call | s.Declare)]
    own = e.Local(there.receiver or "")
    asked = [n for n in targets if isinstance(n, e.Attribute) and n.name == key.name]
    return all(n.object == own for n in asked)
