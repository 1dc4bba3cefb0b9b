// Values that depend on themselves, functions that call each other, and code that nobody calls.
#include <ros/ros.h>
#include <std_msgs/UInt8.h>
#include <string>

std::string forth(int depth, std::string name);
std::string back(int depth, std::string name) { return depth ? forth(depth - 1, name) : name; }
std::string forth(int depth, std::string name) { return back(depth, name + "/x"); }

class Self {
 public:
  Self() : name_(name_) { name_ = name_ + "/again"; }
  explicit Self(std::string unused) : name_(unused) {}
  void twice(ros::NodeHandle& n) {
    n.advertise<std_msgs::UInt8>(name_, 1);  //= publisher "set/more" "std_msgs/UInt8" 1
    name_ = "later";
  }
  void set() {
    name_ = "set";
    name_ += "/more";
  }

 private:
  std::string name_;
};

void down(ros::NodeHandle n, std::string name) {
  n.advertise<std_msgs::UInt8>(name, 1);  //= publisher "top" "std_msgs/UInt8" 1
  down(ros::NodeHandle(n, "x"), name);
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "cycles");  //= node "cycles"
  ros::NodeHandle n;
  std::string text = "a";
  int number = 1;
  for (int i = 0; i < 3; i++) {
    n.getParam("x" + text, text);  //= parameter get ? "x*"
    n.getParam("y" + text, text);  //= parameter get ? "y*"
    number = number * 2;
  }
  n.advertise<std_msgs::UInt8>("b", number);  //= publisher "b" "std_msgs/UInt8" ?
  n.advertise<std_msgs::UInt8>(forth(2, "c"), 1);  //= publisher "c/x/x/x" "std_msgs/UInt8" 1
  Self self;
  self.set();
  self.twice(n);
  down(n, "top");
}
