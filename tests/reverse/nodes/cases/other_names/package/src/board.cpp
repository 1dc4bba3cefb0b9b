#include <ros/ros.h>
#include <std_msgs/Int32.h>

int last = 0;
void onSum(const std_msgs::Int32::ConstPtr& m) { last = m->data; }
void onLamp(const std_msgs::Int32::ConstPtr& m) { last = -m->data; }

int main(int argc, char** argv) {
  ros::init(argc, argv, "board");
  ros::NodeHandle nh;
  ros::Subscriber sum = nh.subscribe("sum", 5, onSum);
  ros::Subscriber lamp = nh.subscribe("lamp", 5, onLamp);
  ros::spin();
}
