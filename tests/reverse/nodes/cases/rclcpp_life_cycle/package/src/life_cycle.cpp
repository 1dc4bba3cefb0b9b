#include <chrono>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_lifecycle/lifecycle_node.hpp"
#include "std_msgs/msg/int32.hpp"

using namespace std::chrono_literals;
using CallbackReturn = rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface::CallbackReturn;

class Pulse : public rclcpp_lifecycle::LifecycleNode {
public:
  Pulse() : rclcpp_lifecycle::LifecycleNode("pulse") {
    echo_ = create_subscription<std_msgs::msg::Int32>(
      "pulse", 5, [this](const std_msgs::msg::Int32 & msg) { heard_ = msg.data; });
  }

  CallbackReturn on_configure(const rclcpp_lifecycle::State &) {
    pub_ = create_publisher<std_msgs::msg::Int32>("pulse", 5);
    timer_ = create_wall_timer(1s, [this]() { beat(); });
    return CallbackReturn::SUCCESS;
  }

  CallbackReturn on_deactivate(const rclcpp_lifecycle::State & state) override {
    count_ = 0;
    return LifecycleNode::on_deactivate(state);
  }

private:
  void beat() {
    std_msgs::msg::Int32 msg;
    msg.data = count_ % 8;
    count_ = count_ % 8 + 1;
    if (!pub_->is_activated()) RCLCPP_INFO(get_logger(), "nobody hears this");
    pub_->publish(msg);
  }

  int count_ = 0;
  int heard_ = 0;
  rclcpp_lifecycle::LifecyclePublisher<std_msgs::msg::Int32>::SharedPtr pub_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr echo_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Pulse>()->get_node_base_interface());
  rclcpp::shutdown();
  return 0;
}
