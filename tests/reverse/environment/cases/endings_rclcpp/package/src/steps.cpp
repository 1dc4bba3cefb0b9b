#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Steps : public rclcpp::Node {
 public:
  Steps() : Node("steps_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("steps", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "steps_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    int left = 3;
    while (true) {
      int step = left / 2;
      RCLCPP_INFO(get_logger(), "waiting");
      if (step-- < 3) break;
    }
    send(1);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Steps>());
  rclcpp::shutdown();
}
