"""The policies of a quality of service that must fit for a publisher to reach a subscription.

DDS calls them requested and offered; the table of what fits is in the design article of ROS 2 on
quality of service. Depth and lifespan concern one end alone, and are not among them.
"""

from __future__ import annotations

import re
from typing import TypeAlias

from rebsync.records import dataclass

UNKNOWN = "unknown"
FOR_EVER = float("inf")
# Seconds, or `unknown`.
Period: TypeAlias = "float | str"

_PREFIX = re.compile(r"RMW_QOS_POLICY_(?:RELIABILITY|DURABILITY|LIVELINESS)_")
_HUMP = re.compile(r"(?<=[a-z])(?=[A-Z])")
_WORDS = frozenset(
    {
        *("reliable", "best_effort", "volatile", "transient_local", "automatic"),
        *("manual_by_topic", "system_default", "best_available"),
    }
)


@dataclass(frozen=True, slots=True)
class Policies:
    """Policies by their names in ROS 2; `unknown` is one that the code does not tell.

    `system_default` and `best_available` depend on the middleware and on the other end.
    `deadline` and `lease`, that of the liveliness, are in seconds.
    """

    reliability: str = "reliable"
    durability: str = "volatile"
    liveliness: str = "automatic"
    deadline: Period = FOR_EVER
    lease: Period = FOR_EVER


USUAL = Policies()
NOT_KNOWN = Policies(UNKNOWN, UNKNOWN, UNKNOWN, UNKNOWN, UNKNOWN)


def policy_of(text: str) -> str:
    """The policy that an enumerator of any client library stands for, else `unknown`."""
    name = re.split(r"::|\.", text.removesuffix(".value"))[-1]
    word = _HUMP.sub("_", _PREFIX.sub("", name)).lower()
    return word if word in _WORDS else UNKNOWN


def either(found: Policies, other: Policies) -> Policies:
    """What is known of a quality that is one of two."""
    return Policies(
        found.reliability if found.reliability == other.reliability else UNKNOWN,
        found.durability if found.durability == other.durability else UNKNOWN,
        found.liveliness if found.liveliness == other.liveliness else UNKNOWN,
        found.deadline if found.deadline == other.deadline else UNKNOWN,
        found.lease if found.lease == other.lease else UNKNOWN,
    )
