"""Random nodes that a person might have written, each a package with a node that receives.

Of a class `N3` there is its source, a class `N3Sink` that subscribes to all that it publishes, and
what a driver needs to call its callbacks and to tell its state.
"""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from tests.reverse.soundness.drawing import (
    INTEGERS,
    WIDE,
    Body,
    Helper,
    Publisher,
    Variable,
)
from tests.reverse.soundness.odd import odd_statement
from tests.reverse.soundness.odd_library import MACROS, library_statement
from tests.reverse.soundness.shapes import SHAPES, Function, Parts, Subscription, files_of

# Message types with their fields by paths.
MESSAGES = {
    "std_msgs::Int32": (("data", "int"),),
    "std_msgs::Int16": (("data", "int16_t"),),
    "std_msgs::Int8": (("data", "int8_t"),),
    "std_msgs::UInt8": (("data", "uint8_t"),),
    "std_msgs::UInt16": (("data", "uint16_t"),),
    "std_msgs::Bool": (("data", "bool"),),
    "std_msgs::Float32": (("data", "float"),),
    "std_msgs::Float64": (("data", "double"),),
    "std_msgs::UInt32": (("data", "uint32_t"),),
    "std_msgs::Int64": (("data", "int64_t"),),
    "std_msgs::UInt64": (("data", "uint64_t"),),
    "std_msgs::Empty": (),
    "geometry_msgs::Twist": tuple(
        (f"{part}.{axis}", "double") for part in ("linear", "angular") for axis in "xyz"
    ),
}
SENT = ("std_msgs::Int32", "std_msgs::Bool", "std_msgs::Int8", "geometry_msgs::Twist")
_INSTEAD_ONLY = ("UInt16", "Float32", "UInt32", "Int64", "UInt64")
TAKEN = tuple(m for m in sorted(MESSAGES) if m.rpartition("::")[2] not in _INSTEAD_ONLY)
# Some nodes have messages of other numbers instead; what else is drawn is the same.
INSTEAD: tuple[dict[str, str], ...] = (
    {},
    {"std_msgs::Bool": "std_msgs::Float32", "std_msgs::Float64": "std_msgs::Float32"},
    {"std_msgs::Int8": "std_msgs::UInt8"},
    {"std_msgs::Int8": "std_msgs::UInt16", "std_msgs::Int32": "std_msgs::UInt8"},
    {},
    {"std_msgs::Int32": "std_msgs::UInt16", "std_msgs::Int16": "std_msgs::UInt16"},
)
# Of those that have wider numbers than models.
WIDE_FROM = 1000
# Of those that use macros of their own and objects of libraries.
LIBRARY_FROM = 2000
WIDE_INSTEAD: tuple[dict[str, str], ...] = (
    {"std_msgs::Int32": "std_msgs::Int64", "std_msgs::Int16": "std_msgs::UInt32"},
    {"std_msgs::Bool": "std_msgs::UInt64", "std_msgs::Int32": "std_msgs::UInt32"},
    {},
)
WIDE_MEMBERS = (
    Variable("seq_", "uint32_t"),
    Variable("count_", "unsigned"),
    Variable("ticks_", "size_t"),
    Variable("sum_", "int64_t"),
    Variable("long_", "long"),
)
MEMBERS = (
    Variable("total_", "int"),
    Variable("level_", "int"),
    Variable("step_", "int16_t"),
    Variable("small_", "int8_t"),
    Variable("octet_", "uint8_t"),
    Variable("on_", "bool"),
    Variable("ready_", "bool"),
    Variable("speed_", "double"),
    Variable("mode_", "Mode"),
    Variable("cells_", "int", length=4),
    Variable("last_.data", "int"),
)


@dataclass(frozen=True)
class Callback:
    """A callback: without a message type, that of a timer."""

    name: str
    message: str | None
    by_value: bool = False

    @property
    def fields(self) -> tuple[tuple[str, str], ...]:
        return MESSAGES[self.message] if self.message is not None else ()


@dataclass(frozen=True)
class DrawnNode:
    """A node: `files` are its package's, `sources` those of the node itself by their names."""

    name: str
    files: dict[str, str]
    sources: dict[str, str]
    shape: str
    callbacks: tuple[Callback, ...]
    members: tuple[Variable, ...]
    publishers: tuple[Publisher, ...]

    @property
    def source(self) -> str:
        """All of its code."""
        return "\n".join(self.sources.values())

    def topic(self, callback: Callback) -> str:
        """The topic of a callback's messages."""
        return f"{self.name.lower()}/{callback.name}"


