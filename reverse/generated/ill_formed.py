"""What C++ does not compile, or gives no meaning, in bodies that a model could be made of.

A member that no class has; an assignment to what is no place, as `a == b || c = d` is one to the
whole of `a == b || c`; a function with a result that control may leave at its end ([stmt.return]);
and a moment of no clock (`rclcpp::Time last_;` is one of the system's) that is held against one of
the node's: rclcpp throws.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_unset_locals import may_reach_end
from rebsync.reverse.findings import Unread
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import assigned_in
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, part, squeezed, text_of

# Classes of the client libraries, of which heirs can name functions, but no members.
_LIBRARY_BASES = frozenset({"Node", "LifecycleNode", "enable_shared_from_this"})
_NO_PLACE = ("binary_expression", "unary_expression")
_COMPARING = frozenset({"-", "<", ">", "<=", ">=", "==", "!="})
_MOMENT = "rclcpp::Time"
# What says of a moment that it was set: a moment of the system's clock is zero until then.
_IS_SET = re.compile(r"(?:this->)?(\w+)\.(?:nano)?seconds\(\)(?:!=|>)0(?:\.0*)?")


def ill_formed(code: Code, function: CppFunction) -> Iterator[Unread]:
    """The places in the body of a function that cannot be compiled, or have no meaning."""
    body, cpp = function.body, function.cpp
    if body is None:
        return
    if _gives(function.node) and may_reach_end(body):
        why = "this may end without a result"
        yield Unread(cpp.span(function.node), why, "return something on each way")
    for node in inside(body, "assignment_expression"):
        above = node.parent
        if above is not None and above.type in _NO_PLACE:
            why = "what is assigned to here is all that stands before it"
            yield Unread(cpp.span(node), why, "put the assignment in parentheses")
    for node in _without_clock(code, function):
        why = "the two moments may be of different clocks, which throws"
        yield Unread(cpp.span(node), why, "give it a moment of the node's clock at the start")
    owner = code.classes.get(function.owner)
    lineage = code.lineage(owner.name) if owner is not None else []
    unread = _bases(lineage) - {c.name for c in lineage}
    names = {f.name for c in lineage for f in c.fields} | {
        f.name for c in lineage for f in c.functions
    }
    for node in inside(body, "field_expression") if lineage and unread <= _LIBRARY_BASES else ():
        name = text_of(part(node, "field"))
        is_own = part(node, "argument").type == "this" and name.isidentifier()
        if is_own and name not in names and not (unread and _is_called(node)):
            why = f'no class has a member "{name}"'
            yield Unread(cpp.span(node), why, "declare it, or mend its name")


def _without_clock(code: Code, function: CppFunction) -> Iterator[Node]:
    """Where a member that has no clock until some callback sets it is held against `now()`."""
    owner = code.classes.get(function.owner)
    fields = [f for c in code.lineage(owner.name) for f in c.fields] if owner is not None else []
    left = {f.name for f in fields if text_of(f.type) == _MOMENT and not _has_clock(f.value)}
    if not left or owner is None:
        return
    for start in code.functions_of(owner):
        if start.name in (owner.name, "construct") and start.body is not None:
            left -= {name for name, _ in assigned_in(start.body)}
            listed = inside(start.initialisers, "field_initializer") if start.initialisers else ()
            left -= {text_of(n.named_children[0]) for n in listed if len(n.named_children) > 1}
    for node in inside(function.body, "binary_expression") if left else ():
        if text_of(part(node, "operator")) not in _COMPARING:
            continue
        sides = [squeezed(part(node, side)).removeprefix("this->") for side in ("left", "right")]
        for side in left.intersection(sides):
            if any("now(" in other for other in sides) and not _is_guarded(node, side):
                yield node


def _has_clock(value: Node | None) -> bool:
    """Whether a moment is made with more than nothing."""
    return value is not None and "RCL_" in text_of(value)


def _is_guarded(node: Node, member: str) -> bool:
    """Whether a condition around says that the member was set, or a statement before sets it."""
    blocks = (n for n in ancestors(node) if n.type == "compound_statement")
    before = (pair for block in blocks for pair in assigned_in(block))
    if any(name == member and value.end_byte <= node.start_byte for name, value in before):
        return True
    conditions = (n.child_by_field_name("condition") for n in ancestors(node))
    found = (m for c in conditions if c is not None for m in _IS_SET.finditer(squeezed(c)))
    return any(m[1] == member for m in found)


def _gives(node: Node) -> bool:
    """Whether a function has a result by its type; that of `auto` is as its body says."""
    type_ = node.child_by_field_name("type")
    return type_ is not None and text_of(type_) not in ("void", "auto")


def _bases(lineage: Sequence[CppClass]) -> set[str]:
    return {base.partition("<")[0].rpartition("::")[2] for c in lineage for base in c.bases}


def _is_called(node: Node) -> bool:
    above = node.parent
    return above is not None and above.type == "call_expression"
