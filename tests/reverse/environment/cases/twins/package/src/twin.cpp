#include <ros/ros.h>
#include <std_msgs/Bool.h>

ros::Publisher heard;

void onGo(const std_msgs::Bool::ConstPtr& message) {
  std_msgs::Bool copy;
  copy.data = message->data;
  heard.publish(copy);
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "twin");
  ros::NodeHandle node;
  heard = node.advertise<std_msgs::Bool>("heard", 1);
  ros::Subscriber go = node.subscribe("go", 1, onGo);
  ros::spin();
}
