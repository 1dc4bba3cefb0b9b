#ifndef RELAY__GATE_HPP_
#define RELAY__GATE_HPP_

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/bool.hpp"
#include "std_msgs/msg/int32.hpp"

namespace relay
{

class Gate : public rclcpp::Node
{
public:
  RELAY_PUBLIC
  explicit Gate(const rclcpp::NodeOptions & options);

private:
  void arrived(const std_msgs::msg::Int32::ConstSharedPtr msg);
  void open(const std_msgs::msg::Bool & msg) { is_open_ = msg.data; }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  rclcpp::Subscription<std_msgs::msg::Bool>::SharedPtr gate_;
  bool is_open_ = true;
  int seen_ = 0;
};

}  // namespace relay

#endif  // RELAY__GATE_HPP_
