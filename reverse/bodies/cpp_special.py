"""Statements of C++ that mean more to a node than the expression that they are."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import (
    cpp_inline,
    cpp_mailbox,
    cpp_messages,
    cpp_optionals,
    cpp_plain_locals,
    cpp_pointers,
    cpp_swap,
    cpp_texts,
    cpp_timers,
)
from rebsync.reverse.bodies.cpp_places import is_this, resolve
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.cpp_time import pause, units
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.bodies.effects.cpp_call_effects import check_read
from rebsync.reverse.bodies.effects.cpp_effects import Effects, touching
from rebsync.reverse.bodies.effects.cpp_kinds import SHORT_CIRCUIT
from rebsync.reverse.bodies.effects.known_functions import streams
from rebsync.reverse.bodies.effects.touches import Touches
from rebsync.reverse.bodies.scope import (
    Called,
    Inline,
    Itself,
    Lambda,
    Record,
    Stores,
    TimerOf,
    Variable,
    meant_by,
)
from rebsync.reverse.bodies.types.cpp_conversions import (
    as_boolean,
    as_number,
    converted_to,
    place_of,
)
from rebsync.reverse.bodies.types.cpp_widths import check_whole
from rebsync.reverse.findings import Unread
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.models.building import bare, is_calm, negated, number_literal
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.constants import constant

# --- statements ---------------------------------------------------------------------------------


def read(reader: CppStatementReader, node: Node) -> Iterator[m.Statement] | None:
    """The statements that stand for an expression; None for one that stands for itself."""
    match node.type:
        case "comma_expression" if reader.scope.open:
            check_read(Effects(reader.cpp, reader.scope), node)
            return _each(reader, node)
        case "conditional_expression" if reader.scope.open:
            return _either(reader, node)
        case "binary_expression" if reader.scope.open and _joins(node):
            return _guarded(reader, node)
        case "parenthesized_expression" if reader.scope.open:
            return read(reader, named(node)[0])
        case "assignment_expression" if text_of(part(node, "operator")) == "=":
            target, value = part(node, "left"), part(node, "right")
            if (timer := _timer(reader, value)) is not None:
                return _starts(reader, value, timer)
            if value.type == "assignment_expression" and _is_message(reader, target):
                raise reader.unread(node, "messages are copied one at a time")
            return cpp_optionals.assign(reader, target, value)
        case "binary_expression" if streams(node):
            Effects(reader.cpp, reader.scope).check(node)
            return iter(())
        case "call_expression":
            return _called(reader, node)
        case _:
            return None


def _is_message(reader: CppStatementReader, node: Node) -> bool:
    return isinstance(resolve(reader.scope, node), Record)


def _each(reader: CppStatementReader, node: Node) -> Iterator[m.Statement]:
    for child in named(node):
        inner = read(reader, child)
        if inner is not None:
            yield from inner
        elif touching(reader.cpp, reader.scope, child) is not None:
            yield m.ExpressionStatement(reader.expressions.read(child), (), reader.cpp.span(child))


def _either(reader: CppStatementReader, node: Node) -> Iterator[m.Statement]:
    """`c ? f() : g();`."""
    condition, then, otherwise = named(node)
    test = reader.expressions.condition(condition)
    yield m.If(test, _way(reader, then), _way(reader, otherwise), (), reader.cpp.span(node))


def _joins(node: Node) -> bool:
    return text_of(part(node, "operator")) in SHORT_CIRCUIT


def _guarded(reader: CppStatementReader, node: Node) -> Iterator[m.Statement]:
    """`c && f();`, and `c || f();`."""
    test = reader.expressions.condition(part(node, "left"))
    if text_of(part(node, "operator")) in ("||", "or"):
        test = negated(test)
    yield m.If(test, _way(reader, part(node, "right")), None, (), reader.cpp.span(node))


def _way(reader: CppStatementReader, node: Node) -> m.Block:
    """What one branch of an expression does, and what must run before that only there."""
    around, reader.before = reader.before, []
    inner = read(reader, node)
    if inner is not None:
        done = list(inner)
    elif touching(reader.cpp, reader.scope, node) is not None:
        done = list(reader.done(node, reader.effect(node)))
    else:
        done = []
    needed, reader.before = reader.before, around
    return m.Block((*needed, *done), span=reader.cpp.span(node))


def _called(reader: CppStatementReader, node: Node) -> Iterator[m.Statement] | None:
    name = text_of(function := part(node, "function"))
    if (sends := cpp_messages.published(reader, node)) is not None:
        return sends
    if (length := pause(reader.expressions, node)) is not None:
        if cpp_mailbox.has_mailbox(reader.scope):
            why = "the mailbox knows nothing of this sleep: to it the body takes no time"
            raise reader.unread(node, why, "call `delay` of the mailbox, in units of time")
        return _statement(reader, node, m.Call(None, "delay", (length,)))
    if (swaps := cpp_swap.swap(reader, node)) is not None:
        return swaps
    if name in libraries.failing():
        return _statement(reader, node, m.Call(None, "assertion", (m.BoolLiteral(False),)))
    if name in libraries.named(Kind.CHECK) and name not in reader.scope.functions:
        condition = _checked(reader, named(part(node, "arguments"))[0])
        if not is_calm(condition):
            raise reader.unread(node, "a build without assertions does not do this")
        checked = m.Call(None, "assertion", (as_boolean(reader.scope, condition),))
        return _statement(reader, node, checked)
    arguments = named(part(node, "arguments"))
    if (inline := _inline(reader, function, len(arguments))) is not None:
        return cpp_inline.dropped(reader, node, reader.inlined(node, inline, arguments))
    if (timer := _timer(reader, node)) is not None:
        return _starts(reader, node, timer)
    stored = cpp_texts.emptied(reader.expressions, node) or _from_seconds(reader, node)
    if stored is not None:
        return _statement(reader, node, stored)
    if function.type == "field_expression" and not is_this(part(function, "argument")):
        ended = cpp_pointers.ended(reader.cpp, reader.scope, node, function)
        return ended if ended is not None else cpp_timers.switched(reader, node, function)
    return None


def _inline(reader: CppStatementReader, function: Node, count: int) -> Inline | Lambda | None:
    """The function that is called for what it does, if its body stands in here.

    Of several with this name the one that takes so many arguments.
    """
    if function.type == "lambda_expression":
        return Lambda(function, reader.scope) if reader.scope.open else None
    name = text_of(function)
    if function.type == "field_expression":
        target = part(function, "argument")
        if not is_this(target) and not isinstance(resolve(reader.scope, target), Itself):
            return None
        name = text_of(part(function, "field"))
    elif isinstance(held := reader.scope.meaning(name), Lambda):
        return held
    elif function.type == "template_function":
        name = text_of(part(function, "name"))
    elif function.type not in ("identifier", "qualified_identifier"):
        return None
    found = reader.scope.functions.get(name.rpartition("::")[2])
    if isinstance(found, Called) and found.overloads:
        meant = meant_by(found, name, count)
        return Inline(meant[0]) if len(meant) == 1 else None
    if isinstance(found, Inline) and found.function.may_take(count):
        return found
    return None


def _checked(reader: CppStatementReader, node: Node) -> m.Expression:
    """What is asserted; a choice would be an assertion that fails."""
    try:
        return reader.expressions.read(node)
    except Unknown as unknown:
        why = f"whether this holds is not known: {unknown.why}"
        raise Unread(unknown.span, why, unknown.hint) from None


def _from_seconds(reader: CppStatementReader, node: Node) -> m.Expression | None:
    """`duration.fromSec(2.0)`: a variable gets a span of time."""
    function, arguments = part(node, "function"), named(part(node, "arguments"))
    if function.type != "field_expression" or len(arguments) != 1:
        return None
    variable = resolve(reader.scope, part(function, "argument"))
    if text_of(part(function, "field")) != "fromSec" or not isinstance(variable, Variable):
        return None
    value = units(reader.expressions, arguments[0], Fraction(1))
    return m.Assign("=", m.Name(variable.name), value, reader.cpp.span(node))


def _statement(
    reader: CppStatementReader, node: Node, expression: m.Expression
) -> Iterator[m.Statement]:
    yield m.ExpressionStatement(expression, (), reader.cpp.span(node))


# --- timers -------------------------------------------------------------------------------------


def _timer(reader: CppStatementReader, node: Node) -> TimerOf | None:
    """The timer that a call makes."""
    if node.type != "call_expression" or b"Timer" not in (node.text or b""):
        return None
    call = call_of(node)
    if call is None or call.name not in libraries.timers_of_handles():
        return None
    made = reader.scope.timers.get(node.id)
    if made is not None:
        return made
    above = node.parent
    if above is not None and above.type == "assignment_expression":
        kept = resolve(reader.scope, part(above, "left"))
        if isinstance(kept, TimerOf):
            once = any(text_of(a) == "true" for a in call.arguments)
            return TimerOf(kept.server, not once)
    return None


def _starts(reader: CppStatementReader, node: Node, timer: TimerOf) -> Iterator[m.Statement]:
    """`timer = createTimer(Duration(e), callback, this, true)`: `self.callback() after(e)`."""
    if timer.periodic:
        hint = "create it in the constructor, or one-shot timers one after the other"
        raise reader.unread(node, "this starts a periodic timer in the middle of a run", hint)
    length = reader.expressions.read(named(part(node, "arguments"))[0])
    span = reader.cpp.span(node)
    if reader.scope.server != timer.server:
        why = "a timer that still runs is stopped by this; the model lets it go off as well"
        reader.findings.unreadable(reader.cpp.source, Unread(span, why), reader.within)
    yield m.ExpressionStatement(m.Call(m.Self(), timer.server, (), length, None, span), (), span)


# --- switch -------------------------------------------------------------------------------------


def subject(reader: CppStatementReader, node: Node, body: Node) -> m.Expression:
    """What a switch looks at; one of the cases, or another value, where that is not known."""
    expressions = reader.expressions
    try:
        check_whole(expressions, node)
        return as_number(reader.scope, expressions.read(node))
    except Unread as unread:
        if not reader.scope.open:
            raise
        values = []
        for case in named(body):
            value = case.child_by_field_name("value")
            known = constant(expressions.read(value)) if value is not None else None
            if isinstance(known, int):
                values.append(int(known))
        expressions.approximate(node, unread)
        other = max(values, default=0) + 1
        options = tuple(number_literal(v) for v in dict.fromkeys([*values, other]))
        return m.Choice(options, reader.cpp.span(node)) if len(options) > 1 else options[0]


# --- the rest -----------------------------------------------------------------------------------


def stores(reader: CppStatementReader, node: Node, known: Stores) -> Iterator[m.Statement]:
    """A value that is stored, as is known from elsewhere; nothing where it is stored outside."""
    expressions, span = reader.expressions, reader.cpp.span(node)
    target, value = known.target, known.value
    try:
        written = expressions.read(target) if isinstance(target, Node) else target
    except Unread:
        return
    place = place_of(reader.scope, written)
    listed = isinstance(value, Node) and value.type == "initializer_list"
    if listed and isinstance(value, Node) and place.type is not None and place.type.dimensions:
        initial = cpp_plain_locals.braces(reader, value, place.type)
        yield from cpp_plain_locals.elements(written, initial, span)
        return
    if isinstance(value, Node):
        read_ = expressions.stored(value, place)
    else:
        read_ = converted_to(reader.scope, value, place)
    yield m.ExpressionStatement(m.Assign("=", written, read_, span), (), span)


def without_ok(condition: m.Expression) -> m.Expression:
    """`true && c` as `c`: what is left of `ros::ok() && c`."""
    match bare(condition):
        case m.Binary("&&", left, right):
            if bare(left) == m.BoolLiteral(True):
                return bare(right)
            if bare(right) == m.BoolLiteral(True):
                return bare(left)
    return condition


def returned(reader: CppStatementReader, node: Node, record: Record) -> Iterator[m.Statement]:
    """`return message;` where the caller has a message for it."""
    source, fresh = cpp_messages.given(reader, node)
    span = reader.cpp.span(node)
    for path, variable in record.fields.items():
        held = source.fields.get(path)
        zero = cpp_messages.zero_of(variable.type) if fresh and variable.type is not None else None
        value = m.Name(held.name) if held is not None else zero
        if value is None:
            raise Unknown(span, f'the model cannot know "{text_of(node)}.{path}"')
        yield m.ExpressionStatement(m.Assign("=", m.Name(variable.name), value), (), span)


def opened(reader: CppStatementReader, node: Node, unread: Unread) -> set[str]:
    """The members that a statement gives a value that the model cannot know."""
    if not isinstance(unread, Unknown | Touches) or node.type != "expression_statement":
        return set()
    found = set()
    for child in named(node):
        effects = Effects(reader.cpp, reader.scope, everything=True)
        try:
            effects.check(child)
        except Touches:
            return set()
        found |= effects.written
    return {name for name in found if name.partition(".")[0] in reader.scope.members}
