// A message is called Node: a class derived from it is none, whatever it hands to its constructor.
#include <rclcpp/rclcpp.hpp>
#include <tree_msgs/msg/node.hpp>

class Branch : public tree_msgs::msg::Node {
 public:
  Branch() : tree_msgs::msg::Node() {}
  explicit Branch(const std::string& text) : tree_msgs::msg::Node(parsed(text)) {}
  Branch(const std::string& text, int) : Node(parsed(text)) {}
};

class Reader : public rclcpp::Node {
 public:
  Reader() : rclcpp::Node("reader") {}  //= node "reader"
};

class Watcher : public wrapped::LifecycleNode {
 public:
  Watcher() : wrapped::LifecycleNode("watcher") {}  //= node "watcher"
};
