"""What binds a name in Python, and which bindings a use of the name may see."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.ancestors import ancestors, holds
from rebsync.reverse.syntax.py_tree import field, named, text_of

# What is in these may run or not; `with` always runs what is in it.
_BRANCHES = frozenset(
    {
        *("if_statement", "elif_clause", "else_clause", "for_statement", "while_statement"),
        *("except_clause", "case_clause", "try_statement"),
    }
)
_LOOPS = frozenset({"for_statement", "while_statement"})
_LEAVING = frozenset({"return_statement", "raise_statement", "continue_statement"})
_PATTERNS = frozenset({"pattern_list", "tuple_pattern", "list_pattern", "tuple", "list"})
_SCOPES = frozenset({"function_definition", "class_definition", "lambda", "module"})


@dataclass(frozen=True, eq=False, slots=True)
class Binding:
    """How a name gets a value: `value` is what `how` works on, `path` the place in it.

    `how` is one of value, augmented, loop, scope, parameter, import, opaque; `node` the statement.
    """

    how: str
    value: Node
    node: Node
    path: tuple[int, ...] = ()


# What `bindings_of` finds something in.
BINDING = frozenset(
    {
        *("assignment", "augmented_assignment", "named_expression", "for_statement"),
        *("for_in_clause", "as_pattern", "import_statement", "import_from_statement"),
        "case_pattern",
    }
)


def bindings_of(node: Node) -> Iterator[tuple[Node, Binding]]:
    """What a statement binds, each target by itself."""
    match node.type:
        case "assignment":
            value = node.child_by_field_name("right")
            while value is not None and value.type == "assignment":
                value = value.child_by_field_name("right")
            if value is not None:
                yield from _targets(field(node, "left"), Binding("value", value, node))
        case "augmented_assignment":
            yield field(node, "left"), Binding("augmented", field(node, "right"), node)
        case "named_expression":
            yield field(node, "name"), Binding("value", field(node, "value"), node)
        case "for_statement" | "for_in_clause":
            yield from _targets(field(node, "left"), Binding("loop", field(node, "right"), node))
        case "as_pattern":
            alias = node.child_by_field_name("alias")
            if alias is not None and alias.named_children:
                within = node.parent is not None and node.parent.type == "with_item"
                how = "value" if within else "opaque"
                yield alias.named_children[0], Binding(how, node.named_children[0], node)
            elif alias is None and named(node)[-1].type == "identifier":
                yield named(node)[-1], Binding("opaque", node, node)
        case "case_pattern":
            for inner in named(node):
                if inner.type == "dotted_name" and len(named(inner)) == 1:
                    yield named(inner)[0], Binding("opaque", node, node)
        case "import_statement" | "import_from_statement":
            yield from _imports(node)


def _targets(target: Node, binding: Binding) -> Iterator[tuple[Node, Binding]]:
    if target.type not in _PATTERNS:
        yield target, binding
        return
    for index, inner in enumerate(named(target)):
        path = (*binding.path, index)
        yield from _targets(inner, Binding(binding.how, binding.value, binding.node, path))


def _imports(node: Node) -> Iterator[tuple[Node, Binding]]:
    for name in node.children_by_field_name("name"):
        target = name.child_by_field_name("alias") or name
        if target.type == "dotted_name":
            target = target.named_children[0]
        yield target, Binding("import", name, node)
    for child in node.named_children:
        if child.type == "wildcard_import":
            yield child, Binding("import", child, node)


def reaching(bindings: Sequence[Binding], use: Node) -> list[Binding]:
    """The bindings of a scope that a use in the same scope may see: the last before it.

    One that a branch may skip lets those before it be seen too; one of a loop around the use, and
    behind it, is seen in later rounds.
    """
    found: list[Binding] = []
    branches: set[int] = set()
    before = [b for b in bindings if _is_before(b, use)]
    for binding in reversed(before):
        branch = None if binding.how == "parameter" else _branch(binding.node)
        if branch is None or holds(branch, use):
            found.append(binding)
            break
        if not _leaves(branch):
            found.append(binding)
            branches.add(branch.id)
            if _all_ways(branch, branches):
                break
    later = [b for b in bindings if not _is_before(b, use) and _in_a_loop_with(b, use)]
    return [*reversed(found), *later]


def _is_before(binding: Binding, use: Node) -> bool:
    if binding.how == "parameter":
        return True
    if binding.how == "loop":
        return binding.node.start_byte <= use.start_byte and not holds(binding.value, use)
    return binding.node.end_byte <= use.start_byte or (
        binding.node.type == "for_in_clause"
        and binding.node.parent is not None
        and holds(binding.node.parent, use)
    )


def _branch(node: Node) -> Node | None:
    """The innermost part of the code around a binding that may be skipped."""
    inner, above = node, node.parent
    if node.type in _LOOPS:  # the target of a loop is bound in the loop
        return node
    if node.type == "for_in_clause":
        return above
    while above is not None and above.type not in _SCOPES:
        by_blocks = above.type in ("if_statement", "try_statement")
        is_condition = inner == above.child_by_field_name("condition")
        if (
            above.type in _BRANCHES
            and not is_condition
            and (not by_blocks or inner.type == "block")
        ):
            return inner if by_blocks else above
        inner, above = above, above.parent
    return None


def _leaves(branch: Node) -> bool:
    """Whether a branch ends by leaving the function or the round of a loop."""
    block = branch if branch.type == "block" else branch.child_by_field_name("consequence")
    block = block or branch.child_by_field_name("body")
    if block is None:
        block = next((c for c in branch.children if c.type == "block"), None)
    if block is None or branch.type in _LOOPS:
        return False
    last = named(block)[-1:] or [block]
    return last[0].type in _LEAVING or text_of(last[0]).startswith(("sys.exit(", "exit("))


def _all_ways(branch: Node, seen: set[int]) -> bool:
    """Whether each way through the statement that a branch belongs to is among those seen."""
    statement = branch.parent
    if statement is None or statement.type != "if_statement":
        return False
    parts: list[Node] = [field(statement, "consequence")]
    parts += statement.children_by_field_name("alternative")
    has_else = any(p.type == "else_clause" for p in parts)
    return has_else and all(p.id in seen or _leaves(p) for p in parts)


def _in_a_loop_with(binding: Binding, use: Node) -> bool:
    around = ancestors(binding.node, lambda n: n.type in _SCOPES)
    return any(n.type in _LOOPS and holds(n, use) for n in around)
