"""What Python goes through, element by element: displays, comprehensions, and what has a name."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import is_calm, number_literal
from rebsync.reverse.python.expressions.operands import OperandReader
from rebsync.reverse.python.expressions.values import WHOLE, Value
from rebsync.reverse.syntax.py_tree import field, named, text_of, whole_number_of

MOST = 32  # elements that are said one by one
COMPREHENSIONS = ("generator_expression", "list_comprehension")
# For these order and number are nothing; the first three stop where they know the answer.
_SHORT = frozenset({"any", "all", "in"})
_OF_SETS = _SHORT | {"min", "max"}
_ALL_FIRST = 'all of what "{}" goes through is evaluated first'
# An element, and the condition under which it is there.
Element: TypeAlias = "tuple[Value, m.Expression | None]"


def arguments_of(call: Node) -> list[Node]:
    """What a call is given, a generator that stands alone too."""
    given = field(call, "arguments")
    return [given] if given.type in COMPREHENSIONS else named(given)


def known_range(arguments: list[Node]) -> range | None:
    """What `range` gives for arguments that are numbers; None for others, and where it fails."""
    whole = [n for n in map(whole_number_of, arguments) if n is not None]
    is_known = 1 <= len(whole) == len(arguments) <= 3 and whole[2:] != [0]
    return range(*whole) if is_known else None


def elements(reader: OperandReader, node: Node, called: str) -> list[Element]:
    """Each value that a function goes through. Unread: nobody knows these."""
    if node.type == "set" and called not in _OF_SETS:
        raise reader.unread(node, "nobody knows how many values this set has, in which order")
    if node.type == "list_comprehension" and called in _SHORT and reader.may_fail(node):
        raise reader.unread(node, _ALL_FIRST.format(called))
    if node.type in COMPREHENSIONS:
        found = list(_comprehended(reader, node))
    elif node.type in ("list", "tuple", "set"):
        found = [(value, None) for value in _displayed(reader, node, called)]
    elif (numbers := _numbers(reader, node)) is not None:
        found = [(Value(number_literal(n), WHOLE), None) for n in numbers[: MOST + 1]]
    else:
        values = reader.container(node, called not in _OF_SETS)
        if values is None:
            raise reader.unread(node, f'nobody knows what "{called}" goes through here')
        found = [(value, None) for value in values]
    if len(found) > MOST:
        raise reader.unread(node, "this goes through too many values to say each")
    return found


def _numbers(reader: OperandReader, node: Node) -> range | None:
    """What `range(...)` gives, if that is known; None for anything else."""
    name = reader.library(field(node, "function")) if node.type == "call" else ""
    is_range = name.removeprefix("builtins.") in ("range", "xrange")
    return known_range(arguments_of(node)) if is_range else None


def certain(reader: OperandReader, node: Node, called: str) -> list[Value]:
    """Each value that something goes through. Unread: one may not be there."""
    found = elements(reader, node, called)
    if any(condition is not None for _, condition in found):
        raise reader.unread(node, f'nobody knows how many values "{called}" goes through here')
    return [value for value, _ in found]


def _displayed(reader: OperandReader, node: Node, called: str) -> list[Value]:
    """The values of `(a, b)`: all are evaluated, where the model may stop at the first."""
    values = [reader.read(part) for part in named(node)]
    if not reader.is_calm(*values) or (called in _SHORT and any(map(reader.may_fail, named(node)))):
        raise reader.unread(node, _ALL_FIRST.format(called))
    return values


def _comprehended(reader: OperandReader, node: Node) -> Iterator[Element]:
    """`f(x) for x in values if condition`, of one loop and at most one condition."""
    body, *clauses = named(node)
    loops = [c for c in clauses if c.type == "for_in_clause"]
    tests = [named(c)[0] for c in clauses if c.type == "if_clause"]
    is_plain = len(loops) == 1 and len(tests) <= 1 and len(loops) + len(tests) == len(clauses)
    if not is_plain or not reader.hides(node):
        raise reader.unread(node, "the model has no such expression")
    left, right = field(loops[0], "left"), field(loops[0], "right")
    names = [text_of(n) for n in (named(left) if left.type == "pattern_list" else [left])]
    for values in rows(reader, right, len(names)):
        with reader.standing_for(names, values):
            condition = reader.condition(tests[0]) if tests else None
            value = reader.read(body)
        if not reader.is_calm(value) or (condition is not None and not is_calm(condition)):
            raise reader.unread(node, "what this does may count for what stands behind it")
        yield value, condition


def rows(reader: OperandReader, node: Node, width: int) -> list[tuple[Value, ...]]:
    """What a loop gives its variables, round by round."""
    name = reader.library(field(node, "function")) if node.type == "call" else ""
    arguments = arguments_of(node) if name else []
    match name.removeprefix("builtins."):
        case "enumerate" if width == 2 and 1 <= len(arguments) <= 2:
            start = _start(arguments[1]) if len(arguments) > 1 else 0
            values = certain(reader, arguments[0], "enumerate")
            if start is not None:
                numbered = enumerate(values, start)
                return [(Value(number_literal(i), WHOLE), value) for i, value in numbered]
        case "zip" if width == len(arguments):
            each = [certain(reader, a, "zip") for a in arguments]
            return list(zip(*each, strict=False))
        case _ if width > 1 and node.type in ("tuple", "list"):
            if all(n.type == "tuple" and len(named(n)) == width for n in named(node)):
                return [tuple(certain(reader, n, "this")) for n in named(node)]
        case _ if width == 1 and node.type not in COMPREHENSIONS:
            return [(value,) for value in certain(reader, node, name or "this")]
    raise reader.unread(node, "nobody knows what this goes through")


def _start(node: Node) -> int | None:
    """What `enumerate` counts from, given by place or by its name."""
    if node.type == "keyword_argument":
        node = field(node, "value") if text_of(field(node, "name")) == "start" else node
    return whole_number_of(node)
