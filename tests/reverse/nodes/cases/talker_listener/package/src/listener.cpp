#include <ros/ros.h>
#include <std_msgs/Int32.h>
int last = -1;
bool seen = false;
void chatterCallback(const std_msgs::Int32::ConstPtr& msg) {
  ROS_INFO("got %d", msg->data);
  if (msg->data > last) {
    seen = true;
  }
  last = msg->data;
}
int main(int argc, char** argv) {
  ros::init(argc, argv, "listener");
  ros::NodeHandle n;
  ros::Subscriber sub = n.subscribe("chatter", 10, chatterCallback);
  ros::spin();
  return 0;
}
