"""What makes a class another one than its body says: decorators, keywords, bases, special names.

"Customizing class creation" and "Special method names" in the reference of Python.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from tree_sitter import Node

from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.libraries.python import clients
from rebsync.reverse.python.values.annotations import unbound_annotations
from rebsync.reverse.python.values.py_evaluator import PyEvaluator
from rebsync.reverse.python.values.py_worth import Class, External, Ways
from rebsync.reverse.syntax.py_index import FUNCTION, Scope
from rebsync.reverse.syntax.py_tree import decorating, field, named, text_of

Departure = tuple[Node, str]
DECORATORS = frozenset({"abstractmethod", "final", "override", "staticmethod", "classmethod"})
# Where decorators come from that leave a function the one that stands there.
_PLAIN_ROOTS = frozenset({"builtins", "abc", "typing", "typing_extensions"})
_METACLASS = "abc.ABCMeta"
_FINAL = frozenset({"typing.final", "typing_extensions.final"})  # only told to type checkers
_GENERIC = frozenset({"typing.Generic", "typing.Protocol", "typing_extensions.Protocol"})
# Of the names that Python looks for in a class, those that change no behaviour of its objects.
_PLAIN_NAMES = frozenset({"__init__", "__str__", "__repr__", "__doc__"})
# The libraries besides those of ROS whose classes nodes may have above them: they call nothing.
PLAIN_BASES = frozenset({"abc", "typing", "typing_extensions", "builtins", "enum"})
_HINT = "take it out: no model says this"


def list_creation(
    values: PyEvaluator, owner: Scope, functions: Iterable[Scope], findings: Findings
) -> None:
    """Lists what makes a generated class, or a function of it, another than is read."""
    for node, why in (
        *class_departures(values, owner, PLAIN_BASES | {c.name for c in clients()}),
        *special_names(owner, _PLAIN_NAMES),
        *renamed_decorators(values, functions, DECORATORS | {"property"}),
    ):
        findings.unreadable(owner.py.source, Unread(owner.py.span(node), why, _HINT), owner.name)


def class_departures(
    values: PyEvaluator, scope: Scope, libraries: Collection[str] | None = None
) -> Iterator[Departure]:
    """Decorators, keywords and bases of a class by which it may be another class, or none.

    With `libraries` bases of all others are listed as well.
    """
    outer = scope.parent or scope
    for node in decorating(scope.node):
        if _names(values.ways(named(node)[0], outer)) - _FINAL:
            yield node, "what decorates this class may change it"
    yield from unbound_annotations(scope)
    bases = scope.node.child_by_field_name("superclasses")
    for base in named(bases) if bases is not None else ():
        if base.type == "keyword_argument":
            made_by = _names(values.ways(field(base, "value"), outer))
            if text_of(field(base, "name")) != "metaclass" or made_by != {_METACLASS}:
                yield base, "a metaclass may change what this class is"
        elif not _is_class(values, base, outer, libraries):
            yield base, "what class this is is not known"


def _is_class(
    values: PyEvaluator, base: Node, scope: Scope, libraries: Collection[str] | None
) -> bool:
    """Whether all that a base may be are classes of the files, or of some or any libraries."""
    if base.type == "subscript":
        return _names(values.ways(field(base, "value"), scope)) <= _GENERIC
    if base.type not in ("identifier", "attribute"):
        return False
    ways = values.ways(base, scope)
    of_libraries = [w for w in ways if isinstance(w, External)]
    is_known = libraries is None or all(w.root in libraries for w in of_libraries)
    return is_known and bool(ways) and all(isinstance(w, (Class, External)) for w in ways)


def _names(ways: Ways) -> set[str]:
    """The names that values have in libraries; an empty one for each that has none."""
    return {way.name if isinstance(way, External) else "" for way in ways}


def special_names(scope: Scope, plain: frozenset[str]) -> Iterator[Departure]:
    """What a class binds that Python itself looks for, but for some names."""
    for name, bindings in scope.names.items():
        if name.startswith("__") and name.endswith("__") and name not in plain:
            for binding in bindings:
                yield binding.node, f'"{name}" changes what objects and attributes are'


def renamed_decorators(
    values: PyEvaluator, functions: Iterable[Scope], plain: frozenset[str]
) -> Iterator[Departure]:
    """Decorators with the names of well-known ones that are others."""
    for function in functions:
        for node in decorating(function.node) if function.kind == FUNCTION else ():
            expression = named(node)[0]
            if text_of(expression) not in plain:
                continue
            ways = values.ways(expression, function.module)
            if any(not isinstance(w, External) or w.root not in _PLAIN_ROOTS for w in ways):
                yield node, f'nobody knows what "{text_of(node)}" makes of it'
