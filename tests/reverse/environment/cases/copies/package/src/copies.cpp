#include <chrono>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Copies : public rclcpp::Node {
 public:
  Copies() : Node("copies") {
    out_ = create_publisher<std_msgs::msg::Int32>("out", 1);
    int level = 7;
    timer_ = create_wall_timer(std::chrono::seconds(1), [this, level]() {
      std_msgs::msg::Int32 message;
      message.data = level;
      out_->publish(message);
    });
    level = 1;
  }

 private:
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Copies>());
  rclcpp::shutdown();
}
