// Drives on until the bumper was pressed three times.
#include <chrono>
#include <geometry_msgs/msg/twist.hpp>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/bool.hpp>

using namespace std::chrono_literals;

class Guard : public rclcpp::Node {
 public:
  Guard() : Node("guard") {
    command_ = create_publisher<geometry_msgs::msg::Twist>("cmd_vel", 1);
    stopped_ = create_publisher<std_msgs::msg::Bool>("stopped", 1);
    bumper_ = create_subscription<std_msgs::msg::Bool>(
        "bumper", 1, [this](const std_msgs::msg::Bool& message) { onBumper(message); });
    timer_ = create_wall_timer(100ms, [this]() { drive(); });
  }

 private:
  void onBumper(const std_msgs::msg::Bool& message) {
    pressed_ = message.data;
    if (message.data && hits_ < 3) {
      ++hits_;
      if (hits_ == 3) {
        std_msgs::msg::Bool stopped;
        stopped.data = true;
        stopped_->publish(stopped);
      }
    }
  }

  void drive() {
    geometry_msgs::msg::Twist command;
    if (hits_ < 3 && !pressed_) {
      command.linear.x = 0.5;
    } else if (hits_ < 3) {
      command.angular.z = 1.0;
    }
    command_->publish(command);
  }

  rclcpp::Publisher<geometry_msgs::msg::Twist>::SharedPtr command_;
  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr stopped_;
  rclcpp::Subscription<std_msgs::msg::Bool>::SharedPtr bumper_;
  rclcpp::TimerBase::SharedPtr timer_;
  int hits_ = 0;
  bool pressed_ = false;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Guard>());
  rclcpp::shutdown();
}