def draw_node(seed: int) -> DrawnNode:
    """The node of a seed, always the same; from `WIDE_FROM` on with wider numbers than models'.

    From `LIBRARY_FROM` on macros stand before the code instead.
    """
    random = Random(seed)
    name = f"N{seed}"
    all_members = (*MEMBERS, *WIDE_MEMBERS) if _is_wide(seed) else MEMBERS
    members = tuple(m for m in all_members if random.randrange(100) < 70)
    publishers = tuple(
        Publisher(f"pub{i}_", message, MESSAGES[message])
        for i, message in enumerate(_drawn(random, SENT, seed))
    )
    messages = _drawn(random, TAKEN, seed)
    taken = tuple(
        Callback(f"on{m.rpartition('::')[2]}", m, random.random() < 0.3) for m in messages
    )
    ticks = (Callback("tick", None),) if random.random() < 0.5 else ()
    once = (Callback("later", None),) if random.random() < 0.4 else ()
    callbacks = (*taken, *ticks, *once)
    shape = random.choice(SHAPES)
    integers = (*INTEGERS, *(WIDE if _is_wide(seed) else ()))
    writer = _Writer(random, name, members, publishers, callbacks, shape, integers)
    writer.is_of_library = seed >= LIBRARY_FROM
    parts = writer.parts()
    sources = files_of(parts, shape, random)
    files = {
        **{f"src/{path}": text for path, text in sources.items()},
        f"src/{name.lower()}_sink.cpp": _sink(name, publishers),
        "CMakeLists.txt": _build(name),
        "package.xml": f"<package format='2'><name>{name.lower()}</name></package>\n",
        "launch/all.launch": _launch(name),
    }
    return DrawnNode(name, files, sources, shape, callbacks, members, publishers)


def _is_wide(seed: int) -> bool:
    return WIDE_FROM <= seed < LIBRARY_FROM


def _drawn(random: Random, messages: tuple[str, ...], seed: int) -> list[str]:
    """One to three types of messages."""
    instead = INSTEAD[seed % len(INSTEAD)]
    if _is_wide(seed):
        instead = WIDE_INSTEAD[seed % len(WIDE_INSTEAD)]
    drawn = random.sample(messages, random.randint(1, 3))
    return list(dict.fromkeys(instead.get(m, m) for m in drawn))


@dataclass
class _Writer:
    random: Random
    name: str
    members: tuple[Variable, ...]
    publishers: tuple[Publisher, ...]
    callbacks: tuple[Callback, ...]
    shape: str
    integers: tuple[str, ...]
    odd: bool = False
    is_of_library: bool = False

    def parts(self) -> Parts:
        opaque = self.random.random() < 0.6
        self.odd = self.random.random() < 0.5 or self.integers != INTEGERS
        helpers, free = self._helpers()
        called = [h for h, _ in helpers]
        made = {c.name: self._callback(c, called, opaque) for c in self.callbacks}
        macros = MACROS if self.is_of_library else ()
        mode = ["enum Mode { IDLE, RUN, STOP };", ""]
        low = self.name.lower()
        return Parts(
            self.name,
            ("#include <ros/ros.h>", *(f"#include <{_path(m)}.h>" for m in sorted(MESSAGES))),
            ("#include <library.h>", "", *macros, *(mode if self._has("Mode") else []), *free),
            tuple(f for h, f in helpers if h.member),
            tuple(made[c.name] for c in self.callbacks if c.message is None),
            tuple(
                Subscription(f"{low}/{c.name}", c.message, made[c.name], self._style())
                for c in self.callbacks
                if c.message is not None
            ),
            tuple(self._declarations()),
            tuple(self._initial()),
            self.random.randint(1, 3),
            tuple(
                f'{p.name} = nh_.advertise<{p.message}>("{low}/{p.name.rstrip("_")}", 10);'
                for p in self.publishers
            ),
        )

    def _style(self) -> str:
        style = self.random.choice(("pointer", "pointer", "bind", "lambda"))
        return "pointer" if self.shape == "functions" else style

    def _has(self, type_: str) -> bool:
        return any(m.type == type_ for m in self.members)

    def _declarations(self) -> list[str]:
        return [
            "ros::NodeHandle nh_;",
            *(f"ros::Publisher {p.name};" for p in self.publishers),
            *(f"ros::Subscriber {c.name}_;" for c in self.callbacks if c.message is not None),
            *("ros::Timer timer_;", "ros::Timer once_;"),
            *("std::map<int, int> table_;", "std::string label_;"),
            *map(self._declared, self.members),
        ]

    def _ticks(self) -> list[str]:
        """Callbacks that others call; a lambda has no name, and base classes do not know it."""
        timers = any(c.name == "tick" for c in self.callbacks)
        return ["tick"] if timers and self.shape in ("class", "header") else []

    def _declared(self, member: Variable) -> str:
        if member.name.endswith(".data"):
            return f"std_msgs::Int32 {member.name.partition('.')[0]};"
        if member.length:
            return self.random.choice(
                (
                    f"int {member.name}[{member.length}] = {{}};",
                    f"std::array<int, {member.length}> {member.name}{{}};",
                )
            )
        value = {"bool": "true", "Mode": "RUN", "double": "1.5"}.get(member.type, "3")
        return self.random.choice(
            (f"{member.type} {member.name} = {value};", f"{member.type} {member.name}{{}};")
        )

    def _initial(self) -> list[str]:
        plain = [m for m in self.members if m.type == "int" and not m.length]
        plain = [m for m in plain if m.name.isidentifier()]
        some = [m for m in plain if self.random.random() < 0.4]
        return [f"{m.name} = {self.random.randrange(9)};" for m in some]

    # --- functions ------------------------------------------------------------------------------

    def _body(self, variables: list[Variable], helpers: list[Helper], opaque: bool) -> Body:
        once = any(c.name == "later" for c in self.callbacks)
        free = self.shape == "functions"
        timer = "later" if free else f"&{self.name}::later, this"
        known = [*self.members, *variables]
        body = Body(self.random, known, helpers, list(self.publishers), opaque=opaque)
        body.timers = [timer] if once and self.shape != "base" else []
        body.handle = "ros::NodeHandle()" if free else "nh_"
        body.odd = odd_statement if self.odd else None
        if self.is_of_library:
            body.odd = library_statement
        body.integers = self.integers
        return body

    def _helpers(self) -> tuple[list[tuple[Helper, Function]], list[str]]:
        """Helpers that are members, each knowing those before it; and the free functions."""
        found: list[tuple[Helper, Function]] = []
        free: list[str] = []
        for index in range(self.random.randint(0, 3)):
            result = self.random.choice(("int", "bool", "void", "void"))
            takes = tuple("int" for _ in range(self.random.randint(0, 2)))
            if result == "void" and self.random.random() < 0.25:
                takes = (*takes, "int&")
            member = result == "void" or self.random.random() < 0.7
            helper = Helper(f"help{index}", result, takes, member)
            names = [f"p{i}" for i in range(len(takes))]
            body = self._helping(helper, names, [h for h, _ in found if member or not h.member])
            given = ", ".join(f"{t} {n}" for t, n in zip(takes, names, strict=True))
            function = Function(result, helper.name, given, tuple(body.lines()))
            found.append((helper, function))
            free += [] if member else [*function.text(), ""]
        return found, free

    def _helping(self, helper: Helper, names: list[str], others: list[Helper]) -> Body:
        variables = [Variable(n, "int") for n in names]
        body = self._body(variables, others, False)
        body.result = helper.result
        if helper.result != "void":  # C++ leaves open when an expression has its effects
            body.publishers, body.timers = [], []
            body.helpers = [h for h in body.helpers if h.result != "void"]
            body.variables = [
                Variable(v.name, v.type, v.length, constant="_" in v.name) for v in body.variables
            ]
        if not helper.member:
            body.variables, body.members = variables, False
        return body

    def _callback(self, callback: Callback, helpers: list[Helper], opaque: bool) -> Function:
        if callback.message is None:
            taken, variables = "const ros::TimerEvent& event", []
        else:
            arrow = "." if callback.by_value else "->"
            variables = [
                Variable(f"msg{arrow}{path}", type_, constant=True)
                for path, type_ in callback.fields
            ]
            by = "&" if callback.by_value else "::ConstPtr&"
            taken = f"const {callback.message}{by} msg"
        body = self._body(variables, helpers, opaque)
        body.message = callback.message or ""
        body.by_value = callback.by_value
        body.callable = self._ticks() if callback.message is not None else []
        return Function("void", callback.name, taken, tuple(body.lines()))


