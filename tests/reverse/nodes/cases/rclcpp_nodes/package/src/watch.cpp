#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/bool.hpp"
#include "std_msgs/msg/int32.hpp"

int last = 0;

void heard(const std_msgs::msg::Int32 & msg)
{
  last = msg.data;
}

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  auto node = rclcpp::Node::make_shared("watch");
  auto sub = node->create_subscription<std_msgs::msg::Int32>("passed", 10, heard);
  auto pub = node->create_publisher<std_msgs::msg::Bool>("/gate/open", 1);
  rclcpp::Rate rate(1);
  while (rclcpp::ok()) {
    std_msgs::msg::Bool open;
    open.data = last < 12;
    pub->publish(open);
    rclcpp::spin_some(node);
    rate.sleep();
  }
  rclcpp::shutdown();
  return 0;
}
