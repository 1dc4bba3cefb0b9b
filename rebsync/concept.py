"""The conceptual model of a robotic problem (thesis, section 3.1.1), read from TOML."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from math import isfinite, prod

from rebsync.diagnostics import Findings, RebsyncError, did_you_mean
from rebsync.records import dataclass
from rebsync.source import Source
from rebsync.toml import Table, read_toml

ROBOT_ID = "robotId"
TYPES = ("byte", "short", "int", "float", "double", "boolean")
_BITS = {"byte": 8, "short": 16, "int": 32}
_LARGEST = 2**31 - 1
_MOST_ELEMENTS = 100
_NAME = re.compile(r"[^\W\d]\w*\Z")
_TYPE = re.compile(r"\s*([^\W\d]\w*)\s*((?:\[\s*[1-9]\d*\s*\]\s*)*)\Z")
_KEYWORDS = frozenset(
    """abstract after boolean break byte case continue deadline default delay double else env
    extends false featurevar float for goto if implements import instanceof int interface
    knownrebecs main msgsrv new now null package private protected public reactiveclass record
    return self sender short statevars super switch true while assertion pow sqrt""".split()  # noqa: SIM905
)


@dataclass(frozen=True, slots=True)
class Variable:
    """A property of a robot or a variable of the controller."""

    name: str
    type: str
    dimensions: tuple[int, ...] = ()
    initial: str | None = None


@dataclass(frozen=True, slots=True)
class Activity:
    """Something that takes time: an activity of a robot, which may move it, or a task."""

    name: str
    time: int
    move: tuple[int, int] | None = None


@dataclass(frozen=True, slots=True)
class Sensor:
    """A sensor with its rate, and the property that it sets."""

    name: str
    rate: int
    sets: str | None = None


@dataclass(frozen=True, slots=True)
class Robot:
    """A kind of robot: its instances, command port, properties, activities, sensors."""

    name: str
    instances: tuple[str, ...]
    port: str
    properties: tuple[Variable, ...]
    activities: tuple[Activity, ...]
    sensors: tuple[Sensor, ...]


@dataclass(frozen=True, slots=True)
class Controller:
    """The central node: its tasks in the order of their work, and its variables."""

    name: str
    instance: str
    tasks: tuple[Activity, ...]
    variables: tuple[Variable, ...]


@dataclass(frozen=True, slots=True)
class Concept:
    """A whole robotic problem."""

    robots: tuple[Robot, ...]
    controller: Controller | None = None


def parse_concept(source: Source) -> Concept:
    """The conceptual model in a text; a RebsyncError with all its mistakes when there are any."""
    table = read_toml(source)
    concept = Concept(_robots(table), _controller(table))
    table.finish()
    _check_names(table, concept)
    if table.diagnostics:
        found = sorted(table.diagnostics, key=lambda d: d.span.start)
        raise RebsyncError([Findings(source, tuple(found))])
    return concept


# --- robots ------------------------------------------------------------------------------------


def _robots(table: Table) -> tuple[Robot, ...]:
    robots = table.table("robots")
    if robots is None or not robots.values:
        table.require("robots")
        if robots is not None:
            table.wrong("robots", "there is no robot", "write [robots.NAME] for each kind")
        return ()
    found = tuple(_robot(name, entry) for name, entry in robots.named_tables())
    robots.finish()
    return found


def _robot(name: str, table: Table) -> Robot:
    _check_name(table, None, name)
    properties = _variables(table, "properties")
    robot = Robot(
        name,
        _instances(table, name),
        _name(table, "port", "command"),
        properties,
        _activities(table, "activities", moves=True),
        _sensors(table, {p.name: p for p in properties}),
    )
    table.finish()
    return robot


def _instances(table: Table, robot: str) -> tuple[str, ...]:
    """Names, or a number of robots to be named after their class."""
    value = table.raw("instances")
    first = robot[:1].lower() + robot[1:]
    base = first if first != robot else f"{robot}_"
    match value:
        case None:
            return (base,) if base != f"{robot}_" else (f"{robot}_1",)
        case bool():
            pass
        case int() if 1 <= value <= 100:
            joint = "_" if base[-1].isdigit() else ""
            return tuple(f"{base}{joint}{number}" for number in range(1, value + 1))
        case list() if value and all(isinstance(each, str) for each in value):
            for each in value:
                _check_name(table, "instances", each)
            return tuple(value)
    table.wrong("instances", "`instances` must be names, or a number from 1 to 100")
    return ()


def _sensors(table: Table, properties: dict[str, Variable]) -> tuple[Sensor, ...]:
    below = table.table("sensors")
    sensors = []
    for name, _ in below.named() if below else ():
        assert below
        _check_name(below, name, name)
        entry, rate = _timed(below, name, "rate")
        sets = entry.text("sets") if entry else None
        if entry and sets is not None:
            if sets not in properties:
                hint = did_you_mean(sets, properties)
                entry.wrong("sets", f'the robot has no property "{sets}"', hint)
            elif properties[sets].dimensions:
                entry.wrong("sets", "a sensor sets one value, not an array")
        if entry:
            entry.finish()
        sensors.append(Sensor(name, rate, sets))
    return tuple(sensors)


# --- the controller ----------------------------------------------------------------------------


def _controller(table: Table) -> Controller | None:
    entry = table.table("controller")
    if entry is None:
        return None
    entry.require("tasks")
    controller = Controller(
        _name(entry, "name", "Controller"),
        _name(entry, "instance", "controller"),
        _activities(entry, "tasks", moves=False),
        _variables(entry, "variables"),
    )
    entry.finish()
    return controller


# --- parts -------------------------------------------------------------------------------------


def _activities(table: Table, key: str, moves: bool) -> tuple[Activity, ...]:
    below = table.table(key)
    activities = []
    for name, _ in below.named() if below else ():
        assert below
        _check_name(below, name, name)
        entry, time = _timed(below, name, "time")
        move = _move(entry) if entry and moves else None
        if entry:
            entry.finish()
        activities.append(Activity(name, time, move))
    return tuple(activities)


def _timed(table: Table, name: str, key: str) -> tuple[Table | None, int]:
    """`name = 2` or `name = { time = 2, ... }`: the table if there is one, and the number."""
    value = table.raw(name)
    if isinstance(value, dict):
        entry = table.table(name)
        assert entry
        entry.require(key)
        number = entry.integer(key, 1)
        if number is None or not 1 <= number <= _LARGEST:
            entry.wrong(key, f"`{key}` must be 1 or more")
        return entry, number or 1
    if isinstance(value, int) and not isinstance(value, bool) and 1 <= value <= _LARGEST:
        return None, value
    table.wrong(name, f"`{name}` must be a whole number, 1 or more", f"its {key} in model time")
    return None, 1


def _move(entry: Table) -> tuple[int, int] | None:
    match entry.raw("move"):
        case None:
            return None
        case [int(x), int(y)] if -1 <= x <= 1 and -1 <= y <= 1:
            return (int(x), int(y))
        case _:
            hint = "a robot moves to one of the eight cells around it: move = [1, 0]"
            entry.wrong("move", "`move` must be the steps along X and Y, each -1, 0 or 1", hint)
            return None


def _variables(table: Table, key: str) -> tuple[Variable, ...]:
    below = table.table(key)
    variables = []
    for name, value in below.named() if below else ():
        assert below
        _check_name(below, name, name)
        entry = below.table(name) if isinstance(value, dict) else None
        if entry:
            entry.require("type")
            variables.append(_variable(name, entry, "type"))
            entry.finish()
        else:
            variables.append(_variable(name, below, name))
    return tuple(variables)


def _variable(name: str, table: Table, key: str) -> Variable:
    text = table.text(key, "int") or "int"
    match = _TYPE.match(text)
    type_, dimensions = (match[1], match[2]) if match else (text, "")
    if type_ not in TYPES or not match:
        hint = did_you_mean(type_, TYPES) or "known: " + ", ".join(TYPES) + ", and int[2]"
        table.wrong(key, f'unknown type "{text}"', hint)
        type_ = "int"
    sizes = tuple(int(size) for size in re.findall(r"\d+", dimensions))
    if prod(sizes) > _MOST_ELEMENTS:
        table.wrong(key, f"an array of a skeleton has at most {_MOST_ELEMENTS} elements")
        sizes = ()
    initial = table.raw("initial") if key == "type" else None
    return Variable(name, type_, sizes, _initial(table, type_, initial))


def _initial(table: Table, type_: str, value: object) -> str | None:
    if value is None:
        return None
    whole = isinstance(value, int) and not isinstance(value, bool)
    decimal = whole or (isinstance(value, float) and isfinite(value))
    fits = {"boolean": isinstance(value, bool), "float": decimal, "double": decimal}
    if isinstance(value, int) and type_ in _BITS:
        half = 2 ** (_BITS[type_] - 1)
        whole = whole and -half <= value < half
    if not fits.get(type_, whole):
        table.wrong("initial", f"`initial` must be a value of the type {type_}")
        return None
    return str(value).lower()


def _name(table: Table, key: str, default: str) -> str:
    name = table.text(key, default) or default
    _check_name(table, key, name)
    return name


def _check_name(table: Table, key: str | None, name: str) -> None:
    if name in _KEYWORDS:
        message = f'"{name}" is a word of the language and cannot be a name'
        table.report("RS809", table.place(key), message, "choose another name")
    elif not _NAME.match(name):
        hint = "letters, digits and `_`, and no digit first"
        table.report("RS809", table.place(key), f'"{name}" is not a name', hint)


def _check_names(table: Table, concept: Concept) -> None:
    """No two things of one scope may share a name."""
    controller = concept.controller
    central = [controller.name, controller.instance] if controller else []
    instances = [name for robot in concept.robots for name in robot.instances]
    _check_unique(table, ("controller",), central)
    for robot in concept.robots:
        path = ("robots", robot.name)
        _check_unique(table, path, [robot.name], {*central, *instances} - {*robot.instances})
        others = {r.name for r in concept.robots} | {*central}
        _check_unique(table, path, robot.instances, others | _earlier(concept, robot))
        scope = [robot.port, *(each.name for each in robot.properties)]
        scope += [a.name for a in robot.activities] + [s.name for s in robot.sensors]
        _check_unique(table, path, scope, {ROBOT_ID, *central} if controller else {robot.name})
    if controller:
        parts = [v.name for v in controller.variables] + [t.name for t in controller.tasks]
        _check_unique(table, ("controller",), parts, {*instances, controller.name})


def _earlier(concept: Concept, robot: Robot) -> set[str]:
    before = concept.robots[: concept.robots.index(robot)]
    return {name for other in before for name in other.instances}


def _check_unique(
    table: Table, path: tuple[str, ...], names: Sequence[str], taken: Collection[str] = ()
) -> None:
    seen = set(taken)
    for name in names:
        if name in seen:
            span = table.places.get(path, table.place())
            message = f'the name "{name}" is taken already'
            table.report("RS809", span, message, "choose another name")
        seen.add(name)
