#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Order : public rclcpp::Node {
 public:
  Order() : Node("order") {
    out_ = create_publisher<std_msgs::msg::Int32>("order", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "order_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    send(message->data < limit_ ? 1 : 2);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  unsigned limit_ = 3;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Order>());
  rclcpp::shutdown();
}
