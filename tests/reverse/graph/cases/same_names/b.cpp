#include <ros/ros.h>
#include <std_msgs/Char.h>
static const int DEPTH = 2;
struct Node {
  Node(ros::NodeHandle& n, const char* name) {
    n.subscribe(name, DEPTH, &Node::heard, this);  //= subscription "~from_b" "std_msgs/Char" 2 -> Node::heard
  }
  void heard(const std_msgs::Char::ConstPtr& message) {}
};
void ask(ros::NodeHandle& n) {
  n.getParam("b", value);  //= parameter get "~b"
}
int main(int argc, char** argv) {
  ros::init(argc, argv, "b");  //= node "b"
  ros::NodeHandle n("~");
  Node node(n, "from_b");
  ask(n);
}
