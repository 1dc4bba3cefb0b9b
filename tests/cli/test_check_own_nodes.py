"""Nodes of one's own beside generated ones are told of, for any of them may matter."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.cli import main
from tests.cli.test_check import Check, check, made, package, replace

__all__ = ["check", "made", "package"]  # fixtures

LISTENER = """\
#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Listener {
 public:
  explicit Listener(ros::NodeHandle& node) {
    sub_ = node.subscribe("numbers", 10, &Listener::hear, this);
    // more
  }
  void hear(const std_msgs::Int32::ConstPtr& msg) { ROS_INFO("%d", msg->data); }

 private:
  ros::Subscriber sub_;
  ros::Publisher pub_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "listener");
  ros::NodeHandle node;
  Listener listener(node);
  ros::spin();
}
"""


@pytest.fixture
def listener(package: Path) -> str:
    """A node that only listens to what another package publishes."""
    source = Path("patrol/src/listener.cpp")
    source.write_text(LISTENER)
    with Path("patrol/CMakeLists.txt").open("a") as build:
        build.write("add_executable(listener src/listener.cpp)\n")
    node = '  <node name="listener" pkg="patrol" type="listener"/>\n</launch>'
    replace("patrol/launch/patrol.launch", "</launch>", node)
    return str(source)


def test_one_that_listens_is_taken_in(check: Check, listener: str) -> None:
    status, shown = check()
    assert status == 1
    assert "reactiveclass Listener: added  [code]" in shown
    code = Path(listener).read_bytes()
    assert main(["sync"]) == 1  # it may hear what nobody in the package publishes
    assert "Listener listener():();" in Path("patrol.rebeca").read_text()
    assert Path(listener).read_bytes() == code
    assert "in step, as far as the code can be told" in check()[1]


def test_one_that_publishes_to_a_generated_node_is_told(check: Check, listener: str) -> None:
    replace(listener, "// more", 'pub_ = node.advertise<patrol::RobotGo>("/robot2/go", 1);')
    replace(listener, 'ROS_INFO("%d", msg->data);', "pub_.publish(patrol::RobotGo());")
    assert main(["sync"]) == 1
    status, shown = check()
    assert status == 1
    assert 'nobody in these files subscribes to "/robot2/go"' in shown
