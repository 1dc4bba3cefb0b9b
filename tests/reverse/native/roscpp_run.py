"""Runs nodes in C++ on the fake roscpp: inputs once a second, timers, and what they publish."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from pathlib import Path

from tests.reverse.native.closing import Case
from tests.reverse.native.ros1 import Input

_FAKE = Path(__file__).parents[1] / "fake_roscpp"
_OPTIONS = ("-std=c++17", "-O0", "-fwrapv", "-w", "-pthread", f"-I{_FAKE}")
_HEADERS = ("ros/ros.h", "std_msgs/Int32.h", "cstring", "future", "optional", "thread")
_PLAY = """
namespace {

struct Given {
  std::string topic;
  int value;
};
const double end = 40;

void serve(const std::vector<Given>& inputs, std::size_t& given) {
  while (given < inputs.size() && static_cast<double>(given + 1) <= fake::clock()) {
    const Given input = inputs[given++];
    const auto found = fake::callbacks<std_msgs::Int32>().find(input.topic);
    auto message = std::make_shared<std_msgs::Int32>();
    message->data = input.value;
    if (found != fake::callbacks<std_msgs::Int32>().end()) found->second(message);
  }
  for (std::size_t i = 0; i < fake::world().timers.size(); ++i) {
    const auto timer = fake::world().timers[i];
    if (timer.due > fake::clock()) continue;
    fake::world().timers[i].due = timer.one_shot ? 1e9 : timer.due + timer.period;
    timer.callback();
  }
}

void play(const std::string& name, int (*node)(int, char**), const std::vector<Given>& inputs) {
  std::size_t given = 0;
  fake::clock() = 0;
  fake::effects().clear();
  fake::callbacks<std_msgs::Int32>().clear();
  fake::world().timers.clear();
  fake::world().ok = [] { return fake::clock() < end; };
  fake::world().spin_once = [&] { serve(inputs, given); };
  fake::world().spin = [&] {
    for (; fake::clock() < end; fake::clock() += 0.25) serve(inputs, given);
  };
  node(0, nullptr);
  for (const auto& effect : fake::effects()) {
    std::printf("%s %s\\n", name.c_str(), effect.c_str());
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
        space = case.folder.name
        node = case.folder / case.node
        text += [f"namespace {space} {{", f'#include "{node}"', "}"]
        text[-3:] = [f"#define main {space}_main", *text[-3:], "#undef main"]
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
    for name, _, what, *words in (line.split() for line in shown.stdout.splitlines()):
        if what == "publish":
            found[name].append((words[0], int(words[1].lstrip("i"))))
    return found
