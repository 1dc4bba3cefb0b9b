"""What macros hide is not taken for nothing."""

from __future__ import annotations

import pytest

from rebsync.reverse.recovery import extract
from rebsync.reverse.syntax.macros import hides
from rebsync.source import Source

NODE = """\
#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Node {{
 public:
  Node() {{ sub_ = nh_.subscribe("in", 1, &Node::take, this); }}
  void take(const std_msgs::Int32::ConstPtr& msg) {{
    count_ = msg->data;
    {statement}
  }}

 private:
  ros::NodeHandle nh_;
  ros::Subscriber sub_;
  int count_ = 0;
}};

int main(int argc, char** argv) {{
  ros::init(argc, argv, "node");
  Node node;
  ros::spin();
}}
"""


@pytest.mark.parametrize(
    ("statement", "listed"),
    [
        ('ROS_INFO("%d", 3);', []),
        ("ROS_WARN_STREAM_THROTTLE(1, count_);", []),
        ("RESET_ALL();", ["RESET_ALL()"]),
        ("CHECK_OR_RETURN(3 > 2);", ["CHECK_OR_RETURN(3 > 2)"]),
        ("tidy();", []),
    ],
)
def test_a_macro_may_do_anything(statement: str, listed: list[str]) -> None:
    found = extract({"node.cpp": Source("node.cpp", NODE.format(statement=statement))})
    assert [f.text.rstrip(";") for f in found.findings if f.within.endswith("take")] == listed


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        *((n, False) for n in ("reset", "Reset", "X", "ROS_INFO_ONCE", "NODELET_WARN", "LOG")),
        *((n, False) for n in ("PLUGINLIB_EXPORT_CLASS", "BOOST_ASSERT", "EXPECT_EQ")),
        *((n, True) for n in ("RESET", "ROS_REGISTER", "LOGIC", "RETURN_IF", "BOOST_FOREACH")),
    ],
)
def test_names(name: str, wanted: bool) -> None:
    assert hides(name) is wanted
