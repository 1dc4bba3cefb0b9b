#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Waits : public rclcpp::Node {
 public:
  Waits() : Node("waits_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("waits", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "waits_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    while (rclcpp::ok() && !ready_) {
      RCLCPP_INFO(get_logger(), "waiting");
    }
    send(1);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  bool ready_ = false;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Waits>());
  rclcpp::shutdown();
}
