"""Functions of the modules of a Python package that are called by their names alone."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync.reverse.python.generated.py_types import is_text
from rebsync.reverse.python.generated.slicing.log_words import LOOKS
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.py_index import FUNCTION, PyCode, Scope, module_named, module_of
from rebsync.reverse.syntax.py_tree import field, named, text_of

_TEXTS = frozenset({"string", "concatenated_string"})


def function_named(code: PyCode, module: Scope, name: str) -> Scope | None:
    """A plain function of a module of the package, of this one or one that it is imported from."""
    bindings = module.names.get(name, [])
    if len(bindings) != 1:
        return None
    binding = bindings[0]
    if binding.how == "import" and binding.node.type == "import_from_statement":
        item = binding.value
        is_other = item is not None and item.type == "aliased_import"
        source = module_named(code, module_of(binding.node), module)
        if source is None or source is module or is_other or is_runtime(source):
            return None
        return function_named(code, source, name)
    if binding.how != "scope":
        return None
    found = code.scope_of(binding.node, module.py)
    is_coroutine = any(c.type == "async" for c in found.node.children)
    return found if found.kind == FUNCTION and not (found.decorators or is_coroutine) else None


def is_runtime(module: Scope) -> bool:
    """Whether a module is of the run-time part, whose functions the model has words for."""
    text = module.py.source.text
    return any(f"\nclass {name}" in text for name in ("Violation", "Mailbox", "Startup"))


def describing(code: PyCode, module: Scope) -> dict[str, int]:
    """The functions that a module calls by a name and that only put texts together.

    Each with how many arguments it takes. They choose between texts by what they are given, and
    look at nothing else: nothing of the model depends on them, nor can they fail.
    """
    found = {}
    for name in module.names:
        function = function_named(code, module, name)
        if function is not None and _describes(function):
            found[name] = len(function.parameters)
    return found


def _describes(function: Scope) -> bool:
    taken = {p.name for p in function.parameters}
    nodes = named(field(function.node, "parameters"))
    is_plain = all(n.type in ("identifier", "typed_parameter") for n in nodes)
    body = [s for s in body_of(function) if not is_text(s)]
    return is_plain and taken.isdisjoint(LOOKS) and _gives_text(body, taken)


def _gives_text(body: Sequence[Node], taken: set[str]) -> bool:
    """Whether statements end with a text that is put together of what is taken."""
    if not body:
        return False
    *before, last = body
    if not all(_is_way(s, taken) for s in before):
        return False
    if last.type == "return_statement":
        values = named(last)
        return len(values) == 1 and _is_text(values[0], taken)
    is_whole = last.type == "if_statement" and _is_way(last, taken)
    return is_whole and any(c.type == "else_clause" for c in named(last))


def _is_way(statement: Node, taken: set[str]) -> bool:
    """Whether it is an `if` each way of which gives a text."""
    if statement.type != "if_statement":
        return False
    for part in [statement, *statement.children_by_field_name("alternative")]:
        condition = part.child_by_field_name("condition")
        body = field(part, "body" if part.type == "else_clause" else "consequence")
        if condition is not None and not _is_condition(condition, taken):
            return False
        if not _gives_text([n for n in named(body) if n.type != "comment"], taken):
            return False
    return True


def _is_text(node: Node, taken: set[str]) -> bool:
    if node.type == "conditional_expression":
        then, condition, otherwise = named(node)
        is_known = _is_condition(condition, taken)
        return is_known and _is_text(then, taken) and _is_text(otherwise, taken)
    if node.type not in _TEXTS:
        return False
    parts = [n for n in named(node) if n.type == "interpolation"]
    return all(_is_taken(named(p)[0], taken) and len(named(p)) == 1 for p in parts)


def _is_condition(node: Node, taken: set[str]) -> bool:
    """Whether a condition compares what is taken for being equal, or asks whether it is true."""
    match node.type:
        case "not_operator" | "parenthesized_expression" | "boolean_operator":
            return all(_is_condition(n, taken) for n in named(node))
        case "comparison_operator":
            signs = [text_of(c) for c in node.children_by_field_name("operators")]
            return set(signs) <= {"==", "!="} and all(_is_taken(n, taken) for n in named(node))
        case _:
            return _is_taken(node, taken)


def _is_taken(node: Node, taken: set[str]) -> bool:
    is_literal = node.type in ("integer", "string", "true", "false")
    return is_literal or (node.type == "identifier" and text_of(node) in taken)
