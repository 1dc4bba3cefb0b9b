// Texts that are put together: streams, formats, lists, loops.
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

const char* const NAMES[] = {"red", "green"};

int main(int argc, char** argv) {
  ros::init(argc, argv, "texts");  //= node "texts"
  ros::NodeHandle n;
  std::stringstream stream;
  stream << "robot_" << 3 << "/pose";
  n.advertise<std_msgs::String>(stream.str(), 1);  //= publisher "robot_3/pose" "std_msgs/String" 1
  std::ostringstream open;
  open << "arm_" << argc;
  open << "/state";
  n.advertise<std_msgs::String>(open.str(), 1);  //= publisher ? "arm_*/state" "std_msgs/String" 1
  char buffer[40];
  sprintf(buffer, "wheel_%02d/%s", 7, "speed");
  n.advertise<std_msgs::String>(buffer, 1);  //= publisher "wheel_07/speed" "std_msgs/String" 1
  snprintf(buffer, sizeof(buffer), "leg_%d", argc);
  n.advertise<std_msgs::String>(buffer, 1);  //= publisher ? "leg_*" "std_msgs/String" 1
  std::vector<std::string> sides = {"left", "right"};
  n.advertise<std_msgs::String>(sides[0], 1);  //= publisher "left" "std_msgs/String" 1
  for (const auto& side : sides) {
    n.advertise<std_msgs::String>(side + "/x", 1);  //= publisher "left/x" | "right/x" "std_msgs/String" 1
  }
  for (int i = 0; i < 2; i++) {
    n.advertise<std_msgs::String>(NAMES[i], 1);  //= publisher "red" | "green" "std_msgs/String" 1
  }
  std::vector<std::string> unknown;
  unknown.push_back(argv[1]);
  n.advertise<std_msgs::String>(unknown[0], 1);  //= publisher ? "std_msgs/String" 1
  std::string replaced = "a";
  replaced.append("/b");
  n.advertise<std_msgs::String>(replaced, 1);  //= publisher "a/b" "std_msgs/String" 1
  replaced.erase(0, 1);
  n.advertise<std_msgs::String>(replaced, 1);  //= publisher ? "std_msgs/String" 1
}
