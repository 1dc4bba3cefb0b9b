"""A conceptual model becomes a first Timed Rebeca model, by the rules of thesis section 3.2.

Robots become `@Robot` classes, their properties state variables, their activities message servers
that `delay`, their sensors servers that send to themselves, their command port a `@Port` server;
the controller becomes a `@Controller` class that knows all robots, and they know it.
"""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.concept import ROBOT_ID, Activity, Concept, Controller, Robot, Sensor, Variable
from rebsync.grammars.formatting import format_text


def skeleton(concept: Concept) -> str:
    """The text of the model, in the canonical layout, with remarks where to go on."""
    parts = [*_constants(concept)]
    if concept.controller:
        parts += _controller_class(concept, concept.controller)
    for robot in concept.robots:
        parts += _robot_class(concept, robot)
    parts += _main(concept)
    return format_text("\n".join(parts) + "\n")


# --- constants ---------------------------------------------------------------------------------


def _constants(concept: Concept) -> Iterator[str]:
    for owner, names in _times(concept).items():
        if names:
            yield f"// {owner}"
        for name, value in names:
            yield f"env int {name} = {value};"


def _times(concept: Concept) -> dict[str, list[tuple[str, int]]]:
    times: dict[str, list[tuple[str, int]]] = {}
    if controller := concept.controller:
        owner = f"Execution times of the tasks of {controller.name}."
        times[owner] = [
            (_constant(controller.name, t.name, "Time"), t.time) for t in controller.tasks
        ]
    for robot in concept.robots:
        owner = f"Execution times of the activities of {robot.name}."
        times[owner] = [(_constant(robot.name, a.name, "Time"), a.time) for a in robot.activities]
        owner = f"Rates of the sensors of {robot.name}."
        times[owner] = [(_constant(robot.name, s.name, "Rate"), s.rate) for s in robot.sensors]
    return times


def _constant(owner: str, name: str, kind: str) -> str:
    return f"{owner}_{name}{kind}"


# --- robots ------------------------------------------------------------------------------------


def _robot_class(concept: Concept, robot: Robot) -> Iterator[str]:
    controller = concept.controller
    queue = len(robot.activities) + len(robot.sensors) + 2
    yield f"@Robot\nreactiveclass {robot.name}({queue}) {{"
    yield f"knownrebecs {{ {f'{controller.name} {controller.instance};' if controller else ''} }}"
    yield "statevars {"
    if controller:
        yield f"int {ROBOT_ID};  // by which the controller knows this robot"
    yield from _declarations(robot.properties)
    yield "}"
    yield from _robot_constructor(robot, controller)
    if controller:
        yield from _port(robot)
    for number, activity in enumerate(robot.activities):
        yield from _activity(robot, number, activity, controller)
    for sensor in robot.sensors:
        yield from _sensor(robot, sensor)
    yield "}"


def _declarations(variables: tuple[Variable, ...]) -> Iterator[str]:
    for variable in variables:
        sizes = "".join(f"[{size}]" for size in variable.dimensions)
        yield f"{variable.type}{sizes} {variable.name};"


def _robot_constructor(robot: Robot, controller: Controller | None) -> Iterator[str]:
    number = _free("number", {each.name for each in robot.properties})
    yield f"{robot.name}({f'int {number}' if controller else ''}) {{"
    if controller:
        yield f"{ROBOT_ID} = {number};"
    yield from _initial_values(robot.properties)
    for sensor in robot.sensors:
        yield f"self.{sensor.name}();"
    if not controller and robot.activities:
        yield f"self.{robot.activities[0].name}();"
    yield "}"


def _initial_values(variables: tuple[Variable, ...]) -> Iterator[str]:
    for variable in variables:
        for place in _places(variable.dimensions):
            yield f"{variable.name}{place} = {_initial(variable)};"


def _places(dimensions: tuple[int, ...]) -> Iterator[str]:
    if not dimensions:
        yield ""
        return
    for index in range(dimensions[0]):
        for rest in _places(dimensions[1:]):
            yield f"[{index}]{rest}"


def _initial(variable: Variable) -> str:
    unset = {"boolean": "false", "float": "0.0", "double": "0.0"}
    return variable.initial or unset.get(variable.type, "0")


