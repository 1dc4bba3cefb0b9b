"""What Python lets a program change of the meaning of attributes, methods and classes.

Bodies are read as if `self.x` were a plain attribute of the object, and `self.m()` the method of
its class. Where a class does otherwise, that is listed: nothing is known of what its bodies do.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.libraries.python import client_modules
from rebsync.reverse.python.bodies.body_effects import is_getter
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_units import scope_around
from rebsync.reverse.python.values.class_creation import PLAIN_BASES, class_departures
from rebsync.reverse.python.values.py_evaluator import lineage
from rebsync.reverse.python.values.py_worth import Class, External, Instance
from rebsync.reverse.syntax.py_index import CLASS, FUNCTION, Scope
from rebsync.reverse.syntax.py_tree import field, text_of

_HOOKS = frozenset(
    {"__setattr__", "__getattr__", "__getattribute__", "__delattr__", "__new__", "__del__"}
    | {"__init_subclass__", "__set_name__", "__prepare__"}
)
_PLAIN_DECORATORS = frozenset(
    {"staticmethod", "classmethod", "abstractmethod", "abc.abstractmethod"}
    | {"override", "typing.override", "typing_extensions.override"}
)
_WITHOUT_DICT = frozenset({"builtins.object", "abc.ABC"})
_BY_NAMES = ("__dict__", "__class__")
_DESCRIBES = frozenset({"__get__", "__set__", "__delete__"})


def list_object_model(reading: Reading, findings: Findings) -> None:
    """Lists what makes the classes of a unit other than they are read."""
    unit = reading.unit
    if not unit.lineage:
        return
    for scope, node, why in _departures(reading):
        findings.unreadable(scope.py.source, Unread(scope.py.span(node), why), unit.name)


def _departures(reading: Reading) -> Iterator[tuple[Scope, Node, str]]:
    for scope in reading.unit.lineage:
        yield from _of_class(reading, scope)
        yield from _of_members(reading, scope)
    yield from _by_names(reading)
    yield from _slots(reading)
    yield from _replaced(reading)
    yield from _private(reading)
    yield from _of_subclasses(reading)


def _of_class(reading: Reading, scope: Scope) -> Iterator[tuple[Scope, Node, str]]:
    """What makes a class another than its body says."""
    for node, why in class_departures(reading.values, scope, PLAIN_BASES | client_modules()):
        yield scope, node, why


def _of_members(reading: Reading, scope: Scope) -> Iterator[tuple[Scope, Node, str]]:
    """Hooks of attribute access, decorated methods, descriptors, and the object's dictionary."""
    for name, bindings in scope.names.items():
        for binding in bindings:
            if name in _HOOKS:
                yield scope, binding.node, f'"{name}" changes what objects and attributes are'
            elif binding.how == "scope":
                yield from _decorated(reading, scope, name, binding.node)
            elif binding.how == "value" and _may_describe(reading, scope, binding.value):
                yield scope, binding.node, f'"{name}" may be a descriptor: what it does is not read'


def _by_names(reading: Reading) -> Iterator[tuple[Scope, Node, str]]:
    """The dictionaries of what may be such an object, and stores in its class, in all files."""
    for path, module in reading.code.modules.items():
        for name in _BY_NAMES:
            for node in _attributes(module.node, name):
                scope = scope_around(reading.code, node, path)
                is_read = name == "__class__" and not _holds_what_is_set(node)
                if not is_read and _may_be_of(reading, scope, field(node, "object")):
                    yield scope, node, "attributes that are set by their names are not read"


def _may_be_of(reading: Reading, scope: Scope, node: Node) -> bool:
    """Whether a value may be an object of the unit: nothing shows that it is of other classes."""
    family = reading.unit.lineage
    ways = reading.values.ways(node, scope)
    others = (isinstance(w, Instance) and w.scope not in family for w in ways)
    return not ways or not all(others)


def _holds_what_is_set(node: Node) -> bool:
    """Whether an attribute of this is the target of a store."""
    target = node.parent
    store = target.parent if target is not None else None
    is_attribute = target is not None and target.type == "attribute"
    return is_attribute and store is not None and store.child_by_field_name("left") == target


def _slots(reading: Reading) -> Iterator[tuple[Scope, Node, str]]:
    """Attributes that fail to be set: each class of the lineage says which ones there are."""
    family = reading.unit.lineage
    above = {c.name for c in lineage(reading.values, family[0]) if isinstance(c, External)}
    said = [scope.names.get("__slots__") for scope in family]
    if not above <= _WITHOUT_DICT or not all(said):
        return
    texts = " ".join(text_of(b.node) for bindings in said for b in bindings or ())
    for scope in family:
        for name, bindings in scope.attributes.items():
            if not re.search(rf"\b{re.escape(name)}\b", texts):
                yield scope, bindings[0].node, f'no `__slots__` has "{name}": to set it fails'


def _decorated(
    reading: Reading, scope: Scope, name: str, node: Node
) -> Iterator[tuple[Scope, Node, str]]:
    inner = reading.code.scope_of(node, scope.py)
    unknown = set(inner.decorators) - _PLAIN_DECORATORS
    if not unknown or not _is_used(scope.module.node, name):
        return
    if inner.kind == CLASS or is_getter(reading, inner):
        return
    yield scope, node, f'what "@{sorted(unknown)[0]}" makes of "{name}" is not read'


