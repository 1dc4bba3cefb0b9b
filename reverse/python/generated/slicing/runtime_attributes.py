"""Attributes that objects of the run-time part do not have: `self._drive.statex` in a log.

The run-time part is no part of the program of which effects are asked, so that its objects are of
no known type there. What its classes have are the names that it says itself.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import PyCode, Scope, module_named, module_of
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import field, text_of

_SAID = re.compile(r"(?:\bdef\s+|\.)(\w+)|^[ \t]+(\w+)[ \t]*[:=]", re.MULTILINE)
_OF_OBJECTS = frozenset(dir(type)) | frozenset(dir(object)) | {"__dict__"}


@dataclass(frozen=True, slots=True)
class RuntimeAttributes:
    """What modules call things of the run-time part, by their roots, and what these have."""

    objects: Mapping[int, frozenset[str]]
    known: frozenset[str]

    @staticmethod
    def of(code: PyCode) -> RuntimeAttributes:
        """Those of a package; nothing is known where its run-time part is elsewhere."""
        runtime = [m for m in code.modules.values() if is_runtime_file(m.py.source)]
        said = (_SAID.findall(m.py.source.text) for m in runtime)
        known = {word for found in said for words in found for word in words}
        users = [m for m in code.modules.values() if m not in runtime] if runtime else []
        objects = {m.node.id: frozenset(_objects(code, m)) for m in users}
        return RuntimeAttributes(objects, frozenset(known | _OF_OBJECTS))

    def lacking(self, root: Node, node: Node) -> Iterator[Node]:
        """The attributes in a part of a module that no object of the run-time part has."""
        objects = self.objects.get(root.id, frozenset())
        for each in nodes_in(node) if objects else ():
            is_of_runtime = each.type == "attribute" and text_of(field(each, "object")) in objects
            if is_of_runtime and text_of(field(each, "attribute")) not in self.known:
                yield each


def _objects(code: PyCode, module: Scope) -> Iterator[str]:
    """What a module imports of the run-time part, and what it makes of its classes."""
    imported = {
        name
        for name, bindings in module.names.items()
        if len(bindings) == 1 and bindings[0].node.type == "import_from_statement"
        for source in [module_named(code, module_of(bindings[0].node), module)]
        if source is not None and is_runtime_file(source.py.source)
    }
    classes = {name for name in imported if name[:1].isupper()}
    yield from (*classes, *(("self.mailbox",) if classes else ()))
    made: dict[str, list[str]] = {}
    for node in nodes_in(module.node) if classes else ():
        value = node.child_by_field_name("right") if node.type == "assignment" else None
        if value is not None:
            called = text_of(field(value, "function")) if value.type == "call" else ""
            made.setdefault(text_of(field(node, "left")), []).append(called)
    yield from (place for place, calls in made.items() if classes.issuperset(calls))
