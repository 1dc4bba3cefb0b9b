#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Int16.h>

bool enabled = true;

void enable(const std_msgs::Bool::ConstPtr& msg) { enabled = msg->data; }

int main(int argc, char** argv) {
  ros::init(argc, argv, "pump");
  ros::NodeHandle nh("tank");
  ros::Publisher level_pub = nh.advertise<std_msgs::Int16>("level", 1, true);
  ros::Subscriber sub = nh.subscribe("enable", 1, enable);
  ros::Rate rate(0.5);
  int level = 3;
  while (ros::ok()) {
    if (enabled && level < 10) {
      level++;
    }
    std_msgs::Int16 msg;
    msg.data = level;
    level_pub.publish(msg);
    ros::spinOnce();
    rate.sleep();
  }
  return 0;
}
