"""ROS 1 packages such as people write, made by chance: nodes, their helpers, and libraries.

Their shares of the code are those of ros_comm (2.26 MB): a quarter in files that ask something of
ROS, half in what is read with them, and a quarter in packages that have no node.
"""

from __future__ import annotations

import random
from pathlib import Path

HEAD = """\
/*********************************************************************
 * Software License Agreement (BSD License)
 *
 * Redistribution and use in source and binary forms, with or without
 * modification, are permitted provided that the above copyright notice
 * is kept in all copies.
 *********************************************************************/
"""
NODE_HEADER = """\
#ifndef {guard}
#define {guard}

#include <string>
#include <vector>

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_msgs/Int32.h>
#include <std_msgs/String.h>

{includes}
namespace {package} {{

/// Takes {topic} and tells others what it makes of it.
class {cls} {{
 public:
  explicit {cls}(const ros::NodeHandle& nh, const std::string& name = "{topic}");

  void spin();

 private:
{declared}
  ros::NodeHandle nh_;
  ros::Subscriber sub_;
  ros::Publisher pub_;
  ros::Publisher status_pub_;
  ros::Timer timer_;
  std::string name_;
  double rate_;
  int limit_;
  int count_ = 0;
  bool active_ = false;
  std::vector<double> values_;
  {libcls} filter_;
}};

}}  // namespace {package}

#endif
"""
NODE_SOURCE = """\
#include "{package}/{file}.h"

#include <algorithm>
#include <cmath>

namespace {package} {{

static const double kPeriod = 0.{digit};

{cls}::{cls}(const ros::NodeHandle& nh, const std::string& name)
    : nh_(nh), name_(name), rate_(10.0), limit_({digit}), filter_({digit}.5) {{
  ros::NodeHandle private_nh("~");
  private_nh.param("rate", rate_, 10.0);
  private_nh.param<int>("limit", limit_, {digit});
  sub_ = nh_.subscribe(name_ + "/in", {digit}, &{cls}::onMessage, this);
  pub_ = nh_.advertise<std_msgs::Int32>(name_ + "/out", {digit}0);
  status_pub_ = nh_.advertise<std_msgs::String>("status", 1, true);
  timer_ = nh_.createTimer(ros::Duration(kPeriod), &{cls}::onTimer, this);
}}

{defined}
void {cls}::spin() {{
  ros::Rate rate(rate_);
  while (ros::ok()) {{
    ros::spinOnce();
    rate.sleep();
  }}
}}

}}  // namespace {package}
"""
HANDLERS = """\
void {cls}::onMessage(const std_msgs::Int32::ConstPtr& msg) {{
  ROS_DEBUG("%s: got %d", name_.c_str(), msg->data);
  if (msg->data > limit_) {{
    ROS_WARN_STREAM("too much: " << msg->data);
    active_ = false;
    return;
  }}
  count_ += msg->data;
  active_ = true;
  std_msgs::Int32 out;
  out.data = count_;
  pub_.publish(out);
}}

void {cls}::onTimer(const ros::TimerEvent&) {{
  if (!active_) {{
    return;
  }}
  count_ = count_ > 0 ? count_ - 1 : 0;
  std_msgs::String text;
  text.data = count_ == 0 ? "idle" : "busy";
  status_pub_.publish(text);
}}

"""
METHOD = """\
double {cls}::{name}(const std::vector<double>& values, int start) {{
  double sum = 0.0;
  for (size_t i = start; i < values.size(); ++i) {{
    if (std::isnan(values[i]) || values[i] < -{a}.0) {{
      continue;
    }}
    const double weight = std::exp(-{a} * static_cast<double>(i)) + {b};
    sum += weight * (values[i] - {b}.25) / std::max(1.0, std::abs(values[i]));
    values_.push_back(sum);
  }}
  switch (start) {{
    case 0:
      sum *= 2;
      break;
    case {a}:
      sum = std::min(sum, {b}.0);
      break;
    default:
      sum += filter_.update(sum, {b});
  }}
  // What is left over goes into the next round.
  while (values_.size() > {b}0u) {{
    values_.erase(values_.begin());
  }}
  return sum > {a} ? sum / {b}.0 : std::sqrt(sum * sum + {a});
}}

"""
MAIN = """\
#include <ros/ros.h>

#include "{package}/{file}.h"

int main(int argc, char** argv) {{
  ros::init(argc, argv, "{file}");
  ros::NodeHandle nh;
  {package}::{cls} node(nh, "{topic}");
  node.spin();
  return 0;
}}
"""
LIB_HEADER = """\
#ifndef {guard}
#define {guard}

#include <memory>
#include <string>
#include <vector>

namespace {package} {{

/// What is known of one channel.
struct {cls}State {{
  double value = 0.0;
  std::string label;
}};

class {cls} {{
 public:
  explicit {cls}(double gain);
  double update(double value, int steps);

 private:
{declared}
  double gain_;
  std::vector<double> values_;
  std::unique_ptr<{cls}State> state_;
  Smoother filter_;
}};

}}  // namespace {package}

#endif
"""
LIB_SOURCE = """\
#include "{package}/{file}.h"

#include <algorithm>
#include <cmath>

namespace {package} {{

{cls}::{cls}(double gain) : gain_(gain), state_(new {cls}State) {{}}

double {cls}::update(double value, int steps) {{
  for (int i = 0; i < steps; ++i) {{
    state_->value += gain_ * (value - state_->value);
  }}
  return state_->value;
}}

{defined}}}  // namespace {package}
"""
WORDS = (
    "scan",
    "pose",
    "path",
    "goal",
    "map",
    "tick",
    "grid",
    "base",
    "wheel",
    "arm",
    "state",
    "joy",
)


