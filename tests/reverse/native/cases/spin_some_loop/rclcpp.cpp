#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  auto node = rclcpp::Node::make_shared("n");
  auto pub = node->create_publisher<Int32>("out", 9);
  int sum = 0;
  auto sub = node->create_subscription<Int32>("inp", 9, [&sum](const Int32& m) { sum += m.data; });
  rclcpp::Rate rate(2);
  while (rclcpp::ok()) {
    rclcpp::spin_some(node);
    if (sum > 2) {
      Int32 msg;
      msg.data = sum;
      pub->publish(msg);
    }
    rate.sleep();
  }
}
