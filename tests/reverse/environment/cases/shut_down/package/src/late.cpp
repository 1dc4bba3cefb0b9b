#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Late : public rclcpp::Node {
 public:
  Late() : Node("late_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("late", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "late_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) { send(1); }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  auto node = std::make_shared<Late>();
  rclcpp::shutdown();
  rclcpp::spin(node);
  rclcpp::shutdown();
}
