"""Variables of a Python module that only logs have to do with: counters, loggers."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.python.generated.slicing.logs import Looks, looks_in
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import PyCode, Scope, module_of
from rebsync.reverse.syntax.py_tree import field, named, text_of


def imported_as(module: Scope, name: str) -> str:
    """What a name of a module is of, as `threading.Lock`, with dots too; empty if it is not
    imported, or not alone, or only under a condition, as what types are checked with.
    """
    head, dot, rest = name.partition(".")
    bindings = module.names.get(head, [])
    if len(bindings) != 1 or bindings[0].how != "import":
        return ""
    node, item = bindings[0].node, bindings[0].value
    if node.parent != module.node:
        return ""
    is_alias = item.type == "aliased_import"
    if node.type == "import_statement" and not is_alias:
        return name
    wanted = text_of(field(item, "name") if is_alias else item)
    source = module_of(node) if node.type == "import_from_statement" else ""
    between = "." if source and not source.endswith(".") else ""
    return f"{source}{between}{wanted}{dot}{rest}"


def call_and_arguments(node: Node) -> tuple[str, list[Node]]:
    """What is called and the arguments, those with names among them."""
    if node.type != "call":
        return "", []
    return text_of(field(node, "function")), named(field(node, "arguments"))


def counters_of(code: PyCode, module: Scope) -> Iterator[str]:
    """The variables of a module that are made of a literal at its top, and that no other names."""
    for name, bindings in module.names.items():
        values = [b for b in bindings if b.node.parent and b.node.parent.parent == module.node]
        others = [b for b in bindings if b not in values]
        is_made = len(values) == 1 and values[0].how == "value" and not values[0].path
        is_made = is_made and bool(others) and all(_counts(b, name) for b in bindings)
        if is_made and not _is_named_elsewhere(code, module, name):
            yield name


def _counts(binding: Binding, name: str) -> bool:
    """Whether a variable gets a number, or has one added that is written out."""
    value = binding.value
    if binding.how == "augmented":
        return value.type == "integer" and text_of(binding.node).partition("=")[0][-1:] in "+-*"
    if value.type == "binary_operator" and text_of(field(value, "operator")) in "+-*":
        sides = field(value, "left"), field(value, "right")
        return all(n.type == "integer" or text_of(n) == name for n in sides)
    return binding.how == "value" and not binding.path and value.type in ("integer", "float")


def hidden_names(code: PyCode, module: Scope) -> frozenset[str]:
    """The names that functions and classes of a module bind as their own."""
    path = module.py.source.path
    inner = (s for (of, _), s in code.scopes.items() if of == path and s is not module)
    return frozenset(name for scope in inner for name in scope.names)


def _is_named_elsewhere(code: PyCode, module: Scope, name: str) -> bool:
    """Whether another module may look at a variable of a module, or change it."""
    word = re.compile(rf"\b{re.escape(name)}\b")
    others = (m for m in code.modules.values() if m is not module)
    return any(word.search(m.py.source.text) for m in others)


def is_clock(module: Scope, name: str) -> bool:
    """Whether a name of a module is imported, and is a function that tells the time."""
    return imported_as(module, name) in libraries.clocks()


def loggers_of(module: Scope) -> frozenset[str]:
    """The variables of a module that only ever are a logger of Python's library."""
    found = set[str]()
    for name, bindings in module.names.items():
        called, arguments = (
            call_and_arguments(bindings[0].value) if len(bindings) == 1 else ("", [])
        )
        whole = imported_as(module, called)
        is_named = all(a.type in ("identifier", "string") for a in arguments)
        if whole == "logging.getLogger" and bindings[0].how == "value" and is_named:
            found.add(name)
    return frozenset(found)


def looks_of(
    code: PyCode, modules: Iterable[Scope], makers: frozenset[str], hidden: Collection[str]
) -> Looks:
    """What names stand for in some modules, `hidden` are bound anew; the first has the functions
    that look."""
    each = [*{id(m): m for m in modules}.values()]
    clocks = frozenset(n for n in each[0].names if is_clock(each[0], n))
    return replace(
        looks_in(code, each, makers),
        loggers=loggers_of(each[0]).difference(hidden),
        clocks=clocks.difference(hidden),
    )
