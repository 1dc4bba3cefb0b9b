"""Code that leads deeper than it can be read is listed: nothing ends with a traceback."""

from __future__ import annotations

import pytest

from rebsync.reverse.recovery import extract
from rebsync.source import Source

_NODE = """
#include <ros/ros.h>
#include <std_msgs/Int32.h>
CONSTANTS
class Deep {
 public:
  Deep() { sub_ = nh_.subscribe("in", 10, &Deep::on, this); }
 private:
  void on(const std_msgs::Int32::ConstPtr& msg) { int n = msg->data; STATEMENT }
  FUNCTIONS
  ros::NodeHandle nh_;
  ros::Subscriber sub_;
  int count_ = 0;
};
int main(int argc, char** argv) { ros::init(argc, argv, "deep"); Deep deep; ros::spin(); }
"""
_CONSTANTS = "".join(f"const int k{i} = k{i + 1} + 1;\n" for i in range(400))


def _chain(count: int, depth: int, result: str) -> str:
    """Functions that call the next one, each deep inside of itself."""
    parts = []
    for number in range(count):
        call = f"f{number + 1}(n)" if number + 1 < count else "count_ = n"
        if result == "int":
            inner = call if number + 1 < count else "n"
            parts.append(f"int f{number}(int n) {{ return {'(' * depth}{inner}{')' * depth}; }}")
        else:
            inner = f"{'if (n) {' * depth}{call};{'}' * depth}"
            parts.append(f"void f{number}(int& n) {{ {inner} }}")
    return "\n  ".join(parts)


@pytest.mark.parametrize(
    ("statement", "functions"),
    [
        pytest.param("f0(n);", _chain(8, 50, "void"), id="statements"),
        pytest.param("count_ = f0(n);", _chain(8, 100, "int"), id="values"),
        pytest.param("count_ = k0;", "", id="constants"),
        pytest.param(f"count_ = {'std::abs(' * 40}n{')' * 40};", "", id="repeated"),
        pytest.param(f"if ({'n && ' * 140}n) count_ = 1;", "", id="conditions"),
    ],
)
def test_what_is_deep_is_read_or_listed(statement: str, functions: str) -> None:
    text = _NODE.replace("STATEMENT", statement).replace("FUNCTIONS", functions)
    text = text.replace("CONSTANTS", _CONSTANTS if "k0" in statement else "")
    manifest = "<package format='2'><name>deep</name></package>"
    files = {"package.xml": manifest, "src/deep.cpp": text}
    found = extract({path: Source(path, t) for path, t in files.items()})
    (declared,) = found.model.classes
    assert declared.name == "Deep"
    listed = [f for f in found.findings if f.grade.value == "unreadable"]
    assert listed or statement.startswith("if")
