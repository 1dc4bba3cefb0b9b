"""Classes of which something is unreadable that stands in none of their bodies."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from rebsync import model as m
from rebsync.reverse.findings import Finding, Grade
from rebsync.statements import UNREADABLE


def marked_lacking(owner: m.ReactiveClass, findings: Iterable[Finding]) -> m.ReactiveClass:
    """The class, with `@Unreadable;` in its constructor where a place outside of bodies is listed.

    What the model is printed to then says of itself that it says less than the code does.
    """
    if not any(f.grade is Grade.UNREADABLE and f.within == owner.name for f in findings):
        return owner
    lacking = m.Empty((m.Annotation(UNREADABLE),))
    members = tuple(
        replace(c, body=replace(c.body, statements=(lacking, *c.body.statements)))
        if isinstance(c, m.Constructor) and c.body is not None
        else c
        for c in owner.members
    )
    return replace(owner, members=members)