def _is_used(module: Node, name: str) -> bool:
    """Whether anything takes an attribute of that name."""
    return any(True for _ in _attributes(module, name))


def _attributes(node: Node, name: str) -> Iterator[Node]:
    wanted = name.encode()
    waiting = [node]
    while waiting:
        current = waiting.pop()
        if current.type == "attribute" and field(current, "attribute").text == wanted:
            yield current
        waiting += [c for c in current.named_children if wanted in (c.text or b"")]


def _may_describe(reading: Reading, scope: Scope, value: Node) -> bool:
    """Whether a class attribute is an object whose class says what access to it does."""
    if value.type != "call":
        return False
    ways = reading.values.ways(field(value, "function"), scope)
    made = [w.scope for w in ways if isinstance(w, Class)]
    return any(_DESCRIBES & set(s.names) for s in made) or text_of(field(value, "function")) in (
        "property",
        "functools.cached_property",
        "cached_property",
    )


# --- what is set on classes ---------------------------------------------------------------------


def _replaced(reading: Reading) -> Iterator[tuple[Scope, Node, str]]:
    """Attributes of the class itself that code sets, and methods that objects replace."""
    family = reading.unit.lineage
    methods = {
        name for s in family for name, of in s.names.items() if any(b.how == "scope" for b in of)
    }
    for above in family:
        for name, bindings in above.attributes.items():
            if name in methods:
                yield above, bindings[0].node, f'this replaces the method "{name}" of the object'
    code = reading.code
    for scope in (*code.scopes.values(), *code.modules.values()):
        for (holder, name), bindings in scope.stores.items():
            for binding in bindings:
                if _is_family(reading, scope, holder, binding.node):
                    why = f'"{name}" of the class is set: its objects share it'
                    yield scope, binding.node, why
    yield from _shadowed(reading)


def _is_family(reading: Reading, scope: Scope, holder: str, node: Node) -> bool:
    """Whether a store is on a class of the unit, not on an object."""
    if holder in ("cls", "self.__class__", "type(self)"):
        return scope.owner in reading.unit.lineage
    target = node.child_by_field_name("left")
    inner = target.child_by_field_name("object") if target is not None else None
    if inner is None or not any(holder == s.name for s in reading.unit.lineage):
        return False
    ways = reading.values.ways(inner, scope)
    return any(isinstance(w, Class) and w.scope in reading.unit.lineage for w in ways)


def _shadowed(reading: Reading) -> Iterator[tuple[Scope, Node, str]]:
    """Class attributes that objects hide with their own, where code reads the class's."""
    family = reading.unit.lineage
    owners = {s.name for s in family} | {"cls"}
    for scope in family:
        values = {n for n, of in scope.names.items() if any(b.how == "value" for b in of)}
        hidden = {n for n in values if any(n in s.attributes for s in family)}
        for name in sorted(hidden):
            for node in _attributes(scope.module.node, name):
                if text_of(field(node, "object")) in owners:
                    why = f'"{name}" of the class and of its objects are two variables'
                    yield scope, node, why


def _private(reading: Reading) -> Iterator[tuple[Scope, Node, str]]:
    """Names such as `__x`, of which each class of a lineage has its own."""
    seen: dict[str, Scope] = {}
    for scope in reading.unit.lineage:
        for name in (*scope.attributes, *scope.names):
            if not name.startswith("__") or name.endswith("__"):
                continue
            first = seen.setdefault(name, scope)
            if first is not scope:
                binding = (scope.attributes.get(name) or scope.names[name])[0]
                yield scope, binding.node, f'each class has a "{name}" of its own'


# --- subclasses ---------------------------------------------------------------------------------


def _of_subclasses(reading: Reading) -> Iterator[tuple[Scope, Node, str]]:
    """Classes below that of the unit, whose objects do what they say."""
    first = reading.unit.lineage[0]
    whole = lineage(reading.values, first)
    for scope in list(reading.code.scopes.values()):
        if scope.kind != CLASS or scope is first or scope in reading.unit.lineage:
            continue
        if scope in reading.nodes:
            continue
        above = lineage(reading.values, scope)
        is_other = scope.names or scope.attributes or above[1:] != whole
        if first in above and is_other and _is_made(reading, scope):
            why = f'objects of "{scope.name}" do otherwise than those of "{first.name}"'
            yield scope, scope.node, why


def _is_made(reading: Reading, made: Scope) -> bool:
    for call, scope in reading.code.by_callee.get(made.name, []):
        ways = reading.values.ways(field(call, "function"), scope)
        if any(isinstance(w, Class) and w.scope is made for w in ways):
            return True
    return False


def decorated_callback(scope: Scope) -> str:
    """Why it is not known what a free function does; empty where nothing decorates it."""
    if scope.kind != FUNCTION or scope.is_method:
        return ""
    unknown = sorted(set(scope.decorators) - _PLAIN_DECORATORS)
    return f'what "@{unknown[0]}" makes of this callback is not read' if unknown else ""
