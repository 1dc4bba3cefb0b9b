#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Copy : public rclcpp::Node {
 public:
  Copy() : Node("copy_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("copy", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "copy_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void change(const std_msgs::msg::Int32 value) {
    kept_.data = 5;
    send(value.data);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    kept_.data = 1;
    change(kept_);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  std_msgs::msg::Int32 kept_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Copy>());
  rclcpp::shutdown();
}
