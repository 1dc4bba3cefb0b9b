#include <utility>

#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Pair : public rclcpp::Node {
 public:
  Pair() : Node("pair") {
    out_ = create_publisher<std_msgs::msg::Int32>("pair", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "pair_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    auto [a, b] = pair_;
    auto& [c, d] = pair_;
    c = 5;
    send(a * 100 + pair_.first * 10 + b);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  std::pair<int, int> pair_{1, 2};
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Pair>());
  rclcpp::shutdown();
}
