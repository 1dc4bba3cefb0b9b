#include <ros/ros.h>
#include <std_msgs/Int32.h>

int seen = 0;

void onTimer(const ros::TimerEvent&) { seen = 1; }

int main(int argc, char** argv) {
  ros::init(argc, argv, "loop");
  ros::NodeHandle node;
  ros::Publisher out = node.advertise<std_msgs::Int32>("out", 1);
  ros::Timer timer = node.createTimer(ros::Duration(2.0), onTimer);
  ros::Rate rate(1);
  int early = 0;
  while (ros::ok()) {
    if (early < 3) {
      ++early;
      continue;
    }
    std_msgs::Int32 message;
    message.data = seen;
    out.publish(message);
    ros::spinOnce();
    rate.sleep();
  }
}
