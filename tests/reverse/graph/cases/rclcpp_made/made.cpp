// What is made without the help of a node's methods, and a lambda that reads parameters.
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "message_filters/subscriber.h"
#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/int32.hpp"

using std_msgs::msg::Int32;

class Pair {
 public:
  explicit Pair(std::shared_ptr<rclcpp::Node> & node, rclcpp::Node::SharedPtr other) : right_(other, "right", rclcpp::QoS(3).get_rmw_qos_profile()) {  //= subscription "right" "std_msgs/Int32" 3 -> Pair::both
    left_ = std::make_shared<message_filters::Subscriber<Int32>>(node, "left");  //= subscription "left" "std_msgs/Int32" 10 -> Pair::both
    sync_->connectInput(*left_, right_);
    sync_->registerCallback(std::bind(&Pair::both, this, std::placeholders::_1, std::placeholders::_2));
  }
  void both(const Int32::ConstSharedPtr & left, const Int32::ConstSharedPtr & right) {}

 private:
  std::shared_ptr<message_filters::Subscriber<Int32>> left_;
  message_filters::Subscriber<Int32> right_;
  std::shared_ptr<Both> sync_;
};

class Made : public rclcpp::Node {
 public:
  Made() : Node("made") {  //= node "made"
    double rate = declare_parameter("rate", 20.0);  //= parameter declare "rate" = 20.0
    const std::chrono::duration<double> period{1.0 / rate};
    timer_ = rclcpp::GenericTimer<rclcpp::VoidCallbackType>::make_shared(get_clock(), std::chrono::duration_cast<std::chrono::nanoseconds>(period), std::bind(&Made::tick, this), nullptr);  //= timer {"rate" = 0.05 : 1.0/value} -> Made::tick
    auto read = [this](const std::string & name, bool & value) {
      declare_parameter(name, false);  //= parameter declare "loud" | "quiet" = false
      return get_parameter(name, value);  //= parameter get "loud" | "quiet"
    };
    bool loud = false;
    if (!read("loud", loud)) {
      read("quiet", loud);
    }
    auto handed = [this](const std::string & name) { declare_parameter(name, 1); };  //= parameter declare ? = 1
    for_each(handed);
    handed("known");
    std::vector<bool> used(3, 0);
    used = declare_parameter("used", used);  //= parameter declare "used" = [false, false, false]
  }
  void tick() {}

 private:
  rclcpp::TimerBase::SharedPtr timer_;
};
