"""Drawn nodes compiled against the fake roscpp, and what their callbacks do on random inputs."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random

from tests.reverse.soundness.nodes import MESSAGES, Callback, DrawnNode

FAKE = Path(__file__).parents[1] / "fake_roscpp"
# Signed integers wrap, as those of models do; warnings are of what is drawn, not of what is tried.
OPTIONS = ("-std=c++17", "-O0", "-fwrapv", "-w")
_RANGES = {
    "bool": (0, 1),
    "int8_t": (-128, 127),
    "uint8_t": (0, 255),
    "uint16_t": (0, (1 << 16) - 1),
    "int16_t": (-(1 << 15), (1 << 15) - 1),
    "int": (-(1 << 31), (1 << 31) - 1),
    # Models take those that an int holds.
    "uint32_t": (0, (1 << 31) - 1),
    "int64_t": (-(1 << 31), (1 << 31) - 1),
    "uint64_t": (0, (1 << 31) - 1),
}


@dataclass(frozen=True)
class Input:
    """A call of a callback with the values of the message's fields."""

    callback: Callback
    values: tuple[float, ...]


@dataclass(frozen=True)
class Effect:
    """What a callback has done at a time since its call: a topic and values, or a timer armed."""

    time: float
    topic: str | None
    values: tuple[float, ...]


@dataclass(frozen=True)
class Seen:
    """What a callback has done: its effects, and the members' values after it."""

    effects: tuple[Effect, ...]
    state: tuple[float, ...]


def inputs(node: DrawnNode, seed: int, count: int) -> list[Input]:
    """Random calls of a node's callbacks."""
    random = Random(seed)
    found = []
    armed = re.search(r"later(?:, this)?, true", node.source) is not None
    callbacks = [c for c in node.callbacks if armed or c.name != "later"]
    for _ in range(count):
        callback = random.choice(callbacks)
        found.append(Input(callback, tuple(_value(random, t) for _, t in callback.fields)))
    return found


def _value(random: Random, type_: str) -> float:
    if type_ in ("double", "float"):
        return random.choice((0.0, 0.5, -0.25, 1.0, 2.5, -3.0, 100.0))
    low, high = _RANGES[type_]
    if random.random() < 0.7:
        low, high = max(low, -3), min(high, 8)
    return random.randint(low, high)


