// A copy of a message whose fields nothing here declares.
#include <memory>

#include <rclcpp/rclcpp.hpp>
#include <gripper_msgs/msg/grip_array.hpp>
#include <std_msgs/msg/int32.hpp>

class Relay : public rclcpp::Node {
 public:
  Relay() : Node("relay") {
    grips_ = create_subscription<gripper_msgs::msg::GripArray>(
        "grips", 10, [this](const gripper_msgs::msg::GripArray::SharedPtr msg) {
          const auto grips = *msg;
          if (grips.width > 3) {
            std_msgs::msg::Int32 out;
            out.data = 1;
            count_->publish(out);
          }
        });
    count_ = create_publisher<std_msgs::msg::Int32>("count", 10);
  }

 private:
  rclcpp::Subscription<gripper_msgs::msg::GripArray>::SharedPtr grips_;
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr count_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Relay>());
  rclcpp::shutdown();
  return 0;
}
