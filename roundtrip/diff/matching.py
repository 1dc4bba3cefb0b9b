"""Which element of one model is which of the other: by name, by marker, or because it is alike."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import field
from difflib import SequenceMatcher
from typing import TypeAlias

from rebsync import model as m
from rebsync.printing import print_member, print_statement
from rebsync.records import dataclass
from rebsync.roundtrip.diff.alignment import overlap
from rebsync.roundtrip.diff.operands import Item, Operand, markers_at
from rebsync.roundtrip.diff.tokens import ElementNames

Pair: TypeAlias = tuple[Item, Item]

_CALLABLE = ("msgsrv", "method")
_MOVABLE = ("statevar", "knownrebec", *_CALLABLE)
_ENOUGH = 0.6
_WORD = re.compile(r"\w+|[^\w\s]+")


@dataclass(slots=True)
class Matching:
    """Pairs of elements, and those without a partner."""

    pairs: list[Pair] = field(default_factory=list)
    lefts: list[Item] = field(default_factory=list)
    rights: list[Item] = field(default_factory=list)

    def take(self, pairs: Iterable[Pair]) -> None:
        """Makes pairs of elements that had no partner."""
        for left, right in pairs:
            if left in self.lefts and right in self.rights:
                self.lefts.remove(left)
                self.rights.remove(right)
                self.pairs.append((left, right))

    def by(self, key: Callable[[Item], object], other: Callable[[Item], object]) -> None:
        """Takes pairs of which the keys are the same, in their order."""
        wanted, found = _by_key(self.lefts, key), _by_key(self.rights, other)
        self.take(
            pair
            for k, lefts in wanted.items()
            for pair in zip(lefts, found.get(k, ()), strict=False)
        )


def _by_key(items: Iterable[Item], key: Callable[[Item], object]) -> dict[object, list[Item]]:
    found: dict[object, list[Item]] = defaultdict(list)
    for item in items:
        if (k := key(item)) is not None:
            found[k].append(item)
    return found


def matched(left: Operand, right: Operand) -> Matching:
    """The elements of two models as pairs, renamed and moved ones among them."""
    matching = Matching([], list(left.items), list(right.items))
    _match_classes(matching)
    classes = {r.name: x.name for x, r in matching.pairs}
    _match_named(matching, classes)
    _match_marked(matching)
    _match_alike(matching, left, right, classes)
    matching.by(_moving, _moving)
    order = {id(item): i for i, item in enumerate(left.items)}
    matching.pairs.sort(key=lambda pair: order[id(pair[0])])
    return matching


def names_of(matching: Matching) -> tuple[ElementNames, ElementNames]:
    """What the elements of both sides are called: as on the left, where they are there."""
    classes = {r.name: x.name for x, r in matching.pairs if not r.owner and r.kind in _CLASSES}
    declared = {id(r.node): x.name for x, r in matching.pairs if x.name != r.name}
    taken = {(x.kind, classes.get(r.owner, r.owner), x.name) for x, r in matching.pairs}
    for item in matching.rights:
        if (item.kind, classes.get(item.owner, item.owner), item.name) in taken:
            declared[id(item.node)] = f"{item.name}'"  # another one has that name on the left
    return ElementNames(), ElementNames(declared, classes)


# --- by name ------------------------------------------------------------------------------------

_CLASSES = ("reactiveclass", "interface")


def _match_classes(matching: Matching) -> None:
    def name(item: Item) -> object:
        return (item.kind, item.name) if item.kind in _CLASSES else None

    matching.by(name, name)
    _match_markers(matching, lambda item: item.kind in _CLASSES)
    lefts, rights = ([i for i in each if i.kind in _CLASSES] for each in _unpaired(matching))
    scores = [(_alike_classes(x, r), x, r) for x in lefts for r in rights if x.kind == r.kind]
    matching.take(_greedy(scores))


def _match_named(matching: Matching, classes: dict[str, str]) -> None:
    """Those that the other side has under the same name in the same class."""

    def owner(item: Item) -> str:
        return classes.get(item.owner, item.owner)

    def full(item: Item, types: dict[str, str], within: str) -> object:
        name = "" if item.kind == "constructor" else item.name
        return (item.kind, within, name, tuple(types.get(t, t) for t in item.signature))

    matching.by(lambda i: full(i, {}, i.owner), lambda i: full(i, classes, owner(i)))
    callables = (*_CALLABLE, "constructor")
    matching.by(
        lambda i: full(i, {}, i.owner)[:3] if i.kind in callables else None,  # type: ignore[index]
        lambda i: full(i, classes, owner(i))[:3] if i.kind in callables else None,  # type: ignore[index]
    )


def _moving(item: Item) -> object:
    return (item.kind, item.name, item.signature) if item.kind in _MOVABLE else None


# --- by marker ----------------------------------------------------------------------------------


def _match_marked(matching: Matching) -> None:
    """Those of which the marker in the code names the other one."""
    _match_markers(matching, lambda item: item.kind in (*_MOVABLE, "env"))


def _match_markers(matching: Matching, wanted: Callable[[Item], bool]) -> None:
    lefts, rights = (list(filter(wanted, each)) for each in _unpaired(matching))
    if lefts and rights:
        matching.take(_marked(lefts, rights))
        matching.take((x, r) for r, x in _marked(rights, lefts))


def _marked(lefts: Sequence[Item], rights: Sequence[Item]) -> list[Pair]:
    """Pairs of elements and what has a marker with the name of the element."""
    by_name = {str(item.element): item for item in lefts}
    return [
        (by_name[marker], right)
        for right in rights
        for marker in sorted(markers_at(right))
        if marker in by_name and by_name[marker].kind == right.kind
    ]


# --- because they are alike ---------------------------------------------------------------------


def _match_alike(
    matching: Matching, left: Operand, right: Operand, classes: dict[str, str]
) -> None:
    lefts, rights = _unpaired(matching)
    both = [(x, r) for x in lefts for r in rights if x.kind == r.kind]
    pairs = [(x, r) for x, r in both if x.owner == classes.get(r.owner, r.owner)]
    if not pairs:
        return  # most models: how they use their names need not be known
    blind = {item.name for item in (*lefts, *rights)}
    uses = (_uses(left, blind), _uses(right, blind))
    scores = [(_alike(x, r, uses, blind, classes), x, r) for x, r in pairs]
    matching.take(_greedy(scores))


def _unpaired(matching: Matching) -> tuple[list[Item], list[Item]]:
    return list(matching.lefts), list(matching.rights)


def _greedy(scores: Iterable[tuple[float, Item, Item]]) -> Iterator[Pair]:
    """The pairs that are alike, the most similar ones first; names decide between equal ones."""
    enough = [(s + 0.01 * _like(x.name, r.name), x, r) for s, x, r in scores if s >= _ENOUGH]
    for _, left, right in sorted(enough, key=lambda score: -score[0]):
        yield left, right


def _alike(
    left: Item,
    right: Item,
    uses: tuple[dict[str, Counter[str]], dict[str, Counter[str]]],
    blind: set[str],
    classes: dict[str, str],
) -> float:
    match left.node, right.node:
        case m.Declarator(), m.Declarator():
            if left.type != _renamed_type(right.type, classes):
                return 0.0
            return _alike_uses(left, right, uses)
        case m.Rebec(), m.Rebec():
            return _alike_rebecs(left.node, right.node, classes)
        case (m.MessageServer() | m.Method(), m.MessageServer() | m.Method()):
            return _alike_bodies(left, right, blind)
        case _:
            return 0.0


def _alike_uses(
    left: Item, right: Item, uses: tuple[dict[str, Counter[str]], dict[str, Counter[str]]]
) -> float:
    """Variables are alike that are used in the same way."""
    first, second = uses[0].get(_key(left), Counter()), uses[1].get(_key(right), Counter())
    if not first and not second:
        return _ENOUGH + 0.3 * _like(left.name, right.name)  # nothing tells them apart
    return overlap(first, second)


def _alike_rebecs(left: m.Rebec, right: m.Rebec, classes: dict[str, str]) -> float:
    if left.type != _renamed_type(right.type, classes):
        return 0.0
    first, second = ([print_statement(m.Return(a)) for a in r.arguments] for r in (left, right))
    return 0.6 + 0.4 * overlap(Counter(first), Counter(second))


def _alike_bodies(left: Item, right: Item, blind: set[str]) -> float:
    first, second = (_words(item, blind) for item in (left, right))
    if not first or not second:
        same = left.signature == right.signature and first == second
        return max(_like(left.name, right.name), _ENOUGH if same else 0.0)
    return SequenceMatcher(None, first, second, autojunk=False).ratio()


def _words(item: Item, blind: set[str]) -> list[str]:
    """The words of a body, without names that only one side has."""
    node = item.node
    if not isinstance(node, m.MessageServer | m.Method) or node.body is None:
        return []
    inner = "".join(print_statement(s) + "\n" for s in node.body.statements)
    return ["_" if w in blind else w for w in _WORD.findall(inner)]


def _alike_classes(left: Item, right: Item) -> float:
    """By the words that they share, and by the order of their words but for names of one side."""
    first, second = (list(_class_words(item)) for item in (left, right))
    common = set(first) & set(second)
    blind = [[w if w in common else "_" for w in words] for words in (first, second)]
    in_order = SequenceMatcher(None, blind[0], blind[1], autojunk=False).ratio()
    return (overlap(Counter(first), Counter(second)) + in_order) / 2


def _class_words(item: Item) -> Iterator[str]:
    node = item.node
    if not isinstance(node, m.ReactiveClass | m.Interface):
        return
    members = node.members if isinstance(node, m.ReactiveClass) else node.servers
    for member in members:
        text = print_member(member)
        yield from (w for w in _WORD.findall(text) if w != node.name)


def _uses(side: Operand, blind: set[str]) -> dict[str, Counter[str]]:
    """For each name of a class, and each `env`, the words of the statements that use it."""
    found: dict[str, Counter[str]] = defaultdict(Counter)
    for each in side.model.classes:
        for node in m.walk(each):
            if isinstance(node, m.ExpressionStatement | m.Local | m.Return | m.If | m.While):
                text = print_statement(_head(node))
                words = _WORD.findall(text)
                line = Counter("_" if w in blind else w for w in words)
                for word in {w for w in words if w in blind}:
                    found[f"{each.name}.{word}"] += line
                    found[f".{word}"] += line
    return found


def _head(statement: m.Statement) -> m.Statement:
    match statement:
        case m.If(condition) | m.While(condition):
            return m.While(condition, m.Empty())
        case _:
            return statement


def _key(item: Item) -> str:
    return f"{item.owner}.{item.name}"


def _like(left: str, right: str) -> float:
    return SequenceMatcher(None, left.lower(), right.lower()).ratio()


def _renamed_type(type_: m.Type | None, classes: dict[str, str]) -> m.Type | None:
    if type_ is None:
        return None
    return m.Type(classes.get(type_.name, type_.name), type_.dimensions)
