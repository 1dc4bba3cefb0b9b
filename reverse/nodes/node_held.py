"""Functions that members hold, `std::function<void(int)> act_`: where one is put in, once."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.nodes.node_kept import places
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of

_TYPE = re.compile(r"(?:std|boost)::function\b")
_BOUND = re.compile(r"&(?:\w+::)*(\w+)\Z")
_PLACE = re.compile(r"(?:\w+::)*_(\d)\Z")
_DECLARES = frozenset({"field_declaration", "declaration"})


@dataclass(frozen=True, slots=True)
class Held:
    """What a member holds from when the node starts: a lambda, or a function by its name.

    `statement` puts it there.
    """

    name: str
    cpp: Cpp
    statement: Node
    lambda_: Node | None = None
    function: str = ""


def held(
    members: Iterable[tuple[str, Node]], first: Sequence[CppFunction], files: Sequence[Cpp]
) -> Iterator[Held]:
    """The functions that members, by names and types, get in the functions that run `first`."""
    for name, type_ in members:
        if _TYPE.match(text_of(type_)):
            found = _put(name, first, files)
            if found is not None:
                yield found


def _put(name: str, first: Sequence[CppFunction], files: Sequence[Cpp]) -> Held | None:
    puts = []
    for node in places(name, files):
        at, above = node, node.parent
        if above is not None and text_of(above) == f"this->{name}":
            at, above = above, above.parent
        if above is None:
            return None
        if above.type == "assignment_expression" and above.child_by_field_name("left") == at:
            puts.append(above)
        elif above.type not in _DECLARES and not _is_called(above, at):
            return None
    if len(puts) != 1 or puts[0].parent is None:
        return None
    statement, value = puts[0].parent, puts[0].child_by_field_name("right")
    function = next((f for f in first if f.body is not None and f.body == statement.parent), None)
    if function is None or value is None or statement.type != "expression_statement":
        return None
    if value.type == "lambda_expression":
        return Held(name, function.cpp, statement, value)
    bound = _bound(value)
    return Held(name, function.cpp, statement, None, bound) if bound else None


def _is_called(above: Node, at: Node) -> bool:
    return above.type == "call_expression" and above.child_by_field_name("function") == at


def _bound(value: Node) -> str:
    """`bump` of `std::bind(&Node::bump, this, _1, _2)`, which only hands on what it gets."""
    call = call_of(value)
    if call is None or call.name not in ("std::bind", "boost::bind") or len(call.arguments) < 2:
        return ""
    function, target, *others = (text_of(a) for a in call.arguments)
    match = _BOUND.match(function)
    numbers = [_PLACE.match(other) for other in others]
    in_order = all(m is not None and m[1] == str(i) for i, m in enumerate(numbers, 1))
    return match[1] if match is not None and target == "this" and in_order else ""
