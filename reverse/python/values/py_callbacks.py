"""What is called: functions, bound methods, lambdas, partial applications, objects."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.graph import Callback, Callbacks, Place, Unresolved
from rebsync.reverse.python.values.py_asks import PyRosCall
from rebsync.reverse.python.values.py_evaluator import lineage
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import (
    Bound,
    External,
    Function,
    Instance,
    Items,
    Made,
    NoneValue,
    Value,
)
from rebsync.reverse.syntax.py_index import LAMBDA, Scope, arguments_of, last_name
from rebsync.reverse.syntax.py_tree import field, is_constant_text, named, text_of

# Filters that get others: several, or one.
_FED = ("TimeSynchronizer", "ApproximateTimeSynchronizer", "Cache")
_DEEPEST = 4


def callbacks_of(values: PyValues, node: Node, scope: Scope) -> Callbacks:
    """What a callback may be; each is told once."""
    found: dict[tuple[str, int], Callback | Unresolved] = {}
    for way in values.ways(node, scope):
        for one in _called(values, way, node, scope):
            label = one.name if isinstance(one, Callback) else one.why
            found.setdefault((label, one.place.span.start), one)
    none = values.unknown("what is called is computed", node, scope)
    return tuple(found.values()) or (none,)


def _called(
    values: PyValues, way: Value, node: Node, scope: Scope
) -> Iterator[Callback | Unresolved]:
    match way:
        case Function(inner, _, bound):
            yield Callback(callback_name(inner), _place(inner), bound=bound)
        case Instance(owner):
            called = _call_method(values, owner)
            if called is None:
                yield values.unknown("an object that cannot be called", node, scope)
            else:
                yield Callback(callback_name(called), _place(called), through=owner.name)
        case Bound() | External():
            place = Place(scope.py.source, scope.py.span(node))
            yield Callback(text_of(node).removeprefix("self."), place)
        case Unresolved():
            yield way
        case NoneValue():
            return
        case _:
            yield values.unknown("what is called is computed", node, scope)


def _call_method(values: PyValues, owner: Scope) -> Scope | None:
    for above in lineage(values, owner):
        if isinstance(above, Scope) and "__call__" in above.names:
            return values.code.scope_of(above.names["__call__"][-1].node, above.py)
    return None


def callback_name(function: Scope) -> str:
    """`function`, or `Class.method`; empty for a lambda."""
    if function.kind == LAMBDA:
        return ""
    if function.is_method and function.parent is not None:
        return f"{function.parent.name}.{function.name}"
    return function.name


def _place(function: Scope) -> Place:
    name = function.node.child_by_field_name("name") or function.node
    return Place(function.py.source, function.py.span(name))


# --- message filters ----------------------------------------------------------------------------


def filtered(values: PyValues, asked: PyRosCall) -> Callbacks:
    """What is registered with a filter, or with those that wait for several of them."""
    found: list[Callback | Unresolved] = []
    for call, scope in values.code.by_callee.get("registerCallback", []):
        plain, _ = arguments_of(call)
        holder = field(field(call, "function"), "object")
        for way in values.ways(holder, scope) if plain else ():
            if isinstance(way, Made) and _is_fed(values, way, asked):
                found += callbacks_of(values, plain[0], scope)
    return tuple(found)


def _is_fed(values: PyValues, made: Made, asked: PyRosCall, deep: int = 0) -> bool:
    """Whether what is registered with is the filter itself, or made of it, or of such others."""
    if made.call == asked.call:
        return True
    if deep >= _DEEPEST or last_name(field(made.call, "function")) not in _FED:
        return False
    plain, keywords = arguments_of(made.call)
    filters = plain[0] if plain else keywords.get("fs") or keywords.get("f")
    ways = values.ways(filters, made.scope) if filters is not None else ()
    items = [w for v in ways for w in (_each(v) if isinstance(v, Items) else (v,))]
    return any(isinstance(w, Made) and _is_fed(values, w, asked, deep + 1) for w in items)


def _each(items: Items) -> Iterator[Value]:
    return (way for each in items.each for way in each)


def body_of(function: Scope) -> list[Node]:
    """The statements of a function without what describes it."""
    body = field(function.node, "body")
    statements = named(body) if body.type == "block" else []
    first = statements[0] if statements else None
    if first is not None and first.type == "expression_statement":
        inner = named(first)
        if inner and is_constant_text(inner[0]):
            return statements[1:]
    return statements
