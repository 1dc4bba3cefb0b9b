#include "base_pkg/base.hpp"

namespace base_pkg {

Base::Base() : Node("base") {
  sub_ = create_subscription<std_msgs::msg::Int32>(
      "level", 10, std::bind(&Base::cb, this, std::placeholders::_1));
  pub_ = create_publisher<std_msgs::msg::Int32>("alarm", 10);
}

void Base::send(int value) {
  std_msgs::msg::Int32 m;
  m.data = value;
  pub_->publish(m);
}

void Base::cb(const std_msgs::msg::Int32::SharedPtr msg) { on_level(msg->data); }

Other::Other() : Node("other") {
  pub_ = create_publisher<std_msgs::msg::Int32>("level", 10);
  sub_ = create_subscription<std_msgs::msg::Int32>(
      "alarm", 10, [this](const std_msgs::msg::Int32::SharedPtr msg) { pub_->publish(*msg); });
}

}  // namespace base_pkg
