#pragma once
#include <ros/ros.h>
#include <std_msgs/Int32.h>

namespace base_pkg {

constexpr int kCritical = 3;

void startOther();
void publishValue(ros::Publisher& pub, int value);

}  // namespace base_pkg
