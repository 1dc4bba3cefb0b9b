#pragma once

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/int32.hpp"

/// Another class of this name than that of the program `pipes`.
class Source : public rclcpp::Node
{
public:
  Source() : Node("other_source")
  {
    pub_ = create_publisher<std_msgs::msg::Int32>("middle", 1);
    timer_ = create_wall_timer(std::chrono::minutes(1), [this]() {
      std_msgs::msg::Int32 msg;
      msg.data = 60;
      pub_->publish(msg);
    });
  }

private:
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr pub_;
  rclcpp::TimerBase::SharedPtr timer_;
};
