"""Functions of the node that bodies call: what they do stands in the place of the call."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.building import is_calm, negated
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.findings import Unread
from rebsync.reverse.python.body_effects import is_harmless, is_quiet_body
from rebsync.reverse.python.body_reading import Reading
from rebsync.reverse.python.body_scope import Frame, Message, Nobody, Own, Value, Var
from rebsync.reverse.python.py_bindings import Binding
from rebsync.reverse.python.py_callbacks import body_of
from rebsync.reverse.python.py_index import Parameter, Scope, arguments_of, has_splat
from rebsync.reverse.python.py_tree import field, named, text_of

if TYPE_CHECKING:
    from rebsync.reverse.python.body_expressions import PyExpressions
    from rebsync.reverse.python.body_statements import PyStatements

_DEEPEST = 12
_KNOWN = frozenset({"staticmethod"})
_INNER = frozenset({"function_definition", "lambda"})


def inlined(reader: PyStatements, own: Scope, call: Node) -> Iterator[m.Statement]:
    """A call as a statement: the body of the function, with its parameters as locals."""
    span = reader.frame.span(call)
    if own.node.id in reader.running or len(reader.running) > _DEEPEST:
        raise Unread(span, "a function that leads to itself is not read")
    if not set(own.decorators) <= _KNOWN or text_of(own.node).startswith("async"):
        raise Unread(span, "what decorates this function is not known")
    frame = Frame(own, is_start=reader.frame.is_start, server=reader.frame.server)
    frame.kept = kept_names(reader.reading, own) if frame.is_start else frozenset()
    inner = type(reader)(
        reader.reading, frame, reader.within, own.node, (*reader.running, own.node.id), reader.loops
    )
    if has_splat(call):
        raise Unread(span, "what stars unpack into the arguments is not read")
    first: list[m.Statement] = []
    for parameter, node, given in arguments(own, call, span):
        first += _bound(reader, inner, parameter, node, given)
    found = inner.body(body_of(own))
    reader.is_over = reader.is_over or (frame.is_start and inner.is_over)
    plain = without_returns(found)
    if plain is None:
        raise Unread(span, "what it calls ends in the middle of a loop, or by cases")
    yield from first
    yield from plain


def kept_names(reading: Reading, own: Scope) -> frozenset[str]:
    """The names that are used both in a loop that keeps the node running, or a function inside, and
    outside of it."""
    kept = reading.unit.kept
    if own.node.id not in kept:
        kept[own.node.id] = _kept_names(own)
    return kept[own.node.id]


def _kept_names(own: Scope) -> frozenset[str]:
    from rebsync.reverse.python.body_loops import forever

    inside: set[str] = set()
    outside: set[str] = set()
    waiting: list[tuple[Node, bool]] = [(own.node, False)]
    while waiting:
        node, is_in = waiting.pop()
        if node.type == "identifier":
            (inside if is_in else outside).add(text_of(node))
        is_in = is_in or forever(node) or (node.type in _INNER and node != own.node)
        waiting += [(child, is_in) for child in node.named_children]
    return frozenset(inside & outside & set(own.names))


def arguments(
    own: Scope, call: Node, span: object
) -> Iterator[tuple[Parameter, Node | None, bool]]:
    """The parameters of a function with what a call gives; False for what it is by default."""
    plain, keywords = arguments_of(call)
    parameters = own.parameters
    if own.self_name is not None and not _names_object(call, own):
        parameters = parameters[1:]
    for number, parameter in enumerate(parameters):
        if parameter.star:
            yield parameter, None, True
        elif number < len(plain):
            yield parameter, plain[number], True
        elif parameter.name in keywords:
            yield parameter, keywords[parameter.name], True
        else:
            yield parameter, parameter.default, False


def _names_object(call: Node, own: Scope) -> bool:
    """Whether the object is the first argument, as in `Base.__init__(self)`."""
    called = field(call, "function")
    if called.type != "attribute" or own.name != "__init__":
        return False
    plain, _ = arguments_of(call)
    return bool(plain) and text_of(plain[0]) == "self" and "super" not in text_of(called)


def _bound(
    reader: PyStatements, inner: PyStatements, parameter: Parameter, node: Node | None, given: bool
) -> Iterator[m.Statement]:
    """What a parameter stands for in the body."""
    frame, name = inner.frame, parameter.name
    if node is None or not given:
        ways = reader.reading.values.ways(node, frame.scope) if node is not None else ()
        frame.bound[name] = reader.reading.constant(ways) or Nobody()
        return
    is_same = all(b.how == "parameter" for b in frame.scope.names.get(name, ()))
    if node.type in ("identifier", "attribute"):
        meaning, path = reader.expressions.meaning(node)
        if isinstance(meaning, (Own, Message)) and not path and is_same:
            frame.bound[name] = meaning
            return
    try:
        value = reader.expressions.read(node)
    except Unknown:
        frame.bound[name] = Nobody()
        return
    if is_same and isinstance(value.expression, (m.IntLiteral, m.BoolLiteral, m.FloatLiteral)):
        frame.bound[name] = value
        return
    from rebsync.reverse.python.body_stores import give

    variable = reader.reading.name(name, node, frame)
    if isinstance(variable, Var):
        yield from give(inner, variable, name, value, node)


def value_of_method(reader: PyExpressions, own: Scope, call: Node) -> Value:
    """The value of a function that only computes it from what it is given."""
    span = reader.frame.span(call)
    body = body_of(own)
    if is_still(reader.reading, own):
        quiet = all(is_harmless(reader.reading, n, reader.frame) for n in _given(call))
        if quiet and not (len(body) == 1 and body[0].type == "return_statement"):
            raise Unknown(span, f'the model cannot know what "{own.name}" gives', "")
    if len(body) != 1 or body[0].type != "return_statement" or own.decorators:
        raise Unread(span, f'the value of "{own.name}" is not read')
    inner = Frame(own, server=reader.frame.server)
    for parameter, node, given in arguments(own, call, span):
        if node is None or not given:
            ways = reader.reading.values.ways(node, own) if node is not None else ()
            inner.bound[parameter.name] = reader.reading.constant(ways) or Nobody()
            continue
        value = reader.read(node)
        if not is_calm(value.expression):
            raise Unread(span, f'the value of "{own.name}" is not read')
        inner.bound[parameter.name] = value
    returned = named(body[0])
    if has_splat(call):
        raise Unread(span, "what stars unpack into the arguments is not read")
    if not returned or inner.scope.node.id in reader.running:
        raise Unread(span, f'the value of "{own.name}" is not read')
    running = (*reader.running, own.node.id)
    return type(reader)(reader.reading, inner, reader.within, running).read(returned[0])


def _given(call: Node) -> list[Node]:
    plain, keywords = arguments_of(call)
    return [*plain, *keywords.values()]


def is_still(reading: Reading, own: Scope) -> bool:
    """Whether a function of the node changes nothing: it only computes what it gives."""
    if not set(own.decorators) <= _KNOWN:
        return False
    return is_quiet_body(reading, own, 0) and not any(
        b.how in ("value", "augmented") and scope_of_binding(b, own)
        for above in reading.unit.lineage
        for of in above.attributes.values()
        for b in of
    )


def scope_of_binding(binding: Binding, own: Scope) -> bool:
    """Whether a binding stands in a function."""
    return (
        own.node.start_byte <= binding.node.start_byte
        and binding.node.end_byte <= own.node.end_byte
    )


# --- early ends ---------------------------------------------------------------------------------


def without_returns(statements: tuple[m.Statement, ...]) -> tuple[m.Statement, ...] | None:
    """The same statements where nothing ends them early; None where they cannot be so written."""
    for number, statement in enumerate(statements):
        if isinstance(statement, m.Return):
            return statements[:number]
        if not _returns(statement):
            continue
        if not isinstance(statement, m.If):
            return None
        rest = statements[number + 1 :]
        done = _split(statement, rest)
        return (*statements[:number], *done) if done is not None else None
    return statements


def _split(statement: m.If, rest: tuple[m.Statement, ...]) -> tuple[m.Statement, ...] | None:
    """A branch that ends all, with what follows in the other branch."""
    from rebsync.reverse.python.body_statements import always_leaves

    then = _listed(statement.then)
    other = _listed(statement.otherwise) if statement.otherwise is not None else ()
    if always_leaves(statement.then):
        first, second = without_returns(then), without_returns((*other, *rest))
    elif not _returns(statement.then) and other and always_leaves(m.Block(other)):
        first, second = without_returns((*then, *rest)), without_returns(other)
    elif not rest:
        first, second = without_returns(then), without_returns(other)
    else:
        return None
    if first is None or second is None:
        return None
    if not first:
        return (m.If(negated(statement.condition), m.Block(second)),) if second else ()
    return (m.If(statement.condition, m.Block(first), m.Block(second) if second else None),)


def _listed(statement: m.Statement) -> tuple[m.Statement, ...]:
    return statement.statements if isinstance(statement, m.Block) else (statement,)


def _returns(statement: m.Statement) -> bool:
    return any(isinstance(n, m.Return) for n in m.walk(statement))
