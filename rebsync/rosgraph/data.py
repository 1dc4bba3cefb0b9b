"""The graph for other programs: docs/graph.schema.json describes it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

from rebsync.codes import CODES
from rebsync.reverse.graph import Place
from rebsync.reverse.graph_json import policies_data
from rebsync.rosgraph.findings import GraphFinding
from rebsync.rosgraph.picture import Box, Mark, Picture, Wire

Json: TypeAlias = dict[str, Any]


def graph_data(picture: Picture, findings: Sequence[GraphFinding]) -> Json:
    """The boxes, the wires and the findings; boxes are named by their numbers."""
    ids = {box.key: number for number, box in enumerate(picture.boxes)}
    return {
        "version": 1,
        "title": picture.title,
        "boxes": [_box(box, ids[box.key]) for box in picture.boxes],
        "wires": [_wire(wire, ids) for wire in picture.wires],
        "findings": [_finding(finding) for finding in findings],
    }


def _box(box: Box, number: int) -> Json:
    return {
        "id": number,
        "kind": box.kind.value,
        "name": box.name,
        "package": box.package or None,
        "namespace": box.namespace or None,
        "label": box.label or None,
        "types": list(box.types),
        "note": box.note or None,
        "place": _place(box.place),
        **_mark(box.mark),
    }


def _wire(wire: Wire, ids: dict[str, int]) -> Json:
    qos: Json = {} if wire.policies is None else {"qos": policies_data(wire.policies)}
    return {
        "from": ids[wire.source],
        "to": ids[wire.target],
        "role": wire.role.value,
        "types": list(wire.types),
        "certain": wire.certain,
        "place": _place(wire.place),
        **qos,
        **_mark(wire.mark),
    }


def _mark(mark: Mark) -> Json:
    return {} if mark is Mark.SAME else {"change": mark.value}


def _place(place: Place | None) -> Json | None:
    """File and line, and the text of the line."""
    if place is None:
        return None
    text = place.source.line(place.line).strip()
    return {"file": place.source.path, "line": place.line, "text": text[:_LONGEST]}


_LONGEST = 300


def _finding(finding: GraphFinding) -> Json:
    return {
        "code": finding.code,
        "title": CODES[finding.code],
        "severity": finding.severity.value,
        "message": finding.message,
        "hint": finding.hint,
        "place": _place(finding.place),
        "others": [{"what": what, "place": _place(place)} for place, what in finding.others],
    }
