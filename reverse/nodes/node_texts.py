"""Variables of texts with which code does more than to copy and to compare them: none is kept."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.scope import Member, Outside, Record, Stores, Variable
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.nodes.node_state import State
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import text_of


def leave_out(state: State, names: Collection[str]) -> None:
    """Takes some variables, by their names in the model, for what the model does not have."""
    for name in names:
        del state.variables[name]
    for members in (state.members, *state.local.values()):
        for name, member in members.items():
            members[name] = _without(member, names)
    state.initial[:] = [(cpp, stores) for cpp, stores in state.initial if _is_kept(stores, names)]
    for instead in state.outlived.values():
        for node, all_of in instead.items():
            instead[node] = tuple(stores for stores in all_of if _is_kept(stores, names))


def forgets(
    state: State, function: CppFunction | None, target: Node | None, of: m.Type | None
) -> bool:
    """Takes a text that gets an unknown value for what the model does not have.

    False: it is a local text, or a field of a message that is none.
    """
    text = text_of(target) if target is not None else ""
    name, _, path = text.removeprefix("this->").partition(".")
    match state.members_of(function).get(name):
        case Variable(of_model, type_) if not path:
            if type_ == TEXT:
                leave_out(state, (of_model,))
            return True
        case Record(fields) if path in fields and fields[path].type == TEXT:
            leave_out(state, (fields[path].name,))
            return True
        case Record(fields):
            return path not in fields
        case found:
            return found is not None or of != TEXT


def _without(member: Member, names: Collection[str]) -> Member:
    match member:
        case Variable(name) if name in names:
            return Outside()
        case Record(fields):
            kept = {path: v for path, v in fields.items() if v.name not in names}
            return member if len(kept) == len(fields) else replace(member, fields=kept)
        case _:
            return member


def _is_kept(stores: Stores, names: Collection[str]) -> bool:
    return not (isinstance(stores.target, m.Name) and stores.target.name in names)
