"""Bodies that the code writes otherwise than the model, and that are proved to do the same."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from rebsync import model as m
from rebsync.diagnostics import Diagnostic, Findings, Severity
from rebsync.printing import print_line
from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import (
    Added,
    Aspect,
    Changed,
    Comparison,
    Depth,
    Difference,
    Element,
    Place,
    Removed,
    StatementInserted,
    StatementMoved,
    StatementRemoved,
)
from rebsync.roundtrip.diff.invariants import invariants_of
from rebsync.roundtrip.diff.normal_form import rewrite
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.static import Analysis, analyse

if TYPE_CHECKING:
    from rebsync.checker.symbolic.equivalence import Invariants, Proof

_OF_STATEMENTS = (Aspect.DELAY, Aspect.EXPRESSION, Aspect.PERIOD)  # with no name of a part
_BODIES = ("msgsrv", "method", "constructor")


_MOVED = "\0move"  # what a move is sent to; no server of a model has this name


class _NotMarked(Exception):
    """A statement has an annotation whose place in a run cannot be told."""


def without_equivalent(
    apart: Comparison, left: SourcedModel, right: SourcedModel, depth: Depth = Depth.EQUAL
) -> tuple[Comparison, Comparison]:
    """What is different between two models, and apart from it what is so in writing only.

    That is what is different in bodies that are proved to do the same. Nothing is, unless all
    differences are in bodies: a proof of bodies takes for granted that variables, servers,
    constants and rebecs are the same.
    """
    proved = _proved_elements(apart, left, right) if depth is Depth.EQUAL else frozenset()
    same = tuple(d for d in apart.differences if d.element in proved)
    rest = tuple(d for d in apart.differences if d.element not in proved)
    return Comparison(rest), Comparison(same)


def _proved_elements(
    apart: Comparison, left: SourcedModel, right: SourcedModel
) -> frozenset[Element]:
    """The elements of differences that only are written otherwise."""
    if apart.is_empty or not all(map(_is_of_a_body, apart.differences)):
        return frozenset()
    if left.partial or right.partial or left.unread or right.unread:
        return frozenset()
    try:
        first, second = _marked(left.model), _marked(right.model)
    except _NotMarked:
        return frozenset()
    if not (_can_run(first) and _can_run(second)):
        return frozenset()
    lines = {
        name: info.lineage
        for name, info in first.classes.items()
        if not getattr(info.declaration, "abstract", True)
    }
    proved = _proved(apart.elements, _proofs(first, second, {}), lines)
    if proved != apart.elements:
        # Bounds that the left side keeps, the right one does if nothing is left that is different.
        bounds = invariants_of(first, {e.group for e in apart.elements})
        bounded = _proved(apart.elements, _proofs(first, second, bounds), lines)
        proved = bounded if bounded == apart.elements else proved
    return proved


def _proved(
    elements: Iterable[Element], known: Sequence[Proof], lines: Mapping[str, Collection[str]]
) -> frozenset[Element]:
    return frozenset(e for e in elements if _is_proved(e, known, lines))


def _proofs(left: Analysis, right: Analysis, invariants: Invariants) -> tuple[Proof, ...]:
    from rebsync.checker.lowering import lower

    try:
        from rebsync.checker.symbolic.equivalence import proofs
    except ImportError:  # z3 is not for every processor
        return ()
    return tuple(proofs(lower(left)[0], lower(right)[0], invariants))


def _is_proved(
    element: Element, known: Sequence[Proof], lines: Mapping[str, Collection[str]]
) -> bool:
    """Whether all that run a body, or a method, do the same; somebody must be there to run it."""
    _, _, name = element.path.partition(".")
    running = [proof for proof in known if element.group in lines[proof.class_name]]
    heirs = {name for name, line in lines.items() if element.group in line}
    if heirs - {proof.class_name for proof in running}:
        return False  # nothing runs one of them here
    if element.kind == "method":
        return bool(running) and all(p.is_alike for p in running if name in p.methods)
    own = [proof for proof in running if proof.server == name]
    return bool(own) and all(proof.is_alike for proof in own)


def _is_of_a_body(difference: Difference) -> bool:
    """Whether it is about statements, or about methods: these have no meaning but in bodies."""
    if difference.element.kind not in _BODIES:
        return False
    match difference:
        case StatementInserted() | StatementRemoved() | StatementMoved():
            return True
        case Changed(aspect=Aspect.ANNOTATION, old=old, new=new):
            return all(note.startswith("@Move(") for note in (old, new))  # of a statement
        case Changed(aspect=aspect, of=of):
            return aspect in _OF_STATEMENTS or bool(of)
        case Added() | Removed():
            return difference.element.kind == "method"
        case _:
            return False


def _can_run(analysis: Analysis) -> bool:
    from rebsync.checker.sizes import check_sizes

    return analysis.model.main is not None and not (analysis.errors or check_sizes(analysis))


def _marked(model: m.Model) -> Analysis:
    """The model with something that a run does in the place of each annotation of a statement.

    A move is a message with its cells, as these may depend on variables; anything else is an
    assertion that holds.
    """
    return analyse(rewrite(model, _mark))


def _mark(node: object) -> object:
    match node:
        case m.ReactiveClass(members=members, extends=None):
            return replace(node, members=(*members, _moved()))
        case m.Empty(annotations=(m.Annotation("Move", (x, y)),)):
            cells = _offset(x, "X"), _offset(y, "Y")
            return m.ExpressionStatement(m.Call(m.Self(), _MOVED, cells))
        case m.Empty(annotations=notes) if notes:
            if not all(map(_is_fixed, notes)):
                raise _NotMarked
            text = " ".join(print_line(note).strip() for note in notes)
            told = m.StringLiteral(f'"\0{text}"')  # no text of a model has this
            return m.ExpressionStatement(m.Call(None, "assertion", (m.BoolLiteral(True), told)))
        case (
            m.Block()
            | m.ExpressionStatement()
            | m.If()
            | m.While()
            | m.For()
            | m.Case()
            | m.Switch()
            | m.Return()
            | m.Break()
            | m.Continue()
            | m.Local()
        ) if node.annotations:
            raise _NotMarked
        case m.Local(declaration) if declaration.annotations:
            raise _NotMarked
        case _:
            return node


@dataclass(frozen=True, slots=True)
class ThreeWay:
    """How today's model, the code and the model of last time stand to each other.

    `of_model` and `of_code` are what each has changed since then, None where that is not known.
    What the code only writes otherwise is no difference, but `written`.
    """

    apart: Comparison
    of_model: Comparison | None
    of_code: Comparison | None
    written: Comparison


def compare_with_code(
    today: SourcedModel,
    code: SourcedModel,
    base: SourcedModel | None,
    compared: Callable[[SourcedModel, SourcedModel], Comparison],
    depth: Depth = Depth.EQUAL,
) -> ThreeWay:
    """Compares the three; `base` is the model of last time, which may be today's."""
    apart, written = without_equivalent(compared(today, code), today, code, depth)
    if base is None:
        return ThreeWay(apart, None, None, written)
    if base is today:
        return ThreeWay(apart, Comparison(()), apart, written)
    since = compared(base, code)
    of_code, same = without_equivalent(since, base, code, depth)
    if same.elements & apart.elements:
        of_code = since  # the model has changed what the code writes otherwise
    return ThreeWay(apart, compared(base, today), of_code, written)


