"""Warnings about robotic models: what section 3.2 of the RoboRebeca thesis asks of them."""

from __future__ import annotations

from rebsync.model import Call, Main, MessageServer, Name
from rebsync.records import dataclass
from rebsync.static.facts import BodyFacts, Delay, Event, Facts, Invocation, Move, Send
from rebsync.static.paths import Exit, Paths
from rebsync.static.symbols import ClassInfo, ServerSymbol


@dataclass(slots=True)
class _Robotics:
    """The robots and controllers of a model and what their bodies do."""

    facts: Facts
    robots: list[ClassInfo]
    controllers: list[ClassInfo]
    bodies: dict[int, BodyFacts]
    senders: dict[int, set[int]]

    def events(self, body: BodyFacts, seen: set[int] | None = None) -> list[Event]:
        """What a body does, the methods that it calls included."""
        seen = seen if seen is not None else set()
        found: list[Event] = []
        for event in body.events:
            found.append(event)
            if isinstance(event, Invocation) and id(event.symbol.declaration) not in seen:
                seen.add(id(event.symbol.declaration))
                called = self.bodies.get(id(event.symbol.declaration))
                found.extend(self.events(called, seen) if called is not None else ())
        return found


def check_robotic(facts: Facts, main: Main | None) -> None:
    """Checks the classes that are annotated @Robot or @Controller."""
    robots = [i for i in facts.infos if i.annotated("Robot") and not i.is_abstract]
    controllers = [i for i in facts.infos if i.annotated("Controller") and not i.is_abstract]
    bodies = {id(b.declaration): b for b in facts.bodies}
    robotics = _Robotics(facts, robots, controllers, bodies, _senders(facts))
    _check_acquaintance(robotics, main)
    for robot in robots:
        for server in robot.servers:
            _check_server(robotics, robot, server)
    for info in facts.infos:
        if not info.annotated("Robot"):
            _check_stray_ports(facts, info)
    _check_commands(robotics)


def _senders(facts: Facts) -> dict[int, set[int]]:
    """For each message server that is sent, the bodies that send it."""
    senders: dict[int, set[int]] = {}
    for body in facts.bodies:
        for event in body.events:
            if isinstance(event, Send):
                senders.setdefault(id(event.symbol.declaration), set()).add(id(body.declaration))
    return senders


def has(declaration: MessageServer, name: str) -> bool:
    """Whether a message server carries an annotation."""
    return any(a.name == name for a in declaration.annotations)


# --- who knows whom ----------------------------------------------------------------------------


def _check_acquaintance(robotics: _Robotics, main: Main | None) -> None:
    if not robotics.controllers:
        return
    facts, controller = robotics.facts, robotics.controllers[0]
    known = {name for c in robotics.controllers for name in _known_types(c)}
    names = {name for c in robotics.controllers for name in (*c.lineage, "ReactiveClass")}
    strangers: set[str] = set()
    for robot in robotics.robots:
        if known.isdisjoint((*robot.lineage, "ReactiveClass")):
            strangers.add(robot.name)
            message = f'the controller "{controller.name}" knows no robot of class "{robot.name}"'
            hint = f"add {robot.name} robot; to its knownrebecs and bind it in main"
            facts.warn("RS601", controller.declaration.name_span, message, hint)
        if names.isdisjoint(_known_types(robot)):
            message = f'the robot "{robot.name}" does not know the controller'
            hint = f"add {controller.name} controller; to its knownrebecs and bind it in main"
            facts.warn("RS602", robot.declaration.name_span, message, hint)
        if not any(has(s.declaration, "Port") for s in robot.servers):
            message = f'the robot "{robot.name}" has no @Port for the commands of the controller'
            hint = "write @Port before the message server that takes its commands"
            facts.warn("RS606", robot.declaration.name_span, message, hint)
    if main is not None:
        _check_bindings(robotics, main, strangers)


