"""Loops over numbers and arrays, and `match`, as people write them, in the model's words."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import binary, selected
from rebsync.reverse.python.expressions.elements import MOST, known_range, rows
from rebsync.reverse.python.expressions.patterns import asked, cases
from rebsync.reverse.python.expressions.values import Value
from rebsync.reverse.python.generated import aliases, endings, idioms
from rebsync.reverse.python.generated.arrays import NO_LENGTH, array_elements
from rebsync.reverse.python.generated.callees import callee, is_method
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.inner import is_shown
from rebsync.reverse.python.generated.lazy import DISPLAYS
from rebsync.reverse.python.generated.names import Callee
from rebsync.reverse.python.generated.py_types import call_parts, markers_above
from rebsync.reverse.python.generated.statement_reader import ModelStatementReader
from rebsync.reverse.python.generated.tuples import parts
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import field, named, text_of

_STEP = "step"
# What must hold for a branch, if anything, and the branch.
Way: TypeAlias = "tuple[m.Expression | None, m.Block]"

# What leaves a round, or may be done after it.
_LEAVING = frozenset({"break_statement", "continue_statement", "function_definition", "lambda"})


def counted(reader: ModelStatementReader, node: Node, name: str) -> m.For:
    """`for i in range(...)`."""
    start, end, step = idioms.rounds(reader.expressions, node)
    if reader.lasting:  # the variable keeps its last value, and not the one that ends the loop
        index = _free(reader, node, name)
        body = _round(reader, node, [], index, [(name, m.Type("int"), m.Name(index))])
        return _for(reader, node, index, start, end, step, body)
    reader.annotated[name] = m.Type("int")
    index = _counter(reader, node, name)
    body = _round(reader, node, [(name, m.Type("int"))], index, [])
    return _for(reader, node, index, start, end, step, body)


def _counter(reader: ModelStatementReader, node: Node, name: str) -> str:
    """What a loop counts by in the model: there, `i` may be what `i__2` is in Python.

    It is not where the body has another `i`.
    """
    plain = reader.without_number(name)
    return reader.local(name if plain in idioms.names_in(field(node, "body")) else plain)


def stepped(reader: ModelStatementReader, body: Node) -> tuple[list[Node], list[Node]]:
    """What a `while` does up to the marker of a step, and the step, which a `continue` skips.

    There is none behind a `continue`, and where more than stores stands there.
    """
    nodes = named(body)
    marked = (_STEP in markers_above(reader.expressions.py, n) for n in nodes)
    at = next((i for i, is_step in enumerate(marked) if is_step), len(nodes))
    is_plain = all(n.type == "expression_statement" for n in nodes[at:])
    if not is_plain or endings.leaves(body, "continue_statement"):
        return nodes, []
    return nodes[:at], nodes[at:]


def through(
    reader: ModelStatementReader, node: Node, called: str, arguments: list[Node]
) -> m.For | m.Block | None:
    """`enumerate`, `zip` and `reversed(range(...))`, and a tuple of numbers; None for others."""
    left, right = field(node, "left"), field(node, "right")
    names = [text_of(n) for n in (named(left) if left.type == "pattern_list" else [left])]
    match called, arguments:
        case (("enumerate" | "zip"), _) if any(_is_shown(reader, a) for a in arguments):
            return _unrolled(reader, node, names)
        case "enumerate", [values] if len(names) == 2:
            return numbered(reader, node, names[0], names[1:], [values])
        case "zip", _ if len(names) == len(arguments) > 0:
            return numbered(reader, node, "", names, arguments)
        case "reversed", [inner] if len(names) == 1:
            return _backwards(reader, node, names[0], inner)
        case "", _ if len(names) == 1 and _are_literals(reader, right):
            return _listed(reader, node, names[0], named(right))
        case "", _ if _is_shown(reader, right):
            return _unrolled(reader, node, names)
        case _:
            return None


def _are_literals(reader: ModelStatementReader, node: Node) -> bool:
    """Whether a display has values alone that are the same at any time."""
    is_display = node.type in ("tuple", "list")
    return is_display and all(idioms.is_literal(reader.expressions, v) for v in named(node))


def _is_shown(reader: ModelStatementReader, node: Node) -> bool:
    """Whether the values that are gone through are written out somewhere."""
    if node.type in DISPLAYS or text_of(node) in reader.expressions.kept_tables:
        return True
    return bool(parts(reader.expressions, node, arrays=False))


def numbered(
    reader: ModelStatementReader, node: Node, number: str, names: list[str], arrays: list[Node]
) -> m.For:
    """A loop through several arrays at once; the variable `number` counts, if it has a name."""
    each_ = [array_elements(reader.expressions, a) for a in arrays]
    if None in each_ or len({*names, number}) != len(names) + 1:
        raise reader.expressions.unread(node, "the model has no such loop")
    for array in arrays:
        _assert_kept(reader, node, array)
    length = min(len(elements) for elements in each_ if elements is not None)
    index = reader.local(number) if number else _free(reader, node, names[0])
    first: list[tuple[str, m.Type, m.Expression]] = []
    for name, elements in zip(names, each_, strict=True):
        read = elements[0] if elements else m.IntLiteral(0)
        element = reader.expressions.kind(read)
        if not isinstance(read, m.Index) or element is None:
            raise reader.expressions.unread(node, "the model has no such loop")
        first.append((name, element, m.Index(read.target, m.Name(index))))
    body = _round(reader, node, [(number, m.Type("int"))] if number else [], index, first)
    return _times(reader, node, index, length, body)


def _listed(reader: ModelStatementReader, node: Node, name: str, values: list[Node]) -> m.For:
    """A loop over numbers, each in its turn."""
    read = [reader.expressions.expression(v) for v in values]
    kinds = {reader.expressions.kind(e) for e in read}
    if len(kinds) != 1:
        raise reader.expressions.unread(node, "the model has no such loop")
    (kind,) = kinds
    index = _free(reader, node, name)
    value = selected(m.Name(index), dict(enumerate(read[:-1])), read[-1])
    body = _round(reader, node, [], index, [(name, kind or m.Type("int"), value)])
    return _times(reader, node, index, len(read), body)


def _unrolled(reader: ModelStatementReader, node: Node, names: list[str]) -> m.Block:
    """What a loop through values that are written out does, once for each of them."""
    body, expressions = field(node, "body"), reader.expressions
    patterns = (n for n in nodes_in(body) if n.type == "case_pattern")
    stored = idioms.stored_in(body).union(*map(_identifiers, patterns))
    given = _identifiers(field(node, "right"))
    leaves = any(n.type in _LEAVING for n in nodes_in(body))
    if leaves or {*names, *given} & stored or set(names) & expressions.locals.keys():
        raise expressions.unread(node, "the model has no such loop")
    statements: list[m.Statement] = []
    outer, are_arrays = expressions.kept_sends, _are_arrays(reader, node, names)
    for values, sends in [*_rounds(expressions, field(node, "right"), names)]:
        if not (are_arrays or all(_is_steady(expressions, v.expression) for v in values.values())):
            raise expressions.unread(node, "the model has no such loop")
        expressions.kept_sends = {**outer, **sends}
        with expressions.standing_for([*values], [*values.values()]):
            statements.append(reader.suite(body))
        expressions.kept_sends = outer
    return m.Block(tuple(statements), span=expressions.py.span(node))


def _identifiers(node: Node) -> set[str]:
    return {text_of(n) for n in nodes_in(node) if n.type == "identifier"}


def _rounds(
    expressions: ModelExpressionReader, right: Node, names: list[str]
) -> Iterator[tuple[dict[str, Value], dict[str, Callee]]]:
    """What the variables of a loop are round by round: values, and functions of the object."""
    right = expressions.kept_tables.get(text_of(right), right)
    if not is_shown(expressions, right):
        for values in rows(expressions, right, len(names)):
            yield dict(zip(names, values, strict=True)), {}
        return
    for each in named(right):
        given = named(each) if len(names) > 1 and each.type == "tuple" else [each]
        if len(given) != len(names) or len(named(right)) > MOST:
            raise expressions.unread(each, "nobody knows what this goes through")
        by_name = dict(zip(names, given, strict=True))
        sends = {n: callee(expressions, g) for n, g in by_name.items() if is_method(expressions, g)}
        yield {n: expressions.read(g) for n, g in by_name.items() if n not in sends}, sends


def _are_arrays(reader: ModelStatementReader, node: Node, names: list[str]) -> bool:
    """Whether a loop goes through arrays of the object, of which it only asks elements."""
    right, body = field(node, "right"), field(node, "body")
    arrays = [n for n in named(right) if n.type != "comment"]
    uses = (n for n in nodes_in(body) if n.type == "identifier" and text_of(n) in names)
    is_plain = right.type in ("tuple", "list") and len(names) == 1
    is_calm = idioms.is_quiet(body) and not any("." in name for name in idioms.stored_in(body))
    is_array = aliases.is_array if is_calm else aliases.is_kept
    is_plain = is_plain and all(is_array(reader, array) for array in arrays)
    return is_plain and all(aliases.is_element(use, body) for use in uses)


def _is_steady(expressions: ModelExpressionReader, value: m.Expression) -> bool:
    """Whether only a store into a local changes a value."""
    is_local = isinstance(value, m.Name) and value.name in expressions.locals.values()
    return is_local or isinstance(value, m.IntLiteral | m.BoolLiteral)


def _backwards(reader: ModelStatementReader, node: Node, name: str, inner: Node) -> m.For:
    """`for i in reversed(range(n))`, of numbers that count up by one."""
    called, arguments = call_parts(inner) or ("", [])
    if called != "range" or not 1 <= len(arguments) <= 2:
        if array_elements(reader.expressions, inner) is not None:
            raise reader.expressions.unread(node, NO_LENGTH.format("reversed"))
        raise reader.expressions.unread(node, "the model has no such loop")
    if (numbers := known_range(arguments)) is None:
        raise reader.expressions.unread(node, "say with numbers how often this is done")
    index = _counter(reader, node, name)
    place = m.Name(index)
    body = _round(reader, node, [(name, m.Type("int"))], index, [])
    declared = m.Declaration(m.Type("int"), (m.Declarator(index, m.IntLiteral(numbers.stop - 1)),))
    condition = binary(">=", place, m.IntLiteral(numbers.start))
    span = reader.expressions.py.span(node)
    return m.For(declared, condition, (m.Postfix("--", place),), body, span=span)


def _round(
    reader: ModelStatementReader,
    node: Node,
    counting: list[tuple[str, m.Type]],
    index: str,
    first: list[tuple[str, m.Type, m.Expression]],
) -> m.Block:
    """The body of a loop that begins with what its variables are this time."""
    body, known = field(node, "body"), reader.expressions.locals
    lasting, reader.lasting = reader.lasting, ""
    names = [(name, type_) for name, type_, _ in first] + counting
    types = reader.expressions.types
    own = {n for n, type_, _ in first if n == lasting and types.get(known.get(n, "")) == type_}
    taken = {*(known.keys() - own), *idioms.stored_in(body)}
    if not all(n.isidentifier() and n not in taken for n, _ in names):
        raise reader.expressions.unread(node, "the variable of this loop is used elsewhere")
    known[f"index of {names[0][0]}"] = index
    hidden = dict(types)
    for name, type_ in names:
        if name not in own:
            known[name] = index if (name, type_) in counting else reader.local(name)
        types[known[name]] = type_
    found = reader.suite(body)
    declared: tuple[m.Statement, ...] = tuple(
        m.ExpressionStatement(m.Assign("=", m.Name(known[name]), value))
        if name == lasting
        else m.Local(m.Declaration(type_, (m.Declarator(known[name], value),)))
        for name, type_, value in first
    )
    for name, type_ in names:
        if name != lasting:
            types[known[name]] = hidden.get(known[name], type_)
            del known[name]
    del known[f"index of {names[0][0]}"]
    return replace(found, statements=(*declared, *found.statements))


def _assert_kept(reader: ModelStatementReader, node: Node, array: Node) -> None:
    """Python goes on through the array that there was at the start. Unread: another is stored."""
    body, name = field(node, "body"), text_of(array)
    store = re.compile(rf"(?<![\w.]){re.escape(name)}(?:, [^\n=]+)?\s*=(?!=)")
    is_ours = store.search(text_of(body)) is not None
    if (
        "." in name
        and not is_ours
        and re.search(r"\b(?:self|super\(\))\.(?!send_)\w+\(", text_of(body))
    ):
        is_ours = store.search(reader.expressions.py.source.text) is not None
    if is_ours:
        why = "what is stored here in the array is not gone through: store it behind the loop"
        raise reader.expressions.unread(node, why)


def _free(reader: ModelStatementReader, node: Node, name: str) -> str:
    """A name for the index of a loop, which nothing in it has."""
    taken = {name, *idioms.stored_in(field(node, "body"))}
    return reader.free("i", "j", "k", pattern="i{}", taken=taken)


def _times(
    reader: ModelStatementReader, node: Node, index: str, count_: int, body: m.Block
) -> m.For:
    """A loop that is done so often."""
    zero, one = m.IntLiteral(0), m.IntLiteral(1)
    return _for(reader, node, index, zero, m.IntLiteral(count_), one, body)


def _for(
    reader: ModelStatementReader,
    node: Node,
    index: str,
    start: m.Expression,
    end: m.Expression,
    step: m.Expression,
    body: m.Block,
) -> m.For:
    place = m.Name(index)
    declared = m.Declaration(m.Type("int"), (m.Declarator(index, start),))
    is_down = isinstance(step, m.Unary)
    by = step.operand if isinstance(step, m.Unary) else step
    if not isinstance(by, m.IntLiteral) or by.value == 0:
        raise reader.expressions.unread(node, "the step of this loop is to be a number")
    idioms.check_steady(reader.expressions, node, end, body)
    operator = "-" if is_down else "+"
    update: m.Expression = m.Postfix(operator * 2, place)
    if by.value != 1:
        update = m.Assign(f"{operator}=", place, by)
    else:  # an integer is behind the last one that the body runs with, as `end` is an integer
        update = reader.expressions.cuts.converted("int32", update, update=True)
    condition = binary(">" if is_down else "<", place, end)
    span = reader.expressions.py.span(node)
    return m.For(declared, condition, (update,), body, span=span)


def match(reader: ModelStatementReader, node: Node) -> list[m.Statement]:
    """`match` as the chain of conditions that it is."""
    expressions, subjects = reader.expressions, node.children_by_field_name("subject")
    if [s.type for s in subjects] == ["tuple"] and len(named(subjects[0])) > 1:
        subjects = named(subjects[0])
    (of, *beside), found = [*map(expressions.read, subjects)], list[Way]()
    is_calm = expressions.is_calm(of, *beside) and not any(map(expressions.may_fail, subjects))
    if not (is_calm if beside else idioms.is_plain(subjects[0])):
        why = "what this compares more than once is to be in a variable first"
        raise expressions.unread(node, why)
    for case in cases(expressions, node, len(subjects)):
        pairs = zip(case.names, subjects, (of, *beside), strict=False)
        bound = [(text_of(n), s, value) for n, s, value in pairs if n is not None]
        if not all(idioms.lasts(expressions, s, name, case.block) for name, s, _ in bound):
            why = "this name is not that of what is compared all the time"
            raise expressions.unread(case.clause, why)
        if case.guard is not None and not idioms.is_quiet(case.guard):
            raise expressions.unread(case.guard, "what this does may count for the cases behind it")
        with expressions.standing_for([n for n, _, _ in bound], [v for _, _, v in bound]):
            found.append((asked(expressions, case, of, beside), reader.branch(case.block)))
    chain: m.Statement | None = None
    for condition, body in reversed(found):
        span = expressions.py.span(node)
        chain = body if condition is None else m.If(condition, body, chain, span=span)
    return [chain] if chain is not None else []


def taken_before(
    before: list[m.Statement], condition: m.Expression | None, updates: tuple[m.Expression, ...]
) -> m.Declaration | tuple[m.Expression, ...]:
    """What stands directly before a loop and gives its variable a value, taken out of there."""
    parts = [e for e in (condition, *updates) if e is not None]
    used = {n.name for e in parts for n in m.walk(e) if isinstance(n, m.Name)}
    match before[-1:]:
        case [m.Local(declaration, annotations=())] if declaration.declarators[0].name in used:
            before.pop()
            return declaration
        case [m.ExpressionStatement(m.Assign("=", m.Name(name)) as first, annotations=())]:
            if name in used:
                before.pop()
                return (first,)
    return ()
