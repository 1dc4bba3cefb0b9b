"""`Duration wait(seconds());`, which the grammar takes for a declaration of a function.

Only what names stand for tells it from one ([dcl.ambig.res]): a name that is no type is called.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_call_effects import is_calm
from rebsync.reverse.bodies.effects.cpp_effect_reader import EffectReader
from rebsync.reverse.bodies.scope import Called, Ignored, Inline, meant_by
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.looked_through import is_library
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.syntax.cpp_declarations import unscoped
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of

_CALLED = "abstract_function_declarator"
_NAMES = frozenset({"type_identifier", "qualified_identifier", "template_type"})


def check_misparsed(effects: EffectReader, declarator: Node) -> None:
    """Raises `Touches` where a declaration makes an object with a call that may do something."""
    for parameter in inside(part(declarator, "parameters"), "parameter_declaration"):
        type_ = part(parameter, "type")
        calls = list(_calls(parameter.child_by_field_name("declarator")))
        if type_.type in _NAMES and calls and not _is_harmless(effects, type_, calls):
            why = f'what "{text_of(parameter)}" does is not known where an object is made with it'
            raise effects.touches(parameter, why, "give it a name before")


def _calls(declarator: Node | None) -> Iterator[Node]:
    """What looks like the parameters of functions without a name: `(x)` twice in `f(x)(x)[0]`."""
    while declarator is not None and declarator.type.startswith("abstract_"):
        if declarator.type == _CALLED:
            yield declarator
        below = declarator.child_by_field_name("declarator")
        is_wrapped = below is None and declarator.type == "abstract_parenthesized_declarator"
        declarator = next(iter(named(declarator)), None) if is_wrapped else below


def _is_harmless(effects: EffectReader, type_: Node, calls: Sequence[Node]) -> bool:
    """Whether a name is that of a type, or of a function that does nothing to the model.

    What a function gives may be called as well: what that does is not known.
    """
    scope, name, form = effects.scope, unscoped(type_), effects.scope.form
    if form is None or form.objects.is_type(name):
        return True
    if form.places.may_convert or len(calls) > 1:
        return False
    match scope.functions.get(name):
        case Called() | Inline() as known:
            count = len(named(part(calls[0], "parameters")))
            meant = meant_by(known, name, count)
            return bool(meant) and all(
                is_calm(effects, f)
                and not form.throws(f)
                and len(f.parameters) == count
                and not any(p.may_change for p in f.parameters)
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
