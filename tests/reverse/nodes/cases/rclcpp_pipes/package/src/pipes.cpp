#include <chrono>
#include <memory>
#include <string>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/int32.hpp"

using std_msgs::msg::Int32;

class Source : public rclcpp::Node
{
public:
  Source(const std::string & name, const std::string & to, std::chrono::seconds period)
  : Node(name)
  {
    pub_ = create_publisher<Int32>(to, 10);
    timer_ = create_wall_timer(period, std::bind(&Source::send, this));
  }

private:
  void send()
  {
    Int32 msg;
    msg.data = ++sent_;
    pub_->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::TimerBase::SharedPtr timer_;
  int sent_ = 0;
};

class Pipe : public rclcpp::Node
{
public:
  Pipe(const std::string & name, const std::string & from, const std::string & to) : Node(name)
  {
    pub_ = create_publisher<Int32>(to, 10);
    sub_ = create_subscription<Int32>(
      from, 4, [this](Int32::UniquePtr msg) {
        msg->data = msg->data + 1;
        pub_->publish(std::move(msg));
      });
  }

private:
  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::executors::SingleThreadedExecutor executor;
  auto slow = std::make_shared<Source>("slow", "first", std::chrono::seconds(5));
  auto quick = std::make_shared<Source>("quick", "first", std::chrono::seconds(2));
  auto first = std::make_shared<Pipe>("first_pipe", "first", "middle");
  auto second = std::make_shared<Pipe>("second_pipe", "middle", "last");
  executor.add_node(slow);
  executor.add_node(quick);
  executor.add_node(first);
  executor.add_node(second);
  executor.spin();
  rclcpp::shutdown();
}
