#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class First : public rclcpp::Node {
 public:
  First() : Node("first_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("first", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "first_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    int found = 0;
    for (int i = 0; i < 5; i++) {
      switch (i) {
        case 2:
          break;
        default:
          continue;
      }
      found = i;
      break;
    }
    send(found);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<First>());
  rclcpp::shutdown();
}
