"""Runs nodes in C++ on the fake rclcpp: inputs once a second, and what they publish."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from pathlib import Path

from tests.reverse.native.closing import Case
from tests.reverse.native.ros1 import Input

_FAKE = Path(__file__).parents[1] / "fake_rclcpp"
_OPTIONS = ("-std=c++17", "-O0", "-fwrapv", "-w", f"-I{_FAKE}")
_HEADERS = (
    *("rclcpp/rclcpp.hpp", "rclcpp_components/register_node_macro.hpp"),
    *("std_msgs/msg/int32.hpp", "std_msgs/msg/u_int8.hpp", "std_msgs/msg/bool.hpp"),
    *("std_msgs/msg/int8.hpp", "std_msgs/msg/int64.hpp", "std_msgs/msg/float64.hpp"),
    *("std_msgs/msg/string.hpp", "std_srvs/srv/set_bool.hpp", "std_srvs/srv/trigger.hpp"),
    *("diagnostic_msgs/msg/diagnostic_status.hpp", "array", "atomic", "bitset", "cassert"),
    *("cstring", "limits", "list", "memory", "mutex", "numeric", "optional", "tuple"),
    *("unordered_map", "variant", "vector", "ctime", "cerrno"),
)
_PLAY = """
extern "C" int nanosleep(const timespec* span, timespec*) {
  fake::world().sleep(int64_t{span->tv_sec} * 1000000000 + span->tv_nsec);
  return 0;
}

namespace {

struct Given {
  std::string topic;
  int value;
};

void play(const std::string& name, int (*node)(int, char**), const std::vector<Given>& inputs) {
  auto& world = fake::world();
  world = fake::World();
  int64_t due = 0;
  for (const Given& input : inputs) {
    world.at(due += 1000000000, nullptr, nullptr, [input] {
      auto message = std::make_shared<std_msgs::msg::Int32>();
      message->data = input.value;
      fake::world().publish<std_msgs::msg::Int32>(input.topic, message);
    });
  }
  try {
    node(0, nullptr);
  } catch (const fake::Ended&) {
  }
  for (const auto& sent : world.sent) {
    std::printf("%s %s %d\\n", name.c_str(), sent.first.c_str(), sent.second);
  }
}

}  // namespace

int main() {
"""


def run_all(folder: Path, cases: Sequence[Case]) -> dict[str, list[Input]]:
    """What nodes publish, by the names of their cases: topics and values, in order.

    One program runs all of them, each in a namespace of its own: that is built once.
    """
    text = [f"#include <{header}>" for header in _HEADERS]
    for case in cases:
        space, node = case.folder.name, case.folder / case.node
        text += [f"#define main {space}_main", f"namespace {space} {{"]
        text += [f'#include "{node}"', "}", "#undef main"]
    text.append(_PLAY)
    for case in cases:
        space = case.folder.name
        given = ", ".join(f'{{"{topic}", {value}}}' for topic, value in case.inputs)
        text.append(f'  play("{space}", &{space}::{space}_main, {{{given}}});')
    text.append("}")
    driver, program = folder / "driver.cpp", folder / "driver"
    driver.write_text("\n".join(text) + "\n", encoding="utf-8")
    subprocess.run(["g++", *_OPTIONS, str(driver), "-o", str(program)], check=True)
    shown = subprocess.run([program], check=True, capture_output=True, text=True, timeout=60)
    found: dict[str, list[Input]] = {case.folder.name: [] for case in cases}
    for name, topic, value in (line.split() for line in shown.stdout.splitlines()):
        found[name].append((topic, int(value)))
    return found
