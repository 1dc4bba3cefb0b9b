"""Functions of the modules of a Python package that are called by their names alone."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.syntax.py_index import FUNCTION, PyCode, Scope, module_named, module_of
from rebsync.reverse.syntax.py_tree import named

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


def giving_texts(code: PyCode, module: Scope) -> set[str]:
    """The functions that a module calls by a name and that give texts, so that no model has them.

    What they do where they are called is asked of the form.
    """
    functions = ((name, function_named(code, module, name)) for name in module.names)
    return {name for name, function in functions if function is not None and _gives_text(function)}


def _gives_text(function: Scope) -> bool:
    values = [v for r in function.returns for v in named(r)]
    return bool(values) and all(map(_is_text, values))


def _is_text(node: Node) -> bool:
    if node.type == "conditional_expression":
        then, _, otherwise = named(node)
        return _is_text(then) and _is_text(otherwise)
    return node.type in _TEXTS
