"""Whether calls in C++ can touch what the model has: of functions, of methods, of what is held."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_algorithms import looked_at, only_counts
from rebsync.reverse.bodies.cpp_macros import macro_bodies
from rebsync.reverse.bodies.cpp_mailbox import has_mailbox
from rebsync.reverse.bodies.effects import known_functions
from rebsync.reverse.bodies.effects.cpp_effect_reader import EffectReader
from rebsync.reverse.bodies.effects.cpp_kinds import OF_TEXTS
from rebsync.reverse.bodies.effects.cpp_roots import is_modelled
from rebsync.reverse.bodies.effects.touches import Touches
from rebsync.reverse.bodies.effects.unknown_names import is_method_of_unknown, is_unknown_function
from rebsync.reverse.bodies.scope import (
    Called,
    Ignored,
    Inline,
    Itself,
    Lambda,
    Meaning,
    Outside,
    Publishes,
    Record,
    Runtime,
    TimerOf,
    Variable,
    meant_by,
)
from rebsync.reverse.bodies.serving import Serves
from rebsync.reverse.findings import Unread
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.reverse.syntax.macros import hides

RENAMED = "the object itself gets another name here"


def gives_itself(node: Node) -> bool:
    """Whether a value is a pointer to the object, or may be."""
    match node.type:
        case "this":
            return True
        case "parenthesized_expression" | "conditional_expression":
            return any(map(gives_itself, named(node)))
        case "cast_expression":
            return gives_itself(part(node, "value"))
        case "call_expression" if "_cast<" in text_of(part(node, "function")):
            return any(map(gives_itself, named(part(node, "arguments"))))
        case _:
            return False


def check_call(effects: EffectReader, node: Node) -> None:
    """Raises `Touches` where a call may touch what the model has."""
    call = effects.scope.call(node)
    if call is None or call.name.startswith("["):
        raise effects.touches(node, "this runs a function of its own")
    name, known = call.name.rpartition("::")[2], False
    of, meaning = effects.root_of(call.target) if call.target is not None else ("", None)
    if call.target is None or isinstance(meaning, Itself):
        known = _function(effects, call, name)
        known = _is_matrix(effects, node, name, call) or known
    else:
        _method(effects, call, name, of, meaning)
        known = _takes_copies(effects, call)
    does = known_functions.acts(effects.cpp, call, has_mailbox(effects.scope))
    if does is not None:
        raise effects.touches(node, f'"{text_of(part(node, "function"))}" {does}')
    if looked_at(call):
        return
    if only_counts(call):
        effects.arguments(call.arguments[2:])
        return
    if call.target is not None and any(map(gives_itself, call.arguments)):
        raise effects.touches(node, RENAMED)  # also a container, which only copies it
    if known or known_functions.takes_values(call):
        for argument in call.arguments:
            effects.check(argument)
        return
    effects.arguments(call.arguments)


def _is_constant(effects: EffectReader, node: Node) -> bool:
    form = effects.scope.form
    return form is not None and form.objects.is_constant(effects.cpp, node)


def _is_calm_helper(effects: EffectReader, call: CppCall) -> bool:
    """Whether a function of the files outside of classes is called, which only looks."""
    form = effects.scope.form
    if form is None or call.name in effects.inner or effects.scope.meaning(call.name) is not None:
        return False
    helper = form.objects.free_function(call)
    if helper is None or any(known_functions.may_change(p) for p in helper.parameters):
        return False
    return is_calm(effects, helper)


def _takes_copies(effects: EffectReader, call: CppCall) -> bool:
    """Whether a method of an object of the files gets values, and changes that object alone."""
    form = effects.scope.form
    meant = form.objects.methods_meant(effects.cpp, call) if form is not None else ()
    if any(known_functions.may_change(p) for f in meant for p in f.parameters):
        return False
    near = all(f.cpp is effects.cpp or _is_in_class(f) for f in meant)
    return bool(meant) and near and all(is_calm(effects, f) for f in meant)


def _is_in_class(function: CppFunction) -> bool:
    """Whether a body stands in its class, and not in a file that only that class is read from."""
    above = function.node.parent
    return above is not None and above.type == "field_declaration_list"


def check_macro(effects: EffectReader, node: Node) -> None:
    """Raises `Touches` where a macro without parameters stands for what does something."""
    form = effects.scope.form
    if form is None or not form.acting_macros or node.text not in form.acting_macros:
        return
    name = text_of(node)
    if name not in effects.inner and (given := effects.scope.constants.get(name)) is not None:
        try:
            effects.anew(given[0], effects.scope, effects.inner).check(given[1])
        except Touches as touches:
            raise effects.touches(node, touches.why) from None


def check_read(effects: EffectReader, node: Node) -> None:
    """Raises `Touches` where a piece of code may run what was not read: that may do anything.

    What runs though no call of it stands there must only look.
    """
    form = effects.scope.form
    if form is None:
        return
    if (why := form.places.unread(effects.cpp, node)) is not None:
        raise effects.touches(node, why)
    for function in form.places.unwritten(effects.cpp, node):
        if not is_calm(effects, function):
            raise effects.touches(node, f'"{function.name}" may change what the model has')


def check_deleted(effects: EffectReader, node: Node) -> None:
    """Raises `Touches` where what is ended something may still use."""
    pointer = named(node)[-1]
    if has_mailbox(effects.scope) or gives_itself(pointer):
        raise effects.touches(node, "this ends an object that something may still use")
    effects.check(pointer)


def _function(effects: EffectReader, call: CppCall, name: str) -> bool:
    """Whether a function of the code only looks; `Touches` if it acts on more than it gets."""
    meant: tuple[CppFunction, ...] = ()
    match effects.scope.functions.get(name):
        case None if hides(name) or name in effects.scope.macros:
            if _is_calm_macro(effects, name):
                return True
            raise effects.touches(call.node, f'"{name}" may be a macro that hides statements')
        case Ignored() if call.name == name and name not in effects.inner:
            return True  # what it is given is looked at by whoever asks
        case None | Ignored():
            if _is_calm_helper(effects, call):
                return True
            form = effects.scope.form  # which knows other names: `using Clock = ...;`
            is_other = form is not None and form.places.only_looks(effects.cpp, call.node)
            if not is_other and is_unknown_function(effects.scope, effects.inner, call):
                raise effects.touches(call.node, f'nobody here knows what "{call.name}" does')
            return False
        case Called() | Inline() as known:
            meant = meant_by(known, call.name, len(call.arguments))
    if not meant or not all(is_calm(effects, f) for f in meant):
        raise effects.touches(call.node, f'"{name}" may change what the model has')
    return not any(known_functions.may_change(p) for f in meant for p in f.parameters)


def _is_matrix(effects: EffectReader, node: Node, name: str, call: CppCall) -> bool:
    """Whether a matrix is called; a function that somebody has put there may do anything.

    But for one that only gets an object that is outside, as a distribution gets a generator.
    """
    meaning = None if name in effects.inner else effects.scope.meaning(name)
    if isinstance(meaning, Outside):
        only = call.arguments[0] if len(call.arguments) == 1 else None
        if meaning.indexed or (only and isinstance(effects.root_of(only)[1], Outside)):
            return meaning.indexed
    if meaning is not None:
        raise effects.touches(node, f'"{name}" may change what the model has')
    return False


def _is_calm_macro(effects: EffectReader, name: str) -> bool:
    """Whether a macro only looks at what it gets, and touches nothing else, at this place."""
    bodies = macro_bodies(effects.scope, effects.cpp.source.path, name)
    try:
        for each in bodies:
            inner = effects.inner - each.parameters
            effects.anew(each.cpp, each.scope, inner).check(each.statements)
    except Unread:
        return False
    return bool(bodies)


def is_calm(effects: EffectReader, function: CppFunction) -> bool:
    """Whether a body touches nothing but what it declares, or gets."""
    if function.body is None:
        return False
    form = effects.scope.form
    if form is not None and effects.scope.calm.is_running(function.body.id):
        return not form.recurses(function)  # but one of several by a name
    scope, looks = effects.scope, partial(_looks, effects, function, function.body)
    return scope.calm.of(function.body.id, scope.members, scope.functions, looks)


def _looks(effects: EffectReader, function: CppFunction, body: Node) -> bool:
    inner, scope = {p.name for p in function.parameters}, replace(effects.scope, locals={})
    try:
        effects.anew(function.cpp, scope, inner, returning=True).check(body)
    except (Touches, RecursionError):  # what leads too deep may do anything
        return False
    return True


def _method(
    effects: EffectReader, call: CppCall, name: str, of: str, meaning: Meaning | None
) -> None:
    """A call of a function of some object."""
    target = call.target
    assert target is not None
    match meaning:
        case None if _is_constant(effects, target):
            pass
        case None if is_method_of_unknown(effects.scope, effects.inner, of, name):
            raise effects.touches(call.node, f'nobody here knows what "{text_of(target)}" is')
        case None | Outside(reaches=False):
            if name in libraries.named(Kind.PUBLISH) and (
                meaning is not None or not of or of in effects.inner
            ):
                raise effects.touches(call.node, "what is published here is not known")
        case Outside():
            raise effects.touches(call.node, f'"{text_of(target)}" may act on the node')
        case Publishes(targets):
            if name in libraries.named(Kind.PUBLISH) and not targets:
                return
            if name not in libraries.looking():
                raise effects.touches(call.node, "this sends, or ends that the node can send")
        case Serves() | TimerOf():
            if name not in libraries.looking():
                raise effects.touches(call.node, "this changes a timer, subscription or service")
        case Variable(type=type_) if name == "load" and type_ and not type_.dimensions:
            pass  # of an atomic number
        case Record() | Variable():
            if name not in (libraries.looking() | OF_TEXTS) and is_modelled(target, meaning):
                effects.changes(call.node, of, f'this may change "{of}"')
        case Runtime() | Lambda() | Itself() if name not in libraries.looking():
            raise effects.touches(call.node, f'"{of}" acts on the node')
        case _:
            if name not in libraries.looking() and is_modelled(target, meaning):
                raise effects.touches(call.node, f'this may change "{of}"')
    effects.check(target)
