#pragma once
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

namespace base_pkg {

// Hears levels; what they mean is for classes below to say.
class Base : public rclcpp::Node {
 public:
  Base();

 protected:
  virtual void on_level(int level) = 0;
  void send(int value);
  int count_ = 0;

 private:
  void cb(const std_msgs::msg::Int32::SharedPtr msg);
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr sub_;
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr pub_;
};

// A node of its own, which the program `demo` of this package runs.
class Other : public rclcpp::Node {
 public:
  Other();

 private:
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr sub_;
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr pub_;
};

}  // namespace base_pkg
