"""Tuples of generated Python, element by element: the model has none. They compare so, too."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial, reduce

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import binary, chosen, is_calm
from rebsync.reverse.python.expressions.values import TRUTH, WHOLE
from rebsync.reverse.python.generated import idioms
from rebsync.reverse.python.generated.arguments import in_order
from rebsync.reverse.python.generated.arrays import array_elements
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.failing import may_fail
from rebsync.reverse.python.generated.helpers import own_name
from rebsync.reverse.python.generated.kinds import is_floating
from rebsync.reverse.python.generated.py_types import call_parts, is_text, without_parentheses
from rebsync.reverse.python.generated.record_classes import fields_of, given_to, is_tuple
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import has_splat
from rebsync.reverse.syntax.py_tree import field, named, text_of


def kept(reader: ModelExpressionReader, node: Node) -> list[m.Expression] | None:
    """The elements of a local that is a tuple (`records.behind`); None for anything else."""
    found = list[m.Expression]()
    while (each := reader.bound.get(f"{text_of(node)}.{len(found)}")) is not None:
        found.append(each)
    return found or None


def parts(
    reader: ModelExpressionReader, node: Node, *, arrays: bool = True
) -> list[m.Expression] | None:
    """The elements of a tuple that is written out, kept, constant, or chosen, or of an array.

    None for anything else, and where to evaluate one may fail, or does something.
    """
    node, text = without_parentheses(node), text_of(node)
    if node.type in ("identifier", "attribute"):
        is_own = reader.hides_name(text.partition(".")[0])
        found = kept(reader, node) or (not is_own and [*reader.names.constants.tuple_of(text)])
        return found or given(reader, node) or (array_elements(reader, node) if arrays else None)
    if may_fail(reader, node):
        return None
    match node.type, named(node):
        case "tuple" | "expression_list", values:
            return _unpacked(reader, values)
        case "conditional_expression", [then, condition, otherwise]:
            ways = [parts(reader, way, arrays=arrays) for way in (then, otherwise)]
            return _chosen(reader.condition(condition), *ways) if all(ways) else None
        case "call", _ if (elements := given(reader, node)) is not None:
            return elements
        case "call", _ if is_tuple(reader, called := text_of(field(node, "function"))):
            fields = fields_of(reader, called) or ()
            if has_splat(node):
                spread = _unpacked(reader, named(field(node, "arguments")))
                return spread if spread and len(spread) == len(fields) else None
            of_fields = dict(given_to(node, fields) or ())
            return _calm([reader.expression(of_fields[f]) for f in fields if f in of_fields])
        case _:
            return looked_up(reader, node)


def _unpacked(reader: ModelExpressionReader, values: Sequence[Node]) -> list[m.Expression] | None:
    """The elements of a display, or arguments by position; None: nobody knows how many."""
    found = list[m.Expression]()
    for each in values:
        match each.type:
            case "list_splat":
                inner = parts(reader, named(each)[0])
                if inner is None:
                    return None
                found += inner
            case "keyword_argument" | "dictionary_splat":
                return None
            case _:
                found.append(reader.expression(each))
    return _calm(found)


def given(reader: ModelExpressionReader, node: Node) -> list[m.Expression] | None:
    """The elements of what a method, or a property, gives that only chooses between tuples."""
    called, arguments = call_parts(node) or ("", [])
    holder, _, name = (called or text_of(node)).rpartition(".")
    function = reader.names.beside.get(name)
    if function is None or holder != reader.own or function.py is not reader.py:
        return None
    is_property = "property" in function.decorators
    is_async = any(child.type == "async" for child in function.node.children)
    parameters = function.parameters[1:]
    if is_async or is_property == bool(called) or own_name(function) != reader.own:
        return None
    values = in_order(reader, node, arguments, parameters)
    passed = [*map(reader.expression, values)]
    is_whole = len(passed) == len(parameters) and all(map(is_calm, passed))
    if not is_whole or any(may_fail(reader, value) for value in values):
        return None
    inner = reader.inside({p.name: m.Paren(e) for p, e in zip(parameters, passed, strict=True)})
    others = {n: f for n, f in reader.names.beside.items() if n != name}  # none calls itself
    return _returned(replace(inner, names=replace(inner.names, beside=others)), body_of(function))


def _returned(reader: ModelExpressionReader, body: Sequence[Node]) -> list[m.Expression] | None:
    """The elements of the tuple that statements give, each way through them by itself.

    None where they do more than to choose it, or may fail.
    """
    match [s for s in body if s.type != "comment" and not is_text(s)]:
        case [first, *_] if first.type == "return_statement" and named(first):
            return parts(reader, named(first)[0], arrays=False)
        case [first, *rest] if first.type == "expression_statement":
            return _returned_behind(reader, named(first)[0], rest)
        case [first, *rest] if first.type == "if_statement":
            clauses = first.children_by_field_name("alternative")
            last = [n for c in clauses if c.type == "else_clause" for n in named(field(c, "body"))]
            found = _returned(reader, [*last, *rest])
            for clause in (c for c in (*reversed(clauses), first) if c.type != "else_clause"):
                condition = field(clause, "condition")
                if found is None or may_fail(reader, condition):
                    return None
                way = _returned(reader, [*named(field(clause, "consequence")), *rest])
                found = _chosen(reader.condition(condition), way, found)
            return found
        case _:
            return None


def _returned_behind(
    reader: ModelExpressionReader, made: Node, rest: Sequence[Node]
) -> list[m.Expression] | None:
    """The same of what follows a local that a value is given."""
    left, value = (made.child_by_field_name(n) for n in ("left", "right"))
    is_local = made.type == "assignment" and left is not None and left.type == "identifier"
    if left is None or value is None or not is_local or may_fail(reader, value):
        return None
    read = reader.expression(value)
    with reader.standing_for([text_of(left)], [reader.value(m.Paren(read))]):
        return _returned(reader, rest) if is_calm(read) else None


def _calm(found: list[m.Expression]) -> list[m.Expression] | None:
    return found if found and all(map(is_calm, found)) else None


def _chosen(
    asked: m.Expression, then: list[m.Expression] | None, otherwise: list[m.Expression] | None
) -> list[m.Expression] | None:
    """The elements of one of two tuples of the same length."""
    if not (then and otherwise) or len(then) != len(otherwise) or not is_calm(asked):
        return None
    pairs = zip(then, otherwise, strict=True)
    return [one if one == other else chosen(asked, one, other) for one, other in pairs]


def looked_up(
    reader: ModelExpressionReader, node: Node, *, single: bool = False
) -> list[m.Expression] | None:
    """`TABLE.get(key, (a, b))`, and `TABLE[key]` of a truth value: a tuple, or a `single` value."""
    row = _single if single else parts
    asked_ = table_asked(reader, node)
    if asked_ is None:
        return None
    (written, key), (_, arguments) = asked_, call_parts(node) or ("", [])
    if len(arguments) == 1:
        return None
    kind = WHOLE if arguments else TRUTH
    found = row(reader, arguments[1]) if arguments else None
    entries = [n for n in named(written) if n.type == "pair"]
    if len(entries) != len(named(written)) or (kind == WHOLE and not found):
        return None
    if kind == TRUTH and {text_of(field(n, "key")) for n in entries} != {"True", "False"}:
        return None
    asked = reader.read(key)
    for number, entry in enumerate(entries):
        known, values = reader.read(field(entry, "key")), row(reader, field(entry, "value"))
        if not asked.kind == known.kind == kind:
            return None
        is_it = binary("==", asked.expression, known.expression)
        found = _chosen(is_it, values, found) if number or kind == WHOLE else values
    return found


def looked_up_one(reader: ModelExpressionReader, node: Node) -> m.Expression:
    """The same of a table of plain values. Unread: it may have no such key."""
    found = looked_up(reader, node, single=True)
    if found is None:
        raise reader.unread(node, "say what there is for each value by `if`")
    return found[0]


def _single(reader: ModelExpressionReader, node: Node) -> list[m.Expression] | None:
    return None if may_fail(reader, node) else _calm([reader.expression(node)])


def table(reader: ModelExpressionReader, node: Node) -> Node | None:
    """A table as it is written: in place, kept in a local, or a constant."""
    if node.type == "dictionary":
        return node
    kept_ = reader.kept_tables.get(text_of(node))
    is_kept = kept_ is not None and kept_.type == "dictionary"
    return kept_ if is_kept else _constant(reader, node, "dictionary")


def table_asked(reader: ModelExpressionReader, node: Node) -> tuple[Node, Node] | None:
    """The table, and the key, of `TABLE.get(key, ...)` and `TABLE[key]`; None for others."""
    called, arguments = call_parts(node) or ("", [])
    if called.endswith(".get") and len(arguments) in (1, 2):
        of, key = field(field(node, "function"), "object"), arguments[0]
    elif node.type == "subscript":
        of, key = field(node, "value"), field(node, "subscript")
    else:
        return None
    written = table(reader, of)
    return (written, key) if written is not None else None


def members(reader: ModelExpressionReader, node: Node) -> list[m.Expression] | None:
    """The elements of a constant set, in any order."""
    found = _constant(reader, node, "set", "list", "tuple")
    return None if found is None else _calm([reader.expression(each) for each in named(found)])


def _constant(reader: ModelExpressionReader, node: Node, *types: str) -> Node | None:
    """The display that a name always stands for, if what it says means the same here."""
    text = text_of(node)
    is_own = reader.hides_name(text.partition(".")[0])
    found = None if is_own else reader.names.constants.container(text)
    names = (n for n in nodes_in(found) if n.type == "identifier") if found is not None else ()
    is_same = all(not reader.hides_name(text_of(n)) and "." not in text for n in names)
    return found if found is not None and found.type in types and is_same else None


def _elements(
    reader: ModelExpressionReader, node: Node
) -> tuple[str, Sequence[Node | m.Expression]] | None:
    """What is in a tuple or list that is written out, kept, or made of an array; else None."""
    node = without_parentheses(node)
    if node.type in ("tuple", "list"):
        values: Sequence[Node | m.Expression] | None = named(node)
        if any(each.type == "list_splat" for each in named(node)):
            values = None if may_fail(reader, node) else _unpacked(reader, named(node))
        return None if values is None else (node.type, values)
    called, arguments = call_parts(node) or ("", [])
    is_copy = called in ("tuple", "list") and reader.library(field(node, "function"))
    if is_copy and len(arguments) == 1:
        found = array_elements(reader, arguments[0])
        return None if found is None else (called, found)
    found = parts(reader, node, arrays=False)
    return None if found is None else ("tuple", found)


def is_among(reader: ModelExpressionReader, node: Node, signs: list[str]) -> m.Expression | None:
    """`(a, b) in (here, there)`; None where what is looked for is no tuple."""
    if signs not in (["in"], ["not in"]):
        return None
    left, right = map(without_parentheses, named(node))
    if _elements(reader, left) is None or right.type not in ("tuple", "list"):
        return None
    sign, word = ("==", "||") if signs == ["in"] else ("!=", "&&")
    each = [compared(reader, node, sign, (left, other)) for other in named(right)]
    found = [one for one in each if one is not None]
    if not found or len(found) < len(each):
        raise reader.unread(node, "the model has no such comparison")
    return idioms.grouped(node, reduce(partial(binary, word), found))


def compared(
    reader: ModelExpressionReader, node: Node, operator: str, sides: Sequence[Node]
) -> m.Expression | None:
    """`(a, b) < (c, d)`; None for a comparison of something else.

    Unread: the lengths differ, elements are no whole numbers or truth values (for Python an object
    is equal to itself, even one that is no number), or evaluating one may fail or do something: all
    of them are evaluated before any is compared, in the model only those that are asked.
    """
    left, right = (_elements(reader, side) for side in sides)
    if left is None or right is None or left[0] != right[0]:
        return _of_other_classes(reader, operator, sides)
    pairs = list(zip(left[1], right[1], strict=False))
    parts = [each for both in pairs for each in both]
    is_even = len(left[1]) == len(right[1]) > 0
    if not is_even or any(isinstance(each, Node) and may_fail(reader, each) for each in parts):
        raise reader.unread(node, "the model has no such comparison")
    read = [(_read(reader, one), _read(reader, other)) for one, other in pairs]
    for at, pair in enumerate(read):
        kinds = [reader.kind(side) for side in pair]
        if not all(map(is_calm, pair)):  # a property runs a function
            raise reader.unread(node, "what this does may count for what it is compared with")
        if any(kind is None or is_floating(kind) or kind.dimensions for kind in kinds):
            raise reader.unread(node, "the model has no such comparison")
        read[at] = idioms.alike(reader, node, operator, pair)
    return idioms.grouped(node, _lexicographical(operator, read))


def _of_other_classes(
    reader: ModelExpressionReader, operator: str, sides: Sequence[Node]
) -> m.Expression | None:
    """An array beside a display, to which none is equal, whatever they hold."""
    arrays = [side for side in sides if array_elements(reader, without_parentheses(side))]
    shown = [without_parentheses(side) for side in sides if side not in arrays]
    values = [each for side in shown for each in named(side)]
    if operator not in ("==", "!=") or len(arrays) != 1 or shown[0].type not in ("tuple", "list"):
        return None
    is_quiet = not any(may_fail(reader, each) for each in values) and _unpacked(reader, values)
    return m.BoolLiteral(operator == "!=") if is_quiet else None


def _read(reader: ModelExpressionReader, element: Node | m.Expression) -> m.Expression:
    return reader.expression(element) if isinstance(element, Node) else element


def _lexicographical(operator: str, pairs: list[tuple[m.Expression, m.Expression]]) -> m.Expression:
    """The first elements that differ decide, and if none do, whether the operator has `=`."""
    word = "||" if operator == "!=" else "&&"
    found = binary(operator, *pairs[-1])
    for left, right in reversed(pairs[:-1]):
        if operator in ("==", "!="):
            found = binary(word, binary(operator, left, right), found)
        else:
            same = binary("&&", binary("==", left, right), found)
            found = binary("||", binary(operator[0], left, right), same)
    return found
