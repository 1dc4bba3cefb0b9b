#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Left : public rclcpp::Node {
 public:
  Left() : Node("left_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("left", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "left_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    mutex_.lock();
    if (message->data > 3) {
      send(2);
      return;
    }
    send(1);
    mutex_.unlock();
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  std::mutex mutex_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Left>());
  rclcpp::shutdown();
}
