"""Local variables that people declare: typed, `auto`, references, arrays, messages."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import (
    cpp_aggregates,
    cpp_bindings,
    cpp_messages,
    cpp_optionals,
    cpp_plain_locals,
)
from rebsync.reverse.bodies.cpp_declared import DeclaratorParts, number_of, only_value, taken_apart
from rebsync.reverse.bodies.cpp_mailbox import has_mailbox
from rebsync.reverse.bodies.cpp_messages import zero_of
from rebsync.reverse.bodies.cpp_misparsed import check_misparsed
from rebsync.reverse.bodies.cpp_places import is_this, resolve
from rebsync.reverse.bodies.cpp_references import is_made, is_made_pointer, message_of, stays
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.cpp_time import seconds_of
from rebsync.reverse.bodies.effects import cpp_captures
from rebsync.reverse.bodies.effects.cpp_call_effects import check_read
from rebsync.reverse.bodies.effects.cpp_effects import Effects, is_bound
from rebsync.reverse.bodies.effects.cpp_roots import specifiers_of
from rebsync.reverse.bodies.effects.known_functions import is_matrix, type_takes_values
from rebsync.reverse.bodies.effects.touches import Touches
from rebsync.reverse.bodies.scope import Itself, Meaning, Outside, Record, Variable
from rebsync.reverse.bodies.types.cpp_conversions import converted_to, type_in
from rebsync.reverse.bodies.types.cpp_types import Carried
from rebsync.reverse.bodies.types.cpp_widths import is_only_compared, place_of, wide_of
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.models.texts import TEXT, is_constant
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.constants import constant
from rebsync.static.types import BYTE, INT, SHORT

_VECTOR = re.compile(r"(?:std::)?vector<(.*)>\Z")
_RESIZES = ("push_back", "emplace_back", "resize", "insert", "erase", "clear", "assign", "swap")
_REFERS = ("reference_declarator", "pointer_declarator")


def declarations(reader: CppStatementReader, node: Node) -> Iterator[m.Statement]:
    """The locals of a declaration; what the model has nothing like is outside from here on."""
    type_ = node.child_by_field_name("type") or node
    text = text_of(type_)
    if type_ is node or reader.scope.meaning(text) is not None:
        why = "this looks like a declaration, but starts with a variable"
        raise reader.unread(node, why, "put it in parentheses")
    words = specifiers_of(node)
    kept_elsewhere = "static" in words or "thread_local" in words
    constant_ = "const" in words or "constexpr" in words
    for declarator in node.children_by_field_name("declarator"):
        declared = taken_apart(declarator, type_, text, constant_)
        if declared.kind == "reference_declarator" and declared.value is None:
            why = "this looks like a declaration, but it is none"
            raise reader.unread(node, why, "put it in parentheses")
        if kept_elsewhere and not declared.constant:
            _static(reader, declared)
            continue
        if kept_elsewhere and (number := number_of(reader, declared)) is not None:
            reader.meaning(declared.name, number)
            continue
        try:
            if kept_elsewhere and "constexpr" not in words and _looks_around(declared.value):
                raise reader.unread(node, "this keeps the value that it was first given")
            yield from _declared(reader, declared)
        except Unread as unread:
            if not reader.scope.open:
                raise
            _outside(reader, declared, unread)


def _looks_around(value: Node | None) -> bool:
    """Whether a value names something, which may hold something else another time."""
    is_name = value is not None and value.type in ("identifier", "field_identifier", "this")
    return is_name or (value is not None and any(map(_looks_around, named(value))))


def tested(reader: CppStatementReader, node: Node) -> Iterator[m.Statement]:
    """`if (int x = f())`: the local that the condition declares."""
    declarator, value = part(node, "declarator"), part(node, "value")
    if declarator.type != "identifier":
        raise reader.unread(node, "the model has no pointers and references")
    type_ = part(node, "type")
    text, name = text_of(type_), text_of(declarator)
    declared = DeclaratorParts(node, type_, name, "identifier", value, None, False, text)
    try:
        yield from _declared(reader, declared)
    except Unread as unread:
        _outside(reader, declared, unread)


def _static(reader: CppStatementReader, declared: DeclaratorParts) -> None:
    """A local that keeps its value: a state variable, or a value that nobody knows.

    What its first value does counts: it may be a pointer to what the model has.
    """
    if isinstance(reader.scope.members.get(declared.name), Variable | Record):
        if declared.value is not None and reader.scope.open:
            effects = Effects(reader.cpp, reader.scope, frozenset(reader.own))
            _check_value(reader, effects, declared)
        return
    why = "this local keeps its value from call to call"
    unread = reader.unread(declared.node, why, "make it a member")
    if not reader.scope.open:
        raise unread
    _outside(reader, declared, unread)


def _hidden(reader: CppStatementReader, declared: DeclaratorParts) -> Outside:
    kept = reader.scope.carried(declared.type)
    return Outside(kept.type if kept is not None else None, indexed=is_matrix(declared.text))


def _outside(reader: CppStatementReader, declared: DeclaratorParts, unread: Unread) -> None:
    """A local of which the model knows no value: only what sets it may matter."""
    try:
        effects = Effects(reader.cpp, reader.scope, frozenset(reader.own))
        if declared.kind not in _REFERS:
            check_read(effects, declared.node)
        if declared.value is not None:
            _check_value(reader, effects, declared)
            reader.demote(effects.written, unread)
        elif isinstance(unread, Touches):
            raise unread
    except Touches as touches:
        reader.meaning(declared.name, _hidden(reader, declared))
        raise touches from None
    if declared.kind == "structured_binding_declarator":
        for name in re.findall(r"\w+", declared.name):
            reader.meaning(name, Outside())
        return
    reader.meaning(declared.name, _hidden(reader, declared))


def _check_value(reader: CppStatementReader, effects: Effects, declared: DeclaratorParts) -> None:
    value = declared.value
    assert value is not None
    meaning = resolve(reader.scope, value)
    refers = declared.kind != "identifier" or is_bound(declared.text, value)
    refers = refers and not declared.constant
    if refers and isinstance(meaning, Variable | Record) and not getattr(meaning, "constant", 0):
        raise Touches(reader.cpp.span(value), "the model has no pointers and references")
    if refers:
        effects.refers(value)
    else:
        effects.made_of(declared.type if declared.kind == "identifier" else None, value)


def _declared(reader: CppStatementReader, declared: DeclaratorParts) -> Iterator[m.Statement]:
    if declared.name in reader.shared.demoted:
        raise reader.unread(declared.node, "the model cannot know its values")
    value = only_value(declared)
    if value is not None and is_this(value) and (declared.kind in _REFERS or _is_auto(declared)):
        reader.meaning(declared.name, Itself())
        return
    copies = _copies(declared) or declared.constant
    given = cpp_aggregates.parts(reader, _written(declared), declared.value) if copies else None
    if (binding := cpp_bindings.names_in(declared.node)) is not None:
        if given is not None and len(given) == len(binding):
            yield from cpp_aggregates.declared(reader, declared.node, binding, given)
            return
        yield from cpp_bindings.bound(reader, declared.node, binding, value, _copies(declared))
        return
    if given is not None:
        yield from cpp_aggregates.whole(
            reader, declared.node, declared.name, given, declared.constant
        )
        return
    if declared.kind in _REFERS:
        yield from _reference(reader, declared, value)
        return
    if declared.kind == "identifier" and (
        optional := cpp_optionals.declare(
            reader, declared.node, declared.name, declared.type, declared.value
        )
    ):
        yield from optional
        return
    if declared.kind == "function_declarator":
        yield from _called_or_made(reader, declared)
        return
    type_ = cpp_messages.message_type(reader.scope, declared.text)
    if type_ is not None and declared.kind == "identifier":
        yield from _message(reader, declared, type_, value)
        return
    if _is_auto(declared):
        yield from _inferred(reader, declared, value)
        return
    array = _array(reader, declared)
    kept = array or reader.scope.carried(declared.type)
    if kept is None or (kept.type == TEXT and has_mailbox(reader.scope)):
        raise reader.unread(declared.node, f'the model has no type "{declared.text}"')
    if (kept.bits or kept.wide) and not reader.scope.open:
        raise reader.unread(declared.node, f'"{declared.text}" is none of the model\'s types')
    yield from _typed(reader, declared, kept, value)


def _written(declared: DeclaratorParts) -> Node | None:
    """The type, if it is not left to the compiler."""
    return None if _is_auto(declared) else declared.type


def _copies(declared: DeclaratorParts) -> bool:
    """Whether a declaration makes variables of its own."""
    return declared.kind not in _REFERS


def _is_auto(declared: DeclaratorParts) -> bool:
    return declared.text in ("auto", "const auto") or declared.type.type.startswith("placeholder")


def _typed(
    reader: CppStatementReader, declared: DeclaratorParts, kept: Carried, value: Node | None
) -> Iterator[m.Statement]:
    is_vector = _VECTOR.match(declared.text) is not None
    if declared.value is None and not is_vector:
        cpp_plain_locals.check_set(reader, declared.node, declared.name, kept.type)
    local = place_of(reader.fresh(declared.name), kept)
    initial: m.Initializer | None = None
    if kept.type == TEXT:
        value = _of_text(reader, declared, value)
        initial = zero_of(TEXT)
    if value is not None and value.type == "initializer_list" and not kept.type.dimensions:
        value = named(value)[0] if named(value) else None
    if value is not None and value.type == "initializer_list":
        initial = cpp_plain_locals.braces(reader, value, kept.type)
    elif value is not None and kept.type.dimensions:
        if declared.value is not None and declared.value.type != "argument_list":
            initial = reader.expressions.read(value)
    elif value is not None:
        initial = reader.expressions.stored(value, local)
    overflows = local.name in reader.scope.overflowing
    if overflows and not is_only_compared(declared.node, declared.name):
        span = reader.cpp.span(declared.node)
        reader.findings.assumed(reader.cpp.source, span, kept.why, "", reader.within)
    reader.meaning(declared.name, local, own=True)
    yield reader.local(declared.node, local, initial)


def _of_text(
    reader: CppStatementReader, declared: DeclaratorParts, value: Node | None
) -> Node | None:
    """What a text is made of, if that is another text; without it is empty."""
    given = declared.value
    if given is not None and given.type in ("argument_list", "initializer_list"):
        if len(named(given)) > 1:
            raise reader.unread(declared.node, "the model only copies and compares texts")
        return next(iter(named(given)), None)
    return value


def _array(reader: CppStatementReader, declared: DeclaratorParts) -> Carried | None:
    """The array that `int a[3]` or a vector of fixed size is."""
    if declared.kind == "array_declarator":
        inner = reader.scope.carried(declared.type)
        if inner is None or inner.type == TEXT or declared.length is None:
            raise reader.unread(declared.node, "the length of this array is not known")
        return replace(inner, type=m.Type(inner.type.name, (_length(reader, declared.length),)))
    vector = _VECTOR.match(declared.text)
    if vector is None or declared.value is None:
        return None
    if any(re.search(rf"\b{declared.name}\s*\.\s*{f}\b", reader.text()) for f in _RESIZES):
        raise reader.unread(declared.node, "the length of this vector changes")
    values = named(declared.value)
    (inner_node,) = named(part(_template(declared.type), "arguments"))
    inner = reader.scope.carried(inner_node)
    if inner is None or inner.type == TEXT or not values:
        return None
    if declared.value.type == "initializer_list":
        return replace(inner, type=m.Type(inner.type.name, (len(values),)))
    if len(values) == 2 and constant(reader.expressions.read(values[1])) not in (0, False):
        raise reader.unread(declared.node, "the model fills no array with a value")
    return replace(inner, type=m.Type(inner.type.name, (_length(reader, values[0]),)))


def _template(type_: Node) -> Node:
    while type_.type != "template_type":
        type_ = part(type_, "name")
    return type_


def _length(reader: CppStatementReader, node: Node) -> int:
    value = constant(reader.expressions.read(node))
    if not isinstance(value, int) or isinstance(value, bool) or not 0 < value <= 4096:
        raise reader.unread(node, "the length of this array is not known")
    return value


def _message(
    reader: CppStatementReader, declared: DeclaratorParts, type_: str, value: Node | None
) -> Iterator[m.Statement]:
    pointer = cpp_messages.is_pointer(declared.text)
    if value is not None and value.type in ("null", "initializer_list"):
        value = None
    yield from cpp_messages.declare(reader, declared.node, declared.name, type_, value, pointer)


def _inferred(
    reader: CppStatementReader, declared: DeclaratorParts, value: Node | None
) -> Iterator[m.Statement]:
    if value is None:
        raise reader.unread(declared.node, "the type of this is not written")
    if "decltype" in text_of(declared.type):
        raise reader.unread(declared.node, "whether this is a reference is not known")
    if value.type == "lambda_expression":
        held, needed = cpp_captures.declared(reader, value)
        reader.meaning(declared.name, held)
        yield from needed
        return
    if (type_ := message_of(reader.scope, value)) is not None:
        pointer = is_made_pointer(reader.scope, value)
        yield from cpp_messages.declare(reader, declared.node, declared.name, type_, value, pointer)
        return
    read = reader.expressions.read(value)
    of = type_in(reader.scope, read)
    if of is None or is_constant(read):
        if reader.scope.open:
            raise reader.unread(declared.node, "the type of this is not known")
        reader.meaning(declared.name, read if is_calm(read) and _lasts(reader, read) else Outside())
        return
    whole = INT if of in (BYTE, SHORT) else of
    form = reader.scope.form
    if of.dimensions and (form is None or form.objects.is_pointer(reader.cpp, value)):
        raise reader.unread(declared.node, "the model has no pointers and references")
    wide = wide_of(reader.expressions, value)
    if wide and not reader.scope.open:
        raise reader.unread(declared.node, "this may hold more than the model's int does")
    local = Variable(reader.fresh(declared.name), whole, wide=wide)
    reader.meaning(declared.name, local, own=True)
    yield reader.local(declared.node, local, read)


def _lasts(reader: CppStatementReader, read: m.Expression) -> bool:
    """Whether nothing that a value is made of is written in the body."""
    names = {n.name for n in m.walk(read) if isinstance(n, m.Name | m.Member)}
    return not any(
        re.search(rf"\b{n}_?\s*(?:[-+*/%&|^]?=[^=]|\+\+|--)", reader.text()) for n in names
    )


def _reference(
    reader: CppStatementReader, declared: DeclaratorParts, value: Node | None
) -> Iterator[m.Statement]:
    """`auto& x = member_;`: another name of a place."""
    if value is None:
        raise reader.unread(declared.node, "the model has no pointers and references")
    meaning: Meaning | None = resolve(reader.scope, value)
    if declared.kind == "pointer_declarator":
        if isinstance(meaning, Record):
            reader.meaning(declared.name, replace(meaning, pointer=True))
            return
        raise reader.unread(declared.node, "the model has no pointers and references")
    if isinstance(meaning, Variable | Record | Outside):
        reader.meaning(declared.name, meaning)
        return
    if value.type in ("subscript_expression", "call_expression"):
        place = reader.expressions.read(value)
        if is_calm(place) and stays(place, declared.node):
            reader.meaning(declared.name, place)
            return
    if declared.constant and is_made(reader.scope, value):
        plain = replace(declared, kind="identifier")
        yield from _declared(reader, plain)
        return
    raise reader.unread(declared.node, "the model has no pointers and references")


def _called_or_made(reader: CppStatementReader, declared: DeclaratorParts) -> Iterator[m.Statement]:
    """`int k(other);`, which the grammar takes for a function: an object made from names."""
    declarator = declared.node
    check_misparsed(Effects(reader.cpp, reader.scope), declarator)
    arguments = [text_of(c) for c in named(part(declarator, "parameters"))]
    kept = reader.scope.carried(declared.type)
    meanings = [reader.scope.meaning(a) for a in arguments]
    if kept is not None and len(meanings) == 1 and isinstance(of := meanings[0], Variable):
        local = place_of(reader.fresh(declared.name), kept)
        is_same = (of.type, of.bits, of.wide) == (local.type, local.bits, local.wide)
        if seconds_of(declared.text) is not None or (of.wide and not is_same):
            raise reader.unread(declared.node, f'what "{arguments[0]}" is here is not known')
        value = m.Name(of.name) if is_same else converted_to(reader.scope, m.Name(of.name), local)
        reader.meaning(declared.name, local, own=True)
        yield reader.local(declared.node, local, value)
        return
    if not type_takes_values(declared.text):
        for argument, meaning in zip(arguments, meanings, strict=True):
            if isinstance(meaning, Variable | Record):
                why = f'this may change "{argument}"'
                raise Touches(reader.cpp.span(declared.node), why)
    raise reader.unread(declared.node, f'the model has no type "{declared.text}"')
