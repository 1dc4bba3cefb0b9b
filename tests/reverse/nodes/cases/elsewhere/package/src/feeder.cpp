#include <ros/ros.h>
#include <std_msgs/Int32.h>

int last = 0;
void onDone(const std_msgs::Int32::ConstPtr& done) { last = done->data; }

int main(int argc, char** argv) {
  ros::init(argc, argv, "feeder");
  ros::NodeHandle nh;
  ros::Publisher pub = nh.advertise<std_msgs::Int32>("plate", 5);
  ros::Subscriber sub = nh.subscribe("done", 5, onDone);
  ros::Rate rate(0.25);
  while (ros::ok()) {
    std_msgs::Int32 plate;
    plate.data = last + 1;
    pub.publish(plate);
    if (last > 8) ros::Duration(2).sleep();
    ros::spinOnce();
    rate.sleep();
  }
}
