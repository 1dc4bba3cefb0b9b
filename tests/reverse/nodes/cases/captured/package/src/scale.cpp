#include <boost/bind.hpp>
#include <ros/ros.h>
#include <std_msgs/Int32.h>

int total = 0;

void weigh(const std_msgs::Int32::ConstPtr& msg, int sign) { total += sign * msg->data; }

int main(int argc, char** argv) {
  ros::init(argc, argv, "scale");
  ros::NodeHandle nh;
  int heaviest = 0;
  ros::Publisher pub = nh.advertise<std_msgs::Int32>("heaviest", 1);
  ros::Subscriber left = nh.subscribe<std_msgs::Int32>("left", 1, boost::bind(&weigh, _1, 1));
  ros::Subscriber right = nh.subscribe<std_msgs::Int32>("right", 1, boost::bind(&weigh, _1, -1));
  ros::Timer timer = nh.createTimer(ros::Duration(3), [&](const ros::TimerEvent&) {
    if (total > heaviest) {
      heaviest = total;
      std_msgs::Int32 msg;
      msg.data = heaviest;
      pub.publish(msg);
    }
  });
  ros::spin();
}
