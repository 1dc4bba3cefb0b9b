// Stops the base when the heartbeat of the operator is missing.
#include <chrono>
#include <functional>
#include <geometry_msgs/msg/twist.hpp>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/bool.hpp>
#include <std_msgs/msg/empty.hpp>

using namespace std::chrono_literals;
using std::placeholders::_1;
using Twist = geometry_msgs::msg::Twist;

class Heartbeat : public rclcpp::Node {
 public:
  Heartbeat() : Node("heartbeat") {
    pub_ = create_publisher<Twist>("cmd_vel", 10);
    alive_pub_ = create_publisher<std_msgs::msg::Bool>("alive", rclcpp::QoS(1).transient_local());
    cmd_sub_ = create_subscription<Twist>(
        "cmd_vel_in", 10, std::bind(&Heartbeat::on_command, this, _1));
    beat_sub_ = create_subscription<std_msgs::msg::Empty>(
        "heartbeat", 10, [this](const std_msgs::msg::Empty::SharedPtr) { on_beat(); });
    watch_ = create_wall_timer(1s, std::bind(&Heartbeat::on_missing, this));
    watch_->cancel();
    repeat_ = create_wall_timer(200ms, std::bind(&Heartbeat::on_repeat, this));
  }

 private:
  void on_command(const Twist::SharedPtr msg) { last_ = msg; }

  void on_beat() {
    watch_->reset();
    if (!alive_) {
      alive_ = true;
      tell();
    }
  }

  void on_missing() {
    watch_->cancel();
    alive_ = false;
    last_.reset();
    pub_->publish(Twist());
    tell();
  }

  void on_repeat() {
    if (!alive_ || last_ == nullptr) {
      return;
    }
    pub_->publish(*last_);
  }

  void tell() {
    std_msgs::msg::Bool msg;
    msg.data = alive_;
    alive_pub_->publish(msg);
  }

  rclcpp::Publisher<Twist>::SharedPtr pub_;
  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr alive_pub_;
  rclcpp::Subscription<Twist>::SharedPtr cmd_sub_;
  rclcpp::Subscription<std_msgs::msg::Empty>::SharedPtr beat_sub_;
  rclcpp::TimerBase::SharedPtr watch_, repeat_;
  Twist::SharedPtr last_;
  bool alive_{false};
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Heartbeat>());
  rclcpp::shutdown();
  return 0;
}
