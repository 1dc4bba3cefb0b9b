// Counts ticks from a number that 32 bits do not hold; waits as long as a variable says.
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/empty.hpp>
#include <std_msgs/msg/int32.hpp>

class Ticks : public rclcpp::Node {
 public:
  Ticks() : Node("ticks") {
    late_ = create_publisher<std_msgs::msg::Int32>("late", 10);
    tick_ = create_subscription<std_msgs::msg::Empty>(
        "tick", 10, [this](const std_msgs::msg::Empty&) { onTick(); });
  }

 private:
  void onTick() {
    std_msgs::msg::Int32 message;
    message.data = first_ ? 1 : 2;
    late_->publish(message);
    first_ += 4294967296;
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr late_;
  rclcpp::Subscription<std_msgs::msg::Empty>::SharedPtr tick_;
  int64_t first_ = 4294967296;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Ticks>());
  rclcpp::shutdown();
}
