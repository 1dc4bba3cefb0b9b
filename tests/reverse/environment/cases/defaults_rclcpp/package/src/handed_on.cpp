// Constructors that hand on to others, the last of which gives members their values.
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
using Int32 = std_msgs::msg::Int32;

class HandedOn : public rclcpp::Node {
 public:
  HandedOn() : HandedOn(3) { level_ += 1; }
  explicit HandedOn(int level, int more = 2) : Node("handed_on"), level_(level + more) {
    out_ = create_publisher<Int32>("handed_on", 10);
    sub_ = create_subscription<Int32>("ask_on", 10, [this](Int32::ConstSharedPtr) {
      Int32 message;
      message.data = level_ + step_;
      out_->publish(message);
    });
  }

 private:
  int level_ = 10;
  int step_ = level_ * 10;
  rclcpp::Publisher<Int32>::SharedPtr out_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<HandedOn>());
  rclcpp::shutdown();
}
