"""What C++ does not compile, or gives no meaning, in bodies that a model could be made of.

A member that no class has; an assignment to what is no place, as `a == b || c = d` is one to the
whole of `a == b || c`; and a function with a result that control may leave at its end
([stmt.return]).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from rebsync.reverse.findings import Unread
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of

# Classes of the client libraries, of which heirs can name functions, but no members.
_LIBRARY_BASES = frozenset({"Node", "LifecycleNode", "enable_shared_from_this"})
_LOOPS = ("while_statement", "for_statement", "for_range_loop", "do_statement")
_LEAVES = (
    *("return_statement", "throw_statement", "co_return_statement", "goto_statement"),
    *("break_statement", "continue_statement"),
)
_NO_PLACE = ("binary_expression", "unary_expression")


def ill_formed(code: Code, function: CppFunction) -> Iterator[Unread]:
    """The places in the body of a function that cannot be compiled, or have no meaning."""
    body, cpp = function.body, function.cpp
    if body is None:
        return
    if _gives(function.node) and _may_reach_end(body):
        why = "this may end without a result"
        yield Unread(cpp.span(function.node), why, "return something on each way")
    for node in inside(body, "assignment_expression"):
        above = node.parent
        if above is not None and above.type in _NO_PLACE:
            why = "what is assigned to here is all that stands before it"
            yield Unread(cpp.span(node), why, "put the assignment in parentheses")
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


def _gives(node: Node) -> bool:
    """Whether a function has a result by its type; that of `auto` is as its body says."""
    type_ = node.child_by_field_name("type")
    return type_ is not None and text_of(type_) not in ("void", "auto")


def _bases(lineage: Sequence[CppClass]) -> set[str]:
    return {base.partition("<")[0].rpartition("::")[2] for c in lineage for base in c.bases}


def _is_called(node: Node) -> bool:
    above = node.parent
    return above is not None and above.type == "call_expression"


def _may_reach_end(node: Node) -> bool:
    """Whether control may come to the end of a statement."""
    match node.type:
        case "if_statement":
            ways = (part(node, "consequence"), node.child_by_field_name("alternative"))
            return any(way is None or _may_reach_end(way) for way in ways)
        case "switch_statement":
            cases = [n for n in named(part(node, "body")) if n.type == "case_statement"]
            has_default = any(n.child_by_field_name("value") is None for n in cases)
            return not has_default or _breaks(node) or all(map(_may_reach_end, cases[-1:]))
        case kind if kind in _LOOPS:
            condition = node.child_by_field_name("condition")
            said = "" if condition is None else text_of(condition).strip("() ")
            is_for = kind == "for_statement" and condition is None
            return _breaks(node) or not (is_for or said in ("true", "1"))
        case "try_statement":
            handlers = [n for n in named(node) if n.type == "catch_clause"]
            return any(_may_reach_end(part(n, "body")) for n in (node, *handlers))
        case "compound_statement" | "labeled_statement" | "else_clause" | "case_statement":
            return all(map(_may_reach_end, named(node)))
        case kind:
            return kind not in _LEAVES


def _breaks(node: Node) -> bool:
    """Whether a `break` leaves a loop or switch."""
    inner = [n for n in named(node) if n.type not in (*_LOOPS, "switch_statement")]
    return any(n.type == "break_statement" or _breaks(n) for n in inner)
