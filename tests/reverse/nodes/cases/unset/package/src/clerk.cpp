#include <ros/ros.h>
#include <std_msgs/Int32.h>

int received;

void take(const std_msgs::Int32& msg) { received += msg.data; }

int main(int argc, char** argv) {
  ros::init(argc, argv, "clerk");
  ros::NodeHandle nh;
  ros::Subscriber in = nh.subscribe("reading", 10, take);
  ros::Publisher out = nh.advertise<std_msgs::Int32>("reading", 10);
  int rounds;
  int turns{};
  ros::Rate rate(1);
  while (ros::ok()) {
    std_msgs::Int32 m;
    m.data = ++turns + rounds + received;
    rounds = turns;
    out.publish(m);
    ros::spinOnce();
    rate.sleep();
  }
  return 0;
}
