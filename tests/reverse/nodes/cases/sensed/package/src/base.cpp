#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

bool moving;

void onTwist(const geometry_msgs::Twist& twist) { moving = twist.linear.x > 0.0; }

int main(int argc, char** argv) {
  ros::init(argc, argv, "base");
  ros::NodeHandle nh;
  ros::Subscriber sub = nh.subscribe("cmd_vel", 1, onTwist);
  ros::spin();
}
