#ifndef COMPONENT_HPP_
#define COMPONENT_HPP_
#include <memory>
#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"

namespace parts {

class PARTS_PUBLIC Component : public rclcpp::Node {
 public:
  PARTS_PUBLIC
  explicit Component(const rclcpp::NodeOptions & options);

 private:
  void heard(const std_msgs::msg::String::ConstSharedPtr msg);
  void tick();
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr in_;
  rclcpp::TimerBase::SharedPtr timer_, slow_;
  double rate_ = 4.0;
  int depth_;
};

}  // namespace parts

#endif  // COMPONENT_HPP_
