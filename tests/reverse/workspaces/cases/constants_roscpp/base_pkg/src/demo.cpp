#include <ros/ros.h>

#include "base_pkg/base.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  base_pkg::Other other(nh);
  ros::spin();
}
