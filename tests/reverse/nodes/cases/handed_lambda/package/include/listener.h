// Subscribes with what another file hands in: what that uses of the message stands there.
#pragma once

#include <utility>

#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Listener {
 public:
  template <typename Use>
  Listener(const rclcpp::Node::SharedPtr & node, Use && use) {
    heard_ = node->create_subscription<std_msgs::msg::Int32>("count", 10, std::forward<Use>(use));
  }

 private:
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr heard_;
};
