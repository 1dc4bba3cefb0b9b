// A class of one's own is called Node, too: what says `rclcpp::` does not mean it.
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

namespace route {
struct Node {
  int id = 0;
  Node* next = nullptr;
};
}  // namespace route

class Panel {
 public:
  Panel() {
    auto options = rclcpp::NodeOptions();
    node_ = std::make_shared<rclcpp::Node>("panel", options);  //= node "panel"
    pub_ = node_->create_publisher<std_msgs::msg::Int32>("way", 10);  //= publisher "way" "std_msgs/Int32" 10
  }

 private:
  rclcpp::Node::SharedPtr node_;
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr pub_;
};
