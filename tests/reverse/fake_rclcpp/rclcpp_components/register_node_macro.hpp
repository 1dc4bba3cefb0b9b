// The program that the build makes of a component.
#pragma once
#include <rclcpp/rclcpp.hpp>
#define RCLCPP_COMPONENTS_REGISTER_NODE(NodeClass)                    \
  int main(int, char**) {                                             \
    rclcpp::spin(std::make_shared<NodeClass>(rclcpp::NodeOptions())); \
    return 0;                                                         \
  }
