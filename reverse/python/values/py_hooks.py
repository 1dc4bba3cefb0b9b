"""Functions that a client library calls for other reasons than messages, timers, and services.

The tables of libraries say which arguments of a call are called later.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import Callback, Callbacks, Place
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Routine
from rebsync.reverse.python.values.py_callbacks import callback_name, callbacks_of
from rebsync.reverse.python.values.py_evaluator import lineage
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import Class, External, Function, Module
from rebsync.reverse.syntax.py_index import CLASS, Scope, arguments_of
from rebsync.reverse.syntax.py_tree import field, text_of

# What a node with managed states has that its library calls when its state changes.
_CHANGES = tuple(
    f"on_{change}"
    for change in ("configure", "activate", "deactivate", "cleanup", "shutdown", "error")
)


@dataclass(frozen=True, eq=False, slots=True)
class Hook:
    """A call that hands functions over: `name` is what is called, `within` where it stands.

    Or the method `name` of a node that its library calls.
    """

    name: str
    place: Place
    within: Scope
    callbacks: Callbacks

    @property
    def functions(self) -> str:
        """The functions by their names, as far as they have any."""
        named = (c.name or "lambda" for c in self.callbacks if isinstance(c, Callback))
        return ", ".join(named)


def hooks_in(values: PyValues) -> Iterator[Hook]:
    """All such calls that hand over something, and changes of state: in the order of the text."""
    code = values.code
    calls = [
        (call, scope) for name in libraries.hooks() for call, scope in code.by_callee.get(name, ())
    ]
    found = [hook for call, scope in calls if (hook := _hook(values, call, scope)) is not None]
    found += (hook for scope in code.scopes.values() for hook in _changes(values, scope))
    yield from sorted(found, key=lambda h: (h.place.source.path, h.place.span.start))


def _changes(values: PyValues, owner: Scope) -> Iterator[Hook]:
    """The methods of a class that its library calls when the state of its node changes."""
    names = [name for name in _CHANGES if name in owner.names] if owner.kind == CLASS else []
    above = lineage(values, owner) if names else []
    if any(isinstance(c, External) and c.name in libraries.managed() for c in above):
        for name in names:
            method = values.code.scope_of(owner.names[name][-1].node, owner.py)
            word = field(method.node, "name")
            place = Place(owner.py.source, owner.py.span(word))
            yield Hook(name, place, method, (Callback(callback_name(method), place),))


def _hook(values: PyValues, call: Node, scope: Scope) -> Hook | None:
    called = field(call, "function")
    word = field(called, "attribute") if called.type == "attribute" else called
    entry = _entry(values, text_of(word), called, scope)
    if entry is None:
        return None
    given = _given(entry, call)
    if not given:
        return None
    callbacks = tuple(c for node in given for c in callbacks_of(values, node, scope))
    return Hook(text_of(word), Place(scope.py.source, scope.py.span(word)), scope, callbacks)


def _given(entry: Routine, call: Node) -> list[Node]:
    """The arguments that are called later, None left out."""
    plain, keywords = arguments_of(call)
    roles = libraries.hook_roles(entry)
    given = [node for role, node in zip(entry.arguments, plain, strict=False) if role in roles]
    given += [keywords[name] for name, role in entry.keywords if role in roles and name in keywords]
    return [node for node in given if node.type != "none"]


def _entry(values: PyValues, name: str, called: Node, scope: Scope) -> Routine | None:
    """The entry that a call is of: by the module of a function, by the name of a method."""
    entries = libraries.hooks()[name]
    ways = values.ways(called, scope)
    for value in ways:
        if isinstance(value, External):
            module = value.name.rpartition(".")[0]
            for of, entry in entries:
                if of and (module == of or module.startswith(f"{of}.")):
                    return entry
    if called.type != "attribute" or any(isinstance(v, (Function, Class)) for v in ways):
        return None
    holder = field(called, "object")
    is_known = any(isinstance(h, (External, Module)) for h in values.ways(holder, scope))
    if is_known or text_of(holder).startswith("super("):
        return None
    return next((entry for of, entry in entries if not of), None)
