#include "geometry_msgs/msg/point.hpp"
#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/int32.hpp"

#include "sensors/measured.h"

class Pump : public rclcpp::Node {
public:
  Pump() : Node("pump") {
    flow_ = create_publisher<geometry_msgs::msg::Point>("flow", 3);
    valve_ = create_subscription<std_msgs::msg::Int32>(
      "valve", 3, [this](const std_msgs::msg::Int32 & msg) { onValve(msg); });
  }

private:
  void onValve(const std_msgs::msg::Int32 & msg) {
    if (msg.data > 1) {
      geometry_msgs::msg::Point point;
      point.x = angles::measured();
      point.z = 2.0;
      flow_->publish(point);
    }
  }

  rclcpp::Publisher<geometry_msgs::msg::Point>::SharedPtr flow_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr valve_;
};

int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Pump>());
  rclcpp::shutdown();
  return 0;
}