def _port(robot: Robot) -> Iterator[str]:
    yield f"// Commands of the controller: {_commands(robot)}.\n@Port"
    activity_ = _free("activity", {each.name for each in robot.properties})
    yield f"msgsrv {robot.port}(int {activity_}) {{"
    if robot.activities:
        yield f"switch ({activity_}) {{"
        for number, activity in enumerate(robot.activities, start=1):
            yield f"case {number}: self.{activity.name}(); break;"
        yield "}"
    yield "}"


def _commands(robot: Robot) -> str:
    listed = (f"{i} is {a.name}" for i, a in enumerate(robot.activities, start=1))
    return ", ".join(listed) or "none so far"


def _activity(
    robot: Robot, number: int, activity: Activity, controller: Controller | None
) -> Iterator[str]:
    yield f"msgsrv {activity.name}() {{"
    if activity.move:
        yield f"@Move({_step('X', activity.move[0])}, {_step('Y', activity.move[1])});"
    yield f"delay({_constant(robot.name, activity.name, 'Time')});"
    if controller and controller.tasks:
        yield f"{controller.instance}.{controller.tasks[0].name}({ROBOT_ID});"
    else:
        following = robot.activities[(number + 1) % len(robot.activities)]
        yield "// Decide here what to do next."
        yield f"self.{following.name}();"
    yield "}"


def _step(axis: str, amount: int) -> str:
    return axis if not amount else f"{axis} {'+' if amount > 0 else '-'} {abs(amount)}"


def _sensor(robot: Robot, sensor: Sensor) -> Iterator[str]:
    yield f"@Sensor\nmsgsrv {sensor.name}() {{"
    kinds = {each.name: each.type for each in robot.properties}
    if sensor.sets:
        yield "// All values that may be sensed."
        yield f"{sensor.sets} = {_sensed(kinds[sensor.sets])};"
    else:
        yield "// Put what is sensed into a state variable: near = ?(true, false);"
    yield f"self.{sensor.name}() after({_constant(robot.name, sensor.name, 'Rate')});"
    yield "}"


def _sensed(type_: str) -> str:
    match type_:
        case "boolean":
            return "?(true, false)"
        case "float" | "double":
            return "?(0.0, 1.0)"
        case _:
            return "?(0, 1)"


# --- the controller and main -------------------------------------------------------------------


def _controller_class(concept: Concept, controller: Controller) -> Iterator[str]:
    count = sum(len(robot.instances) for robot in concept.robots)
    yield f"@Controller\nreactiveclass {controller.name}({count + 1}) {{"
    yield "knownrebecs {"
    for robot in concept.robots:
        yield f"{robot.name} {', '.join(robot.instances)};"
    yield "}\nstatevars {"
    yield from _declarations(controller.variables)
    yield f"}}\n{controller.name}() {{"
    yield from _initial_values(controller.variables)
    if controller.tasks:
        for number in range(count):
            yield f"self.{controller.tasks[0].name}({number});"
    yield "}"
    for number, task in enumerate(controller.tasks):
        following = controller.tasks[number + 1 :]
        yield from _task(concept, controller, task, following[0] if following else None)
    yield "}"


def _task(
    concept: Concept, controller: Controller, task: Activity, following: Activity | None
) -> Iterator[str]:
    instances = [(r, i) for r in concept.robots for i in r.instances]
    robot_ = _free("robot", {i for _, i in instances} | {v.name for v in controller.variables})
    yield f"msgsrv {task.name}(int {robot_}) {{"
    yield f"delay({_constant(controller.name, task.name, 'Time')});"
    if following:
        yield f"self.{following.name}({robot_});"
    else:
        yield f"// Decide here which robot may do what.\nswitch ({robot_}) {{"
        for number, (robot, instance) in enumerate(instances):
            yield f"case {number}: {instance}.{robot.port}({min(len(robot.activities), 1)}); break;"
        yield "}"
    yield "}"


def _free(name: str, taken: set[str]) -> str:
    """The name, or a longer one where it would hide another."""
    return _free(f"{name}_", taken) if name in taken else name


def _main(concept: Concept) -> Iterator[str]:
    controller = concept.controller
    instances = [(r, i) for r in concept.robots for i in r.instances]
    yield "main {"
    if controller:
        bound = ", ".join(instance for _, instance in instances)
        yield f"{controller.name} {controller.instance}({bound}):();"
    for number, (robot, instance) in enumerate(instances):
        if controller:
            yield f"{robot.name} {instance}({controller.instance}):({number});"
        else:
            yield f"{robot.name} {instance}():();"
    yield "}"
