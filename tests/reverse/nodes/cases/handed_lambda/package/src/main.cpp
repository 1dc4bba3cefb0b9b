// Longer than the header, so that what stands here stands behind its end.
#include <memory>

#include "listener.h"

#include "sensors/measured.h"

class Watcher : public rclcpp::Node {
 public:
  Watcher() : Node("watcher") {
    seen_ = create_subscription<std_msgs::msg::Int32>("seen", 10, [this](std_msgs::msg::Int32::SharedPtr msg) {
      most_ = msg->data > most_ ? msg->data : most_;
    });
  }

 private:
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr seen_;
  int most_ = 0;
};

class Talker : public rclcpp::Node {
 public:
  Talker() : Node("talker") {
    count_ = create_publisher<std_msgs::msg::Int32>("count", 10);
    timer_ = create_wall_timer(std::chrono::seconds(1), [this]() { tell(); });
  }

 private:
  void tell() {
    std_msgs::msg::Int32 out;
    out.data = 3;
    count_->publish(out);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr count_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("listener");
  auto talker = std::make_shared<Talker>();
  auto watcher = std::make_shared<Watcher>();
  auto seen = node->create_publisher<std_msgs::msg::Int32>("seen", 10);
  Listener listener(node, [seen](const std_msgs::msg::Int32::SharedPtr msg) {
    if (msg->data > 2 && angles::measured()) {
      std_msgs::msg::Int32 out;
      out.data = msg->data;
      seen->publish(out);
    }
  });
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  executor.add_node(talker);
  executor.add_node(watcher);
  executor.spin();
  rclcpp::shutdown();
}