def _moved() -> m.MessageServer:
    axes = tuple(m.Parameter(m.Type("int"), axis) for axis in ("x", "y"))
    return m.MessageServer(_MOVED, axes, m.Block(()))


def _offset(cell: m.Expression, axis: str) -> m.Expression:
    """How far a move goes along an axis."""
    match cell:
        case m.Paren(inner):
            return _offset(inner, axis)
        case m.Name(name) if name == axis:
            return m.IntLiteral(0)
        case m.Binary("+", m.Name(name), by) if name == axis:
            return by
        case m.Binary("-", m.Name(name), by) if name == axis:
            return m.Unary("-", m.Paren(by))
        case _:
            raise _NotMarked


def _is_fixed(note: m.Annotation) -> bool:
    """Whether an annotation names nothing: what others hold is not in its text."""
    return not any(isinstance(n, m.Name | m.Member | m.Index | m.Call) for n in m.walk(note))


def told(same: Comparison) -> tuple[Findings, ...]:
    """A note for each body that the code writes otherwise."""
    found: dict[str, Findings] = {}
    for difference in same.differences:
        place = difference.right
        if place is not None and str(difference.element) not in found:
            found[str(difference.element)] = _note(str(difference.element), place)
    return tuple(found.values())


def _note(element: str, place: Place) -> Findings:
    message = f"{element} is written otherwise than in the model, and does the same"
    note = Diagnostic("RS970", place.span, message, severity=Severity.NOTE)
    return Findings(place.source, (note,))
