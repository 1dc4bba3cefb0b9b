"""`for` loops of Python: over numbers, and over the elements of a list that stands in the code."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import bare, binary, is_plain, selected, whole_number
from rebsync.reverse.python.bodies.body_effects import is_harmless
from rebsync.reverse.python.bodies.body_loops import with_else
from rebsync.reverse.python.bodies.body_rounds import leaves_nothing
from rebsync.reverse.python.bodies.body_scope import Key, Var
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_targets import check_target
from rebsync.reverse.python.bodies.body_together import is_object, kept
from rebsync.reverse.python.bodies.body_variables import forget, give
from rebsync.reverse.python.expressions.values import REAL, WHOLE, Value
from rebsync.reverse.syntax.ancestors import holds
from rebsync.reverse.syntax.py_index import arguments_of
from rebsync.reverse.syntax.py_tree import field, is_label, named, text_of
from rebsync.static.types import INT

_RANGES = ("builtins.range", "builtins.xrange")
_LISTS = frozenset({"list", "tuple"})
_MOST = 32
# What the variable of a loop gets in each round: of the number of the round in the model.
Element: TypeAlias = "Callable[[m.Expression], Value | None]"


def for_(reader: BodyStatementReader, node: Node) -> Iterator[m.Statement]:
    """`for i in range(...)`, `for x in (1, 2)` as a loop of the model that counts."""
    span = reader.frame.span(node)
    check_target(reader, field(node, "left"))
    target, over = field(node, "left"), field(node, "right")
    name = (
        reader.reading.external(field(over, "function"), reader.frame)
        if over.type == "call"
        else ""
    )
    values = _values(reader, named(over)) if over.type in _LISTS else None
    listed = named(over) if values is None and over.type in _LISTS else []
    if any(is_object(reader, target, each) for each in listed):
        raise Unread(span, "what this loop goes through is not in the model")
    if name not in _RANGES and values is None and leaves_nothing(reader, node):
        return
    if target.type not in ("identifier", "attribute"):
        raise Unread(span, "what this loop goes through is not in the model")
    if name in _RANGES:
        yield from _range(reader, node, arguments_of(over)[0])
    elif values is not None:
        yield from _elements(reader, node, values, named(over))
    elif over.type in _LISTS and is_harmless(reader.reading, over, reader.frame):
        high = m.IntLiteral(len(named(over)))
        yield from _counted(reader, node, m.IntLiteral(0), high, 1, lambda _: None)
    else:
        raise Unread(span, "what this loop goes through is not in the model")


def _range(reader: BodyStatementReader, node: Node, plain: Sequence[Node]) -> Iterator[m.Statement]:
    span, variable = reader.frame.span(node), text_of(field(node, "left"))
    if not 1 <= len(plain) <= 3:
        raise Unread(span, "what this loop goes through is not in the model")
    values = [_whole(reader, argument) for argument in plain]
    low = values[0] if len(values) > 1 else m.IntLiteral(0)
    high = values[1] if len(values) > 1 else values[0]
    step = _step(reader, values[2] if len(values) > 2 else m.IntLiteral(1), node)
    if not isinstance(bare(high), m.IntLiteral):
        end = reader.reading.fresh(f"{variable.rpartition('.')[2]}_end")
        yield m.Local(m.Declaration(INT, (m.Declarator(end, high),)), (), span)
        high = m.Name(end)
    element = None if _only_here(reader, node, variable) else _number
    yield from _counted(reader, node, low, high, step, element)


def _number(counter: m.Expression) -> Value:
    return Value(counter, WHOLE)


def _values(reader: BodyStatementReader, listed: Sequence[Node]) -> list[Value] | None:
    """The elements of a list, all of one type; None where the model does not have them."""
    try:
        found = [reader.expressions.read(each) for each in listed]
    except Unknown:
        return None
    kinds = {value.kind for value in found}
    is_plain_ = len(kinds) == 1 or kinds == {WHOLE, REAL}
    return found if is_plain_ and len(found) <= _MOST else None


def _elements(
    reader: BodyStatementReader, node: Node, read: Sequence[Value], listed: Sequence[Node]
) -> Iterator[m.Statement]:
    """A loop over some values, all of which are there before it starts."""
    values: list[Value] = []
    is_real = any(value.kind == REAL for value in read)
    mixed = any(v.mixed or v.kind != read[0].kind for v in read)
    for number, (each, value) in enumerate(zip(listed, read, strict=True)):
        if is_real:
            value = Value(reader.expressions.real(value, each), REAL)
        if not is_plain(value.expression) or isinstance(bare(value.expression), m.Name):
            first, value = kept(reader, value, f"each_{number}", each)
            yield from first
        values.append(value)

    def element(counter: m.Expression) -> Value:
        found = selected(counter, dict(enumerate(plain[:-1])), plain[-1])
        return Value(found, values[0].kind, mixed=mixed)

    plain = [value.expression for value in values]
    high = m.IntLiteral(len(values))
    yield from _counted(reader, node, m.IntLiteral(0), high, 1, element)


def _whole(reader: BodyStatementReader, node: Node) -> m.Expression:
    value = reader.expressions.read(node)
    if value.kind != WHOLE:
        raise Unread(reader.frame.span(node), "a loop over other than whole numbers is not read")
    return reader.expressions.need(value, node, "range")


def _step(reader: BodyStatementReader, step: m.Expression, node: Node) -> int:
    match step:
        case m.IntLiteral(value) if 0 < value < 1 << 16:
            return value
        case m.Unary("-", m.IntLiteral(value)) if 0 < value < 1 << 16:
            return -value
        case _:
            raise Unread(reader.frame.span(node), "the step of this loop is not known")


def _counted(
    reader: BodyStatementReader,
    node: Node,
    low: m.Expression,
    high: m.Expression,
    step: int,
    element: Element | None,
) -> Iterator[m.Statement]:
    """A loop of the model. Its last step may leave the `int` only where that is near its end.

    The variable of the code is the counter of the model, or gets an `element` in each round.
    """
    frame, span, target = reader.frame, reader.frame.span(node), field(node, "left")
    variable = text_of(target)
    key: Key = "local", node.id, variable
    name = reader.reading.fresh(variable.rpartition(".")[2], key)
    reader.reading.learnt.join(key, WHOLE)
    reader.reading.wide.add(name)
    before = set(frame.assigned)
    if element is None:
        outer = frame.bound.get(variable)
        frame.bound[variable] = Value(m.Name(name), WHOLE)
        body = reader.block(field(node, "body"))
        del frame.bound[variable]
        if outer is not None:
            frame.bound[variable] = outer
    else:
        body = _with_element(reader, node, element(m.Name(name)))
    frame.assigned = before
    by = m.IntLiteral(abs(step))
    counts: m.Expression = m.Assign("+=" if step > 0 else "-=", m.Name(name), by)
    if abs(step) == 1:
        counts = m.Postfix("++" if step > 0 else "--", m.Name(name))
    condition = binary("<" if step > 0 else ">", m.Name(name), high)
    declared = m.Declaration(INT, (m.Declarator(name, low),))
    if element is not None and _runs(low, high, step):
        frame.assigned.add(variable)
    loop = m.For(declared, condition, (counts,), body, (), span)
    yield from with_else(reader, node, loop)


def _with_element(reader: BodyStatementReader, node: Node, value: Value | None) -> m.Block:
    """The body of a loop, behind what its variable gets; None: nobody knows it."""
    target = field(node, "left")
    if value is None:
        forget(reader, target)
        return reader.block(field(node, "body"))
    meaning, path = reader.expressions.meaning(target)
    if not isinstance(meaning, Var) or path:
        raise Unread(reader.frame.span(node), f'what "{text_of(target)}" is is not in the model')
    reader.frame.depth += 1
    try:
        first = tuple(give(reader, meaning, text_of(target), value, target))
    finally:
        reader.frame.depth -= 1
    body = reader.block(field(node, "body"))
    return m.Block((*first, *body.statements), span=body.span)


def _runs(low: m.Expression, high: m.Expression, step: int) -> bool:
    """Whether a loop surely goes through its body."""
    first, last = (whole_number(bare(bound)) for bound in (low, high))
    if first is None or last is None:
        return False
    return first < last if step > 0 else first > last


def _only_here(reader: BodyStatementReader, node: Node, variable: str) -> bool:
    """Whether a loop's variable is only read, and only in such loops over it."""
    scope = reader.frame.scope
    bindings = scope.names.get(variable, [])
    if field(node, "left").type != "identifier" or variable in scope.outer:
        return False
    if scope.kind not in ("function", "lambda"):
        return False
    if any(b.how != "loop" for b in bindings):
        return False
    loops = [b.node for b in bindings]
    inner = [n for n in loops if n != node and holds(node, n)]
    if inner:
        return False
    waiting = [scope.node]
    while waiting:
        current = waiting.pop()
        if current in loops:
            continue
        if current.type == "identifier" and text_of(current) == variable and not is_label(current):
            return False
        waiting += current.named_children
    return True
