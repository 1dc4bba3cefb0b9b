#include <chrono>
#include <memory>
#include <thread>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp/executors.hpp"
#include "std_msgs/msg/empty.hpp"
#include "std_msgs/msg/int64.hpp"

using namespace std::chrono_literals;

/// What it says has nothing to do with time.
struct Oracle
{
  int now() { return 7; }
};

class Sleeper : public rclcpp::Node
{
public:
  explicit Sleeper(const std::string & name) : rclcpp::Node(name)
  {
    const auto quality = rclcpp::QoS(rclcpp::KeepLast(6)).reliable();
    alarm_ = create_subscription<std_msgs::msg::Empty>(
      "alarm", quality, [this](const std_msgs::msg::Empty &) { wake(); });
    later_ = create_subscription<std_msgs::msg::Empty>(
      "later", 2, std::bind(&Sleeper::again, this, std::placeholders::_1));
    beat_ = create_wall_timer(std::chrono::seconds(4), std::bind(&Sleeper::tick, this));
    beat_->cancel();
  }

private:
  void wake()
  {
    woken_ = now().seconds() > 10;
    std::this_thread::sleep_for(2s);
    rclcpp::sleep_for(std::chrono::milliseconds(3000));
    beat_->reset();
  }

  void again(const std_msgs::msg::Empty & msg)
  {
    (void)msg;
    guess_ = oracle_.now();
    beat_.reset();
  }

  void tick() { ++beats_; }

  rclcpp::Subscription<std_msgs::msg::Empty>::SharedPtr alarm_, later_;
  rclcpp::TimerBase::SharedPtr beat_;
  Oracle oracle_;
  bool woken_ = false;
  int beats_ = 0, guess_ = 0;
};

class Ringer : public rclcpp::Node
{
public:
  Ringer() : Node("ringer")
  {
    alarm_ = create_publisher<std_msgs::msg::Empty>("alarm", 1);
    late_ = create_publisher<std_msgs::msg::Empty>("later", rclcpp::SensorDataQoS());
    timer_ = rclcpp::create_timer(
      this, get_clock(), rclcpp::Duration(20s), [this]() {
        alarm_->publish(std_msgs::msg::Empty());
        if (get_clock()->now().seconds() > 100) {
          late_->publish(std_msgs::msg::Empty());
        }
      });
  }

private:
  rclcpp::Publisher<std_msgs::msg::Empty>::SharedPtr alarm_, late_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::executors::MultiThreadedExecutor executor;
  auto sleeper = std::make_shared<Sleeper>("sleeper");
  auto ringer = std::make_shared<Ringer>();
  executor.add_node(sleeper);
  executor.add_node(ringer);
  executor.spin();
  rclcpp::shutdown();
}
