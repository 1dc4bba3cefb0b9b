"""What Python makes that has no place in a model, as `reverse.calls.unmodelled_calls` of C++."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from rebsync.reverse.calls.beside import without_unused
from rebsync.reverse.graph import ClientFact, Graph, ServiceFact, Unmodelled, UnmodelledFact
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Kind, Routine
from rebsync.reverse.python.values.py_asks import PyRosCall, roles
from rebsync.reverse.python.values.py_calls import facts_of, graph_with, site_of
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import External
from rebsync.reverse.syntax.py_index import last_name
from rebsync.reverse.syntax.py_tree import field, text_of

_AS_SERVICE = {Kind.ACTION_SERVER: Kind.SERVICE, Kind.ACTION_CLIENT: Kind.CLIENT}


def whole_graph(values: PyValues) -> Graph:
    """All that some files ask of ROS, with what has no place in a model."""
    files = [module.py for module in values.code.modules.values()]
    return Graph(graph_with(values).facts, tuple(without_unused(unmodelled_in(values), files)))


def unmodelled_in(values: PyValues) -> Iterator[UnmodelledFact]:
    """All of them, in the order of files and places."""
    names = {name.rpartition(".")[2] for name in libraries.unmodelled()}
    for call, scope in values.code.calls:
        if last_name(field(call, "function")) not in names:
            continue
        for way in values.ways(field(call, "function"), scope):
            ask = _routine(way.name) if isinstance(way, External) else None
            if ask is not None:
                yield from _facts(values, PyRosCall(ask, call, scope, roles(ask, call)))


def _facts(values: PyValues, asked: PyRosCall) -> Iterator[UnmodelledFact]:
    ask = asked.ask
    what = Unmodelled[ask.kind.name]
    if ask.kind in _AS_SERVICE:
        served = replace(asked, ask=replace(ask, kind=_AS_SERVICE[ask.kind]))
        for fact in facts_of(values, served):
            if isinstance(fact, ServiceFact | ClientFact):
                yield UnmodelledFact(fact.site, what, fact.name, fact.type)
        return
    name, type_ = asked.given.get("name"), asked.given.get("type")
    yield UnmodelledFact(
        site_of(asked),
        what,
        values.value(name, asked.scope) if name is not None else None,
        text_of(type_) if type_ is not None else None,
    )


def _routine(name: str) -> Routine | None:
    """What makes one, by its full name: classes may be defined in modules further down."""
    first, last = name.split(".")[0], name.rpartition(".")[2]
    for known, (routine, _) in libraries.unmodelled().items():
        if known.split(".")[0] == first and known.endswith(f".{last}"):
            return routine
    return None