def run(
    folder: Path, nodes: Sequence[DrawnNode], calls: Sequence[Sequence[Input]]
) -> list[list[Seen]]:
    """For each node what is seen after its constructor, and after each call."""
    sources = []
    for node in nodes:
        for name, text in node.sources.items():
            (folder / name).write_text(text, encoding="utf-8")
        sources.append(folder / f"{node.name.lower()}.cpp")
    driver = folder / "driver.cpp"
    driver.write_text(_driver(nodes, calls, sources), encoding="utf-8")
    program = folder / "driver"
    command = ["g++", *OPTIONS, f"-I{FAKE}", str(driver), "-o", str(program)]
    built = subprocess.run(command, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stderr[:4000]
    told = subprocess.run([str(program)], capture_output=True, text=True, check=True, timeout=60)
    return _read(told.stderr, nodes)


def _driver(
    nodes: Sequence[DrawnNode], calls: Sequence[Sequence[Input]], sources: Sequence[Path]
) -> str:
    text = ["#include <ros/ros.h>", "#include <library.h>"]
    text += [f"#include <{m.replace('::', '/')}.h>" for m in MESSAGES]
    text += [_LIBRARY, "#define private public", "#define protected public"]
    for node, path in zip(nodes, sources, strict=True):
        low = node.name.lower()
        text += [f"namespace of_{low} {{", f"#define main main_of_{low}"]
        text += [f'#include "{path}"', "#undef main", "}"]
    for node, made in zip(nodes, calls, strict=True):
        text += _runner(node, made)
    text += ["int main() {", *(f"  run_{n.name}();" for n in nodes), "}"]
    return "\n".join(text) + "\n"


_LIBRARY = """
static unsigned state_of_library = 7;
static unsigned drawn() {
  state_of_library = state_of_library * 1103515245u + 12345u;
  return state_of_library >> 16;
}
namespace topic_tools {
int level() { return drawn() % 6; }
bool ready() { return drawn() % 2; }
double ratio() { return (drawn() % 100) / 100.0; }
void record(int) {}
std::ostream& out() {
  static std::ostringstream stream;
  return stream;
}
int& Table::at(int) { return cell; }
int& Table::operator()(int, int) { return cell; }
Table& Table::row(int) { return *this; }
Table& table() {
  static Table only;
  return only;
}
}
namespace Eigen {
Matrix3d::Matrix3d(int, int) : cell(topic_tools::ratio()) {}
double& Matrix3d::operator()(int, int) { return cell; }
}
static void tell(const std::string& text) { std::cerr << text << std::endl; }
"""


def _runner(node: DrawnNode, calls: Sequence[Input]) -> list[str]:
    width = max([len(c.values) for c in calls] + [1])
    rows = []
    for call in calls:
        values = [*call.values, *[0] * (width - len(call.values))]
        number = node.callbacks.index(call.callback)
        rows.append(f"{{{number}, {', '.join(repr(float(v)) for v in values)}}}")
    text = [f"static void run_{node.name}() {{", f'  tell("node {node.name}");']
    inside = f"of_{node.name.lower()}"
    made, at = f"static {inside}::{node.name} node;", "node."
    if node.shape == "functions":
        made, at = f"{inside}::main_{inside}(0, nullptr);", f"{inside}::"
    text += ["  fake::effects().clear();", f"  {made}"]
    text += ["  auto report = [&] {", "    for (auto& e : fake::effects()) tell(e);"]
    text += ['    std::string state = "state";']
    for member in node.members:
        for index in range(member.length or 1):
            place = f"[{index}]" if member.length else ""
            text.append(f"    state += fake::value({at}{member.name}{place});")
    text += ["    tell(state);", "  };", "  report();"]
    text += [f"  static const double calls[][{width + 1}] = {{{', '.join(rows)}}};"]
    text += ["  for (auto& call : calls) {", "    fake::effects().clear(); fake::clock() = 0;"]
    text += ["    switch (static_cast<int>(call[0])) {"]
    for number, callback in enumerate(node.callbacks):
        text += [
            f"      case {number}: {{",
            *_called(node, callback, at),
            "        break;",
            "      }",
        ]
    return [*text, "    }", "    report();", "  }", "}"]


def _called(node: DrawnNode, callback: Callback, at: str) -> list[str]:
    if callback.message is None:
        return [f"        {at}{callback.name}(ros::TimerEvent());"]
    text = [f"        auto msg = std::make_shared<{callback.message}>();"]
    for index, (path, type_) in enumerate(callback.fields, 1):
        text.append(f"        msg->{path} = static_cast<{type_}>(call[{index}]);")
    topic = node.topic(callback)
    return [*text, f'        fake::callbacks<{callback.message}>().at("{topic}")(msg);']


def _read(told: str, nodes: Sequence[DrawnNode]) -> list[list[Seen]]:
    found: list[list[Seen]] = []
    effects: list[Effect] = []
    for line in told.splitlines():
        first, *rest = line.split()
        if first == "node":
            found.append([])
        elif first == "state":
            found[-1].append(Seen(tuple(effects), tuple(map(_number, rest))))
            effects = []
        else:
            topic = rest[1] if rest[0] == "publish" else None
            values = rest[2:] if topic is not None else rest[1:]
            effects.append(Effect(float(first), topic, tuple(map(_number, values))))
    assert len(found) == len(nodes)
    return found


def _number(told: str) -> float:
    """A number as it was told; of an integer what a model has of it."""
    if not told.startswith("i"):
        return float(told)
    lower = int(told[1:]) & 0xFFFFFFFF
    return lower - (1 << 32) if lower >> 31 else lower
