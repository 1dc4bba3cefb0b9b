"""Members of generated Python that are containers, which only logs look into: dictionaries, counts.

They are made empty. What is stored in a dictionary is hashable, and what is added to a value of one
is a number there, so that to keep something for people cannot fail.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.python.generated.log_words import LOOKS
from rebsync.reverse.python.generated.module_variables import call_and_arguments, imported_as
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

TABLE, COUNTS, NUMBERS, QUEUE, SET = "table", "counts", "table of numbers", "queue", "set"
TABLES = frozenset({TABLE, COUNTS, NUMBERS})
# What may be called of each kind, and does not fail with one argument, or with none.
STORING = {
    TABLE: {"clear": 0},
    NUMBERS: {"clear": 0},
    COUNTS: {"clear": 0},
    QUEUE: {"append": 1, "appendleft": 1, "clear": 0},
    SET: {"add": 1, "discard": 1, "clear": 0},
}
_ASKING = {"get": (1, 2), "items": (0,), "keys": (0,), "values": (0,), "copy": (0,)}
_MADE = {"dict": TABLE, "set": SET, "collections.deque": QUEUE, "collections.Counter": COUNTS}
_MADE |= {"collections.defaultdict": COUNTS}
_KEYS = frozenset({"string", "integer", "true", "false"})
_SCALARS = frozenset({"int", "short", "byte", "boolean"})
_STORES = ("assignment", "augmented_assignment")
_SUMS = frozenset({"+", "-"})


def container_of(module: Scope, value: Node) -> str:
    """The kind of empty container that a value is; empty for anything else."""
    if value.type == "dictionary":
        return "" if named(value) else TABLE
    called, arguments = call_and_arguments(value)
    is_own = called in ("dict", "set") and called not in module.names
    whole = called if is_own else imported_as(module, called)
    given = [text_of(a) for a in arguments]
    is_empty = not given
    if whole == "collections.defaultdict":
        is_empty = given == ["int"] and "int" not in module.names
    elif whole == "collections.deque" and given:
        key, _, length = given[0].partition("=")
        is_empty = len(given) == 1 and key == "maxlen" and length.isdecimal()
    return _MADE.get(whole, "") if is_empty else ""


def containers_in(
    module: Scope, made: Mapping[str, Node], stores: Iterable[Node]
) -> dict[str, str]:
    """The containers among the members of a class, by what its constructor puts into each.

    `stores` are the statements that store in elements: a table that only gets numbers is one of
    numbers.
    """
    found = {name: kind for name, value in made.items() if (kind := container_of(module, value))}
    listed = [(name, s) for s in stores if (name := member_of(s)) in found]
    odd = {n for n, s in listed if s.type == "assignment" and not _is_number(field(s, "right"), n)}
    keys = {(n, k.type == "string") for n, s in listed for k in _keys(field(s, "left"))}
    found = {n: k for n, k in found.items() if not {(n, True), (n, False)} <= keys}  # to be sorted
    return {n: NUMBERS if k == TABLE and n not in odd else k for n, k in found.items()}


def _keys(place: Node) -> list[Node]:
    return place.children_by_field_name("subscript")


def stores_in(functions: Iterable[Node]) -> Iterator[Node]:
    """The assignments in some functions to an element of something, augmented ones too."""
    for node in (n for function in functions for n in nodes_in(function)):
        is_stored = node.type in _STORES and node.child_by_field_name("right") is not None
        if is_stored and field(node, "left").type == "subscript":
            yield node


def member_of(assignment: Node) -> str:
    """The member in an element of which something is stored; empty for another place."""
    return _own(field(field(assignment, "left"), "value"))


def is_key(node: Node, variables: Mapping[str, m.Type]) -> bool:
    """Whether something is a plain value that a dictionary can have as a key."""
    type_ = variables.get(_own(node))
    return node.type in _KEYS or (
        type_ is not None and type_.name in _SCALARS and not type_.dimensions
    )


def is_counted(assignment: Node, kind: str) -> bool:
    """Whether what is stored in an element is a number, where the others are numbers too."""
    name = _own(field(field(assignment, "left"), "value"))
    if assignment.type == "augmented_assignment":
        operator = text_of(field(assignment, "operator"))
        is_sum = operator in ("+=", "-=") and field(assignment, "right").type == "integer"
        return kind == COUNTS and is_sum
    return kind in (NUMBERS, COUNTS) and _is_number(field(assignment, "right"), name)


def is_asked(call: Node, containers: Mapping[str, str]) -> bool:
    """Whether a call only asks what a container has: `self._counts.get("served", 0)`."""
    function = field(call, "function")
    if function.type != "attribute":
        return False
    kind = containers.get(_own(field(function, "object")), "")
    counts = _ASKING.get(text_of(field(function, "attribute")), ())
    given = named(field(call, "arguments"))
    is_hashable = all(g.type in _KEYS for g in given[:1])
    is_shown = kind in (NUMBERS, COUNTS) or _is_shown(call)
    return kind in TABLES and len(given) in counts and is_hashable and is_shown


def _is_shown(call: Node) -> bool:
    """Whether a value of any type is only put into a text, or stored."""
    above = call.parent
    if above is None or above.type in ("interpolation", "assignment"):
        return above is not None
    of = above.parent if above.type == "argument_list" else None
    if of is None or of.type != "call":
        return False
    called = text_of(field(of, "function"))
    return called in ("str", "repr", "list", "len", "tuple") or called not in LOOKS


def _is_number(value: Node, name: str) -> bool:
    """Whether a value is a number that is written out, or such a one of a member with others."""
    if value.type == "integer":
        return True
    if value.type == "binary_operator" and text_of(field(value, "operator")) in _SUMS:
        return _is_number(field(value, "left"), name) and _is_number(field(value, "right"), name)
    called, arguments = call_and_arguments(value)
    is_get = called == f"self.{name}.get" and len(arguments) == 2
    return is_get and arguments[1].type == "integer"


def _own(node: Node) -> str:
    """The name of an attribute of the object itself; empty for anything else."""
    is_own = node.type == "attribute" and text_of(field(node, "object")) == "self"
    return text_of(field(node, "attribute")) if is_own else ""
