"""What Python lets a program change of the names of modules, and of what libraries have.

A name of a module is read as what statements of its file bind, and what a library has as what its
table says. Code that sets them through dictionaries or by their names is listed: it may set any.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from tree_sitter import Node

from rebsync.reverse.files.python_files import is_launch
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.python.bodies.body_units import scope_around
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import External, Function, Module
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import MODULE, Scope
from rebsync.reverse.syntax.py_tree import field, text_of

_ANYWHERE = frozenset({"exec", "execfile", "globals"})
_AT_TOP = _ANYWHERE | {"eval", "vars", "locals", "setattr", "delattr"}
_WHY = "names of modules that are set in this way are not read"
_REPLACED = "this replaces what other code takes from there: it is not read"
# What runs code of the interpreter itself, and is not asked for by the tables.
_OF_INTERPRETER = ("sys.", "os.environ", "warnings.")


def list_module_model(values: PyValues, generated: Collection[str], findings: Findings) -> None:
    """Lists what makes names of modules other than they are read, but for generated files."""
    for path, module in values.code.modules.items():
        if path in generated or is_launch(path):
            continue
        for node, why in (*_by_names(values, module, path), *_replaced(values, module)):
            findings.unreadable(module.py.source, Unread(module.py.span(node), why), "")


def _by_names(values: PyValues, module: Scope, path: str) -> Iterator[tuple[Node, str]]:
    """Calls that get at the dictionaries of modules, or run a text, and `sys.modules`."""
    for node in nodes_in(module.node):
        if node.type == "attribute" and text_of(node) == "sys.modules":
            yield node, _WHY
        name = text_of(field(node, "function")) if node.type == "call" else ""
        if name in _AT_TOP and name not in module.names:
            is_top = scope_around(values.code, node, path).kind == MODULE
            if name in _ANYWHERE or is_top:
                yield node, _WHY


def _replaced(values: PyValues, module: Scope) -> Iterator[tuple[Node, str]]:
    """Stores to functions and classes of modules, and to whatever libraries have."""
    scopes = (s for s in values.code.scopes.values() if s.module is module)
    for scope in {id(s): s for s in (module, *scopes)}.values():
        for (_, name), bindings in scope.stores.items():
            for binding in bindings:
                target = binding.node.child_by_field_name("left")
                holder = target.child_by_field_name("object") if target is not None else None
                ways = values.ways(holder, scope) if holder is not None else ()
                if any(_is_replaced(way, name) for way in ways):
                    yield binding.node, _REPLACED


def _is_replaced(way: object, name: str) -> bool:
    match way:
        case Module(inner):
            return any(b.how in ("scope", "import") for b in inner.names.get(name, ()))
        case Function():
            return name.startswith("__")
        case External(library):
            return not f"{library}.{name}".startswith(_OF_INTERPRETER)
        case _:
            return False
