#include "relay/gate.hpp"

#include "rclcpp_components/register_node_macro.hpp"

namespace relay
{

Gate::Gate(const rclcpp::NodeOptions & options) : rclcpp::Node("gate", options)
{
  using std::placeholders::_1;
  out_ = this->create_publisher<std_msgs::msg::Int32>("passed", rclcpp::QoS(rclcpp::KeepLast(4)));
  in_ = this->create_subscription<std_msgs::msg::Int32>(
    "in", rclcpp::SensorDataQoS(), std::bind(&Gate::arrived, this, _1));
  gate_ = this->create_subscription<std_msgs::msg::Bool>(
    "~/open", 1, std::bind(&Gate::open, this, _1));
}

void Gate::arrived(const std_msgs::msg::Int32::ConstSharedPtr msg)
{
  ++seen_;
  if (!is_open_) {
    return;
  }
  out_->publish(*msg);
}

}  // namespace relay

RCLCPP_COMPONENTS_REGISTER_NODE(relay::Gate)
