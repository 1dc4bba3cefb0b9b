#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
class Watcher {
 public:
  explicit Watcher(rclcpp::Node* node) {
    pub_ = node->create_publisher<std_msgs::msg::Int32>("alarm", 10);
    sub_ = node->create_subscription<std_msgs::msg::Int32>("level", 10,
        [this](const std_msgs::msg::Int32& msg) { cb(msg); });
  }
  void cb(const std_msgs::msg::Int32& msg) {
    std_msgs::msg::Int32 m;
    m.data = 2;
    pub_->publish(m);
  }
 private:
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr pub_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr sub_;
};
class Robot : public rclcpp::Node {
 public:
  Robot() : Node("robot"), w_(std::make_unique<Watcher>(this)) {
    own_ = create_publisher<std_msgs::msg::Int32>("alarm", 10);
    sub2_ = create_subscription<std_msgs::msg::Int32>("go", 10,
        [this](const std_msgs::msg::Int32& msg) { go(msg); });
  }
 private:
  void go(const std_msgs::msg::Int32& msg) {
    std_msgs::msg::Int32 m;
    m.data = 1;
    own_->publish(m);
  }
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr own_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr sub2_;
  std::unique_ptr<Watcher> w_;
};
int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Robot>());
}
