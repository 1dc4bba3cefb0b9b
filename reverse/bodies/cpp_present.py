"""Where code asks an optional whether it holds a value before it looks at it.

`x.value()` throws where there is none ([optional.observe]). It does not where a condition that
holds there says that there is one, and nothing between could take it away.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_kinds import LOOPS, SHORT_CIRCUIT
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_tree import named, text_of

# Names in capitals are macros, which are asked elsewhere what they hide.
_CALL = re.compile(r"\b(?:[a-z_]\w*|[A-Z]\w*[a-z]\w*)\s*(?:<[^;(){}]*>\s*)?\(|[\])]\s*\(")
_NOTHING = re.compile(r"\bnullopt\b|=\s*\{\s*\}")  # of another name for it, perhaps
_HARMLESS = re.compile(r"\b(?:if|while|for|switch|sizeof|value|has_value|value_or)\s*\(")
_WAYS = {"if_statement": "consequence", "while_statement": "body"}
_LEAVING = ("return", "break", "continue", "throw")


def is_asked(node: Node, optional: str) -> bool:
    """Whether a place is only reached where an optional, as it is written, holds a value."""
    name, below = _plain(optional), node
    while (at := below.parent) is not None and not at.type.endswith("_definition"):
        if _says(at, below, name) and not _may_change(below, node, name):
            return True
        if at.type == "compound_statement" and _left_before(below, node, name):
            return True
        if at.type == "lambda_expression":
            return False
        below = at
    return False


def _says(at: Node, below: Node, name: str) -> bool:
    """Whether what is below something runs only where its condition holds, which says so."""
    if at.type == "binary_expression":
        operator, left = at.child_by_field_name("operator"), at.child_by_field_name("left")
        is_and = operator is not None and text_of(operator) in ("&&", "and")
        return is_and and left is not None and left != below and _asks(left, name)
    if at.type == "conditional_expression" or at.type in _WAYS:
        way = at.child_by_field_name(_WAYS.get(at.type, "consequence"))
        condition = at.child_by_field_name("condition")
        return way == below and condition is not None and _asks(condition, name)
    return False


def _asks(condition: Node, name: str) -> bool:
    yes = {name, f"{name}.has_value()", f"{name}!=std::nullopt"}
    return not yes.isdisjoint(_plain(text_of(n)) for n in _conjuncts(condition))


def _conjuncts(node: Node) -> Iterator[Node]:
    inner = named(node)
    if node.type in ("condition_clause", "parenthesized_expression") and len(inner) == 1:
        yield from _conjuncts(inner[0])
    elif node.type == "binary_expression" and _is_and(node):
        for each in inner:
            yield from _conjuncts(each)
    else:
        yield node


def _is_and(node: Node) -> bool:
    operator = node.child_by_field_name("operator")
    text = text_of(operator) if operator is not None else ""
    return text in SHORT_CIRCUIT and text in ("&&", "and")


def _left_before(below: Node, node: Node, name: str) -> bool:
    """Whether a statement before leaves the block where there is no value."""
    no = {f"!{name}", f"!{name}.has_value()", f"{name}==std::nullopt"}
    before = below.prev_named_sibling
    while before is not None:
        condition = before.child_by_field_name("condition")
        way = before.child_by_field_name("consequence")
        if before.type == "if_statement" and condition is not None and way is not None:
            is_no = any(_plain(text_of(n)) in no for n in _conjuncts(condition))
            last = named(way)[-1:] if way.type == "compound_statement" else [way]
            if is_no and any(n.type.startswith(_LEAVING) for n in last):
                first = before.next_named_sibling
                return first is not None and not _may_change(first, node, name)
        before = before.prev_named_sibling
    return False


def _may_change(first: Node, node: Node, name: str) -> bool:
    """Whether something between two places may take a value away: a store, or a call.

    In a loop that begins there that is all of it, as it goes round.
    """
    root = first
    while root.parent is not None:
        root = root.parent
    loops = (n for n in ancestors(node) if n.type in LOOPS and n.start_byte >= first.start_byte)
    end = max((n.end_byte for n in loops), default=node.start_byte)
    between = (root.text or b"")[first.start_byte - root.start_byte : end - root.start_byte]
    text = _HARMLESS.sub("(", between.decode("utf-8", "replace"))
    stores = re.search(rf"{re.escape(name)}\s*(?:=(?!=)|\.\s*(?:reset|emplace|swap))", text)
    another = re.search(rf"(?:[\w>*]|[^&]&)\s+{re.escape(name)}\s*[;={{(,:]", text)
    found = (stores, another, _CALL.search(text), _NOTHING.search(text))
    return any(each is not None for each in found)


def _plain(text: str) -> str:
    return "".join(text.split()).removeprefix("this->").replace("!this->", "!")