def _path(message: str) -> str:
    return message.replace("::", "/")


def _sink(name: str, publishers: tuple[Publisher, ...]) -> str:
    """A node that takes all fields of all messages."""
    low = name.lower()
    lines = ["#include <ros/ros.h>", ""]
    lines += [f"class {name}Sink {{", " public:", f"  {name}Sink() {{"]
    for p in publishers:
        topic = p.name.rstrip("_")
        made = f'nh_.subscribe("{low}/{topic}", 1000, &{name}Sink::{topic}, this)'
        lines.append(f"    {topic}_sub_ = {made};")
    lines += ["  }", "", " private:"]
    for p in publishers:
        topic = p.name.rstrip("_")
        lines.append(f"  void {topic}(const {p.message}::ConstPtr& msg) {{")
        lines += [f"    {topic}_{path.replace('.', '_')}_ = msg->{path};" for path, _ in p.fields]
        lines.append("  }")
    for p in publishers:
        topic = p.name.rstrip("_")
        lines += [f"  {t} {topic}_{path.replace('.', '_')}_ = 0;" for path, t in p.fields]
        lines.append(f"  ros::Subscriber {topic}_sub_;")
    lines += ["  ros::NodeHandle nh_;", "};", "", "int main(int argc, char** argv) {"]
    lines += [f'  ros::init(argc, argv, "{low}_sink");', f"  {name}Sink node;"]
    return "\n".join([*lines, "  ros::spin();", "  return 0;", "}"]) + "\n"


def _build(name: str) -> str:
    low = name.lower()
    return (
        f"project({low})\n"
        f"add_executable({low} src/{low}.cpp)\n"
        f"add_executable({low}_sink src/{low}_sink.cpp)\n"
    )


def _launch(name: str) -> str:
    low = name.lower()
    nodes = (f'  <node name="{n}" pkg="{low}" type="{n}"/>' for n in (low, f"{low}_sink"))
    return "\n".join(["<launch>", *nodes, "</launch>"]) + "\n"
