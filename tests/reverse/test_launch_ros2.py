"""Launch files of ROS 2: what they start is the same in Python, XML and YAML."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from rebsync.reverse.files.python_files import is_launch_of_ros_2
from rebsync.reverse.launch.launch_files_ros2 import read_ros2_launch, speaks_ros_2
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.unknowns import Open, Unknown
from rebsync.source import Source

PYTHON, XML, YAML = "a.launch.py", "a.launch.xml", "a.launch.yaml"
FILES = {
    "config/p.yaml": "/**:\n  ros__parameters: {all: 1}\nn:\n  ros__parameters: {own.x: 2}\n",
    "launch/in.launch.xml": '<launch><arg name="who" default="in"/>'
    '<node pkg="p" exec="i" name="$(var who)"/></launch>',
}
# The same in the three languages, and the nodes: namespace and name, parameters, remappings,
# conditions; then what is unknown.
CASES: dict[str, tuple[dict[str, str], list[str], list[str]]] = {
    "a node": (
        {
            PYTHON: "Node(package='p', executable='e', name='n', namespace='s',"
            " parameters=[{'a': {'b': -1}, 'c': 'x'}], remappings=[('t', 'u')])",
            XML: '<node pkg="p" exec="e" name="n" namespace="s"><param name="a">'
            '<param name="b" value="-1"/></param><param name="c" value="x"/>'
            '<remap from="t" to="u"/></node>',
            YAML: "- node: {pkg: p, exec: e, name: n, namespace: s, param: ["
            "{name: a, param: [{name: b, value: -1}]}, {name: c, value: x}],"
            " remap: [{from: t, to: u}]}",
        },
        ["/s/n p e {a/b: -1, c: x} [t=u]"],
        [],
    ),
    "arguments": (
        {
            PYTHON: "DeclareLaunchArgument('k', default_value='2.5'), DeclareLaunchArgument('z'),"
            "Node(package='p', executable='e', name=['n', LaunchConfiguration('k')],"
            " parameters=[{'x': LaunchConfiguration('k'), 'y': LaunchConfiguration('z')}])",
            XML: '<arg name="k" default="2.5"/><arg name="z"/><node pkg="p" exec="e"'
            ' name="n$(var k)"><param name="x" value="$(var k)"/>'
            '<param name="y" value="$(var z)"/></node>',
            YAML: "- arg: {name: k, default: '2.5'}\n- arg: {name: z}\n- node: {pkg: p, exec: e,"
            " name: n$(var k), param: [{name: x, value: $(var k)}, {name: y, value: $(var z)}]}",
        },
        ["/n2.5 p e {x: 2.5, y: ?} []"],
        ["the parameter `y`: the argument `z` is not given, and has no default"],
    ),
    "groups": (
        {
            PYTHON: "GroupAction([PushRosNamespace('g'), SetRemap('a', 'b'), SetParameter('s', 1),"
            " SetLaunchConfiguration('v', 'w'), Node(package='p', executable='e', name='n')]),"
            " Node(package='p', executable='e', name='o')",
            XML: '<group><push-ros-namespace namespace="g"/><set_remap from="a" to="b"/>'
            '<set_parameter name="s" value="1"/><let name="v" value="w"/>'
            '<node pkg="p" exec="e" name="n"/></group><node pkg="p" exec="e" name="o"/>',
            YAML: "- group:\n  - push_ros_namespace: {namespace: g}\n"
            "  - set_remap: {from: a, to: b}\n  - set_parameter: {name: s, value: 1}\n"
            "  - let: {name: v, value: w}\n"
            "  - node: {pkg: p, exec: e, name: n}\n- node: {pkg: p, exec: e, name: o}",
        },
        ["/g/n p e {s: 1} [a=b]", "/o p e {} []"],
        [],
    ),
    "conditions": (
        {
            PYTHON: "DeclareLaunchArgument('k', 'True'), Node(package='p', executable='e',"
            " name='a', condition=IfCondition(LaunchConfiguration('k'))),"
            " Node(package='p', executable='e', name='b',"
            " condition=UnlessCondition(LaunchConfiguration('k')))",
            XML: '<arg name="k" default="True"/><node pkg="p" exec="e" name="a" if="$(var k)"/>'
            '<node pkg="p" exec="e" name="b" unless="$(var k)"/>',
            YAML: "- arg: {name: k, default: 'True'}\n- node: {pkg: p, exec: e, name: a,"
            " if: $(var k)}\n- node: {pkg: p, exec: e, name: b, unless: $(var k)}",
        },
        ["/a p e {} []"],
        [],
    ),
    "files of parameters": (
        {
            PYTHON: "Node(package='p', executable='e', name='n', parameters=["
            "os.path.join(get_package_share_directory('here'), 'config', 'p.yaml')])",
            XML: '<node pkg="p" exec="e" name="n">'
            '<param from="$(find-pkg-share here)/config/p.yaml"/></node>',
            YAML: "- node: {pkg: p, exec: e, name: n,"
            " param: [{from: $(find-pkg-share here)/config/p.yaml}]}",
        },
        ["/n p e {all: 1, own/x: 2} []", "{/all: 1}"],
        [],
    ),
    "of another package": (
        {
            PYTHON: "Node(package='p', executable='e', name='n', parameters=["
            "PathJoinSubstitution([FindPackageShare('there'), 'config', 'p.yaml'])])",
            XML: '<node pkg="p" exec="e" name="n">'
            '<param from="$(find-pkg-share there)/config/p.yaml"/></node>',
            YAML: "- node: {pkg: p, exec: e, name: n,"
            " param: [{from: $(find-pkg-share there)/config/p.yaml}]}",
        },
        ["/n p e {**: ?} []"],
        ["parameters of a node: `share:/there/config/p.yaml` is not at hand"],
    ),
    "included": (
        {
            PYTHON: "IncludeLaunchDescription(XMLLaunchDescriptionSource(["
            "FindPackageShare('here'), '/launch/in.launch.xml']),"
            " launch_arguments={'who': 'me'}.items())",
            XML: '<include file="$(find-pkg-share here)/launch/in.launch.xml">'
            '<arg name="who" value="me"/></include>',
            YAML: "- include: {file: $(find-pkg-share here)/launch/in.launch.xml,"
            " arg: [{name: who, value: me}]}",
        },
        ["/me p i {} []"],
        [],
    ),
    "components": (
        {
            PYTHON: "ComposableNodeContainer(name='c', namespace='', package='rclcpp_components',"
            " executable='component_container', composable_node_descriptions=["
            "ComposableNode(package='p', plugin='p::N', name='n')])",
            XML: '<node_container pkg="rclcpp_components" exec="component_container" name="c"'
            ' namespace=""><composable_node pkg="p" plugin="p::N" name="n"/></node_container>',
            YAML: "- node_container: {pkg: rclcpp_components, exec: component_container, name: c,"
            " namespace: '', composable_node: [{pkg: p, plugin: 'p::N', name: n}]}",
        },
        ["/n p p::N {} []"],
        [],
    ),
    "expressions": (
        {
            PYTHON: "Node(package='p', executable='e', name='n', condition=IfCondition("
            "PythonExpression(['1 < 2'])))",
            XML: '<node pkg="p" exec="e" name="n" if="$(eval 1 &lt; 2)"/>',
            YAML: "- node: {pkg: p, exec: e, name: n, if: $(eval 1 < 2)}",
        },
        ["/n p e {} []"],
        [],
    ),
    "expressions over arguments": (
        {
            PYTHON: "DeclareLaunchArgument('k', 'sim'), DeclareLaunchArgument('z'),"
            "Node(package='p', executable='e', name='a', condition=IfCondition("
            """PythonExpression(["'", LaunchConfiguration('k'), "' == 'sim'"]))),"""
            "Node(package='p', executable='e', name='b', condition=UnlessCondition("
            """PythonExpression(["'", LaunchConfiguration('k'), "' == 'sim'"]))),"""
            "Node(package='p', executable='e', name='c', condition=IfCondition("
            """PythonExpression(["'", LaunchConfiguration('z'), "' == 'sim'"]))),"""
            "Node(package='p', executable='e', name='d', condition=IfCondition("
            "PythonExpression(['true'])))",
            XML: '<arg name="k" default="sim"/><arg name="z"/>'
            """<node pkg="p" exec="e" name="a" if="$(eval '\\'$(var k)\\' == \\'sim\\'')"/>"""
            """<node pkg="p" exec="e" name="b" unless="$(eval '\'$(var k)\' == \'sim\'')"/>"""
            """<node pkg="p" exec="e" name="c" if="$(eval '\'$(var z)\' == \'sim\'')"/>"""
            '<node pkg="p" exec="e" name="d" if="$(eval true)"/>',
            YAML: "- arg: {name: k, default: sim}\n- arg: {name: z}\n"
            '- node: {pkg: p, exec: e, name: a, if: $(eval \'"$(var k)" == "sim"\')}\n'
            '- node: {pkg: p, exec: e, name: b, unless: $(eval \'"$(var k)" == "sim"\')}\n'
            '- node: {pkg: p, exec: e, name: c, if: $(eval \'"$(var z)" == "sim"\')}\n'
            "- node: {pkg: p, exec: e, name: d, if: $(eval true)}",
        },
        ["/a p e {} []", "/c p e {} [] if", "/d p e {} [] if"],
        [],
    ),
    "comparisons": (
        {
            PYTHON: "DeclareLaunchArgument('k', '1.0'), Node(package='p', executable='e', name='a',"
            " condition=IfCondition(EqualsSubstitution(LaunchConfiguration('k'), '1'))),"
            "Node(package='p', executable='e', name=IfElseSubstitution("
            "AndSubstitution('true', NotSubstitution('false')), 'b', 'c'),"
            " condition=IfCondition(NotEqualsSubstitution(LaunchConfiguration('k'), 'x')))",
            XML: '<arg name="k" default="1.0"/>'
            '<node pkg="p" exec="e" name="a" if="$(equals $(var k) 1)"/>'
            '<node pkg="p" exec="e" name="$(if $(and true $(not false)) b c)"'
            ' if="$(not-equals $(var k) x)"/>',
            YAML: "- arg: {name: k, default: '1.0'}\n"
            "- node: {pkg: p, exec: e, name: a, if: $(equals $(var k) 1)}\n"
            "- node: {pkg: p, exec: e, name: $(if $(and true $(not false)) b c),"
            " if: $(not-equals $(var k) x)}",
        },
        ["/a p e {} []", "/b p e {} []"],
        [],
    ),
}
# What only Python can say: the actions, the nodes, and what is unknown.
ONLY_PYTHON = {
    "a function": (
        "OpaqueFunction(function=f)",
        [],
        ["the action `OpaqueFunction`: it is computed when the file runs"],
    ),
    "a set of remappings": (
        "Node(package='p', executable='e', name='n', remappings={('a', 'b')})",
        ["/n p e {} [a=b]"],
        [],
    ),
    "what starts nothing": ("ExecuteProcess(cmd=['ls']), LogInfo(msg='x')", [], []),
    "later": (
        "TimerAction(period=1.0, actions=[Node(package='p', executable='e', name='n')])",
        ["/n p e {} []"],
        [],
    ),
    "of a helper": (
        "made(3)",
        [],
        ["the action `made`: it is computed when the file runs"],
    ),
    "at an event": (
        "RegisterEventHandler(OnProcessExit(target_action=x, on_exit=["
        "Node(package='p', executable='e', name='n')]))",
        ["/n p e {} [] if"],
        ["the action `RegisterEventHandler`: it is computed when the file runs"],
    ),
    "texts of numbers": (
        "DeclareLaunchArgument('k', default_value=str(0)),"
        " Node(package='p' + str(), executable='e',"
        " name=f'n{1}', parameters=[{'a': LaunchConfiguration('k')}])",
        ["/n1 p e {a: 0} []"],
        [],
    ),
    "an argument that equals": (
        "DeclareLaunchArgument('k', 'x'), Node(package='p', executable='e', name='a', condition="
        "LaunchConfigurationEquals('k', 'x')), Node(package='p', executable='e', name='b',"
        " condition=LaunchConfigurationNotEquals(launch_configuration_name='k',"
        " expected_value='x'))",
        ["/a p e {} []"],
        [],
    ),
    "neither true nor false": (
        "Node(package='p', executable='e', name='n', condition=IfCondition("
        "OrSubstitution('maybe', 'true'))), Node(package='p', executable='e', name='m',"
        " condition=IfCondition(EqualsSubstitution('one')))",
        ["/n p e {} [] if", "/m p e {} [] if"],
        [],
    ),
    "files beside the launch file": (
        "Node(package='p', executable='e', name='n', parameters=["
        "os.path.dirname(os.path.realpath(__file__)) + '/config/p.yaml',"
        " Path(__file__).resolve().parent / 'config' / 'p.yaml',"
        " [ThisLaunchFileDir(), os.sep, 'config/p.yaml'], Path(__file__).parent.parent])",
        ["/n p e {all: ?, **: ?, own/x: 2} []", "{/all: 1}"],
        ["parameters of a node: it is computed when the file runs"],
    ),
    "a text of YAML": (
        "Node(package='p', executable='e', name='n', parameters=[{'a': ParameterValue("
        "LaunchConfiguration('k', default='1'), value_type=str), 'b': LaunchConfiguration("
        "'k', default='1')}])",
        ["/n p e {a: '1', b: 1} []"],
        [],
    ),
}
_HEAD = "from launch import *\ndef generate_launch_description():\n    "


def _text(path: str, body: str) -> str:
    if path == PYTHON:
        return f"{_HEAD}return LaunchDescription([{body}])\n"
    return f"<launch>{body}</launch>" if path == XML else f"launch:\n{body}\n"


def _read(path: str, text: str) -> Launch:
    files = {name: Source(name, content) for name, content in FILES.items()}
    return read_ros2_launch(Source(path, text), files.get, "here")


def _shown(found: Launch) -> list[str]:
    lines = []
    for node in found.nodes:
        values = {p.name: p.value for p in node.parameters}
        remaps = ", ".join(f"{r.private}={r.target}" for r in node.remaps)
        path = "?" if isinstance(node.path, Open) else node.path
        place = f"{path} {node.package} {node.type}"
        lines.append(f"{place} {_table(values)} [{remaps}]{' if' * bool(node.only_if)}")
    common = {p.name: p.value for p in found.parameters}
    return lines + ([_table(common)] if common else [])


def _table(values: Mapping[str, object]) -> str:
    shown = (f"{k}: {'?' if isinstance(v, Open) else _value(v)}" for k, v in values.items())
    return f"{{{', '.join(shown)}}}"


def _value(value: object) -> str:
    return repr(value) if isinstance(value, str) and value.isdigit() else str(value)


def _whys(unknowns: tuple[Unknown, ...]) -> list[str]:
    return [f"{u.what}: {u.why}" for u in unknowns]


@pytest.mark.parametrize("path", [PYTHON, XML, YAML])
@pytest.mark.parametrize("case", CASES)
def test_the_languages_say_the_same(case: str, path: str) -> None:
    bodies, nodes, unknowns = CASES[case]
    found = _read(path, _text(path, bodies[path]))
    assert _shown(found) == nodes
    assert _whys(found.unknowns) == unknowns


@pytest.mark.parametrize("case", ONLY_PYTHON)
def test_what_python_says(case: str) -> None:
    body, nodes, unknowns = ONLY_PYTHON[case]
    found = _read(PYTHON, _text(PYTHON, body))
    assert _shown(found) == nodes
    assert _whys(found.unknowns) == unknowns


def test_actions_that_are_added_one_by_one() -> None:
    body = (
        "ld = LaunchDescription()\n    n = Node(package='p', executable='e', name='n')\n"
        "    ld.add_action(n)\n    if x:\n        ld.add_action("
        "Node(package='p', executable='e', name='o'))\n    return ld\n"
    )
    assert _shown(_read(PYTHON, _HEAD + body)) == ["/n p e {} []", "/o p e {} [] if"]


def test_unknowns_have_their_place() -> None:
    text = '<launch>\n <node pkg="p" exec="$(eval x)" name="n"/>\n <odd/>\n</launch>'
    assert [str(u) for u in _read(XML, text).unknowns] == [
        "a.launch.xml:2:22: the program of a node: `x` has no value",
        "a.launch.xml:3:2: the tag <odd>: launch does not know it, or it lacks what it needs",
    ]


@pytest.mark.parametrize(
    ("path", "text", "why"),
    [
        (XML, "<launch>", "no element found"),
        (YAML, "launch: [", "no YAML"),
        (YAML, "nodes: []", "no list `launch`"),
        (PYTHON, "def (", "no Python"),
    ],
)
def test_what_cannot_be_read_is_listed(path: str, text: str, why: str) -> None:
    (unknown,) = _read(path, text).unknowns
    assert why in unknown.why


@pytest.mark.parametrize(
    ("path", "text", "is_it"),
    [
        ("launch/x.launch.py", "", True),
        ("launch/x_launch.py", "", True),
        ("launch/x-launch.yaml", "", True),
        ("launch/x.py", "", False),
        ("launch/x.launch.xml", '<launch><node pkg="p" type="t" name="n"/></launch>', False),
        ("launch/x.launch.xml", '<launch><node pkg="p" exec="t"/></launch>', True),
    ],
)
def test_which_files_are_of_ros_2(path: str, text: str, is_it: bool) -> None:
    assert (is_launch_of_ros_2(path) and speaks_ros_2(Source(path, text))) is is_it
