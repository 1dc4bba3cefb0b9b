"""Changes of what only C++ for ROS 2 has: qualities of service, components, its parameters."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.layout import swapped_lines
from tests.roundtrip.mutations.package import (
    BODIES,
    Edit,
    Kind,
    Maker,
    Package,
    anywhere,
    at_end,
    at_start,
    in_files,
    within,
)
from tests.roundtrip.mutations.spelling import in_sources

_S = "setup"
_ARGUMENT = r'(const int32_t \w+ = declare_parameter<int>\(")(\w+)(", \d+,[^;]*;\n)'


def _program(pattern: str, text: str) -> Maker:
    return in_files("_node.cpp", pattern, text)


def _in_setup(pattern: str, text: str) -> Maker:
    return within(pattern, text, _S, strings=True)


def _other_class(package: Package) -> Iterator[Edit]:
    """A program that makes a node of another class."""
    for path in package.paths("_node.cpp"):
        for found in re.finditer(r"make_shared<\w+::(\w+)>", package.files[path]):
            for other in [c for c in package.classes if c != found[1]][:1]:
                yield Edit(path, *found.span(1), other)


def _logged(package: Package) -> Iterator[Edit]:
    """What a body does, told with the state."""
    for part in (p for p in package.parts if p.kind in BODIES):
        for member in package.members_of(part.owner)[:1]:
            if member.type in ("int32_t", "bool"):
                told = f'"now " << {member.name} << " of " << 1'
                text = f"  RCLCPP_INFO_STREAM(get_logger(), {told});\n"
                yield Edit(part.path, part.start, part.start, text)


_TIMER = (
    r"\g<0>  static const auto own = create_wall_timer(std::chrono::seconds(1),"
    r" [this] { mailbox_.delay(1); });\n"
)

KINDS = (
    Kind(
        "second publisher",
        _in_setup(
            r"^( *)\w+ = mailbox_\.advertise<([\w:]+)>\(\"(.*)\"\);\n",
            r'\g<0>\1create_publisher<\2>("~/\3", 1)->publish(\2());\n',
        ),
    ),
    Kind(
        "second subscription",
        _in_setup(
            r"^( *)\w+ = mailbox_\.subscribe\(\"(.*)\", &(\w+)::receive(\w+), this\);\n",
            r'\g<0>\1static const auto own = create_subscription<msg::\3\4>("~/\2", 1,\n'
            r"\1    [this](const msg::\3\4::ConstSharedPtr& msg) { receive\4(msg); });\n",
        ),
    ),
    Kind("timer in set-up", _in_setup(r"^  mailbox_\.construct.*\n", _TIMER)),
    Kind("constant declared with another name", _in_setup(r'(\("env\.\w+)"', r'\1_b"')),
    Kind("constant declared beside the others", _in_setup(r'\("env\.(\w+)"', r'("\1"')),
    Kind("argument declared with another name", anywhere(_in_setup(_ARGUMENT, r"\1\2_b\3"))),
    Kind(
        "arguments exchanged",
        anywhere(_in_setup(_ARGUMENT + "( +)" + _ARGUMENT, r"\1\6\3\4\5\2\7")),
    ),
    Kind(
        "argument of another type",
        _in_setup(r'declare_parameter<int>(\("(?!env))', r"declare_parameter<double>\1"),
    ),
    Kind(
        "constant of another type",
        _in_setup(r'declare_parameter<int>(\("env)', r"declare_parameter<double>\1"),
    ),
    Kind("known rebec declared with another name", _in_setup(r'(\("knownrebecs\.\w+)"', r'\1_b"')),
    Kind(
        "argument a number", _in_setup(r"(const int32_t \w+ = )declare_parameter[^;]*", r"\g<1>3")
    ),
    Kind("mailbox not started", _in_setup(r"^  mailbox_\.start\(\);\n", "")),
    Kind("mailbox started twice", _in_setup(r"^  mailbox_\.start\(\);\n", r"\g<0>\g<0>")),
    Kind("mailbox not stopped", in_files(".h", r"mailbox_\.stop\(\); ", "")),
    Kind("state volatile", _in_setup(r"\.transient_local\(\)", "")),
    Kind("state best effort", _in_setup(r"\.transient_local\(\)", r"\g<0>.best_effort()")),
    Kind("component not registered", in_files(".cpp", r"^RCLCPP_COMPONENTS_REGISTER.*\n", "")),
    Kind(
        "components not built",
        in_files("CMakeLists.txt", r"^rclcpp_components_register_nodes\([^)]*\)\n", ""),
    ),
    Kind("program of another class", _other_class),
    Kind("program does not spin", _program(r"^ *rclcpp::spin.*\n", "")),
    Kind("program takes part in nothing", _program(r"^ *rclcpp::init.*\n", "")),
    Kind(
        "program gives parameters",
        _program(
            r"NodeOptions\(\)", 'NodeOptions().parameter_overrides({{"mailbox.time_unit", 2.0}})'
        ),
    ),
    Kind(
        "program renames topics",
        _program(r"NodeOptions\(\)", 'NodeOptions().arguments({"--ros-args", "-r", "~/a:=b"})'),
    ),
)

_LOG = "  RCLCPP_INFO(get_logger(), {});\n"

NEUTRAL = (
    Kind("RCLCPP_INFO", at_start(_LOG.format('"here: %d", 1'), *BODIES)),
    Kind(
        "RCLCPP_DEBUG_STREAM",
        at_start('  RCLCPP_DEBUG_STREAM(get_logger(), "at " << 1);\n', *BODIES),
    ),
    Kind(
        "RCLCPP_WARN in the end",
        at_end(
            '  RCLCPP_WARN_THROTTLE(get_logger(), *get_clock(), 1000, "end");\n',
            "constructor",
            "msgsrv",
        ),
    ),
    Kind(
        "logged with another logger",
        at_start('  RCLCPP_INFO(rclcpp::get_logger("own"), "here");\n', *BODIES),
    ),
    Kind("logged where received", at_start(_LOG.format('"received"'), "receive")),
    Kind("logged where sent", at_start(_LOG.format('"sent"'), "send")),
    Kind("logged in set-up", at_end(_LOG.format('"ready"'), _S)),
    Kind(
        "logged in the program",
        _program(r"^( +rclcpp::spin)", r'  RCLCPP_INFO(rclcpp::get_logger("main"), "up");\n\1'),
    ),
    Kind(
        "parameters declared in another order",
        swapped_lines(r"  \w+_ = declare_parameter<int>\([^\n]*;", ".cpp"),
    ),
    Kind(
        "another description", _in_setup(r'described\("constant of the model"', 'described("own"')
    ),
    Kind(
        "descriptions on their own lines",
        _in_setup(r", described\(", ",\n      described("),
    ),
    Kind(
        "macro that logs",
        in_sources(
            r"^(namespace \{\n)", r'#define OWN(x) RCLCPP_INFO(rclcpp::get_logger("x"), x)\n\1'
        ),
    ),
    Kind(
        "logged where the state is told",
        in_sources(r"^(  state_pub_->publish)", r'  RCLCPP_DEBUG(get_logger(), "told");\n\1'),
    ),
    Kind(
        "logged with what is served",
        at_start(_LOG.format('"at %ld", static_cast<long>(mailbox_.now())'), *BODIES),
    ),
    Kind("log of a state variable", _logged),
    Kind(
        "this-> before a declaration",
        _in_setup(r"(?<= = )(?=declare_parameter<|create_publ)", "this->"),
    ),
    Kind(
        "auto argument",
        _in_setup(r"const int32_t (\w+ = declare_parameter<int>)", r"const auto \1"),
    ),
    Kind("QoS on more lines", _in_setup(r"(QoS\(kQueueSize\))", r"\1\n          ")),
    Kind(
        "warnings of the build",
        in_files("CMakeLists.txt", r"^(find_package\(Threads .*\n)", r"\1# mine\n"),
    ),
)
