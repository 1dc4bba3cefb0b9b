"""Differences between two constructors, message servers or methods: parameters and body."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.roundtrip.diff.alignment import longest_increasing
from rebsync.roundtrip.diff.difference import (
    Added,
    Aspect,
    Changed,
    Depth,
    Difference,
    Element,
    Moved,
    Place,
    Removed,
    Renamed,
)
from rebsync.roundtrip.diff.locals import (
    Mapped,
    by_name,
    by_order,
    by_pairs,
    by_type,
    parameters_as_one,
)
from rebsync.roundtrip.diff.operands import Callable
from rebsync.roundtrip.diff.statements import BodyComparison
from rebsync.roundtrip.diff.tokens import Tokens

Both = tuple[Tokens, Tokens]
Places = tuple[Place | None, Place | None]
Parameters = list[tuple[m.Parameter, m.Parameter]]


def callable_differences(
    element: Element, left: Callable, right: Callable, tokens: Both, places: Places
) -> Iterator[Difference]:
    """The differences between two that are a pair."""
    pairs = _parameter_pairs(left, right, tokens)
    yield from _parameters(element, left, right, pairs, tokens)
    if (left.body is None) != (right.body is None):
        words = ("", "{...}") if left.body is None else ("{...}", "")
        yield Changed(element, Aspect.BODY, "", *words, *places)
        return
    yield from _BodyPair(element, left, right, tokens, places, pairs).differences()


# --- parameters ---------------------------------------------------------------------------------


def _parameter_pairs(left: Callable, right: Callable, tokens: Both) -> Parameters:
    """Parameters of one name, then of one type; as many others as there are left on both sides."""
    by_own_name = {p.name: p for p in right.parameters}
    pairs = [(p, by_own_name[p.name]) for p in left.parameters if p.name in by_own_name]
    lefts, rights = (
        [p for p in each.parameters if all(p is not pair[i] for pair in pairs)]
        for i, each in enumerate((left, right))
    )
    for p in list(lefts):
        wanted = tokens[0].of(p.type)
        same = next((r for r in rights if tokens[1].of(r.type) == wanted), None)
        if same is not None:
            lefts = [x for x in lefts if x is not p]
            rights = [r for r in rights if r is not same]
            pairs.append((p, same))
    if len(lefts) == len(rights):
        pairs += zip(lefts, rights, strict=True)
    return pairs


def _parameters(
    element: Element, left: Callable, right: Callable, pairs: Parameters, tokens: Both
) -> Iterator[Difference]:
    def named(parameter: m.Parameter) -> Element:
        return Element("parameter", f"{element.path}.{parameter.name}")

    def place(parameter: m.Parameter, at: int) -> Place | None:
        return tokens[at].side.place(parameter.name_span, parameter.span)

    own = [tokens[i].side.place(c.name_span, c.span) for i, c in enumerate((left, right))]
    order = {id(p): i for i, p in enumerate(right.parameters)}
    ordered = [next((r for x, r in pairs if x is p), None) for p in left.parameters]
    kept = longest_increasing([order[id(r)] for r in ordered if r is not None])
    for p, r in zip(left.parameters, ordered, strict=True):
        if r is None:
            yield Removed(named(p), place(p, 0), own[1])
            continue
        places = place(p, 0), place(r, 1)
        if p.name != r.name:
            yield Renamed(named(p), r.name, *places)
        types = str(tokens[0].of(p.type)), str(tokens[1].of(r.type))
        if types[0] != types[1]:
            yield Changed(named(p), Aspect.TYPE, "", *types, *places)
        if order[id(r)] not in kept:
            yield Moved(named(p), f"to number {order[id(r)] + 1}", *places)
    for p in right.parameters:
        if all(p is not r for _, r in pairs):
            yield Added(named(p), own[0], place(p, 1))


# --- bodies -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class _BodyPair:
    """Two bodies: compared with each way in which their locals may belong together."""

    element: Element
    left: Callable
    right: Callable
    tokens: Both
    places: Places
    parameters: Parameters

    def differences(self) -> list[Difference]:
        """The fewest differences that one of the ways gives."""
        if self.tokens[0].side.depth is Depth.IDENTICAL:
            return self._with(({}, {})).found
        if not self.left.body or not self.right.body:
            return []
        in_order = self._with(by_order(self.left.body, self.right.body))
        if not in_order.found:
            return []
        named = self._with(by_name(self.left.body, self.right.body))
        blind = self._with((by_type(self.left.body), by_type(self.right.body)))
        paired = self._with(by_pairs(self.left.body, self.right.body, blind.pairs))
        return min((named.found, paired.found, in_order.found), key=len)

    def _with(self, locals_: Mapped) -> BodyComparison:
        first, second = self._tokens(locals_)
        bodies = BodyComparison(self.element, first, second, self.places)
        lists = first.list_of(self.left.body), second.list_of(self.right.body)
        bodies.found = bodies.compare(*lists)
        return bodies

    def _tokens(self, locals_: Mapped) -> Both:
        given = parameters_as_one(self.left, self.right, self.parameters)
        first, second = (
            replace(tokens, locals={**own, **parameters}, origin={}, kept=[])
            for tokens, own, parameters in zip(self.tokens, locals_, given, strict=True)
        )
        return first, second
