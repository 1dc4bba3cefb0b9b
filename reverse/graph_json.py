"""The package value as read, for other programs: what `rebsync extract --format json` prints.

Values stand as in the facts of `tests/reverse/corpus`: plain ones as they are, others as objects
that say on what they depend. docs/extract.schema.json describes them.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite
from typing import TypeAlias

from rebsync.reverse.graph import (
    Callback,
    Callbacks,
    ClientFact,
    Fact,
    FromParameter,
    Graph,
    NodeFact,
    OneOf,
    ParameterFact,
    Place,
    PublisherFact,
    RateFact,
    Resolved,
    ServiceFact,
    Site,
    SubscriptionFact,
    TimerFact,
    Under,
    Unmodelled,
    UnmodelledFact,
    Unresolved,
)
from rebsync.reverse.policies import FOR_EVER, Period, Policies

Data: TypeAlias = "bool | int | float | str | list[Data] | dict[str, Data] | None"
Item: TypeAlias = "dict[str, Data]"

LISTS = {
    NodeFact: "nodes",
    PublisherFact: "publishers",
    SubscriptionFact: "subscriptions",
    TimerFact: "timers",
    RateFact: "rates",
    ParameterFact: "parameters",
    ServiceFact: "services",
    ClientFact: "clients",
}
BESIDES = {
    Unmodelled.ACTION_SERVER: "action_servers",
    Unmodelled.ACTION_CLIENT: "action_clients",
    **dict.fromkeys(
        (Unmodelled.BROADCASTER, Unmodelled.STATIC_BROADCASTER, Unmodelled.LISTENER), "transforms"
    ),
    **dict.fromkeys((Unmodelled.CONFIGURED, Unmodelled.CONFIGURING), "reconfigurations"),
}


def graph_data(graph: Graph) -> dict[str, list[Item]]:
    """The facts by their kinds, and `unknowns`: every value that the code alone does not tell."""
    lists: dict[str, list[Item]] = {name: [] for name in LISTS.values()}
    lists |= {name: [] for name in BESIDES.values()}
    unknowns: list[Item] = []
    listed = [(LISTS[type(fact)], fact_data(fact)) for fact in graph.facts]
    listed += [(BESIDES[u.what], unmodelled_data(u)) for u in graph.unmodelled]
    for name, item in listed:
        lists[name].append(item)
        for key, value in item.items():
            for unknown in _unknowns_in(value):
                call: Item = {"file": item["file"], "line": item["line"]}
                unknowns.append({"of": name, "key": key, "call": call, **unknown})
    return {**lists, "unknowns": unknowns}


def _unknowns_in(value: Data) -> Iterator[Item]:
    match value:
        case dict() if "unknown" in value:
            yield value
        case dict():
            for inner in value.values():
                yield from _unknowns_in(inner)
        case list():
            for inner in value:
                yield from _unknowns_in(inner)


# --- facts --------------------------------------------------------------------------------------


def fact_data(fact: Fact) -> Item:
    """One fact with its place; keys that say nothing are left out where a fact seldom has them."""
    return {**_site(fact.site), **_own(fact)}


def unmodelled_data(fact: UnmodelledFact) -> Item:
    """What has no place in a model, with its place; its role where a list has several."""
    item = _site(fact.site)
    if BESIDES[fact.what].startswith("action"):
        return {**item, "name": _optional(fact.name), "type": _optional(fact.type)}
    item["role"] = fact.what.value
    if BESIDES[fact.what] == "reconfigurations":
        item |= {"name": _optional(fact.name), "config": _optional(fact.type)}
    return item


def _optional(value: Resolved | None) -> Data:
    return None if value is None else value_data(value)


def _site(site: Site) -> Item:
    item: Item = {**place_data(site.place), "within": site.owner}
    if site.kept:
        item["kept"] = site.kept
    return item


def _own(fact: Fact) -> Item:
    match fact:
        case NodeFact(_, name, anonymous, nodelet):
            return {
                "name": None if name is None else value_data(name),
                "anonymous": anonymous,
                "nodelet": nodelet,
            }
        case PublisherFact() | SubscriptionFact():
            return _channel(fact)
        case TimerFact(_, period, one_shot, callbacks, autostart, wall):
            return {
                "period": value_data(period),
                "one_shot": value_data(one_shot),
                "callback": _called(callbacks),
                "autostart": value_data(autostart),
                "wall": wall,
            }
        case RateFact(_, hz, wall):
            return {"hz": value_data(hz), "wall": wall}
        case ParameterFact():
            return _parameter(fact)
        case ServiceFact(_, name, type_, callbacks):
            callback = _called(callbacks)
            return {"name": value_data(name), "type": value_data(type_), "callback": callback}
        case ClientFact(_, name, type_):
            return {"name": value_data(name), "type": value_data(type_)}


def _channel(fact: PublisherFact | SubscriptionFact) -> Item:
    item: Item = {
        "topic": value_data(fact.topic),
        "type": value_data(fact.type),
        "depth": value_data(fact.depth),
    }
    if isinstance(fact, PublisherFact):
        item["latched"] = value_data(fact.latched)
    else:
        item |= {"callback": _called(fact.callbacks), "single": fact.single}
    if fact.transport is not None:
        item["transport"] = fact.transport
    if fact.policies is not None:
        item["qos"] = policies_data(fact.policies)
    return item


def policies_data(policies: Policies) -> Item:
    """The policies of a quality of service; null for a period that never ends."""
    return {
        "reliability": policies.reliability,
        "durability": policies.durability,
        "liveliness": policies.liveliness,
        "deadline": _period(policies.deadline),
        "lease": _period(policies.lease),
    }


def _period(period: Period) -> Data:
    return None if period == FOR_EVER else period


def _parameter(fact: ParameterFact) -> Item:
    item: Item = {
        "name": value_data(fact.name),
        "access": fact.access.value,
        "default": None if fact.default is None else value_data(fact.default),
    }
    if fact.value is not None:
        item["value"] = value_data(fact.value)
    if fact.search:
        item["search"] = True
    return item


# --- values -------------------------------------------------------------------------------------


def value_data(value: Resolved) -> Data:
    """A value as it is, or an object that says on what it depends or why it is not known."""
    match value:
        case FromParameter():
            return _from_parameter(value)
        case OneOf(values):
            return {"one_of": [value_data(v) for v in values]}
        case Under(name, handles):
            return {"relative": name, "handle": list(handles)}
        case Unresolved():
            return _unknown(value)
        case tuple():
            return [value_data(v) for v in value]
        case float() if not isfinite(value):
            return str(value)
        case _:
            return value


def _from_parameter(value: FromParameter) -> Item:
    item: Item = {"parameter": value_data(value.name)}
    if value.default is not None:
        item["default"] = value_data(value.default)
    if any(value.within):
        within = value.within
        item["in"] = within[0] if len(within) == 1 else list(within)
    if value.expression is not None:
        item["expression"] = value.expression
    if value.search:
        item["search"] = True
    return item


def _unknown(value: Unresolved) -> Item:
    partial: Item = {} if value.partial is None else {"partial": value.partial}
    return {"unknown": value.why, **partial, **place_data(value.place)}


def _called(callbacks: Callbacks) -> Data:
    """What is called: nothing for a call that waits, `one_of` where it is chosen at run time."""
    called: list[Data] = [
        _unknown(c) if isinstance(c, Unresolved) else _callback(c) for c in callbacks
    ]
    if len(called) > 1:
        return {"one_of": called}
    return called[0] if called else None


def _callback(callback: Callback) -> Item:
    """A function with its place; null for a lambda, which stands at the place itself."""
    item: Item = {"function": callback.name or None, **place_data(callback.place)}
    if callback.through is not None:
        item["through"] = callback.through
    return item


def place_data(place: Place) -> Item:
    """The file and the line, the first being 1."""
    return {"file": place.source.path, "line": place.line}
