"""From files of Python to what they ask of ROS, and to the list of what the model lacks of them."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import (
    Callback,
    Callbacks,
    Fact,
    Graph,
    ServiceFact,
    SubscriptionFact,
    TimerFact,
)
from rebsync.reverse.python.py_calls import graph_of
from rebsync.reverse.python.py_index import PyCode
from rebsync.reverse.python.py_tree import parse, unparsed
from rebsync.source import Source

_WHY = "the statements of hand-written Python are not read, only what the node asks of ROS"
_HINT = "--format json tells what it asks of ROS"


def read_python(
    sources: Mapping[str, Source], findings: Findings, only: str | None = None
) -> Graph:
    """What some files ask of ROS; each callback, whose body is not in the model, is listed."""
    trees = [parse(source) for _, source in sorted(sources.items())]
    findings.all += [f for py in trees for f in unparsed(py)]
    graph = graph_of(PyCode.of(trees))
    _list_callbacks(
        graph, findings, sources[only].path if only is not None and only in sources else None
    )
    return graph


def _list_callbacks(graph: Graph, findings: Findings, path: str | None) -> None:
    listed = set()
    for fact in graph.facts:
        for callback in _callbacks(fact):
            if not isinstance(callback, Callback):
                continue
            place = callback.place
            key = place.source.path, place.span.start
            if key not in listed and path in (None, place.source.path):
                listed.add(key)
                name = callback.name or "lambda"
                findings.unreadable(place.source, Unread(place.span, _WHY, _HINT), name)


def _callbacks(fact: Fact) -> Callbacks:
    return fact.callbacks if isinstance(fact, (SubscriptionFact, TimerFact, ServiceFact)) else ()
