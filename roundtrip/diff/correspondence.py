"""Which line of a model, and which place in the code, a line of an extracted model stands for."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync import model as m
from rebsync.printing import print_statement
from rebsync.records import dataclass
from rebsync.roundtrip.diff.alignment import aligned
from rebsync.roundtrip.diff.difference import Depth, Place
from rebsync.roundtrip.diff.matching import matched
from rebsync.roundtrip.diff.operands import Operand, SourcedModel, two_sides
from rebsync.roundtrip.diff.similarity import head_of
from rebsync.source import NOWHERE, Source, SourceSpan, Span

_Body = m.Constructor | m.MessageServer | m.Method


@dataclass(frozen=True, slots=True)
class Both:
    """The place in the model and the one in the code that are the same; None where it is not."""

    model: Place | None
    code: Place | None


def correspondence(
    printed: Source, parsed: m.Model, code: SourcedModel, today: SourcedModel
) -> dict[int, Both]:
    """For lines of the printed text of an extracted model, both places that they stand for.

    `parsed` is the tree of that text, `code` the extracted model, `today` that of the user.
    """
    places = dict(code_places(printed, parsed, code.model))
    partners = _partners(today, code)
    return {line: Both(partners.get(_key(p)), p) for line, p in places.items()}


def _key(place: Place) -> tuple[str, int]:
    return place.source.path, place.span.start


def code_places(printed: Source, parsed: m.Model, model: m.Model) -> Iterator[tuple[int, Place]]:
    """By the lines of the printed text of a model the first place in the code of what begins there.

    `parsed` is the tree of that text; the spans of `model` are places in the code.
    """
    seen: set[int] = set()
    for shown, read in zip(m.walk(parsed), m.walk(model), strict=False):
        if type(shown) is not type(read):
            return
        line = printed.position(_span(shown).start).line
        span = _span(read)
        if line not in seen and isinstance(span, SourceSpan) and _begins(shown):
            seen.add(line)
            yield line, Place(span.source, span)


def _begins(node: m.Node) -> bool:
    """Whether a run may be at this node: a body, or a statement."""
    return isinstance(node, _Body | m.ReactiveClass | m.Statement)


def _span(node: m.Node) -> Span:
    name: Span = getattr(node, "name_span", NOWHERE)
    return name if name != NOWHERE else node.span


def _partners(today: SourcedModel, code: SourcedModel) -> dict[tuple[str, int], Place]:
    """For places in the code those in the model that say the same."""
    left, right = two_sides(today, code, Depth.EQUAL)
    found: dict[tuple[str, int], Place] = {}
    for x, r in matched(left, right).pairs:
        _note(found, left, right, x.node, r.node)
        if isinstance(x.node, _Body) and isinstance(r.node, _Body):
            ours, theirs = (list(_statements(n.body)) for n in (x.node, r.node))
            for one, other in aligned(ours, theirs, _similarity):
                if one is not None and other is not None:
                    _note(found, left, right, one.statement, other.statement)
    return found


def _note(
    found: dict[tuple[str, int], Place], left: Operand, right: Operand, one: m.Node, other: m.Node
) -> None:
    here, there = left.place(_span(one)), right.place(_span(other))
    if here is not None and there is not None:
        found.setdefault(_key(there), here)


@dataclass(frozen=True, slots=True)
class _Step:
    """A statement of a body by what it says itself, whatever is in it."""

    text: str
    statement: m.Statement

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Step) and self.text == other.text

    def __hash__(self) -> int:
        return hash(self.text)


def _statements(body: m.Block | None) -> Iterator[_Step]:
    """All statements of a body in the order of the text."""
    for node in m.walk(body) if body is not None else ():
        if isinstance(node, m.Statement) and not isinstance(node, m.Block):
            yield _Step(_head(node), node)


def _head(statement: m.Statement) -> str:
    text = print_statement(head_of(statement))
    return f"if {text}" if isinstance(statement, m.If) else text


def _similarity(one: _Step, other: _Step) -> float:
    return 0.6 if type(one.statement) is type(other.statement) else 0.0
