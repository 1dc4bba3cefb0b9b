"""What extraction leaves in memory: trees are large, and collecting them is slow."""

from __future__ import annotations

import gc
import weakref

from rebsync.reverse.recovery import extract
from rebsync.source import Source

CODE = """
#include <ros/ros.h>
#include <std_msgs/Int32.h>
class Counter {
 public:
  explicit Counter(const std::string& name) : name_(name) {
    pub_ = nh_.advertise<std_msgs::Int32>(name_ + "/out", 1);
    sub_ = nh_.subscribe("in", 1, &Counter::take, this);
  }
  void take(const std_msgs::Int32::ConstPtr& msg) {
    int seen = lookUp(msg->data);
    if (seen > 1) { total_ += seen; other(&total_); }
    std_msgs::Int32 out;
    out.data = total_;
    pub_.publish(out);
  }
 private:
  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  std::string name_;
  int total_ = 0;
};
int main(int argc, char** argv) { ros::init(argc, argv, "c"); Counter c("a"); ros::spin(); }
"""


def test_the_trees_are_freed_without_a_collection() -> None:
    gc.collect()
    gc.disable()
    try:
        found = extract({"src/counter.cpp": Source("src/counter.cpp", CODE)})
        assert found.findings
        assert len(found.graph.facts) == 3
        trees = [weakref.ref(cpp) for cpp in found.asking.code.files]
        del found
        assert [tree() for tree in trees] == [None]
    finally:
        gc.enable()
