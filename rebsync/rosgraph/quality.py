"""Which offered qualities of service a requested one takes.

The rules are those of the OMG's Data Distribution Service (version 1.4, section 2.2.3), as the
article "About Quality of Service settings" of the documentation of ROS 2 has them in tables.
"""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.policies import Period, Policies

# By policy, what is offered and requested where the two do not fit.
_UNFIT = {
    "reliability": ("best_effort", "reliable"),
    "durability": ("volatile", "transient_local"),
    "liveliness": ("automatic", "manual_by_topic"),
}


def misfits(offered: Policies, requested: Policies) -> Iterator[str]:
    """Why a publisher and a subscription do not match, one text for each policy.

    A policy that is not known, or that the middleware chooses, may fit.
    """
    for name, unfit in _UNFIT.items():
        if (getattr(offered, name), getattr(requested, name)) == unfit:
            yield f"the {name} that is offered is {unfit[0]}, and {unfit[1]} is requested"
    if _is_longer(offered.deadline, requested.deadline):
        yield f"the deadline that is offered is {_said(offered.deadline)}, and " + (
            f"{_said(requested.deadline)} is requested"
        )
    if _is_longer(offered.lease, requested.lease):
        yield f"the lease of the liveliness that is offered is {_said(offered.lease)}, and " + (
            f"{_said(requested.lease)} is requested"
        )


def _is_longer(offered: Period, requested: Period) -> bool:
    if isinstance(offered, str) or isinstance(requested, str):
        return False
    return offered > requested


def _said(period: Period) -> str:
    if isinstance(period, str):
        return period
    return "without bound" if period == float("inf") else f"{period:g} s"
