"""`Duration wait(seconds());`, which the grammar takes for a declaration of a function.

Only what names stand for tells it from one ([dcl.ambig.res]): a name that is no type is called.
"""

from __future__ import annotations

from functools import cache

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_call_effects import is_calm
from rebsync.reverse.bodies.effects.cpp_effect_reader import EffectReader
from rebsync.reverse.bodies.effects.cpp_undefined import is_library
from rebsync.reverse.bodies.scope import Called, Ignored, Inline, meant_by
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.syntax.cpp_declarations import unscoped
from rebsync.reverse.syntax.cpp_tree import named, part, text_of

_CALLS = frozenset({"abstract_function_declarator"})
_NAMES = frozenset({"type_identifier", "qualified_identifier", "template_type"})


def check_misparsed(effects: EffectReader, declarator: Node) -> None:
    """Raises `Touches` where a declaration makes an object with a call that may do something."""
    for parameter in named(part(declarator, "parameters")):
        around, type_ = parameter.child_by_field_name("declarator"), part(parameter, "type")
        if around is None or around.type not in _CALLS or type_.type not in _NAMES:
            continue
        if not _is_harmless(effects, type_, around):
            why = f'what "{text_of(parameter)}" does is not known where an object is made with it'
            raise effects.touches(parameter, why, "give it a name before")


def _is_harmless(effects: EffectReader, type_: Node, around: Node) -> bool:
    """Whether a name is that of a type, or of a function that does nothing to the model."""
    scope, name, form = effects.scope, unscoped(type_), effects.scope.form
    if form is None or form.unread_calls.is_type(name):
        return True
    if form.unread_calls.implicit.may_convert:
        return False
    match scope.functions.get(name):
        case Called() | Inline() as known:
            count = len(named(part(around, "parameters")))
            meant = meant_by(known, name, count)
            return bool(meant) and all(
                is_calm(effects, f) and not form.throws(f) and len(f.parameters) == count
                for f in meant
            )
        case None if type_.type == "qualified_identifier":
            known_so = _outcomes().function("".join(text_of(type_).split()))
            return is_library(text_of(type_)) and not (known_so.raises or known_so.acts)
        case None | Ignored():
            return name in libraries.looking()
        case _:
            return False


@cache
def _outcomes() -> LibraryOutcomes:
    return LibraryOutcomes(Language.CPP)
