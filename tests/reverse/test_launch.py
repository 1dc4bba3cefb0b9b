"""Launch files: scopes, precedence and conversions as roslaunch has them; what is open stays so."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rebsync.reverse.launch.launch_files import read_launch
from rebsync.reverse.launch.launch_values import Surroundings
from rebsync.reverse.launch.launched import Launch, LaunchedNode, Nodelet
from rebsync.reverse.launch.parameters import ParameterValue
from rebsync.reverse.unknowns import Open
from rebsync.source import Source


def launch(
    body: str,
    files: Mapping[str, str] | None = None,
    environment: Mapping[str, str] | None = None,
    arguments: Mapping[str, str] | None = None,
) -> Launch:
    texts = files or {}
    surroundings = Surroundings(
        load=lambda path: Source(path, texts[path]) if path in texts else None,
        find=lambda package: f"/{package}" if package in ("here", "other") else None,
        environment=environment or {},
        arguments=arguments or {},
    )
    return read_launch(Source("main.launch", f"<launch>\n{body}\n</launch>\n"), surroundings)


def node(found: Launch, name: str) -> LaunchedNode:
    return next(n for n in found.nodes if n.name == name)


def values(found: LaunchedNode) -> dict[str, ParameterValue | Open]:
    return {p.name: p.value for p in found.parameters}


def remaps(found: LaunchedNode) -> list[tuple[str, str | Open]]:
    return [(r.private, r.target) for r in found.remaps]


def global_values(found: Launch) -> dict[str, ParameterValue | Open]:
    return {p.name: p.value for p in found.parameters}


def whys(found: Launch) -> list[str]:
    return [u.why for u in found.unknowns]


def lines(found: Launch) -> list[tuple[str, int]]:
    return [(u.source.path, u.source.position(u.span.start).line) for u in found.unknowns]


NODE = '<node name="n" pkg="p" type="t"/>'


def test_a_node() -> None:
    found = launch('<node name="n" pkg="p" type="t" machine="m" required="true" args="-v 3"/>')
    (n,) = found.nodes
    assert (n.name, n.namespace, n.path, n.package, n.type) == ("n", "/", "/n", "p", "t")
    assert n.arguments == ("-v", "3")
    assert n.source.slice(n.span).startswith('<node name="n"')
    assert not found.unknowns
    assert [s.path for s in found.sources] == ["main.launch"]


# --- namespaces -----------------------------------------------------------------------------------


def test_groups_nest_namespaces() -> None:
    found = launch(
        """
        <group ns="a">
          <node name="x" pkg="p" type="t"/>
          <group ns="b"><node name="y" ns="c" pkg="p" type="t"/></group>
          <group ns="/g"><node name="z" pkg="p" type="t"/></group>
        </group>
        """
    )
    assert [n.path for n in found.nodes] == ["/a/x", "/a/b/c/y", "/g/z"]


def test_names_of_a_node_resolve_as_in_roscpp() -> None:
    found = launch(
        """
        <group ns="a"><node name="n" pkg="p" type="t">
          <remap from="~out" to="other/in"/>
          <remap from="chatter" to="/global"/>
        </node></group>
        """
    )
    (n,) = found.nodes
    assert n.resolved("topic") == "/a/topic"
    assert n.resolved("/topic/") == "/topic"
    assert n.resolved("~in") == "/a/n/in"
    assert n.resolved("in", within="~") == "/a/n/in"
    assert n.resolved("in", within="~sub") == "/a/n/sub/in"
    assert n.resolved("~out") == "/a/other/in"
    assert n.resolved("out", within="~") == "/a/other/in"
    assert n.resolved("/a/chatter") == "/global"


def test_two_nodes_of_one_name_are_refused() -> None:
    found = launch(f'{NODE}<group ns="/">{NODE}</group>')
    assert len(found.nodes) == 1
    assert whys(found) == ["another node has the name `/n`"]


def test_two_nodes_of_one_name_are_kept_if_one_of_them_starts() -> None:
    node_ = '<node name="n" pkg="p" type="t" {}><param name="v" value="{}"/></node>'
    body = node_.format('if="$(arg a)"', 1) + node_.format('unless="$(arg a)"', 2)
    found = launch(f'<arg name="a"/>{body}')
    assert [values(n) for n in found.nodes] == [{"v": 1}, {"v": 2}]
    assert [n.only_if for n in found.nodes] == [("if $(arg a)",), ("unless $(arg a)",)]


def test_a_name_with_a_namespace_is_refused() -> None:
    found = launch('<node name="a/n" pkg="p" type="t"/>')
    assert not found.nodes
    assert len(found.unknowns) == 1


# --- arguments and conditions ---------------------------------------------------------------------


def test_arguments() -> None:
    body = """
        <arg name="robot" default="bot"/>
        <arg name="full" value="$(arg robot)_1"/>
        <node name="$(arg full)" pkg="p" type="$(arg robot)_node"/>
        """
    assert [(n.name, n.type) for n in launch(body).nodes] == [("bot_1", "bot_node")]
    given_ = launch(body, arguments={"robot": "arm"})
    assert [(n.name, n.type) for n in given_.nodes] == [("arm_1", "arm_node")]


def test_an_argument_in_a_group_does_not_leak() -> None:
    found = launch(
        '<group><arg name="x" value="1"/></group><param name="p" value="$(arg x)"/>' + NODE
    )
    assert whys(found) == ["the argument `x` has no value here"]
    assert found.parameters[0].value == Open("the argument `x` has no value here")


def test_an_argument_is_declared_once() -> None:
    found = launch('<arg name="x" default="1"/><arg name="x" default="2"/>')
    assert whys(found) == ["it is declared a second time"]


@pytest.mark.parametrize(
    ("condition", "starts"),
    [
        ('if="1"', True),
        ('if="False"', False),
        ('unless="true"', False),
        ('unless="$(eval 1 > 2)"', True),
        ('if="$(eval sim and n == 3)"', True),
        ("if=\"$(eval arg('mode') == 'a' or not sim)\"", False),
    ],
)
def test_conditions(condition: str, starts: bool) -> None:
    arguments = '<arg name="sim" default="true"/><arg name="n" default="3"/>'
    arguments += '<arg name="mode" default="b"/>'
    found = launch(f'{arguments}<node name="n" pkg="p" type="t" {condition}/>')
    assert [n.name for n in found.nodes] == (["n"] if starts else [])
    assert not found.unknowns


def test_what_is_under_an_open_condition_is_told_apart() -> None:
    found = launch(
        """
        <arg name="sim"/>
        <group if="$(arg sim)">
          <param name="p" value="1"/>
          <node name="n" pkg="p" type="t"><param name="own" value="2"/></node>
        </group>
        <node name="m" pkg="p" type="t">
          <param name="q" value="3" unless="$(arg sim)"/>
          <remap from="a" to="b" if="$(arg sim)"/>
        </node>
        """
    )
    assert node(found, "n").only_if == ("if $(arg sim)",)
    assert values(node(found, "n")) == {"own": 2}
    assert global_values(found) == {"/p": Open("it is set only `if $(arg sim)`")}
    assert node(found, "m").only_if == ()
    assert values(node(found, "m")) == {"q": Open("it is set only `unless $(arg sim)`")}
    assert remaps(node(found, "m")) == [("a", Open("it is remapped only `if $(arg sim)`"))]
    assert lines(found)[0] == ("main.launch", 4)


def test_if_and_unless_together_are_open() -> None:
    found = launch('<node name="n" pkg="p" type="t" if="1" unless="0"/>')
    assert len(found.unknowns) == 1
    assert found.nodes[0].only_if


def test_an_argument_under_an_open_condition_is_open() -> None:
    found = launch(
        """
        <arg name="sim"/>
        <arg name="x" default="1" if="$(arg sim)"/>
        <node name="n" pkg="p" type="$(arg x)"/>
        """
    )
    assert isinstance(found.nodes[0].type, Open)
    assert len(found.unknowns) == 2


# --- $(...) ---------------------------------------------------------------------------------------


def test_the_environment() -> None:
    body = """
        <param name="a" value="$(env HOME)"/>
        <param name="b" value="$(optenv SPEED 1.5)"/>
        <param name="c" value="$(optenv TEXT two words)"/>
        """
    assert global_values(launch(body, environment={"HOME": "/h", "SPEED": "2"})) == {
        "/a": "/h",
        "/b": 2,
        "/c": "two words",
    }
    unset = launch(body)
    assert global_values(unset) == {
        "/a": Open("the environment variable `HOME` is not known"),
        "/b": 1.5,
        "/c": "two words",
    }
    assert lines(unset) == [("main.launch", 3)]


def test_an_anonymous_name_is_one_within_a_scope() -> None:
    found = launch(
        """
        <node name="$(anon n)" pkg="p" type="t"/>
        <param name="who" value="$(anon n)"/>
        <group><node name="$(anon m)" pkg="p" type="t"/></group>
        <group><node name="$(anon m)" pkg="p" type="t"/></group>
        """
    )
    assert all(n.anonymous for n in found.nodes)
    assert len({n.name for n in found.nodes}) == 3
    assert global_values(found) == {"/who": found.nodes[0].name}
    assert not found.unknowns


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("1 + 2 * 3", 7),
        ("7 / 2", 3.5),
        ("-7 // 2", -4),
        ("2 ** 10", 1024),
        ("'a' + 'b'", "ab"),
        ("str(3) + 'x'", "3x"),
        ("x if true else 0", 4),
        ("arg('x') - 1", 3),
        ("1 < 2 <= 2", True),
        ("'a' in 'cab'", True),
        ("float('1.5')", 1.5),
        ("round(2.5)", None),
        ("[1][0]", None),
        ("x.__class__", None),
        ("9 ** 9999999", None),
        ("'a' * 999999999", None),
        ("1 / 0", None),
        ("1 +", None),
        ("'%s' % 3", None),
        ("open('x')", None),
        ("(" * 300 + ")" * 300, None),
    ],
)
def test_eval(expression: str, value: ParameterValue | None) -> None:
    attribute = expression.replace("<", "&lt;")
    found = launch(f'<arg name="x" default="4"/><param name="p" value="$(eval {attribute})"/>')
    (parameter,) = found.parameters
    if value is None:
        assert isinstance(parameter.value, Open)
        assert len(found.unknowns) == 1
    else:
        assert parameter.value == value
        assert type(parameter.value) is type(value)
        assert not found.unknowns


@pytest.mark.parametrize("text", ["$(arg $(arg x))", "$(nosuch x)", "$(arg)", "$(arg a b)", "$( )"])
def test_malformed_substitutions_are_open(text: str) -> None:
    found = launch(f'<arg name="x" default="x"/><param name="p" value="{text}"/>')
    assert isinstance(found.parameters[0].value, Open)
    assert len(found.unknowns) == 1


@pytest.mark.parametrize("text", ["$", "a$b", "$x", "$()", "$(arg x", "5$ (arg x)"])
def test_dollars_that_begin_nothing_stay(text: str) -> None:
    found = launch(f'<param name="p" value="{text}" type="str"/>')
    assert global_values(found) == {"/p": text}


def test_arguments_that_double_their_text_end() -> None:
    doubled = "".join(f'<arg name="a{i + 1}" value="$(arg a{i})$(arg a{i})"/>' for i in range(60))
    found = launch(f'<arg name="a0" value="xx"/>{doubled}<param name="p" value="$(arg a60)"/>')
    assert isinstance(found.parameters[0].value, Open)


# --- <include> ------------------------------------------------------------------------------------

INNER = """
<launch>
  <arg name="name"/>
  <arg name="kind" default="t"/>
  <node name="$(arg name)" pkg="p" type="$(arg kind)"/>
