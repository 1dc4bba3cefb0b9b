#include <chrono>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
#include <std_msgs/msg/bool.hpp>

using namespace std::chrono_literals;

class Counter : public rclcpp::Node {
public:
  Counter() : Node("counter"), count_(0) {
    pub_ = create_publisher<std_msgs::msg::Int32>("count", 10);
    sub_ = create_subscription<std_msgs::msg::Bool>(
        "reset", 10, std::bind(&Counter::reset, this, std::placeholders::_1));
    timer_ = create_wall_timer(500ms, std::bind(&Counter::tick, this));
  }

private:
  void reset(const std_msgs::msg::Bool::SharedPtr msg) {
    if (msg->data) {
      count_ = 0;
    }
  }
  void tick() {
    count_ = count_ + 1;
    std_msgs::msg::Int32 out;
    out.data = count_;
    pub_->publish(out);
  }
  int count_;
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr pub_;
  rclcpp::Subscription<std_msgs::msg::Bool>::SharedPtr sub_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char **argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Counter>());
  rclcpp::shutdown();
  return 0;
}
