// Checks that a class can be a component: a node that is made from its options alone.
#pragma once

#include <rclcpp/rclcpp.hpp>
#include <type_traits>

#define RCLCPP_COMPONENTS_REGISTER_NODE(NodeClass)                                        \
  static_assert(std::is_base_of_v<rclcpp::Node, NodeClass>);                              \
  static_assert(std::is_constructible_v<NodeClass, const rclcpp::NodeOptions&>);
