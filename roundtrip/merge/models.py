"""Merges what model and code have changed since they were last in step, in the model's own text."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from enum import Enum

from rebsync import model as m
from rebsync.diagnostics import Edit, RebsyncError
from rebsync.edits import apply_edits
from rebsync.records import dataclass
from rebsync.roundtrip.diff.compare import compare
from rebsync.roundtrip.diff.difference import Comparison, Depth, Difference, Element, Undetermined
from rebsync.roundtrip.diff.equivalence import compare_with_code
from rebsync.roundtrip.diff.matching import matched
from rebsync.roundtrip.diff.operands import Item, SourcedModel, side, two_sides
from rebsync.roundtrip.merge.patch.elements import patched
from rebsync.roundtrip.package.models import parsed
from rebsync.roundtrip.verdict.drift import Drift, Mover, judge
from rebsync.source import NOWHERE, Source, Span


class Favour(Enum):
    """Whose side is taken where model and code have changed one element, each in its own way."""

    MARKERS = "markers"
    MODEL = "ours"
    CODE = "theirs"


class Compared:
    """Comparisons of models that are kept, as merging asks for one several times."""

    def __init__(self) -> None:
        self._known: dict[tuple[int, int], tuple[SourcedModel, SourcedModel, Comparison]] = {}

    def __call__(self, left: SourcedModel, right: SourcedModel) -> Comparison:
        """The comparison of two models, made once."""
        key = id(left), id(right)
        if key not in self._known:
            self._known[key] = left, right, compare(left, right)
        return self._known[key][2]


@dataclass(frozen=True, slots=True)
class MergedModel:
    """The text of a model with the changes of the code; `conflicts` tells what is left to decide.

    Where something is, `text` has both sides between conflict markers.
    """

    text: str
    conflicts: tuple[Difference, ...] = ()


def merged_model(
    base: SourcedModel | None,
    today: SourcedModel,
    code: SourcedModel,
    favour: Favour,
    compared: Callable[[SourcedModel, SourcedModel], Comparison] = compare,
) -> MergedModel:
    """Today's model with what the code has changed since `base`.

    Without a base it is not known who has changed what: then every difference is a conflict.
    RebsyncError: the two cannot be put together to a model.
    """
    drift = _judged(base, today, code, compared)
    told = [(d, mover) for d, mover in drift.differences if not isinstance(d, Undetermined)]
    movers: dict[Element, set[Mover]] = {}
    for difference, mover in told:
        movers.setdefault(whole(difference.element), set()).add(mover)
    mine = _with_code(today, code, movers, {Mover.CODE})
    open_ = [d for d, _ in told if _side_of(movers[whole(d.element)]) is Mover.CONFLICT]
    if not open_ or favour is Favour.MODEL:
        return MergedModel(mine)
    theirs = _with_code(today, code, movers, {Mover.CODE, Mover.CONFLICT})
    if favour is Favour.CODE:
        return MergedModel(theirs)
    from rebsync.roundtrip.merge.text import both_sides

    return MergedModel(both_sides(mine, theirs, "model", "code"), tuple(open_))


def as_code_says(today: SourcedModel, code: SourcedModel, comparison: Comparison) -> str:
    """The text of a model with everything as the code has it, as far as it could be read."""
    unknown = {d.element for d in comparison.differences if isinstance(d, Undetermined)}
    movers = {
        whole(d.element): {Mover.CODE} for d in comparison.differences if d.element not in unknown
    }
    return _with_code(today, code, movers, {Mover.CODE})


def _judged(
    base: SourcedModel | None,
    today: SourcedModel,
    code: SourcedModel,
    compared: Callable[[SourcedModel, SourcedModel], Comparison],
) -> Drift:
    found = compare_with_code(today, code, base, compared)
    return judge(found.apart, found.of_model, found.of_code)


def _side_of(movers: set[Mover]) -> Mover:
    """Whose an element is of which one or more things are different."""
    return next(iter(movers)) if movers in ({Mover.MODEL}, {Mover.CODE}) else Mover.CONFLICT


def whole(element: Element) -> Element:
    """What is merged as one: a parameter together with the body that it is of."""
    if element.kind != "parameter":
        return element
    return Element("callable", element.path.rpartition(".")[0])


_CALLABLE = frozenset({"constructor", "msgsrv", "method"})


def _with_code(
    today: SourcedModel, code: SourcedModel, movers: dict[Element, set[Mover]], taken: set[Mover]
) -> str:
    """The text of today's model with all elements as in the code that are on one of some sides."""
    parameters = {e.path: each for e, each in movers.items() if e.kind == "callable"}

    def of(item: Item, element: Element) -> set[Mover]:
        found = set(movers.get(element, ()))
        return found | parameters.get(element.path, set()) if item.kind in _CALLABLE else found

    sides: dict[tuple[str, str, tuple[str, ...]], Mover] = {}
    left, right = two_sides(today, code, Depth.EQUAL)
    pairs = matched(left, right)
    classes = {r.name: x.name for x, r in pairs.pairs if not r.owner}
    for x, r in pairs.pairs:
        if found := of(x, x.element):
            sides[_key(r)] = _side_of(found)
    for r in pairs.rights:
        owner = classes.get(r.owner, r.owner)
        path = f"{owner}.{r.name}" if owner and r.kind != "constructor" else r.name
        if found := of(r, Element(r.kind, path)):
            sides[_key(r)] = _side_of(found)
    gone = {_key(x): _side_of(found) for x in pairs.lefts if (found := of(x, x.element))}

    def wanted(x: Item | None, r: Item | None) -> bool:
        if r is not None:
            return sides.get(_key(r)) in taken
        return x is not None and gone.get(_key(x)) in taken

    renames = {
        _key(x): r.name
        for x, r in pairs.pairs
        if x.name != r.name and x.kind != "constructor" and sides.get(_key(r)) in taken
    }
    if renames:
        today = _renamed(today, renames)
        classes = {x.name: renames[_key(x)] for x, _ in pairs.pairs if _key(x) in renames}
        gone |= {
            (kind, _moved_path(path, classes), types): mover
            for (kind, path, types), mover in gone.items()
        }
    return patched(today, code, wanted)


