#include <atomic>

#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Shared : public rclcpp::Node {
 public:
  Shared() : Node("shared") {
    out_ = create_publisher<std_msgs::msg::Int32>("shared", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "shared_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    const int before = count_.fetch_add(1);
    if (before == 0) count_.store(254);
    send(before);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  std::atomic<uint8_t> count_{254};
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Shared>());
  rclcpp::shutdown();
}
