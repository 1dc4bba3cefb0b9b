"""Facts of the code as ends and parameters of a node."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeVar

from rebsync.reverse.graph import (
    ClientFact,
    Fact,
    OneOf,
    ParameterFact,
    Place,
    PublisherFact,
    Resolved,
    ServiceFact,
    SubscriptionFact,
    Unmodelled,
    UnmodelledFact,
)
from rebsync.reverse.policies import NOT_KNOWN, Policies
from rebsync.rosgraph.ends import End, ParameterUse, Role

T = TypeVar("T")

_TRANSFORMS = "tf2_msgs/TFMessage"

# What a call is given whose policies may be set by parameters.
_OVERRIDING = ("qos_overriding_options", "QosOverridingOptions")


def end_of(fact: Fact) -> End | None:
    """The end that a fact asks for, if it does."""
    site = fact.site
    match fact:
        case PublisherFact(_, topic, type_):
            role, name = Role.PUBLISHER, topic
        case SubscriptionFact(_, topic, type_):
            role, name = Role.SUBSCRIPTION, topic
        case ServiceFact(_, service, type_):
            role, name = Role.SERVER, service
        case ClientFact(_, service, type_):
            role, name = Role.CLIENT, service
        case _:
            return None
    policies = _policies(fact)
    transport = fact.transport if isinstance(fact, PublisherFact | SubscriptionFact) else None
    return End(role, name, type_, site.place, site.owner, policies, transport)


def _policies(fact: Fact) -> Policies | None:
    if not isinstance(fact, PublisherFact | SubscriptionFact) or fact.policies is None:
        return None
    text = fact.site.place.source.text
    return NOT_KNOWN if any(word in text for word in _OVERRIDING) else fact.policies


def ends_of_unmodelled(fact: UnmodelledFact, is_flat: bool) -> Iterator[End]:
    """The ends of what has no place in a model: of actions, and of the topics of transforms.

    Messages with transforms are, in ROS 1 (not `is_flat`), of one of two types that are the same.
    """
    place, owner = fact.site.place, fact.site.owner
    type_: Resolved = _TRANSFORMS if is_flat else OneOf((_TRANSFORMS, "tf/tfMessage"))
    match fact.what:
        case Unmodelled.ACTION_SERVER | Unmodelled.ACTION_CLIENT:
            if fact.name is not None and fact.type is not None:
                yield End(Role(fact.what.value), fact.name, fact.type, place, owner)
        case Unmodelled.BROADCASTER:
            yield End(Role.PUBLISHER, "/tf", type_, place, owner)
        case Unmodelled.STATIC_BROADCASTER:
            yield End(Role.PUBLISHER, "/tf_static", type_, place, owner)
        case Unmodelled.LISTENER:
            for topic in ("/tf", "/tf_static"):
                yield End(Role.SUBSCRIPTION, topic, type_, place, owner)
        case _:
            return


def parameter_of(fact: Fact) -> ParameterUse | None:
    """The parameter that a fact has to do with, if it does."""
    if not isinstance(fact, ParameterFact):
        return None
    return ParameterUse(fact.name, fact.access, fact.site.place)


def first_place(ends: Sequence[End], uses: Sequence[ParameterUse]) -> Place:
    """Where the first of several ends stands, or else the first parameter."""
    return ends[0].place if ends else uses[0].place


def distinct(items: Iterable[T]) -> Iterator[T]:
    """Each item once, the order kept; items need only be comparable."""
    found: list[T] = []
    for item in items:
        if item not in found:
            found.append(item)
            yield item
