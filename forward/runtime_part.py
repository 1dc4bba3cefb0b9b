"""The run-time part, and what it and the nodes need of other packages, in any dialect."""

from __future__ import annotations

from rebsync.forward.cpp_types import cpp_choices
from rebsync.forward.cpp_words import CppWords
from rebsync.forward.sensors import played_sensors
from rebsync.forward.templating import fill
from rebsync.model import Call, walk
from rebsync.package import NodeClass, Package


def message_packages(package: Package) -> set[str]:
    """The packages whose messages the nodes use, without the package itself."""
    found = {"diagnostic_msgs"}
    if any(c.moves for c in package.classes):
        found.add("geometry_msgs")
        if package.settings.odometry is not None:
            found |= {"nav_msgs", "std_msgs"}
    for node in package.classes:
        found |= {s.type.partition("/")[0] for s in node.sensors if "/" in s.type}
    return found - {package.name}


def action_packages(package: Package) -> set[str]:
    """What ROS 1 has for actions, where there are any."""
    return {"actionlib", "actionlib_msgs"} if package.actions else set()


def _stems(package: Package, is_ros2: bool) -> list[str]:
    names = ["mailbox", "startup", "values", "watchdog"]
    if any(c.moves for c in package.classes):
        names.append("drive")
    if any(c.sensors for c in package.classes):
        names.append("sensor")
    if package.offers:
        names.append("clients")
    if package.services:
        names.append("services")
    if package.actions:
        names.append("actions")
    if is_ros2 and package.settings.lifecycle:
        names.append("lifecycle")
    return names


def is_timed(package: Package) -> bool:
    """Whether the model has an `after`, a deadline or a delay: else its time stands still."""
    bodies = [
        *(c.body for node in package.classes for c in node.constructors),
        *(s.body for node in package.classes for s in node.subscriptions),
        *(f.body for node in package.classes for f in node.functions),
    ]
    calls = (c for body in bodies if body is not None for c in walk(body) if isinstance(c, Call))
    return any(c.after or c.deadline or c.name == "delay" for c in calls)


def python_runtime(package: Package, dialect: str, folder: str) -> dict[str, str]:
    """The modules of the run-time part by path, in the folder of the package's modules."""
    return {
        f"{folder}/{stem}.py": fill(
            f"{'py' if stem == 'values' else dialect}/{stem}.py.j2",
            package=package.name,
            services=package.services,
            actions=package.actions,
            odometry=odometry_topic(package, dialect.startswith("ros2")),
            timed=is_timed(package),
            lifecycle=package.settings.lifecycle,
        )
        for stem in _stems(package, dialect.startswith("ros2"))
    }


def cpp_runtime(package: Package, words: CppWords) -> dict[str, str]:
    """The headers of the run-time part by path."""
    is_ros2 = words.TEMPLATES.startswith("ros2")
    return {
        f"include/{package.name}/{stem}.{words.HEADER}": fill(
            f"{words.TEMPLATES}/{stem}.{words.HEADER}.j2",
            package=package.name,
            services=package.services,
            actions=package.actions,
            odometry=odometry_topic(package, is_ros2),
            includes=_served_headers(package, words, stem),
            timed=is_timed(package),
            lifecycle=package.settings.lifecycle,
            node="lifecycle::RebecNode" if package.settings.lifecycle else "rclcpp::Node",
        )
        for stem in _stems(package, is_ros2)
    }


def odometry_topic(package: Package, is_ros2: bool) -> str:
    """The topic of the odometry; private names have a slash behind the tilde in ROS 2."""
    topic = package.settings.odometry or ""
    private = topic.startswith("~") and not topic.startswith("~/") and is_ros2
    return topic.replace("~", "~/", 1) if private else topic


def _served_headers(package: Package, words: CppWords, stem: str) -> list[str]:
    """The headers of the messages and types that services, or actions, have."""
    offers = package.actions if stem == "actions" else package.services
    found = {words.message_header(package.name, m.name) for o in offers for m in o.messages}
    return sorted(found | {words.offer_header(package.name, o) for o in offers})


def cpp_stand_in(package: Package, node: NodeClass, words: CppWords) -> str:
    """The program that plays the sensors of a class."""
    sensors = played_sensors(node, cpp_choices)
    return fill(
        f"{words.TEMPLATES}/stand_in.cpp.j2",
        package=package.name,
        node=node,
        sensors=sensors,
        includes=sorted(words.message_header(package.name, s.type) for s in sensors),
    )
