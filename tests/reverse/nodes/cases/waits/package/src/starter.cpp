#include <ros/ros.h>
#include <std_msgs/Int32.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "starter");
  ros::NodeHandle nh;
  ros::Publisher pub = nh.advertise<std_msgs::Int32>("signal", 5);
  while (pub.getNumSubscribers() == 0) {
    ros::Duration(0.5).sleep();
  }
  int round = 3;
  std_msgs::Int32 msg;
  msg.data = round;
  pub.publish(msg);
  while (ros::ok() && round > 0) {
    --round;
    if (round == 1) {
      continue;
    }
    msg.data = round;
    pub.publish(msg);
    ros::Duration(1).sleep();
  }
  return 0;
}
