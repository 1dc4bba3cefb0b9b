"""Statements that people write in Python where the model has several, or declares a variable."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.python.expressions.elements import certain
from rebsync.reverse.python.generated import arrays, idioms, tuples
from rebsync.reverse.python.generated.inner import leaves
from rebsync.reverse.python.generated.places import is_kept
from rebsync.reverse.python.generated.py_types import call_parts, string_value
from rebsync.reverse.python.generated.statement_reader import ModelStatementReader
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import SCOPES, field, named, text_of, whole_number_of
from rebsync.static.types import INT

_PLACES = ("identifier", "attribute")

_WHOLE = "say what is stored here element by element"


# --- assignments --------------------------------------------------------------------------------


def chained(reader: ModelStatementReader, node: Node) -> list[m.Statement]:
    """`a = b = e`, where `e` is kept if it may be another value the second time."""
    lefts, value = [field(node, "left")], node.child_by_field_name("right")
    while value is not None and value.type == "assignment":
        lefts.append(field(value, "left"))
        value = value.child_by_field_name("right")
    if value is None:
        raise reader.expressions.unread(node, "nothing is stored here: give it a value")
    stored = {idioms.base_of(left) for left in lefts}
    if not idioms.is_plain(value) or not stored.isdisjoint(idioms.names_in(value)):
        return _computed_once(reader, lefts, value, node)
    return [s for left in lefts for s in _stored(reader, left, value, node)]


def _computed_once(
    reader: ModelStatementReader, lefts: list[Node], value: Node, node: Node
) -> list[m.Statement]:
    """`self._x = x = e`: the value goes into a local, and from there into variables of its type."""
    known = reader.expressions
    new = [n for n in lefts if n.type == "identifier" and text_of(n) not in known.locals]
    others = [n for n in lefts if n not in new[:1]]
    first = reader.implied_local(text_of(new[0]), value, node) if new else None
    first = first or _kept(reader, lefts[0], value, node)
    read = [known.expression(left) for left in others]  # behind what may hide them
    type_, name = first.declaration.type, first.declaration.declarators[0].name
    if any(left.type not in _PLACES for left in others) or {*map(known.kind, read)} - {type_}:
        raise known.unread(node, "store this in one variable after the other")
    span = known.py.span(node)
    stores = (m.Assign("=", target, m.Name(name), span) for target in read)
    return [first, *(m.ExpressionStatement(each, span=span) for each in stores)]


def unpacked(reader: ModelStatementReader, node: Node) -> list[m.Statement]:
    """`a, b = x, y` and `a, b = self._pair`, what is needed again being kept.

    Unread: the values are not as many, or what they are depends on their order.
    """
    lefts, right = named(field(node, "left")), field(node, "right")
    expressions = reader.expressions
    is_plain = right.type in ("expression_list", "tuple")
    elements = None if is_plain else tuples.parts(expressions, right)
    if elements is not None and len(elements) == len(lefts):
        read = {n.name for e in elements for n in m.walk(e) if isinstance(n, m.Name | m.Member)}
        kept_ = list[m.Local]()
        if not read.isdisjoint(map(expressions.variable, map(idioms.base_of, lefts))):
            kept_ = [_kept(reader, left, e, node) for left, e in zip(lefts, elements, strict=True)]
            elements = [m.Name(local.declaration.declarators[0].name) for local in kept_]
        pairs = zip(lefts, elements, strict=True)
        return [*kept_, *(s for left, e in pairs for s in _given(reader, left, e, node))]
    lefts, values = _flat(lefts, named(right) if is_plain else [])
    if len(lefts) != len(values) or "list_splat" in {v.type for v in (*lefts, *values)}:
        raise expressions.unread(node, "the model has no such assignment")
    needed = [i for i, v in enumerate(values) if _is_needed(lefts[:i], v)]
    if not all(map(idioms.is_plain, values[1:] if not needed else values)):
        why = "this needs a value from before: store one after the other"
        raise expressions.unread(node, why)
    kept = {number: _kept(reader, lefts[number], values[number], node) for number in needed}
    found: list[m.Statement] = list(kept.values())
    for number, (left, value) in enumerate(zip(lefts, values, strict=True)):
        if number in kept:
            name = kept[number].declaration.declarators[0].name
            found += _given(reader, left, m.Name(name), node)
        else:
            found += _stored(reader, left, value, node)
    return found


def _flat(lefts: list[Node], values: list[Node]) -> tuple[list[Node], list[Node]]:
    """`a, (b, c) = x, (y, z)` as three: all values are there before the first is stored."""
    if len(lefts) != len(values):
        return lefts, values
    flat: tuple[list[Node], list[Node]] = [], []
    for left, value in zip(lefts, values, strict=True):
        parts = named(left), named(value)
        is_tuple = left.type == "tuple_pattern" and value.type == "tuple"
        is_pair = is_tuple and len(parts[0]) == len(parts[1])
        inner = _flat(*parts) if is_pair else ([left], [value])
        flat[0].extend(inner[0])
        flat[1].extend(inner[1])
    return flat


def _is_needed(before: list[Node], value: Node) -> bool:
    """Whether a value is looked at that is stored over before its turn."""
    stored = {idioms.base_of(left) for left in before}
    return not stored.isdisjoint(idioms.names_in(value))


def _kept(
    reader: ModelStatementReader, left: Node, value: Node | m.Expression, node: Node
) -> m.Local:
    """A local that keeps a value until it is its turn."""
    read = reader.expressions.expression(value) if isinstance(value, Node) else value
    type_ = reader.expressions.kind(read)
    if type_ is None:
        raise reader.expressions.unread(node, "store one after the other, with a variable between")
    plain = idioms.base_of(left).removeprefix("self.").strip("_")
    name = reader.free(pattern=f"{plain}_{{}}")
    reader.expressions.locals[f"kept as {name}"] = name
    reader.expressions.types[name] = type_
    span = reader.expressions.py.span(node)
    return m.Local(m.Declaration(type_, (m.Declarator(name, read, span),), span=span), span=span)


def _stored(reader: ModelStatementReader, left: Node, value: Node, node: Node) -> list[m.Statement]:
    name = text_of(left)
    if left.type == "identifier" and name not in reader.expressions.locals:
        return [reader.implied_local(name, value, node)]
    target = reader.expressions.expression(left)
    stored = reader.expressions.stored(target, left, value, node, statement=True)
    reader.in_order(stored)
    return [m.ExpressionStatement(stored, span=reader.expressions.py.span(node))]


def _given(
    reader: ModelStatementReader, left: Node, value: m.Expression, node: Node
) -> list[m.Statement]:
    """A value of the model that is stored."""
    name, span = text_of(left), reader.expressions.py.span(node)
    if left.type != "identifier" or name in reader.expressions.locals:
        stored = m.Assign("=", reader.expressions.expression(left), value, span)
        reader.in_order(stored)
        return [m.ExpressionStatement(stored, span=span)]
    type_ = reader.expressions.kind(value)
    if type_ is None:
        raise reader.expressions.unread(node, f'say the type of "{name}" where it is first set')
    return [reader.declaration(name, reader.local(name), type_, value, node)]


def all_elements(reader: ModelStatementReader, left: Node, value: Node) -> list[m.Statement] | None:
    """`self._a = Array([x, y])`, element by element; None for another assignment."""
    called, arguments = call_parts(value) or ("", [])
    if (sliced := _whole_slice(left)) is not None and value.type == "list":
        left, called, arguments = sliced, "Array", [value]
    if called != "Array" or len(arguments) != 1:
        return _filled(reader, left, value)
    places = arrays.array_elements(reader.expressions, left)
    values = certain(reader.expressions, arguments[0], "this") if places else []
    if places is None or len(places) != len(values):
        raise reader.expressions.unread(value, _WHOLE)
    if idioms.base_of(left) in idioms.names_in(arguments[0]):
        raise reader.expressions.unread(value, _WHOLE)
    span = reader.expressions.py.span(value)
    stored = (m.Assign("=", p, v.expression, span) for p, v in zip(places, values, strict=True))
    return [m.ExpressionStatement(each, span=span) for each in stored]


def _whole_slice(node: Node) -> Node | None:
    """The array of which all is stored in: `self._a[:]`."""
    at = node.children_by_field_name("subscript") if node.type == "subscript" else []
    return field(node, "value") if [text_of(n) for n in at] == [":"] else None


def _filled(reader: ModelStatementReader, left: Node, value: Node) -> list[m.Statement] | None:
    """`self._a[:] = self._b` and `self._a[:] = [0] * 8`, of as many elements as it has."""
    target = _whole_slice(left)
    places = arrays.array_elements(reader.expressions, target) if target is not None else None
    if target is None or places is None:
        return None
    span = reader.expressions.py.span(value)
    if value.type == "binary_operator" and text_of(field(value, "operator")) == "*":
        given, times = field(value, "left"), whole_number_of(field(value, "right"))
        if given.type != "list" or len(named(given)) != 1 or times != len(places):
            return None
        if not idioms.is_literal(reader.expressions, named(given)[0]):
            return None
        read = reader.expressions.expression(named(given)[0])
        stores = [m.Assign("=", place, read, span) for place in places]
        return [m.ExpressionStatement(each, span=span) for each in stores]
    others = arrays.array_elements(reader.expressions, value)
    kinds = {reader.expressions.kind(each) for each in (*places, *(others or ()))}
    if others is None or len(others) != len(places) or len(kinds) != 1:
        return None
    copied = m.Assign(
        "=", reader.expressions.expression(target), reader.expressions.expression(value), span
    )
    return [m.ExpressionStatement(copied, span=span)]


# --- variables ----------------------------------------------------------------------------------


def declared_before(
    reader: ModelStatementReader, node: Node, after: list[Node]
) -> list[m.Statement]:
    """The variables that a statement names first within, which the model declares before it.

    `:=` stores where it stands; what all branches store is known behind them.
    """
    names = {text_of(field(w, "name")): field(w, "value") for w in _walruses(node)}
    for unsure in _unsure(node, after):
        names.pop(unsure, None)
    if node.type in ("if_statement", "match_statement") and after:
        wanted = {n for each in after for n in idioms.names_in(each)}
        names |= {k: v for k, v in _of_all_branches(node).items() if k in wanted}
    found: list[m.Statement] = []
    for name, value in names.items():
        known = reader.expressions
        if name in known.locals or name in known.names.constants or name in known.kept:
            continue
        try:
            type_ = idioms.kind_at(known, value)
        except Unread:
            continue  # it is listed where it stands
        if type_ is not None:
            found.append(reader.declaration(name, reader.local(name), type_, None, node))
    return found


def _walruses(node: Node) -> Iterator[Node]:
    """The `:=` that a statement evaluates itself, and not one within it."""
    for child in named(node):
        if child.type in ("block", *SCOPES) or child.type == "comment":
            continue
        if child.type == "named_expression" and not is_kept(child):
            yield child
        yield from _walruses(child)


def _unsure(node: Node, after: list[Node]) -> Iterator[str]:
    """What `:=` may leave as it is, and is looked at all the same: a round before may have set it.

    Behind `and` a variable is set wherever all of the condition holds.
    """
    behind = {name for each in after for name in idioms.names_in(each)}
    for walrus in _walruses(node):
        name, way = text_of(field(walrus, "name")), list(_may_skip(walrus, node))
        if way and (name in behind or (set(way) != {"and"} and _count(node, name) > 1)):
            yield name


def _may_skip(walrus: Node, node: Node) -> Iterator[str]:
    """What may leave out a part of a statement."""
    inner, above = walrus, walrus.parent
    while above is not None and inner != node:
        if above.type == "boolean_operator" and field(above, "right") == inner:
            yield text_of(field(above, "operator"))
        elif above.type == "conditional_expression" and named(above)[1] != inner:
            yield "if"
        elif above.type == "elif_clause":
            yield "elif"
        inner, above = above, above.parent


def _count(node: Node, name: str) -> int:
    return sum(n.type == "identifier" and text_of(n) == name for n in nodes_in(node))


def _of_all_branches(node: Node) -> dict[str, Node]:
    """What all branches of an `if` or `match` that takes one store at their top, with the first."""
    found = []
    for body in _branches(node):
        inner = [named(s)[0] for s in named(body) if s.type == "expression_statement" and named(s)]
        plain = [a for a in inner if a.type == "assignment" and a.child_by_field_name("right")]
        untyped = [a for a in plain if a.child_by_field_name("type") is None]
        found.append({text_of(n): v for a in reversed(untyped) for n, v in _pairs(a)})
    first, *others = found or [dict[str, Node]()]
    return {k: v for k, v in first.items() if all(k in other for other in others)}


def _branches(node: Node) -> list[Node]:
    """The blocks of a statement that runs one of them; none if it may run none."""
    if node.type == "match_statement":
        cases = named(field(node, "body"))
        patterns = [c for c in named(cases[-1]) if c.type == "case_pattern"]
        takes_all = [text_of(p) for p in patterns] == ["_"]
        is_whole = takes_all and cases[-1].child_by_field_name("guard") is None
        return [field(c, "consequence") for c in cases] if is_whole else []
    parts = [node, *node.children_by_field_name("alternative")]
    bodies = [field(p, "body" if p.type == "else_clause" else "consequence") for p in parts]
    return bodies if parts[-1].type == "else_clause" else []


def _pairs(assignment: Node) -> Iterator[tuple[Node, Node]]:
    """The names that an assignment gives values, with these: `x = e`, `x, y = e, f`."""
    left, right = field(assignment, "left"), field(assignment, "right")
    is_many = left.type in ("pattern_list", "tuple_pattern")
    is_many = is_many and right.type in ("expression_list", "tuple")
    lefts, values = _flat(named(left), named(right)) if is_many else ([left], [right])
    if len(lefts) == len(values):
        yield from (p for p in zip(lefts, values, strict=True) if p[0].type == "identifier")


def deleted(reader: ModelStatementReader, node: Node) -> list[m.Statement]:
    """`del x` of a local that nothing names behind it, which says nothing in the model."""
    names = [text_of(n) for n in (named(named(node)[0]) or named(node))]
    block = node.parent
    rest = named(block)[named(block).index(node) + 1 :] if block is not None else []
    used = {name for each in rest for name in idioms.names_in(each)}
    if not set(names) <= reader.implied or used & set(names):
        raise reader.expressions.unread(node, "the model has no such statement")
    return []


# --- control ------------------------------------------------------------------------------------


def asserted(reader: ModelStatementReader, node: Node) -> list[m.Statement]:
    """`assert e, "text"`: what must hold, told as one of the model's assertions.

    Nothing for what the types of the model say already.
    """
    parts, span = named(node), reader.expressions.py.span(node)
    if _is_of_its_type(reader, parts[0]):
        return []
    given: list[m.Expression] = [reader.expressions.condition(parts[0])]
    if not is_calm(given[0]):
        raise reader.expressions.unread(node, "Python without assertions does not do this")
    if len(parts) > 1 and string_value(parts[1]) is not None:
        is_formatted = any(c.type == "interpolation" for c in parts[1].children)
        given += [] if is_formatted else [reader.expressions.expression(parts[1])]
    return [m.ExpressionStatement(m.Call(None, "assertion", tuple(given), span=span), span=span)]


def _is_of_its_type(reader: ModelStatementReader, node: Node) -> bool:
    """Whether it is `isinstance(x, int)` of a whole number: of others Python may have another.

    What is asked is a variable: other expressions may fail, or change something.
    """
    called, arguments = call_parts(node) or ("", [])
    binds, local = reader.expressions.names.constants.binds, reader.expressions.locals
    is_own = any(binds(word) or word in local for word in ("isinstance", "int"))
    if called != "isinstance" or len(arguments) != 2 or is_own or arguments[0].type not in _PLACES:
        return False
    kind = reader.expressions.kind(reader.expressions.expression(arguments[0]))
    return text_of(arguments[1]) == "int" and kind == INT


def tried(reader: ModelStatementReader, node: Node) -> list[m.Statement]:
    """`try` with a `finally` alone: one behind the other, as nothing leaves the first part.

    Handlers that only tell people of what they raise again change nothing.
    """
    plain = [*reader.expressions.names.silent.without_handlers([node])]
    if plain != [node]:
        return [*reader.block(plain, node).statements]
    clauses = [c for c in named(node) if c.type.endswith("_clause")]
    body = field(node, "body")
    if [c.type for c in clauses] != ["finally_clause"]:
        why = "what is caught here ends the body in the model"
        raise reader.expressions.unread(node, why)
    if any(leaves(part) for part in (body, clauses[0])):
        raise reader.expressions.unread(node, "nothing is to leave a block that has a finally")
    last = next(c for c in named(clauses[0]) if c.type == "block")
    return [
        *reader.block(named(body), body).statements,
        *reader.block(named(last), last).statements,
    ]
