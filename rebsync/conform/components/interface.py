"""Who is on which topic, as the closed model says it; and values of fields as the model's."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

from rebsync import model as m
from rebsync.checker.program import Cell, Kind, Program
from rebsync.checker.values import cell_of, real
from rebsync.conform.components.environment import CLASS, Link
from rebsync.conform.observable import is_close, is_list, kinds
from rebsync.records import dataclass
from rebsync.reverse.models.texts import OTHER

_RANGES = {"byte": 2**7, "short": 2**15, "int": 2**31}


@dataclass(frozen=True, slots=True)
class Received:
    """A server that gets the messages of a topic, which goes by the environment's server.

    Its arguments are parameters of that one, by their places.
    """

    link: str
    server: str
    places: tuple[int, ...]


class Inside(NamedTuple):
    """A message from one rebec of the package to another."""

    receiver: str
    server: str


@dataclass(frozen=True, slots=True)
class Interface:
    """What a rebec receives, and the topics on which it publishes.

    `unfed` are servers that neither it nor a recorded topic sends to: they serve what was not
    recorded, or calls that are on no topic. `sent` go to other rebecs.
    """

    rebec: str
    received: tuple[Received, ...]
    published: tuple[str, ...]
    unfed: tuple[str, ...]
    sent: frozenset[Inside]


def interfaces(model: m.Model, links: Mapping[str, Link]) -> tuple[Interface, ...]:
    """The interfaces of all rebecs but the environment, in the order of `main`."""
    classes = {c.name: c for c in model.classes if isinstance(c, m.ReactiveClass)}
    rebecs = model.main.rebecs if model.main is not None else ()
    environment = next((r for r in rebecs if r.type.name == CLASS), None)
    if environment is None:
        return ()
    received: dict[str, list[Received]] = {}
    for receiver, each in _sent_by_environment(classes[CLASS], environment, links):
        received.setdefault(receiver, []).append(each)
    return tuple(
        _interface(rebec, classes[rebec.type.name], environment.name, received, links)
        for rebec in rebecs
        if rebec is not environment
    )


def _sent_by_environment(
    class_: m.ReactiveClass, rebec: m.Rebec, links: Mapping[str, Link]
) -> Iterator[tuple[str, Received]]:
    """Receivers with what they get of the environment."""
    slots = dict(zip(_known(class_), map(_name, rebec.bindings), strict=True))
    for server in _servers(class_):
        if server.name not in links:
            continue
        parameters = [p.name for p in server.parameters]
        for call in _calls(server):
            receiver = slots.get(_name(call.target) or "")
            places = [_place(argument, parameters) for argument in call.arguments]
            if receiver is not None and None not in places:
                known = tuple(p for p in places if p is not None)
                yield receiver, Received(server.name, call.name, known)


def _place(argument: m.Expression, parameters: Sequence[str]) -> int | None:
    name = _name(argument)
    return parameters.index(name) if name in parameters else None


def _interface(
    rebec: m.Rebec,
    class_: m.ReactiveClass,
    environment: str,
    received: Mapping[str, Sequence[Received]],
    links: Mapping[str, Link],
) -> Interface:
    slots = dict(zip(_known(class_), map(_name, rebec.bindings), strict=True))
    outside = {name for name, bound in slots.items() if bound == environment}
    calls = list(_calls(class_))
    published = {c.name for c in calls if _name(c.target) in outside and c.name in links}
    bound = ((slots.get(_name(c.target) or ""), c.name) for c in calls)
    sent = frozenset(Inside(to, name) for to, name in bound if to and to != environment)
    own = {c.name for c in calls if isinstance(c.target, m.Self)}
    fed = own | {each.server for each in received.get(rebec.name, ())}
    unfed = tuple(s.name for s in _servers(class_) if s.name not in fed)
    gets = tuple(dict.fromkeys(received.get(rebec.name, ())))
    return Interface(rebec.name, gets, tuple(sorted(published)), unfed, sent)


def _known(class_: m.ReactiveClass) -> list[str]:
    sections = (member for member in class_.members if isinstance(member, m.KnownRebecs))
    return [d.name for s in sections for each in s.declarations for d in each.declarators]


def _servers(class_: m.ReactiveClass) -> list[m.MessageServer]:
    return [member for member in class_.members if isinstance(member, m.MessageServer)]


def _calls(node: m.Node) -> Iterator[m.Call]:
    return (n for n in m.walk(node) if isinstance(n, m.Call) and n.target is not None)


def _name(expression: m.Expression | None) -> str | None:
    return expression.name if isinstance(expression, m.Name) else None


def parameter_names(model: m.Model, server: str) -> list[str]:
    """The names of the parameters of a server of the environment."""
    classes = (c for c in model.classes if isinstance(c, m.ReactiveClass) and c.name == CLASS)
    found = (s for c in classes for s in _servers(c) if s.name == server)
    return [p.name for s in found for p in s.parameters]


# --- values


class Unmodelled(Exception):
    """A value that no variable of the model holds; the text says which."""


def reader(
    program: Program, server: int, texts: Sequence[str]
) -> Callable[[Sequence[object]], tuple[Cell, ...]]:
    """What makes the arguments of a server of the values of fields, texts as their numbers.

    Unmodelled: the model has none such.
    """
    parameters = program.bodies[program.servers[server].body].parameters

    def cells_of(values: Sequence[object]) -> tuple[Cell, ...]:
        cells: list[Cell] = []
        for slot, value in zip(parameters, values, strict=True):
            if isinstance(value, str):
                value = texts.index(value) if value in texts else OTHER
            elements = list(value) if is_list(value) else [value]
            if len(elements) != slot.size:
                raise Unmodelled(f"{slot.name} has {len(elements)} elements, not {slot.size}")
            cells += [cell_of_field(slot.name, slot.kind, each) for each in elements]
        return tuple(cells)

    return cells_of


def cell_of_field(name: str, kind: Kind, value: object) -> Cell:
    """A value of a field. Unmodelled: it is none of that kind."""
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise Unmodelled(f"{name} is {value!r}, which is no {kind}") from None
    match kind:
        case "float" | "double":
            if not math.isfinite(number):
                raise Unmodelled(f"{name} is {number}")
            return cell_of(number)
        case "boolean":
            return int(bool(number))
        case _:
            whole = int(value)  # type: ignore[call-overload]
            most = _RANGES.get(kind, 2**31)
            if whole != number or not -most <= whole < most:
                raise Unmodelled(f"{name} is {value}, which no {kind} holds")
            return int(whole)


def is_same(program: Program, server: int, one: Sequence[Cell], other: Sequence[Cell]) -> bool:
    """Whether two messages are equal, up to the last bits of floating numbers."""
    if tuple(one) == tuple(other):
        return True
    return all(map(is_close, one, other, kinds(program, server)))


def shown(program: Program, server: int, cells: Sequence[Cell]) -> str:
    """The values of a message, for people."""
    return f"({', '.join(map(_shown, cells, kinds(program, server)))})"


def _shown(cell: Cell, kind: Kind) -> str:
    if kind in ("float", "double"):
        return f"{real(cell):g}"
    return str(bool(cell)).lower() if kind == "boolean" else str(cell)
