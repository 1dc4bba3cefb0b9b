"""Whether two models have one normal form, which is told much sooner than how they differ."""

from __future__ import annotations

from rebsync import model as m
from rebsync.roundtrip.diff.normal_form import normal_class, normal_frame
from rebsync.roundtrip.diff.operands import SourcedModel, is_unreadable


def are_same(left: SourcedModel, right: SourcedModel) -> bool:
    """Whether two models that are known in full have one normal form; False too if that is hard."""
    if left.unread or right.unread or left.partial or right.partial:
        return False
    try:
        return _classes_are_same(left.model, right.model) and _is_frame_same(
            left.model, right.model
        )
    except RecursionError:
        return False  # the comparison tells of what nests too deeply


def _classes_are_same(left: m.Model, right: m.Model) -> bool:
    if len(left.classes) != len(right.classes):
        return False
    firsts, seconds = (sorted(x.classes, key=lambda c: c.name) for x in (left, right))
    pairs = zip(firsts, seconds, strict=True)
    return all(x == r or normal_class(x) == normal_class(r) for x, r in pairs) and not any(
        is_unreadable(node) for each in firsts for node in m.walk(each)
    )


def _is_frame_same(left: m.Model, right: m.Model) -> bool:
    if (left.heads, left.main) == (right.heads, right.main):
        return True
    return normal_frame(left) == normal_frame(right)
