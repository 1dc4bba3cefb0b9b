"""Odd wiring as differences of the elements that it is about, each with both places."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from rebsync.reverse.scaffold.fact import NOT_GIVEN, Fact
from rebsync.roundtrip.diff.difference import Aspect, Changed, Depth, Element, Place
from rebsync.roundtrip.diff.operands import Item, Operand, SourcedModel, side
from rebsync.roundtrip.verdict.wiring.facts import Odd

_STRING = re.compile(r'"([^"]*)"')

# By the kind of a fact: the kind of its element, the aspect, and whether its name tells which part.
_TOLD: Mapping[str, tuple[str, Aspect, bool]] = {
    "remap": ("rebec", Aspect.TOPIC, True),
    "node": ("rebec", Aspect.SETTING, True),
    "subscription": ("msgsrv", Aspect.TOPIC, False),
    "publisher": ("knownrebec", Aspect.TOPIC, True),
    "sensor": ("msgsrv", Aspect.TOPIC, True),
    "field": ("msgsrv", Aspect.TYPE, True),
    "priority": ("msgsrv", Aspect.PRIORITY, False),
    "best priority": ("reactiveclass", Aspect.PRIORITY, False),
    "set-up": ("reactiveclass", Aspect.SETTING, True),
    "default": ("reactiveclass", Aspect.SETTING, True),
}


def told(odd: Iterable[Odd], today: SourcedModel) -> tuple[Changed, ...]:
    """The differences that odd wiring makes, of elements that today's model has."""
    model = side(today, Depth.IDENTICAL)
    return tuple(change for each in odd for change in _changes(each, model))


def _changes(odd: Odd, model: Operand) -> Iterator[Changed]:
    facts = (*odd.before, *odd.now)
    if not facts or facts[0].kind not in _TOLD:
        return
    fact = facts[0]
    kind, aspect, is_named = _TOLD[fact.kind]
    item = _item(model, kind, fact)
    if item is None:
        return
    found = odd.finding
    place = Place(found.source, found.diagnostics[0].span)
    of = fact.name if is_named else ""
    old, new = _values(odd.before), _values(odd.now)
    if aspect is Aspect.TOPIC and _topics(old) != _topics(new):
        old, new = _topics(old), _topics(new)
    yield Changed(item.element, aspect, of, old, new, model.place_of(item), place)


def _topics(text: str) -> str:
    """The names in a text of the code; all of it if it has none."""
    return ", ".join(_STRING.findall(text)) or text


def _values(facts: Iterable[Fact]) -> str:
    found = sorted({fact.value for fact in facts} - {NOT_GIVEN})
    return " and ".join(found)


def _item(model: Operand, kind: str, fact: Fact) -> Item | None:
    """The element that a fact is about, or else its class."""
    named = [i for i in model.items if _is_of(i, kind, fact)]
    classes = [i for i in model.items if i.kind == "reactiveclass" and i.name == fact.owner]
    return next(iter((*named, *classes)), None)


def _is_of(item: Item, kind: str, fact: Fact) -> bool:
    if item.kind != kind:
        return False
    match fact.kind:
        case "remap" | "node":
            return item.name == fact.owner
        case "field":
            return f"{item.owner}{item.name}".lower() == fact.owner.lower()
        case "publisher":
            return item.owner == fact.owner and fact.value.partition('"')[2].startswith(
                f"{item.name}/"
            )
        case "sensor":
            return item.owner == fact.owner and fact.value.strip('"').endswith(f"/{item.name}")
        case _:
            return item.element == Element(kind, f"{fact.owner}.{fact.name}")
