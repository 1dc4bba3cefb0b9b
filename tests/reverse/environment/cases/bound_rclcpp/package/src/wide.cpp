#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Wide : public rclcpp::Node {
 public:
  Wide() : Node("wide_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("wide", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "wide_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void change(const double& value) {
    state_ = 9;
    send(value > 5.0 ? 2 : 3);
    state_ = 1;
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) { change(state_); }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  int state_ = 1;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Wide>());
  rclcpp::shutdown();
}
