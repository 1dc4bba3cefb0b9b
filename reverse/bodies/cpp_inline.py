"""Functions whose bodies stand in the place of their calls."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import cpp_given, cpp_idioms, cpp_moments, cpp_sequencing
from rebsync.reverse.bodies.cpp_messages import declare, is_pointer, message_type, zero_of
from rebsync.reverse.bodies.cpp_places import is_this, resolve
from rebsync.reverse.bodies.cpp_pointer_parameters import check_pointer
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.bodies.effects import cpp_captures
from rebsync.reverse.bodies.effects.cpp_effects import Effects
from rebsync.reverse.bodies.effects.cpp_roots import is_element
from rebsync.reverse.bodies.effects.known_functions import is_matrix
from rebsync.reverse.bodies.returns import without_returns
from rebsync.reverse.bodies.scope import (
    Inline,
    Itself,
    Lambda,
    Meaning,
    Outside,
    Publishes,
    Record,
    TimerOf,
    Variable,
)
from rebsync.reverse.bodies.serving import Serves
from rebsync.reverse.bodies.types import cpp_aliases
from rebsync.reverse.bodies.types.cpp_types import Carried
from rebsync.reverse.bodies.types.cpp_widths import place_of
from rebsync.reverse.models.building import bare, is_calm, is_effect
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_declarations import CppParameter, parameter_of
from rebsync.reverse.syntax.cpp_depth import DEEPEST, depth_of
from rebsync.reverse.syntax.cpp_tree import Cpp, default_of, named, part, text_of
from rebsync.static.constants import constant as constant_of

_DEEPEST = 8
_PLACES = frozenset(
    {"subscript_expression", "field_expression", "pointer_expression", "conditional_expression"}
)


def inlined(
    reader: CppStatementReader, node: Node, function: Inline | Lambda, arguments: Sequence[Node]
) -> Meaning | None:
    """Puts the statements of a function before the one that is read; what the call gives."""
    inside, body, parameters, result = _entered(reader, node, function, arguments)
    key = body.start_byte, inside.cpp.source.path
    if key in reader.shared.running or len(reader.shared.running) >= _DEEPEST:
        raise reader.unread(node, "a function that calls itself has no end here")
    depth = depth_of(node)
    if reader.shared.depth + depth > DEEPEST:
        raise reader.unread(node, "with the body of this function it nests too deep")
    if len(arguments) > len(parameters):
        raise reader.unread(node, "there are more arguments here than parameters")
    cpp_sequencing.check_arguments(reader, arguments)
    needed, single = len(reader.before), cpp_given.single(body)
    once = single is not None and not (
        cpp_sequencing.changes(reader, arguments, frozenset())
        or cpp_sequencing.changes(inside, [single], frozenset(p.name for p in parameters))
    )
    for parameter, argument in zip(parameters, arguments, strict=False):
        reader.before += _bound(reader, inside, parameter, argument, once)
        check_pointer(inside, parameter, argument, body)
    for parameter in parameters[len(arguments) :]:
        reader.before += _left_out(reader, inside, parameter, node)
    reader.shared.running.append(key)
    reader.shared.depth += depth
    try:
        if single is not None:
            value = cpp_given.value_of(reader, inside, single, result)
            reader.before += inside.before
            found: Meaning | None = cpp_given.apart(reader, function, node, result, value)
        else:
            found = _body(reader, inside, body, result)
    finally:
        reader.shared.running.pop()
        reader.shared.depth -= depth
    if len(reader.before) > needed:
        cpp_sequencing.check_place(reader, node)
        cpp_sequencing.check_call(reader, node)
    return found


def only_value(
    reader: CppStatementReader, node: Node, function: Inline, arguments: Sequence[Node]
) -> tuple[CppStatementReader, Node] | None:
    """What a function that does nothing else gives, and who reads it: in braces, several values."""
    inside, body, parameters, _ = _entered(reader, node, function, arguments)
    statements = named(body)
    if len(statements) != 1 or statements[0].type != "return_statement":
        return None
    if len(arguments) != len(parameters) or not named(statements[0]):
        return None
    cpp_sequencing.check_arguments(reader, arguments)
    for parameter, argument in zip(parameters, arguments, strict=True):
        reader.before += _bound(reader, inside, parameter, argument, False)
        check_pointer(inside, parameter, argument, body)
    return inside, named(statements[0])[0]


def dropped(reader: CppStatementReader, node: Node, given: Meaning | None) -> Iterator[m.Statement]:
    """What is left of a value that a function gives and nobody takes: what it changes."""
    if isinstance(given, m.Expression):
        if is_effect(given):
            yield m.ExpressionStatement(bare(given), (), reader.cpp.span(node))
        elif not is_calm(given):
            raise reader.unread(node, "what this changes stands within an expression")


def _entered(
    reader: CppStatementReader, call: Node, function: Inline | Lambda, arguments: Sequence[Node]
) -> tuple[CppStatementReader, Node, Sequence[CppParameter], Node | None]:
    """A reader for the body of a function, the body, its parameters and the type of its result."""
    match function:
        case Inline(called, constants):
            if called.body is None:
                raise reader.unread(called.node, "this function has no body here")
            known = reader.scope.constants if constants is None else constants
            types, numbers = cpp_aliases.instantiated(reader, call, called, arguments)
            scope = replace(reader.scope, locals=numbers, constants=known, aliases=types)
            inside = reader.inside(called.cpp, scope, frozenset())
            return inside, called.body, called.parameters, called.result
        case Lambda(node, kept, own):
            cpp_captures.check(reader, function)
            if kept is None:
                return _of_member(reader, node)
            visible = reader.scope.locals.keys() | own
            around = {n: x for n, x in kept.locals.items() if n in visible}
            inside = reader.inside(reader.cpp, replace(kept, locals=around), reader.own)
            declarator = node.child_by_field_name("declarator")
            return (
                inside,
                part(node, "body"),
                _parameters(inside.cpp, declarator),
                _trailing(declarator),
            )


def _of_member(
    reader: CppStatementReader, node: Node
) -> tuple[CppStatementReader, Node, Sequence[CppParameter], Node | None]:
    """The same for a lambda that a member holds."""
    if [node, *ancestors(node)][-1].id != reader.cpp.root.id:
        raise reader.unread(node, "this function is put into its member in another file")
    inside = reader.inside(reader.cpp, replace(reader.scope, locals={}), frozenset())
    declarator = node.child_by_field_name("declarator")
    return inside, part(node, "body"), _parameters(inside.cpp, declarator), _trailing(declarator)


def _parameters(cpp: Cpp, declarator: Node | None) -> tuple[CppParameter, ...]:
    """The parameters of a lambda, with what they are where a call leaves them out."""
    declared = named(part(declarator, "parameters")) if declarator is not None else ()
    values = ((parameter_of(p), default_of(p)) for p in declared)
    return tuple(replace(p, default=(cpp, v) if v is not None else None) for p, v in values)


def _trailing(declarator: Node | None) -> Node | None:
    for child in named(declarator) if declarator is not None else ():
        if child.type == "trailing_return_type":
            return named(child)[0]
    return None


# --- parameters ---------------------------------------------------------------------------------


def _bound(
    reader: CppStatementReader,
    inside: CppStatementReader,
    parameter: CppParameter,
    argument: Node,
    once: bool,
) -> Iterator[m.Statement]:
    """What a parameter stands for in the body."""
    name = parameter.name
    if not name:
        Effects(reader.cpp, reader.scope).check(argument)
        return
    if cpp_moments.is_for_time(reader, parameter, argument):
        yield from cpp_moments.bound(reader, inside, parameter, argument, argument)
        return
    constant = any(text_of(c) == "const" for c in parameter.node.named_children)
    refers = parameter.refers or is_pointer(text_of(parameter.type))
    type_ = message_type(reader.scope, text_of(parameter.type))
    meaning = resolve(reader.scope, argument)
    if isinstance(meaning, Record):
        if refers or (meaning.pointer and argument.type == "identifier"):
            inside.meaning(name, replace(meaning, constant=constant or meaning.constant))
            return
        type_ = type_ or meaning.type
    if isinstance(meaning, Publishes | Serves | TimerOf):
        inside.meaning(name, meaning)
        return
    if is_this(argument) or isinstance(meaning, Itself):
        inside.meaning(name, Itself())
        return
    if type_:
        yield from _copied(reader, inside, name, type_, argument)
        return
    kept = cpp_aliases.type_of(reader, inside, parameter, argument)
    bound = refers and (not constant or _is_bound(argument, meaning, kept))
    if bound and isinstance(meaning, Variable):
        inside.meaning(name, meaning)
        return
    if bound and argument.type == "subscript_expression":
        place = reader.expressions.read(argument)
        if isinstance(place, m.Index) and constant_of(place.index) is not None:
            inside.meaning(name, place)
            return
    if bound or kept is None:
        effects = Effects(reader.cpp, reader.scope)
        effects.check(argument)
        if bound:
            effects.refers(argument)
        inside.meaning(name, Outside(indexed=is_matrix(text_of(parameter.type))))
        return
    yield from _valued(reader, inside, name, place_of("", kept), argument, once)


def _is_bound(argument: Node, meaning: Meaning | None, kept: Carried | None) -> bool:
    """Whether a `const` reference is one to a place that may change, not to a copy of its value."""
    if isinstance(meaning, Variable):
        own = (meaning.type, meaning.bits, meaning.wide)
        return kept is None or own == (kept.type, kept.bits, kept.wide)
    return argument.type in _PLACES or is_element(argument)


def _left_out(
    reader: CppStatementReader, inside: CppStatementReader, parameter: CppParameter, node: Node
) -> Iterator[m.Statement]:
    """A parameter that a call leaves out."""
    if not parameter.name:
        return
    if cpp_moments.is_for_time(reader, parameter, None):
        yield from cpp_moments.bound(reader, inside, parameter, node, None)
        return
    kept = inside.scope.carried(parameter.type)
    if kept is None or kept.type.dimensions:
        raise reader.unread(node, "what is left out of this call is no value of the model")
    place = place_of(parameter.name, kept)
    value = cpp_idioms.left_out(reader.expressions, node, parameter, place)
    local = replace(place, name=reader.fresh(parameter.name, inlining=True))
    reader.shared.made.add(local.name)
    inside.meaning(parameter.name, local, own=True)
    yield reader.local(node, local, value)


def _copied(
    reader: CppStatementReader, inside: CppStatementReader, name: str, type_: str, argument: Node
) -> Iterator[m.Statement]:
    before = reader.scope
    yield from declare(reader, argument, name, type_, argument, pointer=False, inlining=True)
    inside.meaning(name, reader.scope.locals[name], own=True)
    reader.scope = before


def _valued(
    reader: CppStatementReader,
    inside: CppStatementReader,
    name: str,
    place: Variable,
    argument: Node,
    once: bool,
) -> Iterator[m.Statement]:
    try:
        value = reader.expressions.stored(argument, place)
    except Unknown:
        Effects(reader.cpp, reader.scope).check(argument)
        inside.meaning(name, Outside(place.type))
        return
    if once and is_calm(value) and not place.wide:
        same = value if reader.scope.open else cpp_given.as_type(reader, inside, value, place)
        if same is not None:
            inside.meaning(name, same)
            return
        if place.bits:
            raise reader.unread(argument, "the type of the parameter may make another number of it")
    if name in reader.shared.demoted or place.type is None:
        inside.meaning(name, Outside(place.type))
        return
    local = replace(place, name=reader.fresh(name, inlining=True))
    reader.shared.made.add(local.name)
    inside.meaning(name, local, own=True)
    yield reader.local(argument, local, value)


# --- the body -----------------------------------------------------------------------------------


def _body(
    reader: CppStatementReader, inside: CppStatementReader, body: Node, result: Node | None
) -> Meaning | None:
    place = cpp_given.result_of(reader, inside, body, result)
    statements = inside.read(body.named_children)
    if isinstance(place, Variable) and place.type is not None:
        reader.shared.made.add(place.name)
        reader.before.append(reader.local(body, place, zero_of(place.type)))
        reader.scope.results[place.name] = place
    target = m.Name(place.name) if isinstance(place, Variable) else None
    done = without_returns(statements, target)
    if done is None:
        raise reader.unread(body, "a return in a loop has no place in another body")
    reader.before += done
    return place
