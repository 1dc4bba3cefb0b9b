#include <optional>

#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Maybe : public rclcpp::Node {
 public:
  Maybe() : Node("maybe") {
    out_ = create_publisher<std_msgs::msg::Int32>("maybe", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "maybe_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    send(last_.value_or(1));
    last_ = message->data > 0 ? 5 : 6;
    if (message->data > 3) last_.reset();
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  std::optional<int> last_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Maybe>());
  rclcpp::shutdown();
}
