"""The rules of the annotations that rebsync knows; others are let through."""

from __future__ import annotations

from rebsync.model import Annotation, Empty, Name, Statement
from rebsync.reserved import KEEP_LAST, OFFERS, OPEN
from rebsync.static.constants import constant
from rebsync.static.expressions import type_of
from rebsync.static.facts import Facts, Move
from rebsync.static.movement import movement
from rebsync.static.scope import Body
from rebsync.static.types import is_integer

_PRIORITIES = frozenset(("priority", "globalPriority"))
_PLACES = {
    "Robot": "a class",
    "Controller": "a class",
    "Sensor": "a message server",
    "Port": "a message server",
    "Service": "a message server",
    "Action": "a message server",
    OPEN: "a message server",
    KEEP_LAST: "a message server",
    "Move": "an empty statement: @Move(X+1, Y);",
}
KNOWN_ANNOTATIONS = (*_PLACES, *sorted(_PRIORITIES))
_LEGAL = {
    "a class": frozenset(("Robot", "Controller")),
    "a message server": frozenset(("Sensor", "Port", OPEN, KEEP_LAST)) | OFFERS | _PRIORITIES,
    "an instance": _PRIORITIES,
}
_EXCLUSIVE = frozenset(("Robot", "Controller", "Sensor", "Port"))
_OF_SERVERS = frozenset(("Sensor", "Port"))
_ASKED = OFFERS | {"Sensor"}  # in one way; a sensor asks itself
_WANTED = {"Service": (1, 1), "Action": (1, 2)}  # how many servers each names


def check_annotations(facts: Facts, annotations: tuple[Annotation, ...], of: str) -> None:
    """Checks the annotations of `of`: "a class", "a message server", "a method", ..."""
    seen: dict[str, Annotation] = {}
    for annotation in annotations:
        name = annotation.name
        if name == "feature":
            hint = "a generated ROS system has no features: keep one model per variant"
            facts.error("RS110", annotation.span, '"@feature" is not supported', hint)
        elif name in _PRIORITIES:
            _check_priority(facts, annotation, of)
        elif name in _PLACES:
            _check_place(facts, annotation, of, seen)


def _check_place(
    facts: Facts, annotation: Annotation, of: str, seen: dict[str, Annotation]
) -> None:
    name, span = annotation.name, annotation.span
    if name not in _LEGAL.get(of, ()):
        message = f"@{name} does not belong to {of}"
        if name in _OF_SERVERS and of in ("a class", "an instance"):
            # Public models have them there, where the official compiler lets them through.
            hint = f"it has no meaning there: it belongs to {_PLACES[name]}"
            facts.warn("RS427", span, message, hint)
            return
        facts.error("RS427", span, message, f"it belongs to {_PLACES[name]}")
        return
    if name in OFFERS:
        _check_offer(facts, annotation)
    elif name == KEEP_LAST:
        _check_depth(facts, annotation)
    elif annotation.arguments is not None:
        facts.error("RS427", span, f"@{name} takes no arguments")
    for other, first in seen.items():
        if other == name or {other, name} <= _EXCLUSIVE or {other, name} <= _ASKED:
            twice = "stands here twice" if other == name else f"and @{other} exclude each other"
            place = ((first.span, f"@{other} stands here"),)
            facts.error("RS427", span, f"@{name} {twice}", related=place)
    seen.setdefault(name, annotation)


def _check_offer(facts: Facts, annotation: Annotation) -> None:
    """`@Service(done)`, `@Action(done, seen)`: servers, which other classes may have."""
    name, given = annotation.name, annotation.arguments or ()
    least, most = _WANTED[name]
    if least <= len(given) <= most and all(isinstance(a, Name) for a in given):
        return
    hint = f"name the message server that the reply is sent to, such as @{name}(done)"
    more = ", and of the feedback" if most > 1 else ""
    message = f"@{name} takes the name of the reply{more}"
    facts.error("RS427", annotation.span, message, hint)


def _check_depth(facts: Facts, annotation: Annotation) -> None:
    """`@KeepLast(5)`: how many messages wait at most."""
    given = annotation.arguments or ()
    depth = constant(given[0]) if len(given) == 1 else None
    if isinstance(depth, bool) or not isinstance(depth, int) or depth < 1:
        hint = f"write how many messages wait at most, such as @{KEEP_LAST}(10)"
        facts.error("RS427", annotation.span, f"@{KEEP_LAST} takes a number above 0", hint)


def _check_priority(facts: Facts, annotation: Annotation, of: str) -> None:
    name, span = annotation.name, annotation.span
    if name not in _LEGAL.get(of, ()):
        hint = "it orders message servers and the instances in main"
        facts.warn("RS519", span, f"@{name} has no effect on {of}", hint)
        return
    first = facts.priority
    if first is None:
        facts.priority = annotation
    elif first.name != name:
        message = f"@{name} and @{first.name} cannot be mixed in one model"
        facts.error("RS430", span, message, related=((first.span, f"@{first.name} stands here"),))
    arguments = annotation.arguments or ()
    if len(arguments) != 1:
        facts.error("RS429", span, f"@{name} takes one integer, such as @{name}(1)")
        return
    value = constant(arguments[0])
    if isinstance(value, bool) or not isinstance(value, int):
        message = f"the value of @{name} must be a constant integer"
        facts.error("RS429", arguments[0].span, message, "write it as a literal")


def check_statement_annotations(statement: Statement, body: Body) -> None:
    """Checks the annotations of a statement: `@Move` on an empty one."""
    others: list[Annotation] = []
    for annotation in statement.annotations:
        if annotation.name == "Move" and isinstance(statement, Empty):
            _check_move(annotation, body)
        else:
            others.append(annotation)
    check_annotations(body.facts, tuple(others), "this statement")


def _check_move(annotation: Annotation, body: Body) -> None:
    step = movement(annotation)
    if step is None:
        message = "@Move takes the new X and the new Y"
        hint = "write each as X, X+e or X-e: @Move(X+1, Y), @Move(X, Y-(a+b))"
        body.facts.error("RS428", annotation.span, message, hint)
        return
    body.events.append(Move(annotation))
    for offset in (step.x, step.y):
        if offset.amount is None:
            continue
        type_ = type_of(offset.amount, body)
        if type_ is not None and not is_integer(type_):
            message = f'a robot moves by whole cells, not by "{type_}"'
            body.facts.error("RS428", offset.amount.span, message)
    if body.owner is not None and not body.owner.annotated("Robot"):
        message = f'"{body.owner.name}" moves but is not a @Robot'
        hint = f"write @Robot before reactiveclass {body.owner.name}"
        body.facts.warn("RS607", annotation.span, message, hint)
