"""Branches, counted loops, switches and returns."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import cpp_locals, cpp_loops, cpp_plain_locals, cpp_special
from rebsync.reverse.bodies.cpp_messages import zero_of
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.cpp_effects import Effects
from rebsync.reverse.bodies.scope import Outside, Record, Variable
from rebsync.reverse.bodies.types.cpp_types import SCALARS
from rebsync.reverse.bodies.written import annotations_in
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_tree import markers_in, named, part, text_of

_FUNCTIONS = frozenset({"function_definition", "lambda_expression"})


def branches(
    reader: CppStatementReader, node: Node, annotations: tuple[m.Annotation, ...]
) -> Iterator[m.Statement]:
    """`if`, with what its head declares before it."""
    outside = reader.scope
    declared, tested = _head(reader, part(node, "condition"))
    condition = reader.expressions.condition(tested)
    then = reader.branch(part(node, "consequence"))
    otherwise: m.Statement | None = None
    alternative = node.child_by_field_name("alternative")
    if alternative is not None:
        (body,) = named(alternative)
        otherwise = _else(reader, body)
    reader.scope = outside
    read = m.If(condition, then, otherwise, annotations, reader.cpp.span(node))
    if declared:
        yield m.Block((*declared, read))
    else:
        yield read


def _head(reader: CppStatementReader, clause: Node) -> tuple[list[m.Statement], Node]:
    """What the head of a branch or switch declares, and what it looks at."""
    initial = clause.child_by_field_name("initializer")
    inner = named(initial) if initial is not None else []
    declared: list[m.Statement] = []
    for each in inner:
        read = list(reader.declaration(each, (), False))
        if not read:
            reader.check_comes_back(each)
        declared += read
    looked_at = part(clause, "value")
    if looked_at.type == "declaration":
        read = list(cpp_locals.tested(reader, looked_at))
        if not read:
            reader.check_comes_back(looked_at)
        declared += read
        looked_at = part(looked_at, "declarator")
    return declared, looked_at


def _else(reader: CppStatementReader, body: Node) -> m.Statement:
    """The other branch; `else if` goes on without braces where nothing stands before it."""
    if body.type != "if_statement":
        return reader.branch(body)
    around, reader.before = reader.before, []
    read = list(branches(reader, body, ()))
    needed, reader.before = reader.before, around
    if needed or len(read) != 1:
        return m.Block((*needed, *read), span=reader.cpp.span(body))
    return read[0]


def counted(reader: CppStatementReader, node: Node, annotations: tuple[m.Annotation, ...]) -> m.For:
    """`for` with its three parts."""
    outside = reader.scope
    first = node.child_by_field_name("initializer")
    initial: m.Declaration | tuple[m.Expression, ...] = ()
    if first is not None and first.type == "declaration":
        initial = _counter(reader, first)
    elif first is not None:
        initial = tuple(_listed(reader, first))
    tested = node.child_by_field_name("condition")
    condition = cpp_loops.condition_of(reader, tested) if tested is not None else None
    update = node.child_by_field_name("update")
    updates = tuple(_listed(reader, update)) if update is not None else ()
    body = reader.branch(part(node, "body"))
    reader.scope = outside
    return m.For(initial, condition, updates, body, annotations, reader.cpp.span(node))


def _counter(reader: CppStatementReader, node: Node) -> m.Declaration:
    """The declaration at the head of a loop."""
    if not reader.scope.open and cpp_plain_locals.is_plain(node):
        return cpp_plain_locals.declared(reader, node)
    read = [s.declaration for s in reader.declaration(node, (), False) if isinstance(s, m.Local)]
    if not read or any(d.type != read[0].type for d in read):
        raise reader.unread(node, "the model has no such loop")
    declarators = tuple(d for each in read for d in each.declarators)
    return m.Declaration(read[0].type, declarators, span=reader.cpp.span(node))


def _listed(reader: CppStatementReader, node: Node) -> Iterator[m.Expression]:
    """The expressions that commas part."""
    if node.type == "comma_expression":
        for child in named(node):
            yield from _listed(reader, child)
    else:
        yield reader.effect(node)


def switched(
    reader: CppStatementReader, node: Node, annotations: tuple[m.Annotation, ...]
) -> m.Switch | m.Block:
    """`switch`, with what its head declares before it."""
    outside = reader.scope
    declared, looked_at = _head(reader, part(node, "condition"))
    subject = cpp_special.subject(reader, looked_at, part(node, "body"))
    cases = list(_cases(reader, part(node, "body")))
    if all(case.value is None for case in cases):
        raise reader.unread(node, "the model has no switch without cases")
    reader.scope = outside
    cases = _default_last(reader, node, cases)
    read = m.Switch(subject, tuple(cases), annotations, reader.cpp.span(node))
    return m.Block((*declared, read)) if declared else read


def _default_last(reader: CppStatementReader, node: Node, cases: list[m.Case]) -> list[m.Case]:
    """The cases with `default` at the end, where the model wants it, if nothing falls through."""
    places = [index for index, case in enumerate(cases) if case.value is None]
    if not places or places[0] == len(cases) - 1:
        return cases
    at, last = places[0], cases[-1]
    before = at == 0 or _leaves(cases[at - 1])
    if not before or not _leaves(cases[at]):
        raise reader.unread(node, "a default in the middle falls through", "put it last")
    if not _leaves(last):
        last = replace(last, statements=(*last.statements, m.Break()))
    return [*cases[:at], *cases[at + 1 : -1], last, cases[at]]


def _leaves(case: m.Case) -> bool:
    """Whether a case ends with leaving the switch."""
    return bool(case.statements) and isinstance(
        case.statements[-1], m.Break | m.Return | m.Continue
    )


def _cases(reader: CppStatementReader, body: Node) -> Iterator[m.Case]:
    """The cases, each with the annotations in the comments above it."""
    comments: list[str] = []
    for child in body.named_children:
        if child.type == "comment":
            comments.append(text_of(child))
            continue
        annotations = annotations_in(markers_in(comments), reader.cpp.span(child))
        yield _case(reader, child, annotations)
        comments = []


def _case(reader: CppStatementReader, node: Node, annotations: tuple[m.Annotation, ...]) -> m.Case:
    """One case with its statements."""
    if node.type != "case_statement":
        raise reader.unread(node, "this stands before the first case")
    value = node.child_by_field_name("value")
    read = reader.expressions.read(value) if value is not None else None
    body = [c for c in node.named_children if value is None or c.start_byte >= value.end_byte]
    inside = [c for c in body if c.type != "comment"]
    if len(inside) == 1 and inside[0].type == "compound_statement":
        statements = reader.branch(inside[0]).statements
    else:
        statements = tuple(reader.statements(body))
    return m.Case(read, statements, annotations, reader.cpp.span(node))


def _returned_empty(
    reader: CppStatementReader, node: Node, annotations: tuple[m.Annotation, ...]
) -> Iterator[m.Statement]:
    """`return {};`: 0, but behind the last statement of a method, where only C++ wants it."""
    kept = reader.returns
    if kept is None and _ends_function(node):
        return
    type_ = kept.type if isinstance(kept, Variable) else None if kept else _result(reader, node)
    zero = zero_of(type_) if type_ is not None and type_.name in SCALARS else None
    if zero is None and not isinstance(kept, Outside):
        raise reader.unread(node, "the model does not know which value this is")
    yield m.Return(zero, annotations, reader.cpp.span(node))


def _result(reader: CppStatementReader, node: Node) -> m.Type | None:
    """The type of the model that the function around a statement gives, if it has one like it."""
    around = next((n for n in ancestors(node) if n.type in _FUNCTIONS), node)
    declarator = around.child_by_field_name("declarator")
    type_ = around.child_by_field_name("type")
    is_plain = declarator is not None and declarator.type == "function_declarator"
    kept = reader.scope.carried(type_) if type_ is not None and is_plain else None
    return reader.scope.returns if kept is None or kept.bits or kept.wide else kept.type


def _ends_function(node: Node) -> bool:
    """Whether a statement is the last of a function."""
    body = node.parent
    is_last = body is not None and named(body)[-1] == node
    function = body.parent if body is not None and is_last else None
    return function is not None and function.type == "function_definition"


def returned(
    reader: CppStatementReader, node: Node, annotations: tuple[m.Annotation, ...]
) -> Iterator[m.Statement]:
    """`return`: its value goes where the function's value is kept."""
    values = named(node)
    span = reader.cpp.span(node)
    if values and values[0].type == "initializer_list" and not named(values[0]):
        yield from _returned_empty(reader, node, annotations)
        return
    if not values:
        yield m.Return(None, annotations, span)
        return
    match reader.returns:
        case Record() as record:
            yield from cpp_special.returned(reader, values[0], record)
            yield m.Return(None, annotations, span)
        case Variable() as place:
            yield m.Return(reader.expressions.stored(values[0], place), annotations, span)
        case Outside():
            Effects(reader.cpp, reader.scope).check(values[0])
            yield m.Return(None, annotations, span)
        case None if reader.scope.returns is not None:
            place = Variable("", reader.scope.returns)
            yield m.Return(reader.expressions.stored(values[0], place), annotations, span)
        case _ if reader.scope.server is not None and reader.scope.open:
            Effects(reader.cpp, reader.scope).check(values[0])
            yield m.Return(None, annotations, span)
        case _:
            yield m.Return(reader.expressions.read(values[0]), annotations, span)
