"""Which methods of generated Python may wait for a lock: who holds one and calls them may block.

A method may wait if it enters a context or names `acquire`, or does anything with its object's own
methods that may: a fixpoint over the call graph, by names, so that heirs and properties count.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from tree_sitter import Node

from rebsync.reverse.python.model_types import call_parts
from rebsync.reverse.python.module_variables import imported_as
from rebsync.reverse.python.runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_tree import field, text_of

LOCKS = {"threading.Lock": False, "threading.RLock": True}  # whether one may take it again
_OBJECTS = frozenset({"self", "super()"})


def waiting_methods(code: PyCode) -> frozenset[str]:
    """The methods of classes, the run-time part's left out, that may wait for a lock."""
    bodies = {
        name: [f.node for f in found if not is_runtime_file(f.py.source)]
        for name, found in code.methods.items()
    }
    found = frozenset[str]()
    while (more := _waiting(bodies, found)) != found:
        found = more
    return found


def _waiting(bodies: Mapping[str, list[Node]], known: frozenset[str]) -> frozenset[str]:
    return frozenset(n for n, nodes in bodies.items() if any(may_lock(b, known) for b in nodes))


def may_lock(node: Node, waiting: Collection[str]) -> bool:
    """Whether something waits for a lock, or names a method of the object that may."""
    if node.type == "with_statement":
        return True
    if node.type == "attribute":
        name = text_of(field(node, "attribute"))
        if name == "acquire" or (name in waiting and text_of(field(node, "object")) in _OBJECTS):
            return True
    return any(may_lock(child, waiting) for child in node.named_children)


def lock_of(module: Scope, node: Node) -> str:
    """The lock that a value is, by its name in Python's library; empty if it is none."""
    called, arguments = call_parts(node) or ("", [])
    head, _, rest = called.partition(".")
    of = imported_as(module, head)
    whole = ".".join(filter(None, (of, rest)))
    return whole if whole in LOCKS and not arguments else ""
