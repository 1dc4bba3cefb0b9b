#include "base_pkg/base.hpp"

namespace base_pkg {

Base::Base(ros::NodeHandle& nh) {
  sub_ = nh.subscribe("level", 10, &Base::cb, this);
  pub_ = nh.advertise<std_msgs::Int32>("alarm", 10);
}

void Base::send(int value) {
  std_msgs::Int32 m;
  m.data = value;
  pub_.publish(m);
}

void Base::cb(const std_msgs::Int32::ConstPtr& msg) { onLevel(msg->data); }

Other::Other(ros::NodeHandle& nh) {
  sub_ = nh.subscribe("alarm", 10, &Other::cb, this);
  pub_ = nh.advertise<std_msgs::Int32>("level", 10);
}

void Other::cb(const std_msgs::Int32::ConstPtr& msg) { pub_.publish(*msg); }

}  // namespace base_pkg
