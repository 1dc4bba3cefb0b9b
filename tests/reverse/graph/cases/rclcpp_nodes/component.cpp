#include "component.hpp"

#include <chrono>
#include "rclcpp_components/register_node_macro.hpp"

using namespace std::chrono_literals;
using std::placeholders::_1;

namespace parts {

Component::Component(const rclcpp::NodeOptions & options)
: Node("component", options),  //= node "component"
  out_(create_publisher<std_msgs::msg::String>("out", 7))  //= publisher "out" "std_msgs/String" 7
{
  depth_ = declare_parameter("depth", 3);  //= parameter declare "depth" = 3
  this->declare_parameter<double>("rate", 20);  //= parameter declare "rate" = 20.0
  get_parameter("rate", rate_);  //= parameter get "rate" = 4.0
  rclcpp::SensorDataQoS quality;
  quality.keep_last(depth_);
  quality.transient_local();
  in_ = create_subscription<std_msgs::msg::String>("~/in", quality, std::bind(&Component::heard, this, _1));  //= subscription "~in" "std_msgs/String" {"depth" = 3} -> Component::heard
  timer_ = create_wall_timer(std::chrono::duration<double>(1.0 / rate_), [this]() { tick(); });  //= timer {"rate" = 0.05 : 1.0/value} wall -> Component::tick
  slow_ = rclcpp::create_timer(this, get_clock(), 2 * 1500ms, std::bind(&Component::tick, this));  //= timer 3.0 -> Component::tick
}

void Component::heard(const std_msgs::msg::String::ConstSharedPtr msg) {}
void Component::tick() {}

}  // namespace parts

RCLCPP_COMPONENTS_REGISTER_NODE(parts::Component)
