"""What sends and gets transforms has its ends in the graph, in both languages."""

from __future__ import annotations

import pytest

from rebsync.rosgraph.cpp_code import nodes_in_cpp
from rebsync.rosgraph.python_code import nodes_in_python
from rebsync.source import Source

CODE = {
    "node.py": """import rclpy
from rclpy.node import Node
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener

class Arm(Node):
    def __init__(self):
        super().__init__("arm")
        self.sent = TransformBroadcaster(self)
        self.fixed = StaticTransformBroadcaster(self)
        self.heard = TransformListener(Buffer(), self)

rclpy.init()
rclpy.spin(Arm())
""",
    "node.cpp": """#include <rclcpp/rclcpp.hpp>
#include <tf2_ros/transform_listener.h>
class Arm : public rclcpp::Node {
 public:
  Arm() : Node("arm"), sent_(this), fixed_(this) {
    heard_ = std::make_shared<tf2_ros::TransformListener>(*buffer_);
  }
  tf2_ros::TransformBroadcaster sent_;
  tf2_ros::StaticTransformBroadcaster fixed_;
  std::shared_ptr<tf2_ros::TransformListener> heard_;
};
int main() {
  rclcpp::spin(std::make_shared<Arm>());
}
""",
}
ENDS = [
    ("publisher", "/tf", "tf2_msgs/TFMessage"),
    ("publisher", "/tf_static", "tf2_msgs/TFMessage"),
    ("subscription", "/tf", "tf2_msgs/TFMessage"),
    ("subscription", "/tf_static", "tf2_msgs/TFMessage"),
]


@pytest.mark.parametrize("path", CODE)
def test_transforms_are_ends_of_their_topics(path: str) -> None:
    files = {path: Source(path, CODE[path])}
    found = nodes_in_python(files, files, "p") if path.endswith("py") else nodes_in_cpp(files, "p")
    ends = [(e.role.value, e.name, e.type) for node in found for e in node.ends]
    assert sorted(ends) == ENDS
