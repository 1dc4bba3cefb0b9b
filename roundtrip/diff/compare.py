"""Compares two models: the differences, each with its element and both places."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import field

from rebsync import model as m
from rebsync.printing import print_expression, print_line, print_statement
from rebsync.records import dataclass
from rebsync.roundtrip.diff.alignment import longest_increasing
from rebsync.roundtrip.diff.callables import callable_differences
from rebsync.roundtrip.diff.difference import (
    Added,
    Aspect,
    Changed,
    Comparison,
    Depth,
    Difference,
    Element,
    Moved,
    Place,
    Removed,
    Renamed,
    Undetermined,
)
from rebsync.roundtrip.diff.matching import Matching, Pair, matched, names_of
from rebsync.roundtrip.diff.normal_form import normal_class, normal_frame
from rebsync.roundtrip.diff.operands import (
    Item,
    Operand,
    SourcedModel,
    UnreadPlace,
    is_unreadable,
    too_deep,
    two_sides,
)
from rebsync.roundtrip.diff.tokens import Tokens
from rebsync.source import SourceSpan

_SYSTEM = ("env", "rebec")
_CLASSES = ("reactiveclass", "interface")
_BODIES = ("msgsrv", "method", "constructor")
_SECTIONS = {m.KnownRebecs: "knownrebecs", m.StateVars: "statevars"}


def compare(left: SourcedModel, right: SourcedModel, depth: Depth = Depth.EQUAL) -> Comparison:
    """The differences between two models at some depth.

    RebsyncError: something in a model nests too deeply.
    """
    if depth is Depth.EQUAL and _are_same(left, right):
        return Comparison(())
    return compare_in_full(left, right, depth)


def compare_in_full(
    left: SourcedModel, right: SourcedModel, depth: Depth = Depth.EQUAL
) -> Comparison:
    """The same, looked for even where both are plainly the same."""
    both = two_sides(left, right, depth)
    try:
        return Comparison(tuple(_Comparing.of(*both).all()))
    except RecursionError:
        raise too_deep(left) from None


@dataclass(slots=True, eq=False)
class _Comparing:
    left: Operand
    right: Operand
    matching: Matching
    tokens: tuple[Tokens, Tokens]
    partners: dict[int, Item] = field(default_factory=dict)

    @classmethod
    def of(cls, left: Operand, right: Operand) -> _Comparing:
        matching = matched(left, right)
        first, second = names_of(matching)
        tokens = Tokens(left, first), Tokens(right, second)
        partners = {id(x): r for x, r in matching.pairs}
        return cls(left, right, matching, tokens, partners)

    def all(self) -> Iterator[Difference]:
        """All differences: those of elements in the order of the left side, then what is new."""
        found: list[Difference] = []
        for item in self.left.items:
            partner = self.partners.get(id(item))
            if partner is not None:
                found += self._pair(item, partner)
            elif self._counts(item, self.right):
                found.append(self._removed(item))
        for item in self.matching.rights:
            if self._counts(item, self.left) and not self._is_unused(item):
                found.append(self._added(item))
        if self.left.depth is Depth.IDENTICAL:
            found += self._orders()
            found += self._sections() if not found else ()
        found += self._unread(found)
        yield from _grouped(found, self.left)

    # --- elements of one side -------------------------------------------------------------------

    def _counts(self, item: Item, other: Operand) -> bool:
        """Whether it tells something that the other side does not have this element.

        A class that is there or not says everything about its members.
        """
        own = self.matching.lefts if other is self.right else self.matching.rights
        if item.owner and any(i.name == item.owner and i.kind in _CLASSES for i in own):
            return False
        return not (other.given.partial and item.kind in (*_SYSTEM, *_CLASSES))

    def _is_unused(self, item: Item) -> bool:
        """Whether it is a function of the code that nothing calls, and nothing can override."""
        if not isinstance(item.node, m.Method) or self.right.depth is not Depth.EQUAL:
            return False
        if item.node.abstract or not isinstance(item.node.span, SourceSpan):
            return False
        same = [i for i in self.right.items if i.kind in _BODIES and i.name == item.name]
        calls = (n for n in m.walk(self.right.model) if isinstance(n, m.Call))
        return len(same) == 1 and all(call.name != item.name for call in calls)

    def _removed(self, item: Item) -> Removed:
        owner = self._item(self.left, item.owner)
        partner = self.partners.get(id(owner)) if owner is not None else None
        right = self.right.place_of(partner) if partner is not None else self.right.whole
        return Removed(item.element, self.left.place_of(item), right)

    def _added(self, item: Item) -> Added:
        owner = self._item(self.right, item.owner)
        partner = next((x for x, r in self.matching.pairs if r is owner), None)
        left = self.left.place_of(partner) if partner is not None else self.left.whole
        name = f"{partner.name}.{item.name}" if partner is not None else item.path
        path = name if item.kind != "constructor" else item.name
        return Added(Element(item.kind, path), left, self.right.place_of(item))

    def _item(self, of: Operand, name: str) -> Item | None:
        return next((i for i in of.items if i.kind in _CLASSES and i.name == name), None)

    # --- pairs ----------------------------------------------------------------------------------

    def _pair(self, x: Item, r: Item) -> Iterator[Difference]:
        places = self.left.place_of(x), self.right.place_of(r)
        if x.name != r.name and x.kind != "constructor":
            name = r.path if x.owner else r.name
            yield Renamed(x.element, name, *places)
        if x.owner and self.tokens[1].class_name(r.owner) != x.owner:
            yield Moved(x.element, f"to {r.owner}", *places)
        yield from self._aspects(x, r, places)
        if isinstance(x.node, m.Constructor | m.MessageServer | m.Method) and isinstance(
            r.node, m.Constructor | m.MessageServer | m.Method
        ):
            yield from callable_differences(x.element, x.node, r.node, self.tokens, places)

    def _aspects(
        self, x: Item, r: Item, places: tuple[Place | None, Place | None]
    ) -> Iterator[Difference]:
        for aspect, of, old, new in self._values(x, r):
            if old != new:
                yield Changed(x.element, aspect, of, old, new, *places)

    def _values(self, x: Item, r: Item) -> Iterator[tuple[Aspect, str, str, str]]:
        """What an element and its partner have beside a body, as texts of the same form."""
        first, second = self.tokens
        if x.type is not None and r.type is not None:
            yield Aspect.TYPE, "", str(first.of(x.type)), str(second.of(r.type))
        notes = [_notes(t, i.annotations) for t, i in ((first, x), (second, r))]
        yield Aspect.ANNOTATION, "", notes[0], notes[1]
        match x.node, r.node:
            case (m.ReactiveClass() as a, m.ReactiveClass() as b):
                yield Aspect.QUEUE_LENGTH, "", str(a.queue_length), str(b.queue_length)
                yield Aspect.ABSTRACT, "", _word(a.abstract), _word(b.abstract)
                extends = a.extends or "", second.class_name(b.extends or "")
                yield Aspect.EXTENDS, "", *extends
                yield Aspect.IMPLEMENTS, "", *self._listed(a.implements, b.implements)
            case (m.Interface() as a, m.Interface() as b):
                yield Aspect.EXTENDS, "", *self._listed(a.extends, b.extends)
            case (m.Declarator() as a, m.Declarator() as b):
                yield Aspect.INITIAL, "", _initial(first, a), _initial(second, b)
            case (m.MessageServer() | m.Method() as a, m.MessageServer() | m.Method() as b):
                yield Aspect.ABSTRACT, "", _word(a.abstract), _word(b.abstract)
            case (m.Rebec() as a, m.Rebec() as b):
                yield from self._bindings(a, b)
                yield from self._arguments(a, b)

    def _listed(self, left: Sequence[str], right: Sequence[str]) -> tuple[str, str]:
        """The interfaces that two list: their order means nothing, and Python restricts it."""
        renamed = [self.tokens[1].class_name(n) for n in right]
        return ", ".join(left), ", ".join(left if sorted(left) == sorted(renamed) else renamed)

    def _bindings(self, x: m.Rebec, r: m.Rebec) -> Iterator[tuple[Aspect, str, str, str]]:
        """Bindings by the known rebec that they are for."""
        bound = [_bound(t, rebec) for t, rebec in zip(self.tokens, (x, r), strict=True)]
        for name in dict.fromkeys([*bound[0], *bound[1]]):
            yield Aspect.BINDING, name, bound[0].get(name, ""), bound[1].get(name, "")

    def _arguments(self, x: m.Rebec, r: m.Rebec) -> Iterator[tuple[Aspect, str, str, str]]:
        given = [
            [print_expression(t.of(a)) for a in rebec.arguments]
            for t, rebec in zip(self.tokens, (x, r), strict=True)
        ]
        constructor = self.left.analysis.constructor_of(x)
        parameters = constructor.parameters if constructor is not None else ()
        for i in range(max(map(len, given))):
            name = parameters[i].name if i < len(parameters) else f"number {i + 1}"
            texts = [each[i] if i < len(each) else "" for each in given]
            yield Aspect.ARGUMENT, name, texts[0], texts[1]

    # --- order and sections, at the first depth -------------------------------------------------

    def _orders(self) -> Iterator[Moved]:
        """Elements that stand elsewhere among the others of their class or of the model."""
        order = {id(item): i for i, item in enumerate(self.right.items)}
        groups: dict[str, list[Pair]] = {}
        for x, r in self.matching.pairs:
            if self.tokens[1].class_name(r.owner) == x.owner:
                groups.setdefault(x.owner, []).append((x, r))
        for pairs in groups.values():
            numbers = [order[id(r)] for _, r in pairs]
            kept = longest_increasing(numbers)
            for (x, r), number in zip(pairs, numbers, strict=True):
                if number not in kept:
                    after = max((n for n in numbers if n < number), default=None)
                    to = f"after {self.right.items[after].name}" if after is not None else "first"
                    places = self.left.place_of(x), self.right.place_of(r)
                    yield Moved(x.element, to, *places)

    def _sections(self) -> Iterator[Changed]:
        """Sections and declarations that divide the same variables in another way."""
        for x, r in self.matching.pairs:
            if isinstance(x.node, m.ReactiveClass) and isinstance(r.node, m.ReactiveClass):
                old, new = _outline(x.node), _outline(r.node)
                if old != new:
                    places = self.left.place_of(x), self.right.place_of(r)
                    yield Changed(x.element, Aspect.SECTIONS, "", old, new, *places)
        old, new = _heads(self.left.model), _heads(self.right.model)
        if old != new:
            places = self.left.whole, self.right.whole
            yield Changed(Element("model", ""), Aspect.SECTIONS, "", old, new, *places)

    # --- what could not be read -----------------------------------------------------------------

    def _unread(self, found: Sequence[Difference]) -> Iterator[Undetermined]:
        """Places of the code that are in no body that was compared."""
        told = [d for d in found if isinstance(d, Undetermined)]
        for own in (self.left, self.right):
            for unread in own.given.unread:
                if not any(_tells(d, own is self.left, unread) for d in told):
                    yield self._undetermined(unread, own is self.left)

    def _undetermined(self, unread: UnreadPlace, is_left: bool) -> Undetermined:
        own = self.left if is_left else self.right
        item = next((i for i in own.items if i.path == unread.within and i.kind in _BODIES), None)
        pair = next((p for p in self.matching.pairs if item in p), None)
        if pair is None:
            element = item.element if item is not None else Element("model", unread.within)
            left, right = self.left.whole, self.right.whole
        else:
            element = pair[0].element
            left = self.left.place_of(pair[0]) or self.left.whole
            right = self.right.place_of(pair[1]) or self.right.whole
        places = (unread.place, right) if is_left else (left, unread.place)
        return Undetermined(element, unread.why, *places)


def _tells(difference: Undetermined, left: bool, unread: UnreadPlace) -> bool:
    place = difference.left if left else difference.right
    return place is not None and difference.why == unread.why and unread.place.begins_in(place)


def _grouped(found: Sequence[Difference], left: Operand) -> Iterator[Difference]:
    """The differences of each class together, in the order of the classes; the system last."""
    classes = [c.name for c in left.given.model.classes]
    order = {name: i for i, name in enumerate(classes)}
    yield from sorted(found, key=lambda d: order.get(d.element.group, _place_of(d, len(order))))


def _place_of(difference: Difference, classes: int) -> int:
    """Where a group stands that is no class of the left side."""
    if difference.element.kind == "env":
        return -1
    return classes + (difference.element.group == "")


# --- texts --------------------------------------------------------------------------------------


def _word(flag: bool) -> str:
    return "yes" if flag else "no"


def _notes(tokens: Tokens, annotations: Iterable[m.Annotation]) -> str:
    texts = [print_line(tokens.of(a)).strip() for a in annotations]
    return " ".join(sorted(texts) if tokens.side.depth is Depth.EQUAL else texts)


def _initial(tokens: Tokens, declarator: m.Declarator) -> str:
    if declarator.initial is None:
        return ""
    made = tokens.of(declarator.initial)
    local = m.Local(m.Declaration(m.Type("int"), (m.Declarator("x", made),)))
    return print_statement(local).removeprefix("int x = ").removesuffix(";")


def _bound(tokens: Tokens, rebec: m.Rebec) -> dict[str, str]:
    info = tokens.side.analysis.classes.get(rebec.type.name)
    known = info.known if info is not None else ()
    found = {}
    for i, binding in enumerate(rebec.bindings):
        name = f"number {i + 1}"
        if i < len(known):
            declared = known[i].declaration
            name = tokens.names.declared.get(id(declared), declared.name)
        found[name] = print_expression(tokens.of(binding))
    return found


def _outline(node: m.ReactiveClass) -> str:
    """How a class divides its members into sections."""
    return "; ".join(
        f"{_SECTIONS[type(member)]} {', '.join(map(_declared, member.declarations))}"
        if isinstance(member, m.KnownRebecs | m.StateVars)
        else member.name
        for member in node.members
    )


def _heads(model: m.Model) -> str:
    heads = (
        f"env {_declared(h.declaration)}" if isinstance(h, m.Env) else f"{h.keyword} {h.text}"
        for h in model.heads
    )
    return "; ".join([*heads, "main" if model.main is not None else ""])


def _declared(declaration: m.Declaration) -> str:
    return " ".join(d.name for d in declaration.declarators)


def _are_same(left: SourcedModel, right: SourcedModel) -> bool:
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
