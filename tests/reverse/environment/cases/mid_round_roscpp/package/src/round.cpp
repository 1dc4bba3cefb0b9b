// Lets messages be served in the middle of each round, where its callback sees another value.
#include <ros/ros.h>
#include <std_msgs/Int32.h>

int number = 0;
int seen = 0;

void onCommand(const std_msgs::Int32::ConstPtr&) {
  seen = number;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "round");
  ros::NodeHandle node;
  ros::Publisher out = node.advertise<std_msgs::Int32>("out", 10);
  ros::Subscriber commands = node.subscribe("cmd", 10, onCommand);
  ros::Rate rate(1);
  while (ros::ok()) {
    number = 1;
    ros::spinOnce();
    number = 2;
    std_msgs::Int32 message;
    message.data = seen;
    out.publish(message);
    rate.sleep();
  }
}
