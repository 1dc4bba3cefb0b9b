"""Members of generated C++ that are dead for the model: nothing it says depends on their values.

What they hold goes into logs, into fields of messages that functions fill for people, and into
themselves and each other: a backward slice from what the model has does not reach them.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_users import is_logging
from rebsync.reverse.bodies.effects.known_functions import is_known
from rebsync.reverse.generated.parameters import READS
from rebsync.reverse.generated.ros2_words import constant_of_model, known_rebec
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, calls_in, string_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass
from rebsync.reverse.syntax.cpp_tree import inside, named, part, squeezed, text_of

_NUMBER = (
    r"(?:(?:std::)?u?int(?:8|16|32|64)_t|(?:std::)?size_t|int|unsigned(?:int)?|(?:unsigned)?long"
    r"|float|double|bool)"
)
_VALUE = re.compile(rf"{_NUMBER}|(?:std::)?atomic<{_NUMBER}>|(?:std::)?atomic_(?:bool|int|uint)")
_ARRAY = re.compile(rf"(?:std::)?array<{_NUMBER},(\d+)>")
_FLOAT = re.compile(r"(?:float|double)")
_PLACES = ("identifier", "field_expression")
_PARTS = ("field_expression", "subscript_expression")
_STORES = ("assignment_expression", "update_expression")
_ACTS = (*_STORES, "lambda_expression", "new_expression", "delete_expression", "throw_statement")
# Methods of atomic numbers that store in them.
_ATOMIC = frozenset({"fetch_add", "fetch_sub", "store", "exchange"})
_GIVES = frozenset({"load", "as_bool", "as_int", "as_double", "count", "size", "seconds", "toSec"})
_FLOATING = re.compile(r"static_cast<(?:double|float)>|\d\.\d|\.0")


def dead_members(code: Code, owner: CppClass) -> set[str]:
    """The numbers of a class, and arrays of them, that are told to people, and else only stored in.

    Each place that names them is looked at, in all files: as long as one that is left out stands
    in a statement of another, that is looked at again.
    """
    numbers = {f.name for f in owner.fields if _is_candidate(code, f.type) and not f.markers}
    left = numbers
    known = {f.node.id for f in owner.fields}
    places = [
        (text_of(node), [node, *ancestors(node)])
        for cpp in (code.files if left else ())
        for node in code.named(cpp, cpp.root, sorted(left))
    ]
    while True:
        silent = _DeadStores(code, owner, frozenset(left))
        out = {name for name, around in places if name in left and not silent.has(around, known)}
        if not out:
            break
        left = left - out
    told = {name for name, around in places if any(is_logging(n) or _fills(n) for n in around)}
    read = {n for name, around in places for n in silent.read_by(name, around)}
    return {n for n in left if n in told | read}


def is_plain_class(code: Code, name: str) -> bool:
    """Whether objects of a class of the files only hold values, and change nothing else."""
    found = code.all_classes.get(name, [])
    if len(found) != 1 or found[0].bases or found[0].roots or found[0].others:
        return False
    (owner,) = found
    own = {f.name: squeezed(f.type) for f in owner.fields}
    is_held = all(_VALUE.fullmatch(squeezed(f.type)) for f in owner.fields)
    functions = code.functions_of(owner)
    return is_held and all(
        f.body is not None and not f.pure and f.name != f"~{name}" and _keeps(f.body, own)
        for f in functions
    )


def _keeps(body: Node, own: Mapping[str, str]) -> bool:
    """Whether a method stores in its own object only, and cannot fail."""
    if inside(body, "lambda_expression", "new_expression", "delete_expression", "throw_statement"):
        return False
    locals_ = {
        text_of(d)
        for declaration in inside(body, "declaration")
        for d in inside(declaration, "identifier")
        if "&" not in text_of(declaration) and "*" not in text_of(declaration)
    }
    stored = (_root(n) for n in inside(body, *_STORES))
    is_own = all(name in own or name in locals_ for name in stored)
    floating = {n for n, type_ in own.items() if _FLOAT.search(type_)}
    return is_own and not divides(body, floating) and all(_is_pure_call(c) for c in calls_in(body))


def _root(store: Node) -> str:
    target = store.child_by_field_name("left") or part(store, "argument")
    return _name_of(target)


def _name_of(place: Node) -> str:
    """The member or variable that a place is part of."""
    while place.type in _PARTS and part(place, "argument").type != "this":
        place = part(place, "argument")
    return text_of(place).removeprefix("this->")


def _is_candidate(code: Code, type_: Node) -> bool:
    text = squeezed(type_)
    is_number = _VALUE.fullmatch(text) is not None or _ARRAY.fullmatch(text) is not None
    return is_number or is_plain_class(code, text)


class _DeadStores:
    """Statements that store in dead members only, or tell of them."""

    def __init__(self, code: Code, owner: CppClass, left: frozenset[str]) -> None:
        self._left = left
        texts = {f.name: squeezed(f.type) for f in owner.fields}
        self._floating = {n for n, t in texts.items() if _FLOAT.search(t)}
        arrays = ((n, _ARRAY.fullmatch(t)) for n, t in texts.items())
        self._sizes = {n: int(found[1]) for n, found in arrays if found is not None}

    def has(self, around: list[Node], known: Collection[int]) -> bool:
        """Whether a place, which `around` begins with, is in such a statement, or declares one."""
        return any(n.id in known or is_logging(n) or self._is_silent(n) for n in around)

    def read_by(self, name: str, around: list[Node]) -> Iterator[str]:
        """The dead member itself, where it decides what is told, or is stored in another one."""
        for node in around:
            if node.type == "if_statement" and self._is_silent(node):
                yield name
            if node.type in _STORES and _root(node) in self._left - {name}:
                yield name

    def _is_silent(self, node: Node) -> bool:
        match node.type:
            case "expression_statement" if named(node):
                return is_logging(node) or _fills_for_people(node) or self._stores(named(node)[0])
            case "if_statement":
                ways = [part(node, "consequence")]
                if (other := node.child_by_field_name("alternative")) is not None:
                    ways += named(other)
                condition = part(node, "condition")
                return self._is_pure(condition) and all(map(self._is_silent, ways))
            case "compound_statement":
                return bool(named(node)) and all(map(self._is_silent, named(node)))
            case "declaration":
                return self._is_pure(node) and all(map(self._is_told, _uses(node)))
            case _:
                return False

    def _is_told(self, use: Node) -> bool:
        """Whether a place of a local is in a statement that tells of it, or stores it here."""
        around = ancestors(use)
        return any(
            is_logging(n) or (n.type == "expression_statement" and self._is_silent(n))
            for n in around
        )

    def _stores(self, node: Node) -> bool:
        """Whether an expression stores in one of them, and does nothing else."""
        match node.type:
            case "update_expression":
                return self._is_dead(part(node, "argument"))
            case "assignment_expression":
                value = part(node, "right")
                if not self._is_dead(part(node, "left")):
                    return False
                operator = text_of(part(node, "operator"))
                is_cut = operator in ("/=", "%=") and _root(node) not in self._floating
                return not is_cut and (self._is_pure(value) or is_own_parameter(value))
            case "call_expression":
                call = call_of(node)
                if call is None or call.target is None or not self._is_dead(call.target):
                    return False
                if _name_of(call.target) in self._sizes and call.name != "fill":
                    return False
                return all(map(self._is_pure, call.arguments))
        return False

    def _counts(self, act: Node) -> bool:
        """Whether a dead member is counted up or down."""
        return act.type == "update_expression" and self._is_dead(part(act, "argument"))

    def _is_dead(self, place: Node) -> bool:
        is_place = place.type in _PLACES or self._is_element(place)
        return is_place and _name_of(place) in self._left

    def _is_element(self, place: Node) -> bool:
        """Whether a place is an element of an array of the class that is there."""
        if place.type != "subscript_expression" or part(place, "argument").type not in _PLACES:
            return False
        index = text_of(named(part(place, "indices"))[0])
        return index.isdecimal() and int(index) < self._sizes.get(_name_of(place), 0)

    def _is_pure(self, node: Node) -> bool:
        """Whether to evaluate something changes nothing of the model, and cannot fail."""
        acts = list(inside(node, *_ACTS))
        if inside(node, "pointer_expression") or not all(map(self._counts, acts)):
            return False
        words = [text_of(n) for n in inside(node, "identifier", "field_identifier")]
        if any(words.count(_root(act)) > 1 for act in acts):
            return False  # what is stored and read in one expression has no order
        if not all(map(self._is_element, inside(node, "subscript_expression"))):
            return False
        return not divides(node, self._floating) and all(map(_is_pure_call, calls_in(node)))


def _uses(declaration: Node) -> Iterator[Node]:
    """Where the function names what a declaration declares, but for the declaration."""
    declarators = declaration.children_by_field_name("declarator")
    names = {text_of(d.child_by_field_name("declarator") or d).lstrip("&* ") for d in declarators}
    function = next((n for n in ancestors(declaration) if n.type == "function_definition"), None)
    for node in inside(function, "identifier"):
        is_own = declaration.start_byte <= node.start_byte < declaration.end_byte
        if text_of(node) in names and not is_own:
            yield node


def divides(node: Node, floating: Collection[str]) -> bool:
    """Whether integers are divided there, perhaps by zero."""
    for each in inside(node, "binary_expression", "assignment_expression"):
        if text_of(part(each, "operator")).rstrip("=") not in ("/", "%"):
            continue
        words = {text_of(n) for n in inside(each, "identifier", "field_identifier")}
        sides = [text_of(part(each, side)) for side in ("left", "right")]
        if sides[1].isdecimal() and int(sides[1]) > 0:
            continue
        if words.isdisjoint(floating) and not any(map(_FLOATING.search, sides)):
            return True
    return False


def _is_pure_call(call: CppCall) -> bool:
    name = call.name.rpartition("::")[2]
    if name in libraries.acting():
        return False
    if call.target is not None:
        return name in _GIVES or name in libraries.looking()
    return (call.name.startswith("std::") and is_known(call)) or call.name.startswith("static_cast")


def is_own_parameter(value: Node) -> bool:
    """Whether a value is that of a parameter that is none of the model."""
    call = call_of(value)
    if call is None or call.name not in READS or not call.arguments:
        return False
    key = string_of(call.arguments[0])
    is_own = key is not None and constant_of_model(key) is None and known_rebec(key) is None
    return is_own and call.on != "global" and not list(calls_in(part(call.node, "arguments")))


def _fills_for_people(statement: Node) -> bool:
    """Whether a field of a message is filled that does not tell the state of the model."""
    return _fills(statement) and not any(map(_is_of_state, ancestors(statement)))


def _is_of_state(node: Node) -> bool:
    """Whether it is the function that tells the state: its variables are those of the model."""
    is_function = node.type == "function_definition"
    return is_function and "publishState" in text_of(part(node, "declarator"))


def _fills(statement: Node) -> bool:
    """`message.data = ++x;`, where the message is a local."""
    if statement.type != "expression_statement" or not statement.named_children:
        return False
    inner = statement.named_children[0]
    if inner.type != "assignment_expression":
        return False
    left = part(inner, "left")
    return left.type == "field_expression" and part(left, "argument").type == "identifier"
