"""The model's names of what a class of generated code declares."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from tree_sitter import Node

from rebsync.model import Type
from rebsync.names import carry, free_name, uncarry
from rebsync.reserved import RESERVED, RESERVED_GLOBALS, RUNTIME_MEMBERS
from rebsync.reverse.bodies.scope import Called, Runtime
from rebsync.reverse.bodies.types.cpp_types import Carried, carried, type_of
from rebsync.reverse.generated.cpp_roles import Roles
from rebsync.reverse.generated.own_parameters import Stored
from rebsync.reverse.generated.ros2_words import message_name
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppField, CppFunction
from rebsync.reverse.syntax.cpp_tree import named, text_of

_RUNTIME: dict[str, Runtime] = {
    "Mailbox": Runtime("mailbox"),
    "Drive": Runtime("drive"),
    "Sensor": Runtime("sensor"),
}


def runtime_of(member: CppField) -> Runtime | None:
    """What a member is of the run-time part of generated code, if it is of it."""
    return _RUNTIME.get(text_of(member.type).partition("<")[0])


def variable_name(roles: Roles, member: CppField) -> str:
    """The model's name of a member variable: that of the known rebec or constant that it holds."""
    known = roles.known.get(member.name)
    if known is not None:
        return known
    name = _own_name(member)
    if member.name not in roles.globals:
        return name
    key, _ = roles.globals[member.name]
    return name if key in (name, free_name(name, {name})) else uncarry(key, RESERVED_GLOBALS)


def stored_in(code: Code, roles: Roles, owner: CppClass) -> list[Stored]:
    """The state variables of a class that parameters of the node are stored in."""
    return [
        Stored(variable_name(roles, f), type_, roles.own[f.name], f.cpp.span(f.node))
        for f in owner.fields
        if f.name in roles.own and (type_ := declared_type(code, f.type)) is not None
    ]


def _own_name(member: CppField) -> str:
    """The model's name behind a member's, from its marker unless it was renamed."""
    for marker in member.markers:
        kind, path, *_ = [*marker.split(), "", ""]
        name = path.rpartition(".")[2]
        carried = re.escape(carry(name, RUNTIME_MEMBERS))
        if kind in ("statevar", "env") and re.fullmatch(rf"{carried}_(_\d+)?", member.name):
            return name
    return uncarry(member.name.removesuffix("_"), RUNTIME_MEMBERS)


def plain_name(function: CppFunction, types: Collection[str]) -> str:
    """The model's name of a function, from its marker unless it was renamed.

    `types` are the names of classes and messages, which functions give way to.
    """
    reserved = RESERVED | set(types)
    for marker in function.markers:
        kind, path, *_ = [*marker.split(), "", ""]
        name = path.rpartition(".")[2]
        if kind not in ("msgsrv", "method") or not path:
            continue
        apart = function.name.startswith(f"{name}_")  # from overloads that C++ cannot tell
        if apart or carry(name, reserved) == function.name:
            return name
    return uncarry(function.name, reserved)


def called(code: Code, function: CppFunction, types: Collection[str]) -> Called:
    """A function that is a local method, with the type of its result."""
    result = declared_type(code, function.result) if function.result is not None else None
    return Called(plain_name(function, types), returns=result, function=function)


def has_mailbox(code: Code, owner: CppClass) -> bool:
    """Whether a class, or one above it, is a reactive class: it serves messages."""
    fields = (f for c in code.lineage(owner.name) for f in c.fields)
    return any(text_of(f.type) == "Mailbox" for f in fields)


def is_abstract(owner: CppClass) -> bool:
    """Whether no node is of this class: then it does not say what its state is."""
    return not any(f.name == "publishState" and not f.pure for f in owner.functions)


def is_interface(owner: CppClass, alone: bool) -> bool:
    """Whether a class only says what its heirs can do.

    `alone`, where there is no generated node, only a marker tells it from people's own classes.
    """
    if alone and not any(marker.startswith("interface ") for marker in owner.markers):
        return False
    ends = [f for f in owner.functions if f.name == f"~{owner.name}"]
    others = (f for f in owner.functions if f not in ends)
    plain = len(ends) == 1 and (ends[0].body is None or not named(ends[0].body))
    return not owner.fields and plain and all(f.pure for f in others)


def state_types(code: Code, owner: CppClass) -> Iterator[str]:
    """The types of the messages that tell the state of a class's nodes."""
    for function in code.functions_of(owner):
        if function.name == "publishState" and function.body is not None:
            for statement in named(function.body)[:1]:
                type_ = statement.child_by_field_name("type")
                if type_ is not None:
                    yield message_name(text_of(type_))


def enumerators(code: Code) -> dict[str, int]:
    """The constants of enumerations by their names, alone and after the enumeration's.

    Not where there are several of a name with different values, or a constant of that name.
    """
    values: dict[str, set[int | None]] = {}
    constants = {name for _, name in code.constants}
    for name, all_of in code.enumerators.items():
        for each in all_of:
            alone = {""} if name not in constants else set[str]()
            for prefix in alone | {f"{each.enum}::", f"{each.scope}::"} - {"::"}:
                values.setdefault(f"{prefix}{name}", set()).add(each.value)
    return {n: v for n, vs in values.items() for v in vs if len(vs) == 1 and v is not None}


def narrow_enums(code: Code) -> dict[str, Carried | None]:
    """What the model keeps of the types of enumerations that are said not to be of an int."""
    enums = {e.enum: e.node.parent for all_of in code.enumerators.values() for e in all_of}
    bases = {n: b.parent.child_by_field_name("base") for n, b in enums.items() if b and b.parent}
    kept = {name: carried(base) for name, base in bases.items() if base is not None}
    return {name: of for name, of in kept.items() if of != Carried(Type("int"))}


def aliases(code: Code) -> dict[str, Carried | None]:
    """What the model keeps of the types that the code names, each by one name only."""
    found = narrow_enums(code)
    for name, all_of in code.aliases.items():
        kept = carried(all_of[0].type)
        is_one = len({text_of(alias.type) for alias in all_of}) == 1
        if kept is not None and is_one and name not in code.all_classes:
            found[name] = kept
    return found


_ATOMIC = re.compile(r"(?:std::)?atomic<(?:std::)?(bool|int|int32_t)>")
_HELD = {"bool": "boolean", "int": "int", "int32_t": "int"}


def declared_type(code: Code, node: Node) -> Type | None:
    """The model's type for a C++ type, or for what an alias or an atomic object stands for.

    What another thread does to such an object is listed where that thread is begun.
    """
    if (held := _ATOMIC.fullmatch("".join(text_of(node).split()))) is not None:
        return Type(_HELD[held[1]])
    aliases = code.aliases.get(text_of(node), ()) if node.type == "type_identifier" else ()
    types = {type_of(alias.type) for alias in aliases}
    return types.pop() if len(types) == 1 else type_of(node)


def is_given(function: CppFunction) -> bool:
    """Whether C++ itself defines a function, or forbids it: `= default`, `= delete`."""
    kinds = ("default_method_clause", "delete_method_clause")
    return any(child.type in kinds for child in function.node.named_children)