def _known_types(info: ClassInfo) -> set[str]:
    return {k.type.name for k in info.known if k.type is not None}


def _check_bindings(robotics: _Robotics, main: Main, strangers: set[str]) -> None:
    """Every instance of a robot must be bound to an instance of a controller."""
    robots = {r.name for r in robotics.robots} - strangers
    controllers = {c.name for c in robotics.controllers}
    bound: set[str] = set()
    first = None
    for rebec in main.rebecs:
        if rebec.type.name in controllers:
            first = first or rebec
            bound.update(b.name for b in rebec.bindings if isinstance(b, Name))
    for rebec in main.rebecs:
        if first is not None and rebec.type.name in robots and rebec.name not in bound:
            message = f'the controller "{first.name}" does not know the robot "{rebec.name}"'
            hint = "bind it to a known rebec of the controller"
            place = ((rebec.name_span, "the robot"),)
            robotics.facts.warn("RS601", first.name_span, message, hint, related=place)


# --- sensors, activities, ports ----------------------------------------------------------------


def _check_server(robotics: _Robotics, robot: ClassInfo, server: ServerSymbol) -> None:
    body = robotics.bodies.get(id(server.declaration))
    if body is None or server.owner != robot.name:
        return
    if has(server.declaration, "Sensor"):
        _check_sensor(robotics, body, server)
    events = robotics.events(body)
    moves = any(isinstance(e, Move) for e in events)
    if moves and not any(isinstance(e, Delay) for e in events):
        message = f'"{server.name}" moves the robot and takes no time'
        hint = "add delay(e), where e is the execution time of the activity"
        robotics.facts.warn("RS608", server.declaration.name_span, message, hint)


def _check_sensor(robotics: _Robotics, body: BodyFacts, server: ServerSymbol) -> None:
    facts, span = robotics.facts, server.declaration.name_span
    if not _repeats(robotics, server):
        message = f'the sensor "{server.name}" does not go on sensing on every path'
        hint = f"end it with self.{server.name}(...) after(rate)"
        facts.warn("RS603", span, message, hint)
    if not robotics.senders.get(id(server.declaration), set()) - {id(body.declaration)}:
        message = f'the sensor "{server.name}" is never started'
        hint = f"send self.{server.name}(...) in the constructor"
        facts.warn("RS604", span, message, hint)


def _repeats(robotics: _Robotics, server: ServerSymbol) -> bool:
    """Whether every path of a sensor sends it to itself after its rate."""
    symbols = robotics.facts.symbols

    def weigh(call: Call) -> int:
        again = call.after is not None and robotics.facts.value(call.after) != 0
        return int(symbols.get(id(call)) is server and again)

    body = server.declaration.body
    if body is None:
        return True
    ends = Paths(weigh, lambda _: None).sequence(body.statements)
    return all(ends[e] > 0 for e in (Exit.END, Exit.RETURN) if e in ends)


def _check_stray_ports(facts: Facts, info: ClassInfo) -> None:
    for server in info.servers:
        if server.owner == info.name and has(server.declaration, "Port"):
            message = f'@Port "{server.name}" belongs to "{info.name}", which is not a @Robot'
            hint = "the port is the way of the controller's commands to a robot"
            facts.warn("RS609", server.declaration.name_span, message, hint)


def _check_commands(robotics: _Robotics) -> None:
    facts = robotics.facts
    for body in facts.bodies:
        if not body.owner.annotated("Controller"):
            continue
        for event in body.events:
            if isinstance(event, Send) and not has(event.symbol.declaration, "Port"):
                receiver = facts.classes.get(event.receiver)
                if receiver is not None and receiver.annotated("Robot"):
                    message = (
                        f'the controller sends "{event.symbol.name}" past the port of the robot'
                    )
                    hint = "send the command to its @Port server, which can pass it on to self"
                    facts.warn("RS605", event.call.span, message, hint)
