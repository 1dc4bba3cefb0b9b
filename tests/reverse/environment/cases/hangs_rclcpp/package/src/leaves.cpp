#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Leaves : public rclcpp::Node {
 public:
  Leaves() : Node("leaves_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("leaves", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "leaves_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    for (;;) {
      switch (message->data) {
        case 1:
          break;
      }
      if (message->data < 3) break;
      RCLCPP_INFO(get_logger(), "waiting");
    }
    send(1);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Leaves>());
  rclcpp::shutdown();
}
