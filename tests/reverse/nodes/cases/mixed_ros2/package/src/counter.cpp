#include <chrono>
#include <memory>

#include "geometry_msgs/msg/point.hpp"
#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/int32.hpp"

using namespace std::chrono_literals;

class Counter : public rclcpp::Node {
public:
  Counter() : Node("counter"), count_(0) {
    turn_ = create_publisher<geometry_msgs::msg::Point>("turn", 10);
    answers_ = create_subscription<std_msgs::msg::Int32>(
      "answers", 10, [this](std_msgs::msg::Int32::ConstSharedPtr msg) { count_ = msg->data; });
    timer_ = create_wall_timer(1s, [this]() { tick(); });
  }

private:
  void tick() {
    auto msg = std::make_unique<geometry_msgs::msg::Point>();
    msg->x = 1.5;
    msg->y = count_;
    turn_->publish(std::move(msg));
  }

  int count_;
  rclcpp::Publisher<geometry_msgs::msg::Point>::SharedPtr turn_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr answers_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Counter>());
  rclcpp::shutdown();
  return 0;
}
