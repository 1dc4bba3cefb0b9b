#include <chrono>
#include <memory>
#include <string>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/int32.hpp"
#include "std_msgs/msg/string.hpp"

using namespace std::chrono_literals;

class Counter : public rclcpp::Node
{
public:
  Counter() : Node("counter")
  {
    step_ = declare_parameter("step", 1);
    declare_parameter<int>("limits.most", 10);
    get_parameter("limits.most", most_);
    pub_ = create_publisher<std_msgs::msg::Int32>("count", 5);
    text_ = create_publisher<std_msgs::msg::String>("text", 10);
    timer_ = create_wall_timer(2s, [this]() { tick(); });
    once_ = create_wall_timer(3s, [this]() { once_->cancel(); started_ = true; });
  }

private:
  void tick()
  {
    auto note = std_msgs::msg::String();
    note.data = "count: " + std::to_string(told_++);
    text_->publish(note);
    count_ += step_;
    if (count_ > most_) {
      RCLCPP_INFO(get_logger(), "that is all: %d", count_);
      timer_->cancel();
      return;
    }
    auto message = std::make_unique<std_msgs::msg::Int32>();
    message->data = count_;
    pub_->publish(std::move(message));
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr pub_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr text_;
  rclcpp::TimerBase::SharedPtr timer_, once_;
  int step_, most_ = 0;
  int count_ = 0, told_ = 0;
  bool started_ = false;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Counter>());
  rclcpp::shutdown();
  return 0;
}
