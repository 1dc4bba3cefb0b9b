// Functions of the same name, and constructors that nobody uses.
#include <ros/ros.h>
#include <std_msgs/Int8.h>
#include <string>

class Node {
 public:
  Node(ros::NodeHandle& n, ros::NodeHandle& own) : n_(n), own_(own) { start("by_handles"); }
  Node(unsigned long seed, unsigned long length) : own_("~") { start("by_numbers"); }
  Node(ros::NodeHandle& n, const std::string& name) : n_(n) { start(name); }
  void start(const std::string& name) {
    n_.advertise<std_msgs::Int8>(name, 1);  //= publisher "by_numbers" "std_msgs/Int8" 1
    own_.advertise<std_msgs::Int8>("own", 1);  //= publisher "~own" "std_msgs/Int8" 1
  }
  void set(int depth) { n_.advertise<std_msgs::Int8>("int", depth); }  //= publisher "int" "std_msgs/Int8" 7
  void set(const std::string& name) { n_.advertise<std_msgs::Int8>(name, 1); }  //= publisher "text" "std_msgs/Int8" 1
  void set(int depth, bool sure) { n_.advertise<std_msgs::Int8>("two", depth); }  //= publisher "two" "std_msgs/Int8" 9

 private:
  ros::NodeHandle n_, own_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "overloads");  //= node "overloads"
  Node node(values["seed"].as<unsigned long>(), 3);
  node.set(7);
  node.set("text");
  node.set(9, true);
}
