#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
#include <std_msgs/msg/bool.hpp>

class Alarm : public rclcpp::Node {
public:
  Alarm() : Node("alarm"), rung_(false) {
    pub_ = create_publisher<std_msgs::msg::Bool>("alarm", 10);
    sub_ = create_subscription<std_msgs::msg::Int32>(
        "count", 10, [this](const std_msgs::msg::Int32::SharedPtr msg) { heard(msg); });
  }

private:
  void heard(const std_msgs::msg::Int32::SharedPtr msg) {
    bool rings = msg->data >= 3;
    if (rings != rung_) {
      rung_ = rings;
      std_msgs::msg::Bool out;
      out.data = rings;
      pub_->publish(out);
    }
  }
  bool rung_;
  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr pub_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr sub_;
};

int main(int argc, char **argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Alarm>());
  rclcpp::shutdown();
  return 0;
}
