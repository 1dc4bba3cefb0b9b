"""Which attributes the object of a method surely has where the method is entered.

By all places that name the method: what is set there before, and where the function around it is
entered (definite assignment over the call graph). A path that comes back to a method sets no less.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function, FunctionKind
from rebsync.reverse.ir.walk import Node, walk

_DEEPEST = 6
Sets = Callable[[Function, s.Statement], frozenset[str]]


def is_set_at_entry(
    origins: Origins, function: Function, attribute: str, first: frozenset[str], sets: Sets
) -> bool:
    """Whether an attribute is set on each way into a method of its object.

    `first` is what constructors set, which is there where others name the method; `sets` gives what
    a statement of a function sets.
    """
    return _is_set(origins, function, attribute, first, sets, frozenset())


def _is_set(
    origins: Origins,
    function: Function,
    attribute: str,
    first: frozenset[str],
    sets: Sets,
    active: frozenset[str],
) -> bool:
    if function.name in active:
        return True
    name = function.name.rpartition(".")[2]
    around = origins.names.naming.get(name, frozenset())
    users = {f for f in around if origins.graph.program.function(f).kind is not FunctionKind.CLASS}
    if attribute in first or not users or len(active) > _DEEPEST:
        return attribute in first
    for each in around:
        user = origins.graph.program.function(each)
        if user.kind is FunctionKind.CLASS and len(list(_uses(user, name))) == 1:
            continue  # the class has the method
        if user.kind is FunctionKind.CONSTRUCTOR or each.rpartition(".")[2] == "__init__":
            return False
        if user.receiver is None or any(not _is_own(n, user, name) for n in _uses(user, name)):
            return False
        before = _before(user, user.body, frozenset(), name, sets)
        if all(attribute in found for found in before):
            continue
        if not _is_set(origins, user, attribute, first, sets, active | {function.name}):
            return False
    return True


def _uses(user: Function, name: str) -> Iterator[Node]:
    """The places in a function that name a method."""
    return (n for n in walk(user.body) if _names(n, name))


def _names(node: Node, name: str) -> bool:
    if isinstance(node, s.Call) and isinstance(node.callee, s.MethodCallee):
        return node.callee.name == name
    return isinstance(node, e.Attribute) and node.name == name


def _is_own(node: Node, user: Function, name: str) -> bool:
    """Whether a place names a method of the function's own object."""
    own = e.Local(user.receiver or "")
    if isinstance(node, s.Call) and isinstance(node.callee, s.MethodCallee):
        return node.callee.receiver == own and node.callee.declared is None
    return isinstance(node, e.Attribute) and node.object == own


def _before(
    user: Function, body: s.Body, found: frozenset[str], name: str, sets: Sets
) -> Iterator[frozenset[str]]:
    """What is surely set where a method is named in a body, at each such place."""
    for node in body:
        inner: tuple[s.Body, ...] = ()
        match node:
            case s.If(_, then, otherwise):
                inner = then, otherwise
            case s.With(_, _, within) | s.Block(within) | s.Try(within):
                inner = (within,)
            case _:
                pass
        within_names = sum(sum(1 for n in walk(each) if _names(n, name)) for each in inner)
        if sum(1 for n in walk(node) if _names(n, name)) > within_names:
            yield found
        for each in inner:
            yield from _before(user, each, found, name, sets)
        found |= sets(user, node)