def package(name: str, chance: random.Random, nodes: int = 2, libraries: int = 4) -> dict[str, str]:
    """The files of a package; the node classes include all of its libraries."""
    files = {
        "package.xml": f"<package format='2'><name>{name}</name><version>1.0.0</version>"
        "<description>made</description><maintainer email='a@b.c'>a</maintainer>"
        "<license>BSD</license><depend>roscpp</depend></package>\n",
        "CMakeLists.txt": f"cmake_minimum_required(VERSION 3.0)\nproject({name})\n",
    }
    modules = [f"{chance.choice(WORDS)}_{i}" for i in range(libraries)]
    for module in modules:
        _library(files, name, module, chance)
    launched = []
    for index in range(nodes):
        node = f"{chance.choice(WORDS)}_node_{index}"
        _node(files, name, node, modules, chance)
        launched.append(f"  <node pkg='{name}' type='{node}' name='{node}'/>\n")
        files["CMakeLists.txt"] += f"add_executable({node} src/{node}.cpp src/{node}_main.cpp)\n"
    files[f"launch/{name}.launch"] = f"<launch>\n{''.join(launched)}</launch>\n"
    return files


def _node(
    files: dict[str, str], name: str, node: str, libraries: list[str], chance: random.Random
) -> None:
    includes = "".join(f'#include "{name}/{library}.h"\n' for library in libraries)
    values = {
        **_names(name, node, chance),
        **{"includes": includes, "libcls": _class(libraries[0]), "topic": chance.choice(WORDS)},
    }
    methods = [f"weigh{chance.choice(WORDS).title()}{i}" for i in range(chance.randint(4, 9))]
    servers = "  void onMessage(const std_msgs::Int32::ConstPtr& msg);\n"
    servers += "  void onTimer(const ros::TimerEvent& event);\n"
    values["declared"] = servers + _declared(methods)
    values["defined"] = HANDLERS.format(**values) + _defined(values, methods, chance)
    files[f"include/{name}/{node}.h"] = HEAD + NODE_HEADER.format(**values)
    files[f"src/{node}.cpp"] = HEAD + NODE_SOURCE.format(**values)
    files[f"src/{node}_main.cpp"] = HEAD + MAIN.format(**values)


def _library(files: dict[str, str], name: str, module: str, chance: random.Random) -> None:
    values = _names(name, module, chance)
    methods = [f"fit{chance.choice(WORDS).title()}{i}" for i in range(chance.randint(5, 12))]
    values["declared"] = _declared(methods)
    values["defined"] = _defined(values, methods, chance)
    files[f"include/{name}/{module}.h"] = HEAD + LIB_HEADER.format(**values)
    files[f"src/{module}.cpp"] = HEAD + LIB_SOURCE.format(**values)


def _names(name: str, file: str, chance: random.Random) -> dict[str, object]:
    guard = f"{name}_{file}_H".upper()
    cls, digit = _class(file), chance.randint(1, 9)
    return {"package": name, "file": file, "guard": guard, "cls": cls, "digit": digit}


def _class(file: str) -> str:
    return "".join(part.title() for part in file.split("_"))


def _declared(methods: list[str]) -> str:
    line = "  double {}(const std::vector<double>& values, int start);\n"
    return "".join(line.format(m) for m in methods)


def _defined(values: dict[str, object], methods: list[str], chance: random.Random) -> str:
    return "".join(
        METHOD.format(cls=values["cls"], name=m, a=chance.randint(1, 9), b=chance.randint(1, 9))
        for m in methods
    )


def write_packages(root: Path, count: int, seed: int = 1, libraries: int = 4) -> int:
    """Writes so many packages, and gives the bytes of their code; each fourth has no node."""
    chance, size = random.Random(seed), 0
    for number in range(count):
        name, nodes = f"pack_{number}", 2 if number % 4 < 3 else 0
        for path, text in package(name, chance, nodes, libraries + (not nodes) * 2).items():
            target = root / name / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")
            size += len(text) if path.endswith((".h", ".cpp")) else 0
    return size