</launch>
"""


def test_an_include_passes_arguments() -> None:
    found = launch(
        """
        <include file="$(find here)/inner.launch" ns="a"><arg name="name" value="x"/></include>
        <include file="$(find here)/inner.launch">
          <arg name="name" value="y"/><arg name="kind" value="u"/>
        </include>
        """,
        {"/here/inner.launch": INNER},
    )
    assert [(n.path, n.type) for n in found.nodes] == [("/a/x", "t"), ("/y", "u")]
    assert {n.source.path for n in found.nodes} == {"/here/inner.launch"}
    assert [s.path for s in found.sources] == ["main.launch", *["/here/inner.launch"] * 2]
    assert not found.unknowns


def test_an_include_passes_nothing_else() -> None:
    files = {"/here/inner.launch": INNER}
    body = '<arg name="name" value="x"/><include file="/here/inner.launch" {}/>'
    assert isinstance(launch(body.format(""), files).nodes[0].name, Open)
    every = launch(body.format('pass_all_args="true"'), files)
    assert [n.name for n in every.nodes] == ["x"]


def test_remappings_reach_into_an_include() -> None:
    inner = '<launch><remap from="c" to="d"/><node name="i" pkg="p" type="t"/></launch>'
    found = launch(
        f'<remap from="a" to="b"/><include file="/here/i.launch"/>{NODE}',
        {"/here/i.launch": inner},
    )
    assert remaps(node(found, "i")) == [("a", "b"), ("c", "d")]
    assert remaps(node(found, "n")) == [("a", "b")]


@pytest.mark.parametrize(
    ("tag", "why"),
    [
        ('<include file="/nowhere.launch"/>', "it is not at hand"),
        ('<include file="$(find absent)/x"/>', "the package `absent` is not at hand"),
        ("<include/>", "the attribute is missing"),
        ('<include file="/i.launch" pass_all_args="x"/>', "`x` is no bool"),
        (
            '<include file="/i.launch"><arg name="z" value="1"/></include>',
            "it declares no argument `z`",
        ),
        (
            '<include file="/i.launch"><arg name="z"/></include>',
            "it is passed to a file without a value",
        ),
    ],
)
def test_includes_that_cannot_be_read(tag: str, why: str) -> None:
    assert whys(launch(tag, {"/i.launch": "<launch/>"})) == [why]


def test_files_that_include_each_other_for_ever_end() -> None:
    body = '<include file="/i.launch"/>' * 2
    found = launch(body, {"/i.launch": f"<launch>{body}</launch>"})
    assert "files include each other too often to be read" in whys(found)


def test_a_mistake_in_an_included_file_has_its_place() -> None:
    found = launch('<include file="/i.launch"/>', {"/i.launch": "<launch>\n<node\n</launch>"})
    assert lines(found) == [("/i.launch", 3)]


# --- parameters -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "type_", "expected"),
    [
        ("3", None, 3),
        ("-3", None, -3),
        ("3.0", None, 3.0),
        ("1e3", None, "1e3"),
        ("1.e3", None, 1000.0),
        ("1_0", None, "1_0"),
        ("True", None, True),
        ("false", None, False),
        ("yes", None, "yes"),
        (" a b ", None, "a b"),
        ("3", "str", "3"),
        ("3", "double", 3.0),
        ("3", "bool", None),
        ("1", "bool", True),
        ("x", "int", None),
        ("3", "float", None),
        ("[1, x]", "yaml", (1, "x")),
        ("[1", "yaml", None),
        ("4294967296", "int", None),
    ],
)
def test_values_of_param(value: str, type_: str | None, expected: ParameterValue | None) -> None:
    kind = f' type="{type_}"' if type_ else ""
    found = launch(f'<param name="p" value="{value}"{kind}/>')
    if expected is None:
        assert len(found.unknowns) == 1
        assert all(isinstance(p.value, Open) for p in found.parameters)
    else:
        (parameter,) = found.parameters
        assert (parameter.value, type(parameter.value)) == (expected, type(expected))
        assert parameter.source.slice(parameter.span) == value
        assert not found.unknowns


def test_where_parameters_go() -> None:
    found = launch(
        """
        <param name="g" value="1"/>
        <param name="~early" value="2"/>
        <group ns="a">
          <param name="h" value="3"/>
          <param name="/abs" value="4"/>
          <param name="~local" value="5"/>
          <node name="n" pkg="p" type="t">
            <param name="own/x" value="6"/>
            <param name="~tilde" value="7"/>
            <rosparam>{y: 8, /far: 9}</rosparam>
          </node>
        </group>
        <param name="a/n/own/x" value="10"/>
        <node name="m" pkg="p" type="t"/>
        """
    )
    assert values(node(found, "n")) == {
        "y": 8,
        "early": 2,
        "local": 5,
        "own/x": 10,
        "tilde": 7,
    }
    assert values(node(found, "m")) == {"early": 2}
    assert global_values(found) == {"/g": 1, "/a/h": 3, "/abs": 4, "/far": 9}
    assert not found.unknowns


def test_param_goes_before_rosparam_whatever_the_order() -> None:
    found = launch(
        """
        <node name="n" pkg="p" type="t" args="_b:=4 _c:=x">
          <param name="a" value="1"/><param name="b" value="1"/>
          <rosparam>{a: 2, b: 2, d: 2}</rosparam>
        </node>
        <param name="n/b" value="3"/>
        """
    )
    assert values(found.nodes[0]) == {"a": 1, "b": 4, "c": "x", "d": 2}


def test_rosparam() -> None:
    files = {"/here/p.yaml": "a: 1\nb: {c: [x, 2.5]}\n", "/here/s.yaml": "v: $(arg x)\n"}
    found = launch(
        """
        <arg name="x" default="5"/>
        <rosparam command="load" file="$(find here)/p.yaml" ns="f"/>
        <rosparam param="list">[1, 2]</rosparam>
        <rosparam file="$(find here)/s.yaml" subst_value="true"/>
        <rosparam param="deep">
          k: v   # with a comment
        </rosparam>
        <rosparam command="delete" param="list"/>
        """,
        files,
    )
    assert global_values(found) == {
        "/f/a": 1,
        "/f/b/c": ("x", 2.5),
        "/list": (1, 2),
        "/v": 5,
        "/deep/k": "v",
    }
    slices = {p.name: p.source.slice(p.span) for p in found.parameters}
    assert slices["/f/a"] == "1"
    assert slices["/list"] == "[1, 2]"
    assert slices["/deep/k"] == "v"
    assert not found.unknowns


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("5", 5),
        ("-5.5", -5.5),
        ("1e3", 1000.0),
        ("True", True),
        ("false", False),
        ("yes", "yes"),
        ("99999999999", 99999999999.0),
        ("", ""),
    ],
)
def test_values_on_the_command_line(text: str, value: ParameterValue) -> None:
    (found,) = launch(f'<node name="n" pkg="p" type="t" args="_v:={text}"/>').nodes[0].parameters
    assert (found.name, found.value, type(found.value)) == ("v", value, type(value))


@pytest.mark.parametrize(
    "tag",
    [
        '<rosparam file="/nowhere.yaml"/>',
        "<rosparam>[1]</rosparam>",
        "<rosparam>{a: [}</rosparam>",
        "<rosparam>{1: a}</rosparam>",
        '<rosparam command="lode">a: 1</rosparam>',
        '<rosparam param="~p">1</rosparam>',
        '<param name="p"/>',
        '<param name="p" value="1" textfile="x"/>',
        '<param name="p" textfile="/nowhere"/>',
        '<param name="p" binfile="/x"/>',
        '<param name="p" command="date"/>',
        '<param value="1"/>',
        '<param name="$(env X)" value="1"/>',
        '<group ns=""/>',
        '<group ns="~a"/>',
        '<group name="a"/>',
        "<nodes/>",
        '<node name="n" pkg="p"/>',
        '<node name="" pkg="p" type="t"/>',
        '<node name="n" pkg="p" type="t"><remap from="a"/></node>',
        '<node name="n" pkg="p" type="t"><remap from="a" to="b-c"/></node>',
        '<node name="n" pkg="p" type="t" args="&quot;a"/>',
        '<node name="n" pkg="p" type="t" args="__ns:=x"/>',
        '<node name="n" pkg="p" type="t"><env name="ROS_NAMESPACE" value="x"/></node>',
        '<node name="n" pkg="p" type="t" tipe="x"/>',
        '<param name="a" value="1"/><param name="a/b" value="2"/>',
    ],
)
def test_each_of_these_is_one_unknown(tag: str) -> None:
    found = launch(tag)
    assert len(found.unknowns) == 1, whys(found)
    assert lines(found) == [("main.launch", 2)]


def test_text_files() -> None:
    found = launch('<param name="urdf" textfile="/x.urdf"/>', {"/x.urdf": "<robot/>"})
    assert global_values(found) == {"/urdf": "<robot/>"}
    assert [s.path for s in found.sources] == ["main.launch", "/x.urdf"]


# --- remappings, nodelets, tests, markers ---------------------------------------------------------


def test_remappings_are_those_before_in_the_scope() -> None:
    found = launch(
        """
        <remap from="a" to="1a"/>
        <remap from="a" to="b"/>
        <group>
          <remap from="c" to="d/"/>
          <node name="x" pkg="p" type="t" args="e:=f"><remap from="a" to="g"/></node>
        </group>
        <node name="y" pkg="p" type="t"/>
        <remap from="late" to="h"/>
        """
    )
    assert remaps(node(found, "x")) == [("e", "f"), ("c", "d"), ("a", "g")]
    assert remaps(node(found, "y")) == [("a", "b")]
    assert whys(found) == ["`1a` is no name of ROS"]


@pytest.mark.parametrize(
    ("arguments", "nodelet"),
    [
        ("manager", Nodelet("manager", None)),
        ("load pkg/Class mgr in:=out", Nodelet("load", "pkg/Class")),
        ("standalone pkg/Class", Nodelet("standalone", "pkg/Class")),
        ("unload pkg/Class mgr", None),
    ],
)
def test_nodelets(arguments: str, nodelet: Nodelet | None) -> None:
    found = launch(f'<node name="n" pkg="nodelet" type="nodelet" args="{arguments}"/>')
    assert found.nodes[0].nodelet == nodelet


def test_test_nodes_are_marked() -> None:
    found = launch(f'{NODE}<test test-name="t" pkg="p" type="check" time-limit="3"/>')
    assert [(n.name, n.test) for n in found.nodes] == [("n", False), ("t", True)]


def test_markers() -> None:
    found = launch(
        """
        <!-- rebsync: annotation @priority(1 -&#45;2) -->
        <!-- rebsync: rebec
             x -->
        <node name="x" pkg="p" type="t"/>
        <!-- any other comment -->
        <node name="y" pkg="p" type="t"/>
        <!-- rebsync: lost -->
        <arg name="z" default=""/>
        <node name="z" pkg="p" type="t"/>
        """
    )
    assert [n.markers for n in found.nodes] == [("annotation @priority(1 --2)", "rebec x"), (), ()]


# --- malformed files ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("", 1),
        ("<launch>\n<node>\n</launch>", 3),
        ("<launch>\n<a b='1' b='2'/></launch>", 2),
        ("<robot/>", 1),
        ("<launch>&nbsp;</launch>", 1),
        ("<!DOCTYPE launch [\n<!ENTITY a 'aaa'>\n]><launch>&a;</launch>", 2),
        ("<launch>\n\0</launch>", 2),
        ("<launch>" + "\n<group>" * 200 + "</group>" * 200 + "</launch>", 61),
    ],
)
def test_a_file_that_is_no_launch_file(text: str, line: int) -> None:
    found = read_launch(Source("x.launch", text))
    assert not found.nodes
    assert lines(found) == [("x.launch", line)]


def test_places_count_characters_not_bytes() -> None:
    found = launch('<!-- \u00e9\u20ac\U0001f600 -->\n<param name="p" value="\u00e9x"/>')
    (parameter,) = found.parameters
    assert parameter.source.slice(parameter.span) == "\u00e9x"


@given(st.text())
def test_any_text_is_read(text: str) -> None:
    found = read_launch(Source("x.launch", text))
    assert all(u.source.slice(u.span) is not None and str(u) for u in found.unknowns)


_ATTRIBUTES = (
    *("name", "value", "default", "pkg", "type", "ns", "if", "unless", "from", "to"),
    *("file", "args", "param", "subst_value", "pass_all_args", "command", "textfile"),
)
_TAGS = ("node", "test", "param", "rosparam", "arg", "group", "include", "remap", "env", "odd")
_WORDS = st.sampled_from(
    (
        *("", "a", "/", "~", "~b", "a/b", "1", "true", "yaml", "$(arg a)", "$(eval a+1)"),
        *("$(anon a)", "$(find here)/x", "{a: 1}", "load", "main.launch", "a:=b", "'"),
        *("$(env a)", "$(dirname)"),
    )
)


@st.composite
def _elements(draw: st.DrawFn, depth: int = 3) -> str:
    name = draw(st.sampled_from(_TAGS))
    names = draw(st.lists(st.sampled_from(_ATTRIBUTES), unique=True, max_size=5))
    attributes = "".join(f' {a}="{draw(_WORDS)}"' for a in names)
    inner = draw(st.lists(_elements(depth - 1), max_size=3)) if depth else [draw(_WORDS)]
    return f"<{name}{attributes}>{''.join(inner)}</{name}>"


@given(st.lists(_elements(), max_size=5))
def test_any_tags_are_read(elements: list[str]) -> None:
    body = "\n".join(elements)
    found = launch(body, {"/here/x": f"<launch>{body}</launch>", "a": "a: 1"})
    for n in found.nodes:
        assert n.name != ""
        assert n.resolved("~x") is not None
    assert all(str(u) for u in found.unknowns)
