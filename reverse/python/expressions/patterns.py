"""Patterns of `match`: values that stand in the code, and names that take everything."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import binary
from rebsync.reverse.python.expressions.operands import OperandReader
from rebsync.reverse.python.expressions.values import TRUTH, Value
from rebsync.reverse.syntax.py_tree import field, named, text_of

_NUMBERS = frozenset({"integer", "float"})
_VALUES = _NUMBERS | {"string", "concatenated_string", "true", "false"}
_NONE = "the model has no such case"


@dataclass(frozen=True, slots=True)
class MatchCase:
    """A branch of a `match`: the name that takes everything, or some values; then what is done.

    There is one of each for what is looked at, or for each element of a tuple. A value is negative
    where a minus stands before it.
    """

    clause: Node
    names: tuple[Node | None, ...]
    values: tuple[list[tuple[Node, bool]], ...]
    guard: Node | None
    block: Node


def cases(reader: OperandReader, node: Node, width: int = 1) -> Iterator[MatchCase]:
    """The branches of a `match` of one value, or of a tuple. Unread: a pattern looks into another
    container or an object, or nothing is left for the cases behind it.
    """
    clauses = [c for c in named(field(node, "body")) if c.type == "case_clause"]
    for clause in clauses:
        patterns = [c for c in named(clause) if c.type == "case_pattern"]
        if width > 1 and [n.type for n in named(patterns[0])] == ["tuple_pattern"]:
            patterns = named(named(patterns[0])[0])
        names, values = zip(*(_pattern(reader, p) for p in patterns), strict=True)
        is_any = width > 1 and [*map(text_of, patterns)] == ["_"]
        bound = [text_of(n) for n in names if n is not None]
        if (len(patterns) != width and not is_any) or len(bound) != len(set(bound)):
            raise Unread(reader.span(clause), _NONE)
        guard = clause.child_by_field_name("guard")
        test = named(guard)[0] if guard is not None else None
        case = MatchCase(clause, names, values, test, field(clause, "consequence"))
        if not any(values) and test is None and clause != clauses[-1]:
            raise Unread(reader.span(clause), "no case behind this one is ever taken")
        yield case


def _pattern(reader: OperandReader, pattern: Node) -> tuple[Node | None, list[tuple[Node, bool]]]:
    inner, values = named(pattern), list[tuple[Node, bool]]()
    if text_of(pattern) == "_":
        return None, values
    of = inner[0] if [n.type for n in inner] == ["union_pattern"] else pattern
    before = "|"
    for each in of.children:
        is_dotted = each.type == "dotted_name" and len(named(each)) > 1
        if each.type == "dotted_name" and not is_dotted and len(of.children) == 1:
            return named(each)[0], []
        is_first = before == "|" and (each.type in _VALUES or is_dotted or each.type == "-")
        is_number = before == "-" and each.type in _NUMBERS
        if not (is_first or is_number or (each.type == "|" and before not in "|-")):
            raise Unread(reader.span(pattern), _NONE)
        if each.type not in "|-":
            values.append((each, before == "-"))
        before = each.type
    return None, values


def asked(
    reader: OperandReader, case: MatchCase, of: Value | None, beside: Sequence[Value] = ()
) -> m.Expression | None:
    """What must hold so that a value takes a branch, if none above it; None: nothing."""
    found: m.Expression | None = None
    if of is None and any(case.values):
        found = m.Choice((m.BoolLiteral(True), m.BoolLiteral(False)))
    elif of is not None:
        pairs = zip((of, *beside), case.values, strict=False)
        for each in (_is_one(reader, v, values) for v, values in pairs):
            if each is not None:
                found = each if found is None else binary("&&", found, each)
    if case.guard is None:
        return found
    held = reader.condition(case.guard)
    return held if found is None else binary("&&", found, held)


def _is_one(
    reader: OperandReader, of: Value, values: list[tuple[Node, bool]]
) -> m.Expression | None:
    found: m.Expression | None = None
    for number, (value, is_negative) in enumerate(values):
        read = _value(reader, of, value, is_negative)
        one = reader.compared("==", of, read, value, number)
        found = one if found is None else binary("||", found, one)
    return found


def _value(reader: OperandReader, of: Value, value: Node, is_negative: bool) -> Value:
    """A value of a pattern; True and False are looked for by identity."""
    if value.type == "dotted_name":
        return reader.dotted(value)
    if value.type in ("true", "false") and of.kind != TRUTH:
        raise Unread(reader.span(value), _NONE)
    read = reader.read(value)
    if not is_negative:
        return read
    return Value(m.Unary("-", read.expression), read.kind)