def _moved_path(path: str, classes: dict[str, str]) -> str:
    head, dot, rest = path.partition(".")
    return f"{classes.get(head, head)}{dot}{rest}"


def _key(item: Item) -> tuple[str, str, tuple[str, ...]]:
    return item.kind, item.path, item.signature


# --- renaming -----------------------------------------------------------------------------------


def _renamed(
    today: SourcedModel, renames: dict[tuple[str, str, tuple[str, ...]], str]
) -> SourcedModel:
    """A model with elements renamed wherever they are named."""
    plain = side(today, Depth.IDENTICAL)
    names = {id(i.node): renames[_key(i)] for i in plain.items if _key(i) in renames}
    classes = {
        i.name: renames[_key(i)]
        for i in plain.items
        if _key(i) in renames and i.kind in ("reactiveclass", "interface")
    }
    edits = set(_uses(plain.model, plain.analysis.symbol_of, names, classes))
    text = apply_edits(today.source.text, edits)
    source = Source(today.source.path, text)
    return SourcedModel(parsed_again(source), source, today.unread)


def _uses(
    model: m.Model,
    symbol_of: Callable[[object], object],
    names: dict[int, str],
    classes: dict[str, str],
) -> Iterator[Edit]:
    for node in m.walk(model):
        declared = id(getattr(symbol_of(node), "declaration", None))
        name = names.get(id(node)) or names.get(declared)
        span: Span = getattr(node, "name_span", node.span if isinstance(node, m.Name) else NOWHERE)
        if name is not None and span != NOWHERE:
            yield Edit(span, name)
        match node:
            case m.Type(name=old) if old in classes:
                yield Edit(Span(node.span.start, node.span.start + len(old)), classes[old])
            case m.Constructor(name=old) if old in classes:
                yield Edit(node.name_span, classes[old])
            case m.ReactiveClass(extends=str(old)) if old in classes:
                yield Edit(node.extends_span, classes[old])
            case _:
                pass
        spans = getattr(node, "implements_spans", ()) or getattr(node, "extends_spans", ())
        olds = (
            node.implements
            if isinstance(node, m.ReactiveClass)
            else (node.extends if isinstance(node, m.Interface) else ())
        )
        for one, old in zip(spans, olds, strict=False):
            if old in classes:
                yield Edit(one, classes[old])


def parsed_again(source: Source) -> m.Model:
    """The tree of a text that was made of a model. RebsyncError: it is no model any more."""
    try:
        return parsed(source)
    except RebsyncError as error:
        found = error.findings[0].diagnostics[0]
        line = source.line(source.position(found.span.start).line).strip()
        message = "the changes of model and code cannot be put together"
        hint = f"it would say `{line}`: {found.message}"
        raise RebsyncError.of(source.path, "RS967", message, hint) from None
