#include <ros/ros.h>
#include <std_msgs/Int32.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "packer");
  ros::NodeHandle nh;
  ros::Publisher left = nh.advertise<std_msgs::Int32>("left", 1);
  ros::Publisher right = nh.advertise<std_msgs::Int32>("/right", 1);
  ros::Rate rate(1);
  bool side = false;
  while (ros::ok()) {
    std_msgs::Int32 msg;
    msg.data = rand() % 3;
    if (side) {
      left.publish(msg);
    } else {
      right.publish(msg);
    }
    side = !side;
    rate.sleep();
  }
}
