"""Random nodes that a person might have written, each a package with a node that receives.

Of a class `N3` there is its source, a class `N3Sink` that subscribes to all that it publishes, and
what a driver needs to call its callbacks and to tell its state.
"""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from tests.reverse.soundness.drawing import Body, Helper, Publisher, Variable, lines_of
from tests.reverse.soundness.odd import odd_statement

# Message types with their fields by paths.
MESSAGES = {
    "std_msgs::Int32": (("data", "int"),),
    "std_msgs::Int16": (("data", "int16_t"),),
    "std_msgs::Int8": (("data", "int8_t"),),
    "std_msgs::UInt8": (("data", "uint8_t"),),
    "std_msgs::Bool": (("data", "bool"),),
    "std_msgs::Float64": (("data", "double"),),
    "std_msgs::Empty": (),
    "geometry_msgs::Twist": tuple(
        (f"{part}.{axis}", "double") for part in ("linear", "angular") for axis in "xyz"
    ),
}
SENT = ("std_msgs::Int32", "std_msgs::Bool", "std_msgs::Int8", "geometry_msgs::Twist")
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
    """A node: `files` are its package's, `source` the one that has the class."""

    name: str
    files: dict[str, str]
    source: str
    callbacks: tuple[Callback, ...]
    members: tuple[Variable, ...]
    publishers: tuple[Publisher, ...]

    def topic(self, publisher: Publisher) -> str:
        return f"{self.name.lower()}/{publisher.name.rstrip('_')}"


def draw_node(seed: int) -> DrawnNode:
    """The node of a seed, always the same."""
    random = Random(seed)
    name = f"N{seed}"
    members = tuple(m for m in MEMBERS if random.randrange(100) < 70)
    publishers = tuple(
        Publisher(f"pub{i}_", message, MESSAGES[message])
        for i, message in enumerate(random.sample(SENT, random.randint(1, 3)))
    )
    messages = random.sample(sorted(MESSAGES), random.randint(1, 3))
    taken = tuple(
        Callback(f"on{m.rpartition('::')[2]}", m, random.random() < 0.3) for m in messages
    )
    ticks = (Callback("tick", None),) if random.random() < 0.5 else ()
    once = (Callback("later", None),) if random.random() < 0.4 else ()
    callbacks = (*taken, *ticks, *once)
    source = _Writer(random, name, members, publishers, callbacks).source()
    files = {
        f"src/{name.lower()}.cpp": source,
        f"src/{name.lower()}_sink.cpp": _sink(name, publishers),
        "CMakeLists.txt": _build(name),
        "package.xml": f"<package format='2'><name>{name.lower()}</name></package>\n",
        "launch/all.launch": _launch(name),
    }
    return DrawnNode(name, files, source, callbacks, members, publishers)


