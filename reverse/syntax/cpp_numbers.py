"""Whole numbers that constant expressions give, of literals and names that are known."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.cpp_declarations import CppEnumerator
from rebsync.reverse.syntax.cpp_numerals import whole_number
from rebsync.reverse.syntax.cpp_tree import Cpp, named, text_of

# The values of names; None for one that is not known.
Lookup = Callable[[str], "int | None"]
_MOST = 64  # bits of a result
_OPERATORS: Mapping[str, Callable[[int, int], int | None]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: _quotient(a, b),
    "%": lambda a, b: _remainder(a, b),
    "<<": lambda a, b: a << b if 0 <= b < _MOST else None,
    ">>": lambda a, b: a >> b if 0 <= b < _MOST else None,
    "&": lambda a, b: a & b,
    "|": lambda a, b: a | b,
    "^": lambda a, b: a ^ b,
}
_INT = range(-(1 << 31), 1 << 31)


def constant_number(node: Node, lookup: Lookup) -> int | None:
    """The number that an expression gives; None where it is not known, or no `int` holds it."""
    match node.type:
        case "number_literal":
            return whole_number(text_of(node))
        case "char_literal" if len(text_of(node)) == 3:
            return ord(text_of(node)[1])
        case "true" | "false":
            return int(node.type == "true")
        case "identifier" | "qualified_identifier":
            return lookup(text_of(node))
        case "parenthesized_expression" if len(named(node)) == 1:
            return constant_number(named(node)[0], lookup)
        case "unary_expression":
            return _unary(node, lookup)
        case "binary_expression":
            return _binary(node, lookup)
        case "call_expression":
            return _cast(node, lookup)
        case "cast_expression":
            type_, value = node.child_by_field_name("type"), node.child_by_field_name("value")
            plain = type_ is not None and text_of(type_) in ("int", "int32_t")
            return constant_number(value, lookup) if plain and value is not None else None
        case _:
            return None


def whole_result(operator: str, left: int, right: int) -> int | None:
    """What an operator gives for whole numbers, before its type cuts it; None: it has no value."""
    apply = _OPERATORS.get(operator)
    return apply(left, right) if apply is not None else None


@dataclass(frozen=True, slots=True)
class KnownNumbers:
    """The numbers that enumerators and constants of a file stand for.

    `asked` are the names whose values are looked for.
    """

    enumerators: Mapping[str, Sequence[CppEnumerator]]
    constants: Mapping[tuple[str, str], tuple[Cpp, Node]]
    cpp: Cpp
    asked: frozenset[str] = frozenset()

    def of(self, node: Node) -> int | None:
        """The number that an expression gives."""
        return constant_number(node, self._named)

    def _named(self, text: str) -> int | None:
        """What a name stands for, where only one thing has it."""
        name = text.rpartition("::")[2]
        values = {e.value for e in self.enumerators.get(name, ()) if e.cpp is self.cpp}
        constant = self.constants.get((self.cpp.source.path, name))
        if values or constant is None or name in self.asked:
            return values.pop() if len(values) == 1 else None
        made, value = constant
        if value.type in ("binary_expression", "unary_expression") and made is not self.cpp:
            return None  # a macro: what stands beside it may bind tighter
        return replace(self, asked=self.asked | {name}).of(value)


def enumerated(
    enum: Node, number: Callable[[Node], int | None]
) -> Iterator[tuple[Node, int | None]]:
    """The constants of an enumeration with their numbers, of those that are known.

    `number` tells what an expression gives, once the constants before it are taken.
    """
    next_: int | None = 0
    body = enum.child_by_field_name("body")
    for child in body.named_children if body is not None else []:
        if child.type == "enumerator":
            given = child.child_by_field_name("value")
            value = next_ if given is None else number(given)
            yield child, value
            next_ = value + 1 if value is not None else None
        elif child.type != "comment":  # which of some alternatives counts
            next_ = None


def _unary(node: Node, lookup: Lookup) -> int | None:
    operator, argument = node.child_by_field_name("operator"), node.child_by_field_name("argument")
    if operator is None or argument is None:
        return None
    value = constant_number(argument, lookup)
    if value is None:
        return None
    return {"-": -value, "+": value, "~": ~value}.get(text_of(operator))


def _binary(node: Node, lookup: Lookup) -> int | None:
    sides = [node.child_by_field_name(side) for side in ("left", "right")]
    values = [constant_number(s, lookup) if s is not None else None for s in sides]
    operator = node.child_by_field_name("operator")
    left, right = values
    if left is None or right is None or operator is None:
        return None
    value = whole_result(text_of(operator), left, right)
    # A larger number may be cut off, as its type says, which is not looked at.
    return value if value is not None and value in _INT else None


def _cast(node: Node, lookup: Lookup) -> int | None:
    function, arguments = (
        node.child_by_field_name("function"),
        node.child_by_field_name("arguments"),
    )
    inner = named(arguments) if arguments is not None else []
    if function is None or text_of(function) not in ("int", "static_cast<int>") or len(inner) != 1:
        return None
    return constant_number(inner[0], lookup)


def _quotient(left: int, right: int) -> int | None:
    """Towards zero."""
    if right == 0:
        return None
    whole = abs(left) // abs(right)
    return whole if (left < 0) == (right < 0) else -whole


def _remainder(left: int, right: int) -> int | None:
    quotient = _quotient(left, right)
    return None if quotient is None else left - quotient * right
