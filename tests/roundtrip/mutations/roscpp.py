"""Changes of what only C++ for ROS 1 has: node handles, programs that spin, its log."""

from __future__ import annotations

from collections.abc import Iterator

from tests.roundtrip.mutations.layout import swapped_lines
from tests.roundtrip.mutations.package import (
    BODIES,
    Edit,
    Kind,
    Maker,
    Package,
    at_end,
    at_start,
    in_files,
    within,
)
from tests.roundtrip.mutations.spelling import in_sources


def _program(pattern: str, text: str) -> Maker:
    return in_files("_node.cpp", pattern, text)


def _logged(package: Package) -> Iterator[Edit]:
    """What a body does, told with the state."""
    for part in (p for p in package.parts if p.kind in BODIES):
        for member in package.members_of(part.owner)[:1]:
            if member.type in ("int32_t", "bool"):
                text = f'  ROS_INFO_STREAM("now " << {member.name} << " of " << 1);\n'
                yield Edit(part.path, part.start, part.start, text)


KINDS = (
    Kind(
        "second publisher",
        within(
            r"^( *)\w+ = mailbox_\.advertise<(\w+)>\((.*)\);\n",
            r"\g<0>\1ros::NodeHandle(node).advertise<\2>(\3, 1).publish(\2());\n",
            "setup",
            strings=True,
        ),
    ),
    Kind("state not latched", within(r"(\"state\", \w+), true\)", r"\1)", "setup", strings=True)),
    Kind("program reads another parameter", _program(r'(node\.param\("\w+)"', r'\1_b"')),
    Kind(
        "program exchanges parameters",
        _program(r'(param\(")(\w+)(", 0\),\s+node\.param\(")(\w+)"', r'\1\4\3\2"'),
    ),
    Kind("program does not start", _program(r"^ *rebec\.mailbox\(\)\.start.*\n", "")),
    Kind("program does not receive", _program(r"^ *reception\.start.*\n", "")),
    Kind("program ends at once", _program(r"^ *ros::waitForShutdown.*\n", "")),
    Kind("program of another node", _program(r'NodeHandle node\("~"\)', 'NodeHandle node("~b")')),
)

NEUTRAL = (
    Kind("ROS_INFO", at_start('  ROS_INFO("here: %d", 1);\n', *BODIES)),
    Kind("ROS_DEBUG_STREAM", at_start('  ROS_DEBUG_STREAM("at " << 1);\n', *BODIES)),
    Kind(
        "ROS_WARN in the end", at_end('  ROS_WARN_THROTTLE(1.0, "end");\n', "constructor", "msgsrv")
    ),
    Kind("logged where received", at_start('  ROS_INFO("received");\n', "receive")),
    Kind("logged where sent", at_start('  ROS_INFO("sent");\n', "send")),
    Kind("logged in set-up", at_end('  ROS_INFO("ready");\n', "setup")),
    Kind("logged in the program", _program(r"^(  ros::AsyncSpinner)", r'  ROS_INFO("up");\n\1')),
    Kind(
        "parameters read in another order", swapped_lines(r"  \w+_ = global\.param[^\n]*;", ".cpp")
    ),
    Kind("macro that logs", in_sources(r"^(namespace \{\n)", r"#define OWN(x) ROS_INFO(x)\n\1")),
    Kind(
        "logged where the state is told",
        in_sources(r"^(  state_pub_\.publish)", r'  ROS_DEBUG("told");\n\1'),
    ),
    Kind(
        "logged with what is served",
        at_start('  ROS_INFO("at %ld", static_cast<long>(mailbox_.now()));\n', *BODIES),
    ),
    Kind("log of a state variable", _logged),
)
