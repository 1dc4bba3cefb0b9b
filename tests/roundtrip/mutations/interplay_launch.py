"""What launch files put over parameters, topics and nodes that other files and nodes give.

A constant that is hidden, a condition, what an argument or the environment decides, another launch
file, and a namespace or a remap for all.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from tests.roundtrip.mutations import launch_py, launch_xml
from tests.roundtrip.mutations.package import (
    Edit,
    Kind,
    Maker,
    Mutant,
    Package,
    anywhere,
    in_files,
    kinds_in,
)
from tests.roundtrip.mutations.surroundings import constants

_XML, _PY = ".launch", ".launch.py"
_HEAD = r"^<launch>\n"
_END = r"^</launch>"
_LIST = r"^(    return LaunchDescription\(\n        \[\n)"
_NODES = r"^from launch_ros\.actions import Node$"


def hidden(text: str, suffix: str, pattern: str) -> Maker:
    """A constant of the model given again; in the text `NAME` and `VALUE` stand for another."""

    def make(package: Package) -> Iterator[Edit]:
        for _, found in constants(package):
            new = text.replace("NAME", found[2]).replace("VALUE", str(int(found[3]) + 3))
            yield from (e for e in in_files(suffix, pattern, new)(package) if isinstance(e, Edit))

    return make


def _from_another_launch_file(package: Package) -> Iterator[Mutant]:
    """A constant that another launch file gives again, which is included."""
    for _, found in constants(package):
        for launch in package.paths(_XML):
            other = launch.replace(f"{package.name}.launch", "more.launch")
            value = int(found[3]) + 3
            more = f'<launch>\n  <param name="{found[2]}" value="{value}" type="int"/>\n</launch>\n'
            name = f"$(find {package.name})/launch/more.launch"
            text = package.files[launch].replace(
                "</launch>", f'  <include file="{name}"/>\n</launch>'
            )
            yield Mutant({other: more, launch: text}, launch)


def rebecs(package: Package) -> list[tuple[str, str, re.Match[str]]]:
    """The launch files and names of all rebecs, and where these are."""
    in_xml = [(path, node[1], node) for path, node in launch_xml.rebecs(package)]
    return [*in_xml, *launch_py.rebecs(package)]


def _same_topic(pattern: str) -> Maker:
    """A remap to what another of the same node leads to."""

    def make(package: Package) -> Iterator[Edit]:
        for path, name, node in rebecs(package):
            found = list(re.finditer(pattern, node[0]))
            for one, other in pairwise(found):
                start = node.start() + one.start(1)
                yield Edit(path, start, start + len(one[1]), other[1], name)

    return make


_PARAM = '<param name="NAME" value="VALUE" type="int"/>'
_OPEN = r"^( *<node (?!.*stand_in).*>\n)"
_VALUE = r'^( *<param name="\w+" value=")(\d+)(" type="int"/>)$'

XML = (
    Kind(
        "constant hidden by the launch file",
        anywhere(hidden(f"  {_PARAM}\n</launch>", _XML, _END)),
    ),
    Kind(
        "constant hidden in a text of parameters",
        anywhere(hidden("  <rosparam>{NAME: VALUE}</rosparam>\n</launch>", _XML, _END)),
    ),
    Kind("constant hidden by another launch file", _from_another_launch_file),
    *kinds_in(
        _XML,
        {
            "another launch file included": (
                _END,
                r'  <include file="$(find other)/launch/other.launch"/>\n</launch>',
            ),
            "remap for all nodes": (
                r'^<launch>\n((?:.*\n)*?.*<remap from="~[^"]*" to="\w+/(\w+)")',
                r'<launch>\n  <remap from="~\2" to="/other"/>\n\1',
            ),
            "node unless": (r"^  <node (?!.*stand_in)", r'  <node unless="true" '),
            "node if an argument says so": (
                r"^<launch>\n((?:.*\n)*?)  <node ",
                r'<launch>\n  <arg name="with" default="false"/>\n\1  <node if="$(arg with)" ',
            ),
            "node only if an argument does not say no": (
                r"^<launch>\n((?:.*\n)*?)  <node ",
                r'<launch>\n  <arg name="with" default="true"/>\n\1  <node if="$(arg with)" ',
            ),
            "node in nested namespaces": (
                r"^(  <node (?!.*stand_in).*>\n(?:    .*\n)*  </node>\n)",
                r'  <group ns="a">\n  <group ns="b">\n\1  </group>\n  </group>\n',
            ),
            "node in a namespace of its own": (r"^  <node (?!.*stand_in)", r'  <node ns="other" '),
            "node in a namespace by the environment": (
                _OPEN,
                r'\1    <env name="ROS_NAMESPACE" value="other"/>\n',
            ),
            "node with arguments": (
                r"^  <node (?!.*stand_in)",
                r'  <node args="__name:=another" ',
            ),
            "argument by the environment": (_VALUE, r"\1$(optenv OWN 9\2)\3"),
            "argument by a command": (
                r'^( *<param name="\w+" )value="(\d+)"( type="int"/>)$',
                r'\1command="echo 9\2"\3',
            ),
            "argument by an arg of another value": (
                r"^<launch>\n((?:.*\n)*?.*value=\")(\d+)\" type=\"int\"",
                r'<launch>\n  <arg name="own" default="9\2"/>\n\1$(arg own)" type="int"',
            ),
        },
        comments=True,
    ),
    Kind("remap to the same topic", _same_topic(r'<remap .* to="([^"]*)"')),
)

XML_NEUTRAL = kinds_in(
    _XML,
    {
        "node if true": (r"^  <node ", r'  <node if="true" '),
        "node unless false": (r"^  <node ", r'  <node unless="false" '),
        "node in a group": (
            r"^(  <node (?!.*stand_in).*>\n(?:    .*\n)*  </node>\n)",
            r"  <group>\n\1  </group>\n",
        ),
        "how lines are logged": (_OPEN, r'\1    <env name="ROSCONSOLE_FORMAT" value="m"/>\n'),
        "unused argument": (_HEAD, '<launch>\n  <arg name="unused" default="3"/>\n'),
    },
    comments=True,
)


def _with_import(module: str, name: str, pattern: str, text: str) -> Maker:
    """In the launch file, and the import of what it takes."""
    compiled = re.compile(pattern, re.MULTILINE)

    def make(package: Package) -> Iterator[list[Edit]]:
        for path in package.paths(_PY):
            line = re.search(_NODES, package.files[path], re.MULTILINE)
            for found in compiled.finditer(package.files[path]):
                if line is not None and "_stand_in" not in found[0]:
                    new = f"from {module} import {name}\n"
                    yield [
                        Edit(path, *found.span(), found.expand(text)),
                        Edit(path, line.start(), line.start(), new),
                    ]

    return make


_INNER = r'^( {16})(name="(?!\w+_stand_in)\w+",\n)'
_GIVEN = r'^( {24}"\w+": )(\d+),$'
_DECLARED = r"^(    return LaunchDescription\(\n        \[\n)((?:.*\n)*?)"

PY = (
    Kind(
        "constant hidden by the launch file",
        anywhere(hidden('\\1        "env.NAME": VALUE,\n', _PY, r"^(    system = \{\n)")),
    ),
    Kind(
        "remap for all nodes",
        _with_import(
            "launch_ros.actions",
            "SetRemap",
            _DECLARED + r'(.*\("~/[^"]*", "\w+/)(\w+)"',
            r'\1            SetRemap("~/\4", "/other"),\n\2\3\4"',
        ),
    ),
    Kind(
        "another launch file included",
        _with_import(
            "launch.actions",
            "IncludeLaunchDescription",
            _LIST,
            r'\1            IncludeLaunchDescription("other.launch.py"),\n',
        ),
    ),
    Kind(
        "a function that makes more",
        _with_import(
            "launch.actions",
            "OpaqueFunction",
            _LIST,
            r"\1            OpaqueFunction(function=lambda context: []),\n",
        ),
    ),
    Kind(
        "node unless",
        _with_import(
            "launch.conditions",
            "UnlessCondition",
            _INNER,
            r'\1condition=UnlessCondition("true"),\n\1\2',
        ),
    ),
    Kind(
        "node if an argument says so",
        _with_import(
            "launch.conditions",
            "IfCondition\nfrom launch.actions import DeclareLaunchArgument\n"
            "from launch.substitutions import LaunchConfiguration",
            _DECLARED + r'( {16}name="(?!\w+_stand_in)\w+",\n)',
            r'\1            DeclareLaunchArgument("with", default_value="false"),\n\2'
            r'                condition=IfCondition(LaunchConfiguration("with")),\n\3',
        ),
    ),
    Kind(
        "argument by the environment",
        _with_import(
            "launch.substitutions",
            "EnvironmentVariable",
            _GIVEN,
            r'\1EnvironmentVariable("OWN", default_value="9\2"),',
        ),
    ),
    Kind(
        "argument by a launch argument of another value",
        _with_import(
            "launch.actions",
            "DeclareLaunchArgument\nfrom launch.substitutions import LaunchConfiguration",
            _DECLARED + r'( {24}"\w+": )(\d+),\n',
            r'\1            DeclareLaunchArgument("own", default_value="9\4"),\n\2'
            r'\3LaunchConfiguration("own"),\n',
        ),
    ),
    *kinds_in(
        _PY,
        {
            "node in a domain of its own": (
                _INNER,
                r'\1additional_env={"ROS_DOMAIN_ID": "9"},\n\1\2',
            ),
            "node with arguments of ROS": (
                _INNER,
                r'\1ros_arguments=["-r", "__node:=another"],\n\1\2',
            ),
        },
    ),
    Kind("remap to the same topic", _same_topic(r'\("~/[^"]*", ("[^"]*")\)')),
)

PY_NEUTRAL = (
    Kind(
        "namespace of all nodes",
        _with_import(
            "launch_ros.actions",
            "PushRosNamespace",
            _LIST,
            r'\1            PushRosNamespace("a"),\n',
        ),
    ),
    *kinds_in(
        _PY,
        {
            "remap of something else": (
                r'^( {20})(\("~/[^\n]*\n)',
                r'\1("/tf", "/robot/tf"),\n\1\2',
            ),
            "terminal as it is": (_INNER, r"\1emulate_tty=True,\n\1\2"),
        },
    ),
)
