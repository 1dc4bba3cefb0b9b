"""Where code asks an optional, a pointer or a sequence for what is in it before it looks at that.

`x.value()` throws where there is none ([optional.observe]). It does not where a condition that
holds there says that there is one, and nothing between could take it away.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from enum import Enum

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_kinds import LOOPS
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_tree import named, operator_of, text_of

# Names in capitals are macros, which are asked elsewhere what they hide.
_CALL = re.compile(r"\b(?:[a-z_]\w*|[A-Z]\w*[a-z]\w*)\s*(?:<[^;(){}]*>\s*)?\(|[\])]\s*\(")
_NOTHING = re.compile(r"\bnullopt\b|=\s*\{\s*\}")  # of another name for it, perhaps
_HARMLESS = re.compile(
    r"\b(?:if|while|for|switch|sizeof|value|has_value|value_or|get_logger|empty|size|front|back"
    r"|static_cast<\w+>)\s*\("
)
_WAYS = {"if_statement": "consequence", "while_statement": "body"}
_AND, _OR = ("&&", "and"), ("||", "or")
_CONDITIONAL_LOG = re.compile(r"[A-Z0-9_]+_(?:COND|EXPRESSION)(?:_[A-Z0-9_]+)?")
_LEAVING = ("return", "break", "continue", "throw")


class Question(Enum):
    """What conditions ask for: each with the texts that say yes, and those that say no."""

    VALUE = (
        ("{0}", "{0}.has_value()", "{0}!=std::nullopt"),
        (*("!{0}", "!{0}.has_value()", "{0}==std::nullopt"),),
    )
    OBJECT = (
        ("{0}", "{0}!=nullptr", "{0}.has_value()", "nullptr!={0}", "{0}!=std::nullopt"),
        (*("!{0}", "{0}==nullptr", "!{0}.has_value()", "nullptr=={0}", "{0}==std::nullopt"),),
    )
    ELEMENTS = (
        ("!{0}.empty()", "{0}.size()>0", "{0}.size()!=0", "{0}.size()>=1"),
        (*("{0}.empty()", "{0}.size()==0", "{0}.size()<1"),),
    )

    def says(self, name: str, way: bool) -> frozenset[str]:
        """The texts that say that there is something, or that there is nothing."""
        return frozenset(text.format(name) for text in self.value[0 if way else 1])


def is_asked(node: Node, optional: str, question: Question = Question.VALUE) -> bool:
    """Whether a place is only reached where an optional, as it is written, holds a value."""
    name, below = _plain(optional), node
    while (at := below.parent) is not None and not at.type.endswith("_definition"):
        asked = _says(at, below, name, question)
        if asked is not None and not _may_change(asked.end_byte, node, name):
            return True
        if at.type == "compound_statement" and _left_before(below, node, name, question):
            return True
        if at.type == "lambda_expression":
            return False
        below = at
    return False


def _says(at: Node, below: Node, name: str, question: Question) -> Node | None:
    """What says that there is a value, in a condition that holds wherever what is below runs."""
    condition = None
    if at.type == "argument_list" and at.parent is not None:
        function = at.parent.child_by_field_name("function")
        is_log = function is not None and _CONDITIONAL_LOG.fullmatch(text_of(function)) is not None
        before = [n for n in named(at)[:2] if n.end_byte <= below.start_byte] if is_log else []
        found = (_one_of(n, _AND, question.says(name, True)) for n in before)
        return next((n for n in found if n is not None), None)
    if at.type == "conditional_expression" and at.child_by_field_name("alternative") == below:
        no = question.says(name, False)
        return _one_of(at.child_by_field_name("condition"), _OR, no)
    if at.type == "binary_expression" and operator_of(at) in _AND:
        condition = at.child_by_field_name("left")
        condition = condition if condition != below else None
    elif at.type == "conditional_expression" or at.type in _WAYS:
        way = at.child_by_field_name(_WAYS.get(at.type, "consequence"))
        condition = at.child_by_field_name("condition") if way == below else None
    return _one_of(condition, _AND, question.says(name, True))


def _one_of(condition: Node | None, joined: tuple[str, str], texts: Collection[str]) -> Node | None:
    """The last of the parts of a condition that has one of some texts."""
    found = [n for n in _parts(condition, joined) if _plain(text_of(n)) in texts]
    return found[-1] if found else None


def _parts(node: Node | None, joined: tuple[str, str]) -> Iterator[Node]:
    """The conditions that a condition joins by `&&`, or by `||`."""
    inner = named(node) if node is not None else ()
    is_around = node is not None and node.type in ("condition_clause", "parenthesized_expression")
    if is_around and len(inner) == 1:
        yield from _parts(inner[0], joined)
    elif node is not None and node.type == "binary_expression" and operator_of(node) in joined:
        for each in inner:
            yield from _parts(each, joined)
    elif node is not None:
        yield node


def _left_before(below: Node, node: Node, name: str, question: Question) -> bool:
    """Whether a statement before leaves the block wherever there is no value."""
    no = question.says(name, False)
    before = below.prev_named_sibling
    while before is not None:
        condition = before.child_by_field_name("condition")
        way = before.child_by_field_name("consequence")
        if before.type == "if_statement" and condition is not None and way is not None:
            asked = _one_of(condition, _OR, no)
            last = named(way)[-1:] if way.type == "compound_statement" else [way]
            if asked is not None and any(n.type.startswith(_LEAVING) for n in last):
                stays = before.child_by_field_name("alternative") or before.next_named_sibling
                return not (
                    stays is None
                    or _takes_away(_between(node, asked.end_byte, condition.end_byte), name)
                    or _may_change(stays.start_byte, node, name)
                )
        before = before.prev_named_sibling
    return False


def _may_change(start: int, node: Node, name: str) -> bool:
    """Whether something from a place to another may take a value away.

    In a loop that begins there that is all of it, as it goes round.
    """
    loops = (n for n in ancestors(node) if n.type in LOOPS and n.start_byte >= start)
    end = max((n.end_byte for n in loops), default=node.start_byte)
    return _takes_away(_between(node, start, end), name)


def _between(node: Node, start: int, end: int) -> str:
    """The text of a file of which a node is, from a byte to another."""
    root = node
    while root.parent is not None:
        root = root.parent
    text = (root.text or b"")[start - root.start_byte : end - root.start_byte]
    return text.decode("utf-8", "replace")


def _takes_away(code: str, name: str) -> bool:
    """Whether some code may take a value away: by a store, or a call."""
    text = _HARMLESS.sub("(", code)
    stores = re.search(
        rf"{re.escape(name)}\s*(?:=(?!=)|\.\s*(?:reset|emplace|swap|clear|pop|erase|resize))", text
    )
    another = re.search(rf"(?:[\w>*]|[^&]&)\s+{re.escape(name)}\s*[;={{(,:]", text)
    found = (stores, another, _CALL.search(text), _NOTHING.search(text))
    return any(each is not None for each in found)


def _plain(text: str) -> str:
    return "".join(text.split()).removeprefix("this->").replace("!this->", "!")
