"""Default member initialisers that read other members: what a constructor does in their order.

The members of a class get their values in the order of their declarations, each from the list of
initialisers of the constructor that makes the object, or else its default ([class.base.init]).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies.scope import Stores
from rebsync.reverse.nodes.node_declarations import is_static
from rebsync.reverse.nodes.node_state import State
from rebsync.reverse.syntax.cpp_declarations import CppField
from rebsync.reverse.syntax.cpp_index import Code, CppClass
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, text_of

# The default values of members, by the names of their class and their own.
Defaults: TypeAlias = Mapping[tuple[str, str], Sequence[tuple[Cpp, Stores]]]


@dataclass(frozen=True, slots=True)
class DefaultValues:
    """Members of a class that get their default values here, one after the other."""

    owner: str
    members: tuple[str, ...]


def ordered_defaults(state: State) -> Defaults:
    """The defaults of classes in which one may read another member: these have their place."""
    found: dict[tuple[str, str], list[tuple[Cpp, Stores]]] = {}
    for owner in state.unit.lineage:
        fields = _with_defaults(owner)
        if any(_reads(state, value) for _, value in fields):
            for member, value in fields:
                found[owner.name, member.name] = [
                    each
                    for each in state.initial
                    if each[0].source.path == member.cpp.source.path and _is_of(each[1], value)
                ]
    return found


def all_of(owner: CppClass, defaults: Defaults) -> Iterator[DefaultValues]:
    """What a constructor does that gives no member a value."""
    names = tuple(f.name for f, _ in _with_defaults(owner) if (owner.name, f.name) in defaults)
    if names:
        yield DefaultValues(owner.name, names)


def in_order(
    owner: CppClass, entries: Sequence[Node], defaults: Defaults
) -> Iterator[Node | DefaultValues]:
    """The initialisers of a constructor as they are evaluated, with the defaults between them."""
    places = {f.name: number for number, f in enumerate(_fields(owner))}
    at = [places.get(member_of(entry), -1) for entry in entries]
    given = {member_of(entry) for entry in entries}
    left = [n for d in all_of(owner, defaults) for n in d.members if n not in given]
    for number, entry in zip(at, entries, strict=True):
        before = tuple(name for name in left if places[name] < number)
        if before:
            yield DefaultValues(owner.name, before)
            left = left[len(before) :]
        yield entry
    if left:
        yield DefaultValues(owner.name, tuple(left))


def member_of(entry: Node) -> str:
    """What an initialiser of a constructor is for: a member, or the class of a base."""
    inner = named(entry)
    return text_of(inner[0]) if inner else ""


def base_of(entry: Node) -> str:
    """The class of a base that an initialiser makes, by its plain name."""
    return member_of(entry).partition("<")[0].rpartition("::")[2]


def _fields(owner: CppClass) -> list[CppField]:
    """The members of a class that each object has, as they are declared."""
    fields = (f for f in (*owner.fields, *owner.others) if not is_static(f.node))
    return sorted(fields, key=lambda f: f.node.start_byte)


def _with_defaults(owner: CppClass) -> list[tuple[CppField, Node]]:
    return [(f, f.value) for f in _fields(owner) if f.value is not None]


def _is_of(stores: Stores, value: Node) -> bool:
    """Whether what is stored is a default value, or part of it."""
    part = stores.value
    return (
        isinstance(part, Node)
        and value.start_byte <= part.start_byte
        and part.end_byte <= value.end_byte
    )


def _reads(state: State, value: Node) -> bool:
    """Whether a value names a variable of the node, or may run code that does."""
    if inside(value, "lambda_expression", "this"):
        return True
    code, unit = state.code, state.unit
    names = {f.name for c in unit.lineage for f in _fields(c)}
    names |= {v.name for each in code.variables.values() for v in each if not _is_fixed(code, v)}
    names |= {f.name for f in unit.functions} | {name for _, name in code.definitions}
    return any(text_of(n) in names for n in inside(value, "identifier", "field_identifier"))


def _is_fixed(code: Code, variable: CppField) -> bool:
    return (variable.cpp.source.path, variable.name) in code.constants
