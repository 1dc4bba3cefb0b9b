"""The ends of actions that Python makes, as `reverse.calls.action_calls` has those of C++."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.graph import ClientFact, ServiceFact
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Routine
from rebsync.reverse.python.py_asks import PyRosCall, roles
from rebsync.reverse.python.py_calls import facts_of
from rebsync.reverse.python.py_index import last_name
from rebsync.reverse.python.py_tree import field
from rebsync.reverse.python.py_values import PyValues
from rebsync.reverse.python.py_worth import External


def actions_in(values: PyValues) -> Iterator[ServiceFact | ClientFact]:
    """The servers and clients of actions, as those of services."""
    names = {name.rpartition(".")[2] for name in libraries.actions()}
    for call, scope in values.code.calls:
        if last_name(field(call, "function")) not in names:
            continue
        for way in values.ways(field(call, "function"), scope):
            ask = _routine(way.name) if isinstance(way, External) else None
            if ask is not None:
                for fact in facts_of(values, PyRosCall(ask, call, scope, roles(ask, call))):
                    if isinstance(fact, ServiceFact | ClientFact):
                        yield fact


def _routine(name: str) -> Routine | None:
    """What makes an end, by its full name: classes may be defined in modules further down."""
    first, last = name.split(".")[0], name.rpartition(".")[2]
    for known, (routine, _) in libraries.actions().items():
        if known.split(".")[0] == first and known.endswith(f".{last}"):
            return routine
    return None