@dataclass
class _Writer:
    random: Random
    name: str
    members: tuple[Variable, ...]
    publishers: tuple[Publisher, ...]
    callbacks: tuple[Callback, ...]
    odd: bool = False

    def source(self) -> str:
        opaque = self.random.random() < 0.6
        self.odd = self.random.random() < 0.5
        helpers, free = self._helpers()
        bodies = [line for c in self.callbacks for line in self._callback(c, helpers, opaque)]
        members = [h for helper in helpers if helper[0].member for h in helper[1]]
        text = [
            "#include <ros/ros.h>",
            "#include <geometry_msgs/Twist.h>",
            *(f"#include <std_msgs/{m.rpartition('::')[2]}.h>" for m in MESSAGES if "std" in m),
            "#include <library.h>",
            "",
            *(["enum Mode { IDLE, RUN, STOP };", ""] if self._has("Mode") else []),
            *free,
            f"class {self.name} {{",
            " public:",
            *(f"  {line}" for line in self._constructor()),
            "",
            " private:",
            *(f"  {line}" for line in [*members, *bodies]),
            "  ros::NodeHandle nh_;",
            *(f"  ros::Publisher {p.name};" for p in self.publishers),
            "  std::vector<ros::Subscriber> subscribers_;",
            "  ros::Timer timer_;",
            "  ros::Timer once_;",
            "  std::map<int, int> table_;",
            "  std::string label_;",
            *(f"  {self._declared(m)}" for m in self.members),
            "};",
            "",
            "int main(int argc, char** argv) {",
            f'  ros::init(argc, argv, "{self.name.lower()}");',
            f"  {self.name} node;",
            "  ros::spin();",
            "  return 0;",
            "}",
        ]
        return "\n".join(text) + "\n"

    def _has(self, type_: str) -> bool:
        return any(m.type == type_ for m in self.members)

    def _declared(self, member: Variable) -> str:
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

    def _constructor(self) -> list[str]:
        lines = [f"{self.name}() {{"]
        low = self.name.lower()
        for callback in self.callbacks:
            if callback.message is not None:
                given = f'"{low}/{callback.name}", 10, &{self.name}::{callback.name}, this'
                lines.append(f"  subscribers_.push_back(nh_.subscribe({given}));")
            elif callback.name == "tick":
                seconds = self.random.randint(1, 3)
                made = f"nh_.createTimer(ros::Duration({seconds}), &{self.name}::tick, this)"
                lines.append(f"  timer_ = {made};")
        for publisher in self.publishers:
            topic = f"{low}/{publisher.name.rstrip('_')}"
            made = f'nh_.advertise<{publisher.message}>("{topic}", 10)'
            lines.append(f"  {publisher.name} = {made};")
        plain = [m for m in self.members if m.type == "int" and not m.length]
        lines += [f"  {m.name} = {self.random.randrange(9)};" for m in plain if self._maybe()]
        return [*lines, "}"]

    def _maybe(self) -> bool:
        return self.random.random() < 0.4

    # --- functions ------------------------------------------------------------------------------

    def _body(self, variables: list[Variable], helpers: list[Helper], opaque: bool) -> Body:
        timers = [f"{self.name}::later"] if any(c.name == "later" for c in self.callbacks) else []
        known = [*self.members, *variables]
        body = Body(self.random, known, helpers, list(self.publishers), timers, opaque=opaque)
        body.odd = odd_statement if self.odd else None
        return body

    def _helpers(self) -> tuple[list[tuple[Helper, list[str]]], list[str]]:
        """Members that helpers are, each knowing those before it; and the free functions."""
        found: list[tuple[Helper, list[str]]] = []
        free: list[str] = []
        for index in range(self.random.randint(0, 3)):
            result = self.random.choice(("int", "bool", "void", "void"))
            takes = tuple("int" for _ in range(self.random.randint(0, 2)))
            if result == "void" and self.random.random() < 0.25:
                takes = (*takes, "int&")
            member = result == "void" or self.random.random() < 0.7
            helper = Helper(f"help{index}", result, takes, member)
            names = [f"p{i}" for i in range(len(takes))]
            variables = [Variable(n, "int") for n in names]
            body = self._body(variables, [h for h, _ in found if member or not h.member], False)
            body.result = result
            if result != "void":  # C++ leaves open when an expression has its effects
                body.publishers, body.timers = [], []
                body.helpers = [h for h in body.helpers if h.result != "void"]
                body.variables = [
                    Variable(v.name, v.type, v.length, constant=v.name.endswith("_"))
                    for v in body.variables
                ]
            if not member:
                body.variables, body.members = variables, False
            given = ", ".join(f"{t} {n}" for t, n in zip(takes, names, strict=True))
            head = f"{result} {helper.name}({given}) {{"
            text = [head, *lines_of(body), "}"]
            found.append((helper, text if member else []))
            free += [] if member else [*text, ""]
        return found, free

    def _callback(
        self, callback: Callback, helpers: list[tuple[Helper, list[str]]], opaque: bool
    ) -> list[str]:
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
        body = self._body(variables, [h for h, _ in helpers], opaque)
        return [f"void {callback.name}({taken}) {{", *lines_of(body), "}"]


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
