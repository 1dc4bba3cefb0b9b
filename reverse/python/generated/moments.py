"""Times of sends that modules of generated Python give names to, and other names of their class."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.python.generated.py_types import call_parts
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

_CLASS = "When"


def is_moment(module: Scope, called: str) -> bool:
    """Whether a name of a module is the class of times: `from .values import When as Timing`."""
    if called == _CLASS:
        return True
    bindings = module.names.get(called, [])
    if len(bindings) != 1:
        return False
    match bindings[0].how, bindings[0].value.type:
        case "import", "aliased_import" if bindings[0].node.type == "import_from_statement":
            source = text_of(field(bindings[0].node, "module_name"))
            is_class = text_of(field(bindings[0].value, "name")) == _CLASS
            return is_class and source.rpartition(".")[2] == "values"
        case "value", "identifier":
            return text_of(bindings[0].value) == _CLASS and not bindings[0].path
        case _:
            return False


def named_moment(module: Scope, name: str) -> Node | None:
    """The only value of a variable of a module, if it is a time that is written out."""
    bindings = module.names.get(name, [])
    if len(bindings) != 1 or bindings[0].how != "value" or bindings[0].path:
        return None
    statement = bindings[0].node.parent
    is_at_top = statement is not None and statement.parent == module.node
    return bindings[0].value if is_at_top and _is_written(module, bindings[0].value) else None


def _is_written(module: Scope, value: Node) -> bool:
    called, arguments = call_parts(value) or ("", [])
    numbers = [field(a, "value") if a.type == "keyword_argument" else a for a in arguments]
    return is_moment(module, called) and all(n.type == "integer" for n in numbers)


def names_moment(module: Scope, statement: Node) -> bool:
    """Whether a statement of a module gives a name to a time, or to the class of times."""
    inner = named(statement)[0] if statement.type == "expression_statement" else statement
    left = inner.child_by_field_name("left") if inner.type == "assignment" else None
    if left is None or left.type != "identifier":
        return False
    name = text_of(left)
    return named_moment(module, name) is not None or is_moment(module, name)
