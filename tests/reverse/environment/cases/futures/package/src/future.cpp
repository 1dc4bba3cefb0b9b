#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Future : public rclcpp::Node {
 public:
  Future() : Node("future_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("future", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "future_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    value_.get_future().get();
    send(1);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  std::promise<int> value_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Future>());
  rclcpp::shutdown();
}
