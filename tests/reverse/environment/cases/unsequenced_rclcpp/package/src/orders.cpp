// Publishes sums whose operands C++ evaluates in any order.
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/empty.hpp>
#include <std_msgs/msg/int32.hpp>

namespace {

int take(int& from) {
  from = 5;
  return 1;
}

int sum(int a, int b) { return a + b; }

}  // namespace

class Orders : public rclcpp::Node {
 public:
  Orders() : Node("orders") {
    operands_ = create_publisher<std_msgs::msg::Int32>("operands", 1);
    arguments_ = create_publisher<std_msgs::msg::Int32>("arguments", 1);
    nested_ = create_publisher<std_msgs::msg::Int32>("nested", 1);
    tick_ = create_subscription<std_msgs::msg::Empty>(
      "tick", 1, std::bind(&Orders::onTick, this, std::placeholders::_1));
  }

 private:
  void onTick(const std_msgs::msg::Empty::SharedPtr) {
    std_msgs::msg::Int32 message;
    int n = 0;
    auto change = [&]() {
      n = 5;
      return 1;
    };
    message.data = n + change();
    operands_->publish(message);
    int m = 0;
    message.data = sum(m, take(m));
    arguments_->publish(message);
    level_ = 0;
    message.data = level();
    nested_->publish(message);
  }

  int raise() {
    level_ = 5;
    return 1;
  }

  int level() { return level_ + raise(); }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr operands_, arguments_, nested_;
  rclcpp::Subscription<std_msgs::msg::Empty>::SharedPtr tick_;
  int level_ = 0;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Orders>());
  rclcpp::shutdown();
}
