#include <base_pkg/base.hpp>
#include <std_msgs/msg/int32.hpp>

class Robot : public base_pkg::CountingNode {
 public:
  Robot() : base_pkg::CountingNode("robot") {
    pub_ = create_publisher<std_msgs::msg::Int32>("alarm", 10);
    sub_ = create_subscription<std_msgs::msg::Int32>(
        "level", 10, std::bind(&Robot::cb, this, std::placeholders::_1));
  }

 private:
  void cb(const std_msgs::msg::Int32::SharedPtr msg) {
    if (msg->data > 3) {
      std_msgs::msg::Int32 m;
      m.data = 1;
      pub_->publish(m);
    }
  }
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr pub_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr sub_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Robot>());
  rclcpp::shutdown();
}
