#include <ros/ros.h>
#include <std_msgs/Int32.h>
ros::Publisher pub;
void heard(const std_msgs::Int32::ConstPtr& m) {
  std_msgs::Int32 out;
  out.data = 1;
  pub.publish(out);
}
int main(int argc, char** argv) {
  ros::init(argc, argv, "answer");
  if (argc < 2) {
    return 1;
  }
  ros::NodeHandle node;
  pub = node.advertise<std_msgs::Int32>("out", 1);
  ros::Subscriber sub = node.subscribe("in", 1, heard);
  if (argc > 3) {
    ros::spin();
  }
}
