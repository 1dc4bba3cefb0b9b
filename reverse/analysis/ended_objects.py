"""Which objects of C++ end by `delete`, or are given to an owner; the pointers that are left.

A pointer leads to no object from then on until something else is stored in it
([basic.stc.dynamic.deallocation]): to end it again is undefined.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from rebsync.reverse.analysis.stores import Key, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.program import FunctionKind, Program
from rebsync.reverse.ir.walk import Node, parts, walk

_OWNERS = frozenset({"shared_ptr", "unique_ptr", "scoped_ptr", "auto_ptr"})
_ONCE = (FunctionKind.CONSTRUCTOR, FunctionKind.DESTRUCTOR)


def ended_by(node: object) -> Iterator[e.Expression]:
    """The pointers whose objects a node ends, or gives to an owner that ends them."""
    match node:
        case s.Destroy(e.Dereference(of)):
            yield of
        case s.Call(_, s.LibraryCallee("delete[]"), (s.CallArgument(of),)):
            yield of
        case e.Convert(_, of, type_) if _owns(type_) and _is_raw(of):
            yield of
        case s.Call(_, s.LibraryCallee(name, owner), (s.CallArgument(of), *_)):
            last = name.partition("<")[0].rpartition("::")[2]
            is_owner = last == "reset" and owner is not None and _owns(_type_of(owner))
            is_given = is_owner or (owner is None and last in _OWNERS)
            yield from [of] if is_given and _is_raw(of) else []
        case _:
            pass


def left_dangling(program: Program) -> frozenset[Key]:
    """The members and variables of files whose object may end twice.

    Something else is stored in the others before the function that ended it is left, or one
    constructor or destructor, or `main`, alone ends it.
    """
    found = Counter[Key]()
    for function in map(program.function, program.functions):
        left = set[Key]()
        left |= _left(function.body, function.name, frozenset(), left)
        is_once = function.kind in _ONCE or function.name.partition(" ")[0] == "main"
        found.update(dict.fromkeys(left, 1 if is_once else 2))
    return frozenset(key for key, count in found.items() if count > 1)


def _left(
    body: Sequence[Node], function: str, ended: frozenset[Key], left: set[Key]
) -> frozenset[Key]:
    """What some nodes leave ended; in `left` what they did where they leave the function."""
    for node in body:
        match node:
            case s.If(_, then, otherwise):
                ways = (_left(way, function, ended, left) for way in (then, otherwise))
                ended = frozenset[Key]().union(*ways)
            case s.Block(inner):
                ended = _left(inner, function, ended, left)
            case s.Return() | s.Raise() | s.Break() | s.Continue():
                left |= ended
            case s.Loop() | s.ForEach() | s.Switch() | s.Try() | s.With() | s.Unsequenced():
                ended |= _left(parts(node), function, ended, left)
            case _:
                keys = {key_of(of, function) for each in walk(node) for of in ended_by(each)}
                target = getattr(node, "target", None)
                stored = None if target is None else key_of(target, function)
                ended = (ended | {key for key in keys if key is not None}) - {stored}
    return ended


def _type_of(value: e.Expression) -> t.Type:
    type_: t.Type = getattr(value, "type", t.UNKNOWN)
    return type_


def _owns(type_: t.Type) -> bool:
    return isinstance(type_, t.Reference) and bool(type_.ownership.value)


def _is_raw(value: e.Expression) -> bool:
    type_ = _type_of(value)
    return isinstance(type_, t.Reference) and not type_.ownership.value
