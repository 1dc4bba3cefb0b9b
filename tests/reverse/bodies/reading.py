"""Reads the functions of a case as bodies of one class, whose members are always the same."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rebsync import model as m
from rebsync.grammars.parser import parse_model
from rebsync.printing import print_model
from rebsync.reverse.bodies.cpp_statements import CppStatements
from rebsync.reverse.bodies.effects.cpp_form import CppForm
from rebsync.reverse.bodies.scope import (
    Called,
    Inline,
    Member,
    Outside,
    Publishes,
    Record,
    Scope,
    Target,
    TimerOf,
    Variable,
)
from rebsync.reverse.findings import Findings
from rebsync.reverse.models.texts import enumerated
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, parse, text_of
from rebsync.source import Source
from rebsync.static import analyse
from rebsync.static.types import BOOLEAN, DOUBLE, INT

CASES = Path(__file__).with_name("cases")
_SHORT, _FLOAT = m.Type("short"), m.Type("float")
_GRID = m.Type("int", (3,))
_STATE = {
    **{"count_": Variable("count", INT), "limit_": Variable("limit", INT)},
    **{"on_": Variable("on", BOOLEAN), "level_": Variable("level", DOUBLE)},
    **{"small_": Variable("small", _SHORT, 8), "tiny_": Variable("tiny", m.Type("byte"))},
    **{"half_": Variable("half", _FLOAT), "grid_": Variable("grid", _GRID)},
    "rank_": Variable("rank", INT, 0, (m.IntLiteral(0), m.IntLiteral(1))),
    **{"last_": Variable("last", INT), "mode_": Variable("mode", INT)},
}
_KEPT = {"data": Variable("kept_data", INT)}
_MEMBERS: dict[str, Member] = {
    **_STATE,
    "kept_": Record(_KEPT, "std_msgs/Int32"),
    "pub_": Publishes((Target("other", "take", ("data",)),), "std_msgs/Int32"),
    "flag_pub_": Publishes((Target("other", "flag", ("data",)),), "std_msgs/Bool"),
    "octet_pub_": Publishes((Target("other", "octet", ("data",)),), "std_msgs/UInt8"),
    "ping_pub_": Publishes((Target("other", "ping"), Target(None, "ping")), "std_msgs/Empty"),
    "twist_pub_": Publishes(
        (Target("other", "move", ("linear.x", "angular.z")),), "geometry_msgs/Twist"
    ),
    "idle_pub_": Publishes((), "std_msgs/Int32"),
    "timer_": TimerOf("tick"),
    "sensor_": Outside(),
    "matrix_": Outside(indexed=True),
    "range_": Outside(DOUBLE),
    "found_": Outside(BOOLEAN),
    "helper_": Outside(reaches=True),
}
_MESSAGES: dict[str, dict[str, m.Type | None]] = {
    "std_msgs/Int32": {"data": INT},
    "std_msgs/Bool": {"data": BOOLEAN},
    "std_msgs/UInt8": {"data": _SHORT},
    "std_msgs/Int64": {"data": INT},
    "std_msgs/Empty": {},
    "std_msgs/String": {"data": None},
    "geometry_msgs/Twist": {
        f"{part}.{axis}": DOUBLE for part in ("linear", "angular") for axis in "xyz"
    },
}
_WIDTHS = {
    f"std_msgs/{name}": {"data": bits} for name, bits in (("Bool", 8), ("UInt8", 8), ("Int64", 64))
}
_OTHER = """
reactiveclass Other(5) {
  knownrebecs {} statevars {}
  Other() {}
  msgsrv take(int data) {} msgsrv flag(boolean data) {} msgsrv ping() {}
  msgsrv octet(short data) {}
  msgsrv move(double x, double z) {}
}
"""
_METHODS = {
    "bump": Called("bump", takes=()),
    "add": Called("add", takes=(INT,), returns=INT),
    "keep": Called("keep", takes=(("data",),)),
}
_BESIDE = """
  void bump() { count = count + 1; }
  int add(int n) { count = count + n; return count; }
  void keep(int data) { kept_data = data; }
  msgsrv ping() {}
  msgsrv tick() {}
"""


def read_case(source: Source) -> tuple[m.Model, Findings]:
    """The model of a case, and what was found in it."""
    cpp = parse(source)
    code, findings = Code.of([cpp]), Findings()
    functions = [f for all_of in code.definitions.values() for f in all_of]
    inline = {f.name: Inline(f) for f in functions if not _is_served(f)}
    scope = Scope(
        _MEMBERS,
        {**inline, **_METHODS, "tick": Called("tick", server=True)},
        {},
        constants=code.constants_for(cpp),
        macros=code.macros,
        enumerators={"RED": 0, "GREEN": 1, "Mode::FAST": 7},
        enums=frozenset({"Mode"}),
        messages=_MESSAGES,
        widths=_WIDTHS,
        open=True,
        form=CppForm(code),
    )
    servers = [_server(cpp, f, scope, findings) for f in functions if _is_served(f)]
    return _whole(tuple(enumerated(servers)[0])), findings


def _is_served(function: CppFunction) -> bool:
    return function.name.startswith("on")


def _server(cpp: Cpp, function: CppFunction, scope: Scope, findings: Findings) -> m.MessageServer:
    parameters: tuple[m.Parameter, ...] = ()
    inside = replace(scope, server=function.name)
    if function.parameters:
        (parameter,) = function.parameters
        type_ = INT if "Int32" in text_of(parameter.type) else BOOLEAN
        parameters = (m.Parameter(type_, "data"),)
        record = Record({"data": Variable("data", type_)}, constant=True)
        inside = inside.with_locals({parameter.name: record})
    assert function.body is not None
    body = CppStatements(cpp, inside, findings, function.name).block(function.body)
    return m.MessageServer(function.name, parameters, body)


def _whole(servers: tuple[m.MessageServer, ...]) -> m.Model:
    state = "".join(f"{v.type} {v.name};" for v in (*_STATE.values(), *_KEPT.values()))
    beside = f"reactiveclass Node(9) {{ knownrebecs {{ Other other; }} statevars {{ {state} }}"
    text = f"{beside} Node() {{}} {_BESIDE} }} {_OTHER} main {{ Node n(o):(); Other o():(); }}"
    whole = parse_model(Source("whole", text)).model
    node, other = whole.classes
    assert isinstance(node, m.ReactiveClass)
    return replace(whole, classes=(replace(node, members=(*node.members, *servers)), other))


def told(source: Source) -> str:
    """The servers of a case as text, and what was found in it."""
    model, findings = read_case(source)
    node = model.classes[0]
    assert isinstance(node, m.ReactiveClass)
    servers = tuple(x for x in node.members if isinstance(x, m.MessageServer))[2:]
    only = m.Model((), (m.ReactiveClass("Node", 9, servers),), None)
    lines = [
        f"{source.position(f.span.start).line}: {f.grade.value}: {f.why} [{f.text}]"
        for f in sorted(findings.all, key=lambda f: f.span.start)
    ]
    opened = sorted(findings.open_members)
    return "\n".join([print_model(only), *lines, *(f"open: {name}" for name in opened), ""])


def mistakes(model: m.Model) -> list[str]:
    """What is wrong with a model, warnings apart; it is printed and parsed first."""
    again = parse_model(Source("printed", print_model(model))).model
    return [f"{found.code} {found.message}" for found in analyse(again).errors]
