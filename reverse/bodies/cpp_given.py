"""What functions give whose bodies stand in the place of their calls."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import cpp_mailbox, cpp_moments
from rebsync.reverse.bodies.cpp_messages import declare, given, message_type
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.bodies.effects.known_functions import MOMENT
from rebsync.reverse.bodies.scope import (
    Inline,
    Lambda,
    Meaning,
    Outside,
    Record,
    Variable,
)
from rebsync.reverse.bodies.types.cpp_conversions import as_boolean, type_in
from rebsync.reverse.bodies.types.cpp_return_types import return_type
from rebsync.reverse.bodies.types.cpp_widths import place_of
from rebsync.reverse.models.building import cast
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_tree import named, returns_in, text_of
from rebsync.static.types import converts, is_boolean, is_integer, is_numeric


def single(body: Node) -> Node | None:
    """The value of a function that does nothing but give it."""
    statements = named(body)
    if len(statements) == 1 and statements[0].type == "return_statement":
        values = named(statements[0])
        return values[0] if values and values[0].type != "initializer_list" else None
    return None


def value_of(
    reader: CppStatementReader, inside: CppStatementReader, node: Node, result: Node | None
) -> Meaning:
    """What such a function gives: the value itself, where it is called."""
    text = text_of(result) if result is not None else "auto"
    if message_type(inside.scope, text) is not None:
        return given(inside, node)[0]
    if text == MOMENT or cpp_mailbox.is_time(inside.scope, node):
        return cpp_moments.made(inside, node)
    kept = inside.scope.carried(result) if result is not None else None
    if kept is None and text not in ("auto", "const auto"):
        raise Unknown(inside.cpp.span(node), "the model cannot know what this gives")
    place = place_of("", kept) if kept is not None else Variable("")
    inside.findings.statements[inside.within] += 1
    value = inside.expressions.stored(node, place)
    if kept is None or inside.scope.open:
        return value
    converted = as_type(reader, inside, value, place)
    if converted is None:
        raise inside.unread(node, "the type that this gives may make another number of it")
    return converted


def apart(
    reader: CppStatementReader,
    function: Inline | Lambda,
    node: Node,
    result: Node | None,
    found: Meaning,
) -> Meaning:
    """An array that a function gives: a copy, if it gives no reference."""
    above = climb(node, lambda n: n.type != "subscript_expression")
    if above is not None and above.type == "binary_expression":
        return found  # it is only looked at
    refers = function.function.gives_place if isinstance(function, Inline) else False
    refers = refers or (result is not None and "&" in text_of(result))
    of = type_in(reader.scope, found) if isinstance(found, m.Expression) else None
    if of is None or not of.dimensions or refers or not isinstance(found, m.Expression):
        return found
    local = Variable(reader.fresh("result", inlining=True), of)
    reader.before.append(reader.local(node, local, found))
    reader.shared.made.add(local.name)
    reader.scope.results[local.name] = local
    return local


def as_type(
    reader: CppStatementReader, inside: CppStatementReader, value: m.Expression, place: Variable
) -> m.Expression | None:
    """A value of generated code as one of a type where the model stores it nowhere.

    None: its own type is not known, or the model has no numbers of that type.
    """
    of = type_in(inside.scope, value)
    scope = inside.scope if of is not None else reader.scope
    of = of or type_in(scope, value)
    type_ = place.type
    if type_ is None or type_.dimensions or of == type_:
        return value if not (place.bits or place.wide) else None
    if of is None or place.bits or place.wide:
        return None
    if is_boolean(type_):
        return as_boolean(scope, value)
    if not (is_numeric(type_) and is_numeric(of)):
        return None
    whole = is_integer(type_) and is_integer(of) and converts(of, type_, {})
    return value if whole else cast(type_, value)


def result_of(
    reader: CppStatementReader, inside: CppStatementReader, body: Node, result: Node | None
) -> Meaning | None:
    """Where the value that a function returns is kept; sets what `return` does in it."""
    if result is None or text_of(result) in ("auto", ""):
        if not any(named(n) for n in returns_in(body)):
            return None
        kept = return_type(inside, body)
        if kept is None or not inside.scope.open:
            raise reader.unread(body, "the type of what this gives is not written")
        inside.returns = place_of("", kept)
        return place_of(reader.fresh("result", inlining=True), kept)
    if text_of(result) == "void":
        return None
    type_ = message_type(reader.scope, text_of(result))
    if type_ is not None:
        before, name = reader.scope, reader.fresh("result", inlining=True)
        reader.before += declare(reader, body, name, type_, None, pointer=False, inlining=True)
        record = reader.scope.locals[name]
        reader.scope = before
        inside.returns = record if isinstance(record, Record) else None
        return record
    kept = inside.scope.carried(result)
    if kept is None:
        inside.returns = Outside()
        return Outside()
    if (kept.bits or kept.wide) and not inside.scope.open:
        raise inside.unread(body, "the model has no numbers of the type that this gives")
    inside.returns = place_of("", kept)
    return place_of(reader.fresh("result", inlining=True), kept)
