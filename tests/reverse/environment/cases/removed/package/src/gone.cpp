#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Gone : public rclcpp::Node {
 public:
  Gone() : Node("gone_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("gone", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "gone_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
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
  auto node = std::make_shared<Gone>();
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  executor.remove_node(node);
  executor.spin();
  rclcpp::shutdown();
}
