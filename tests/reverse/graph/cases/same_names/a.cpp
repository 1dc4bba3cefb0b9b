// Two programs with classes and functions of the same names.
#include <ros/ros.h>
#include <std_msgs/Bool.h>
static const int DEPTH = 1;
struct Node {
  Node(ros::NodeHandle& n, const char* name) {
    n.subscribe(name, DEPTH, &Node::heard, this);  //= subscription "from_a" "std_msgs/Bool" 1 -> Node::heard
  }
  void heard(const std_msgs::Bool::ConstPtr& message) {}
};
void ask(ros::NodeHandle& n) {
  n.getParam("a", value);  //= parameter get "a"
}
int main(int argc, char** argv) {
  ros::init(argc, argv, "a");  //= node "a"
  ros::NodeHandle n;
  Node node(n, "from_a");
  ask(n);
}
