"""Slips of people: a name changed in one of its places, an entry of another type, a `self` missing.

Those of Python, those of C++ for ROS 2, and those of parameters, builds and launch files.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.choices import stepped
from tests.roundtrip.mutations.package import (
    Edit,
    Kind,
    Maker,
    Mutant,
    Package,
    Texts,
    anywhere,
    in_files,
    kinds_in,
    within,
)
from tests.roundtrip.mutations.surroundings import constants, run_time

_S = "setup"
_MESSAGES = r"^(?:generate_messages\(\)|rosidl_generate_interfaces\([^)]*\))\n"


def _constant(text: str) -> Maker:
    """A constant of the model among the parameters, given otherwise; the value is the third."""

    def make(package: Package) -> Iterator[Edit]:
        for path, found in constants(package):
            yield Edit(path, *found.span(), found.expand(text), found[2])

    return make


def _defined(kind: str) -> Maker:
    """A function whose name is another where it is defined, and nowhere else."""

    def make(package: Package) -> Iterator[Edit]:
        for part in (p for p in package.parts if p.kind == kind):
            text = package.files[part.path]
            head = text.rindex("def ", 0, part.start) + len("def ")
            end = text.index("(", head)
            element = part.owner if kind == "receive" else part.element
            yield Edit(part.path, end, end, "_b", element)

    return make


def _other_component(package: Package) -> Iterator[Edit]:
    """Another class in the place of the one that a source registers."""
    for path in package.paths(".cpp"):
        for found in re.finditer(r"REGISTER_NODE\(\w+::(\w+)\)", package.files[path]):
            for other in [c for c in package.classes if c != found[1]][:1]:
                yield Edit(path, *found.span(1), other)


def _renamed_package(package: Package) -> Iterator[Mutant]:
    """A package that has another name than all that refers to it, as launch files for rebecs do."""
    named = re.compile(r'(?:<node | )name="(\w+)"')
    rebecs = {n for p in package.files if "launch/" in p for n in named.findall(package.files[p])}
    for path in package.paths("package.xml"):
        text = re.sub(r"<name>(\w+)<", r"<name>\1_b<", package.files[path])
        yield Mutant({path: text}, path, tuple(sorted(rebecs)))


def _in_bodies(pattern: str, text: Texts) -> Maker:
    return within(pattern, text)


PYTHON = (
    Kind("constant one smaller", _in_bodies(r"(?<![\w.\[])[1-9]\d*\b", stepped(-1))),
    Kind("self dropped where it is set", _in_bodies(r"\bself\.(?=_\w+ = )", "")),
    Kind("self dropped where it is read", _in_bodies(r"(?<=[ (])self\.(?=_\w+\b(?! =)(?!\.))", "")),
    Kind("self dropped from a send", _in_bodies(r"\bself\.(?=send_)", "")),
    Kind("is not for ==", _in_bodies(r" == (?=True\b|False\b)", " is not ")),
    Kind("server of another name where defined", _defined("msgsrv")),
    Kind("handler of another name where defined", _defined("receive")),
    Kind("send of another name where defined", _defined("send")),
    Kind(
        "handler of another name where given",
        within(r"(?<=self\._receive)(?=_\w+)", "_b", _S, strings=True),
    ),
    Kind("member of another name where set up", within(r"(?<=self\._)(?=\w+: \w+ = )", "b_", _S)),
    Kind("depth of a topic", run_time(r"^QUEUE_SIZE = \d+", "QUEUE_SIZE = 1")),
)

PYTHON_NEUTRAL = (
    Kind("is for == of a truth", _in_bodies(r" == (?=True\b|False\b)", " is ")),
    Kind("times by position", _in_bodies(r"When\(after=(\w+)\)", r"When(\1)")),
)

RCLPY = (
    Kind("state not kept", run_time(r"TRANSIENT_LOCAL", "VOLATILE")),
    Kind("depth of what is kept", run_time(r"depth=QUEUE_SIZE", "depth=1")),
)

RCLCPP = (
    Kind(
        "stand-in by the wall clock",
        in_files(
            "_stand_in.cpp",
            r"rclcpp::create_timer\(node, node->get_clock\(\),\n *(\w+_period \* 0\.5)",
            r"node->create_wall_timer((\1).to_chrono<std::chrono::nanoseconds>()",
        ),
    ),
    Kind(
        "timer of the run-time part by the wall clock", run_time(r"get_clock\(\)", "wall_clock()")
    ),
    Kind("topics best effort", run_time(r"(kQueueSize\)\))\.reliable\(\)", r"\1.best_effort()")),
    Kind("topics kept", run_time(r"\.reliable\(\)", ".reliable().transient_local()")),
    Kind("depth of a topic", run_time(r"kQueueSize = \d+", "kQueueSize = 1")),
    Kind(
        "subscription in a group of its own",
        run_time(
            r"unfailing<rclcpp::SubscriptionOptions>\(topic\)",
            r"of_own_group(topic)",
        ),
    ),
    Kind("another component", _other_component),
    Kind(
        "several threads",
        in_files(
            "_node.cpp",
            r"^( *)rclcpp::spin\((.*)\);$",
            r"\1rclcpp::executors::MultiThreadedExecutor executor;\n"
            r"\1executor.add_node(\2);\n\1executor.spin();",
        ),
    ),
    Kind(
        "spins once",
        in_files("_node.cpp", r"rclcpp::spin\(", "rclcpp::spin_some("),
    ),
)

ANY = (
    Kind("constant made a text", _constant(r"\1\2: '\3'")),
    Kind("constant made a fraction", _constant(r"\1\2: \3.5")),
    Kind("constant made a truth", _constant(r"\1\2: true")),
    Kind("constant under another name", anywhere(_constant(r"\1\2_b: 1\3"))),
    Kind("unit of time made a text", in_files("params.yaml", r"(time_unit: ).*$", r"\1'slow'")),
    Kind("no messages", in_files("CMakeLists.txt", _MESSAGES, "")),
    Kind(
        "parameters not installed by CMake",
        in_files("CMakeLists.txt", r"DIRECTORY config launch", "DIRECTORY launch"),
    ),
    Kind("package of another name", _renamed_package),
)

LAUNCH_PY = kinds_in(
    ".launch.py",
    {
        "parameter of one node": (
            r"^( +)(system,)$",
            r'\1\2\n\1{"mailbox.time_unit": 2.0},',
        ),
        "argument set again": (r'^( +)("\w+": )(\d+),$', r"\1\2\3,\n\1\g<2>9\3,"),
    },
)

# What launch_ros reads as YAML, where a node takes a number.
LAUNCH_PY_NEUTRAL = kinds_in(
    ".launch.py", {"argument given as a text": (r'^( +"\w+": )([1-9]\d*),$', r'\1"\2",')}
)

LAUNCH_XML = kinds_in(
    ".launch",
    {
        "argument given as a text": (
            r'(<param name="\w+" )value="([1-9]\d*)"',
            r'\1value="\2" type="str"',
        ),
        "unit of time set again": (
            r"^</launch>",
            '  <param name="mailbox/time_unit" value="2.0"/>\n</launch>',
        ),
        "argument set again": (
            r'^( *)(<param name="\w+" value=")(\d+)(" type="int"/>)$',
            r"\1\2\3\4\n\1\g<2>9\3\4",
        ),
    },
)
