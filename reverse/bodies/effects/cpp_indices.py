"""Intervals of the members of a class that are indices of arrays in logs of generated C++.

Flow-insensitive: a member holds one of the numbers that are stored in it anywhere. What is stored
otherwise than as a literal, or may be changed by another name, may be any number; conditions around
a log narrow what it is there.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from tree_sitter import Node

from rebsync.intervals import INT32, TRUTH, Interval, compared, exactly, of_binary
from rebsync.reverse.bodies.cpp_users import is_logging
from rebsync.reverse.bodies.effects.cpp_kinds import LOOPS
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_numerals import numeral
from rebsync.reverse.syntax.cpp_tree import inside, named, operator_of, part, squeezed, text_of

_CAST = re.compile(r"static_cast<(?:(?:std::)?(?:u?int(?:32|64)_t|size_t)|int|unsigned(?:int)?)>")
_SIZE = re.compile(r"array<.*,(\d+)>|\[(\d+)\]")
_CONSTANT = re.compile(r"const(?:expr)?\w.*?[\w>](?:=|\{)(\d+)\}?;?\Z")
_COMPARED = frozenset({"==", "!=", "<", ">", "<=", ">="})
_COUNTED = frozenset({"+", "-", "*", "/", "%"})
_MIRRORED = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}
_LOOKING = _COMPARED | _COUNTED | {"&&", "||"}
_LOOKS = ("condition_clause", "subscript_argument_list", "field_declaration")
_ACTS = ("call_expression", "update_expression", "assignment_expression")
_ELSEWHEN = (*LOOPS, "lambda_expression", "function_definition")


class Indices:
    """What indices may be, of members by their declarations, without layout."""

    def __init__(self, code: Code, members: Mapping[str, str]) -> None:
        self._code = code
        self._members = members

    def is_unsure(self, element: Node) -> bool:
        """Whether an element is looked up by a member that may be no index of the array."""
        index = named(part(element, "indices"))[0]
        names = [text_of(n) for n in inside(index, "identifier", "field_identifier")]
        if not any(self._is_kept(name) for name in names):
            return False
        if _goes_through(element, index):
            return False
        found, size = self._interval(index), self._size(element)
        return found is None or size is None or not Interval(0, size - 1).includes(found)

    def _is_kept(self, name: str) -> bool:
        """Whether a name is that of a variable, other than a constant with a number."""
        declared = self._members.get(name, "")
        return bool(declared) and self._constant(name) is None

    def _constant(self, name: str) -> int | None:
        """The number that a constant is declared with, where one is written there."""
        found = _CONSTANT.search(self._members.get(name, ""))
        return int(found[1]) if found is not None else None

    def _interval(self, node: Node) -> Interval | None:
        """What an expression may be; None for what is not known."""
        text = squeezed(node).removeprefix("this->")
        match node.type:
            case "number_literal":
                number = numeral(text)
                return exactly(number.whole) if number and number.whole is not None else None
            case "true" | "false":
                return exactly(int(node.type == "true"))
            case "parenthesized_expression":
                return self._interval(named(node)[0])
            case "identifier" if (constant := self._constant(text)) is not None:
                return exactly(constant)
            case "identifier" | "field_expression" if self._is_kept(text):
                return _counted(text, node) or _narrowed(text, node, self._stored(text))
            case "call_expression" if _CAST.fullmatch(squeezed(part(node, "function"))):
                return self._interval(named(part(node, "arguments"))[0])
            case "conditional_expression":
                ways = [self._interval(part(node, w)) for w in ("consequence", "alternative")]
                first, second = ways
                return first.join(second) if first is not None and second is not None else None
            case "binary_expression":
                return self._computed(node)
        return None

    def _computed(self, node: Node) -> Interval | None:
        operator = operator_of(node)
        if operator in _COMPARED:
            return TRUTH
        left, right = (self._interval(part(node, side)) for side in ("left", "right"))
        if left is None or right is None or operator not in _COUNTED:
            return None
        found = of_binary(operator, left, right)
        return found if INT32.includes(found) else None

    def _stored(self, member: str) -> Interval:
        """All that is stored in a member, in all files; it starts with what it is declared with."""
        declared = self._members[member]
        if declared.removeprefix("mutable").startswith("bool"):
            return TRUTH
        start = re.search(rf"{member}(?:=|\{{)(\d*)\}}?;", declared)
        found = exactly(int(start[1] or 0)) if start is not None else INT32
        for cpp in self._code.files:
            for node in self._code.named(cpp, cpp.root, [member]):
                found = found.join(self._left_by(node))
        return found

    def _left_by(self, name: Node) -> Interval:
        """What a place that names a member may leave in it; 0, which starts it, where it looks."""
        place, above = name, name.parent
        if above is not None and above.type == "field_expression":
            place, above = above, above.parent
        match above.type if above is not None else "":
            case "assignment_expression" if above and part(above, "left") == place:
                value = part(above, "right")
                is_plain = operator_of(above) == "=" and value.type == "number_literal"
                number = numeral(text_of(value)) if is_plain else None
                return exactly(number.whole) if number and number.whole is not None else INT32
            case "binary_expression" if above:
                return exactly(0) if operator_of(above) in _LOOKING else INT32
            case "argument_list" if above and above.parent and above.parent.parent:
                return exactly(0) if is_logging(above.parent.parent) else INT32
            case type_:
                return exactly(0) if type_ in _LOOKS else INT32

    def _size(self, element: Node) -> int | None:
        """How many elements an array has, wherever that is declared; None if that is not known."""
        name = text_of(part(element, "argument")).removeprefix("this->")
        if found := _SIZE.search(self._members.get(name, "")):
            return int(found[1] or found[2])
        sizes = {size for cpp in self._code.files for size in _declared(cpp.root, name)}
        return next(iter(sizes)) if len(sizes) == 1 else None


def _declared(root: Node, name: str) -> Iterator[int | None]:
    """How many elements the arrays by a name have."""
    for node in inside(root, "declaration"):
        for declarator in node.children_by_field_name("declarator"):
            inner = declarator.child_by_field_name("declarator") or declarator
            if not any(text_of(n) == name for n in inside(inner, "identifier")):
                continue
            value = declarator.child_by_field_name("value")
            whole = squeezed(part(node, "type")) + squeezed(inner)
            found = _SIZE.search(whole)
            is_open = "[]" in whole and value is not None and value.type == "initializer_list"
            if found is not None:
                yield int(found[1] or found[2])
            else:
                yield len(named(value)) if is_open and value is not None else None


def _goes_through(element: Node, index: Node) -> bool:
    """Whether a loop counts an index from 0 to the size of what is looked up in, which stays."""
    of, name = squeezed(part(element, "argument")).removeprefix("this->"), squeezed(index)
    loop = _counting(name, element) if name.isidentifier() and of.isidentifier() else None
    if loop is None:
        return False
    bound = (
        rf"{name}(?:<|!=)(?:static_cast<\w+>\({of}\.size\(\)\)|{of}\.size\(\)|std::size\({of}\))"
    )
    changes = rf"\b{of}(?:\.(?!(?:size|at|front|back|empty)\()\w|=(?!=))"
    is_whole = re.fullmatch(bound, squeezed(part(loop, "condition"))) is not None
    return is_whole and re.search(changes, squeezed(part(loop, "body"))) is None


def _counted(name: str, node: Node) -> Interval | None:
    """What a loop counts around a place: `for (int i = 0; i < 3; ++i)`."""
    loop = _counting(name, node)
    if loop is None:
        return None
    first = re.search(r"=(\d+);?\Z", squeezed(part(loop, "initializer")))
    bound = re.fullmatch(rf"{name}(<=?)(\d+)", squeezed(part(loop, "condition")))
    if first is None or bound is None:
        return None
    last = int(bound[2]) - (bound[1] == "<")
    return Interval(int(first[1]), last) if int(first[1]) <= last else None


def _counting(name: str, node: Node) -> Node | None:
    """The loop around a place that declares a variable, and changes it by counting up alone."""
    for loop in ancestors(node):
        if loop.type in ("function_definition", "lambda_expression"):
            return None
        start, update = (loop.child_by_field_name(f) for f in ("initializer", "update"))
        if loop.type != "for_statement" or start is None or update is None:
            continue
        if re.search(rf"[\w>]{name}=\d+;?\Z", squeezed(start)) is None:
            continue
        stored = rf"(?:\+\+|--|&){name}\b|\b{name}(?:\+\+|--|[-+*/%&|^]?=(?!=)|<<=|>>=)"
        is_up = squeezed(update) in (f"++{name}", f"{name}++")
        changed = re.search(stored, squeezed(part(loop, "body"))) is not None
        return loop if is_up and not changed else None
    return None


def _narrowed(name: str, node: Node, found: Interval) -> Interval:
    """What a member may be where conditions around hold, which is asked when nothing is stored."""
    below = node
    for at in ancestors(node):
        if at.type in _ELSEWHEN:
            break  # what holds there holds at another time
        condition = at.child_by_field_name("condition")
        is_way = at.type in ("if_statement", "conditional_expression")
        is_way = is_way and at.child_by_field_name("consequence") == below
        if is_way and condition is not None and not _is_stored_between(at, node):
            for operator, number in () if inside(condition, *_ACTS) else _bounds(name, condition):
                found = compared(found, operator, exactly(number)) or found
        below = at
    return found


def _is_stored_between(start: Node, node: Node) -> bool:
    """Whether statements behind a condition, and before a place, do more than to log."""
    return any(
        n.start_byte < node.start_byte and n.end_byte <= node.start_byte and not is_logging(n)
        for n in inside(start, "expression_statement", "declaration", "return_statement")
    )


def _bounds(name: str, condition: Node) -> Iterator[tuple[str, int]]:
    """What the parts of a condition that `&&` joins compare a member with."""
    match condition.type:
        case "condition_clause" | "parenthesized_expression" if len(named(condition)) == 1:
            yield from _bounds(name, named(condition)[0])
        case "binary_expression" if operator_of(condition) == "&&":
            for each in named(condition):
                yield from _bounds(name, each)
        case "binary_expression" if (operator := operator_of(condition)) in _COMPARED:
            left, right = (squeezed(part(condition, s)) for s in ("left", "right"))
            if left.isdecimal():
                left, right, operator = right, left, _MIRRORED.get(operator, operator)
            if left.removeprefix("this->") == name and right.isdecimal():
                yield operator, int(right)
