"""Loops over what the model does not have that leave nothing in it but values nobody knows."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.python.bodies.body_effects import is_harmless, may_be_of_message
from rebsync.reverse.python.bodies.body_scope import Nobody
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_targets import check_target
from rebsync.reverse.python.bodies.body_variables import forget
from rebsync.reverse.python.values.py_worth import Bound, External, Made
from rebsync.reverse.syntax.py_index import last_name
from rebsync.reverse.syntax.py_tree import field, named

# Calls whose results have an end, and do not wait for what comes.
_FINITE = frozenset(
    {"enumerate", "zip", "reversed", "sorted", "list", "tuple", "set", "dict", "range", "xrange"}
    | {"items", "keys", "values", "iteritems", "iterkeys", "itervalues", "split", "splitlines"}
    | {"deepcopy", "copy"}
)
_PLACES = frozenset({"identifier", "attribute", "subscript", "list", "tuple", "dictionary"})
_IGNORED = frozenset({"pass_statement", "break_statement", "continue_statement", "comment"})


def leaves_nothing(reader: BodyStatementReader, loop: Node) -> bool:
    """Whether a `for` does nothing that the model has; what it sets is from then on unknown.

    It may go through its body any number of times, so that nothing in it may end the function,
    wait, or touch the node but for variables.
    """
    targets: list[Node] = []
    return _is_plain_loop(reader, loop, targets) and _forgotten(reader, targets)


def leaves_only_unknowns(reader: BodyStatementReader, nodes: list[Node]) -> bool:
    """Whether statements do nothing that the model has; what they set is from then on unknown."""
    targets: list[Node] = []
    return _are_plain(reader, nodes, targets) and _forgotten(reader, targets)


def _forgotten(reader: BodyStatementReader, targets: list[Node]) -> bool:
    for target in targets:
        check_target(reader, target)
        forget(reader, target)
    return True


def _is_plain_loop(reader: BodyStatementReader, loop: Node, targets: list[Node]) -> bool:
    if loop.child_by_field_name("alternative") is not None:
        return False
    targets.append(field(loop, "left"))
    over = field(loop, "right")
    form, frame = reader.reading.form, reader.frame
    return (
        is_harmless(reader.reading, over, frame)
        and _is_there(reader, over)
        and _are_plain(reader, named(field(loop, "body")), targets)
        and form is not None
        and form.ends(frame.py, loop)
    )


def _is_there(reader: BodyStatementReader, over: Node) -> bool:
    """Whether what is gone through is there at once, as far as it is seen."""
    if over.type == "call":
        inner = field(over, "function")
        holder = [field(inner, "object")] if inner.type == "attribute" else []
        given = [n for n in named(field(over, "arguments")) if n.type != "keyword_argument"]
        return last_name(inner) in _FINITE and all(_is_there(reader, n) for n in (*holder, *given))
    if over.type not in _PLACES:
        return over.type in ("string", "integer", "list_comprehension", "slice")
    ways = reader.reading.values.ways(over, reader.frame.scope)
    return not any(isinstance(w, External | Bound | Made) for w in ways)


def _are_plain(reader: BodyStatementReader, nodes: list[Node], targets: list[Node]) -> bool:
    return all(_is_plain(reader, node, targets) for node in nodes)


def _is_plain(reader: BodyStatementReader, node: Node, targets: list[Node]) -> bool:
    """Whether a statement does nothing but to set variables; these are put into `targets`."""
    match node.type:
        case _ if node.type in _IGNORED:
            return True
        case "expression_statement":
            return all(_is_value(reader, inner, targets) for inner in named(node))
        case "if_statement" | "elif_clause":
            parts = [field(node, "consequence"), *node.children_by_field_name("alternative")]
            condition = field(node, "condition")
            return is_harmless(reader.reading, condition, reader.frame) and _are_plain(
                reader, parts, targets
            )
        case "else_clause":
            return _are_plain(reader, named(field(node, "body")), targets)
        case "block":
            return _are_plain(reader, named(node), targets)
        case "for_statement":
            return _is_plain_loop(reader, node, targets)
        case _:
            return False


def _is_value(reader: BodyStatementReader, node: Node, targets: list[Node]) -> bool:
    if node.type in ("assignment", "augmented_assignment"):
        target = field(node, "left")
        meaning, _ = reader.expressions.meaning(target)
        is_open = isinstance(meaning, Nobody)
        if is_open and may_be_of_message(reader.reading, target, reader.frame):
            return False
        targets.append(target)
    return is_harmless(reader.reading, node, reader.frame)
