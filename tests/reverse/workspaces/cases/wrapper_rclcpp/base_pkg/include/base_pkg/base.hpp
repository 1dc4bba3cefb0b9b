#pragma once
#include <string>

#include <rclcpp/rclcpp.hpp>

namespace base_pkg {

// Makes publishers as a node does, and counts them.
class CountingNode : public rclcpp::Node {
 public:
  using rclcpp::Node::Node;
  template <typename M>
  typename rclcpp::Publisher<M>::SharedPtr create_publisher(const std::string& topic, int depth) {
    ++made_;
    return rclcpp::create_publisher<M>(*this, topic, depth);
  }

 private:
  int made_ = 0;
};

}  // namespace base_pkg
