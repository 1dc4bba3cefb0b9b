#include <ros/ros.h>
#include <std_msgs/Int32.h>

ros::Publisher brake;

void count(const std_msgs::Int32& msg) {
  static bool braked = false;
  if (msg.data > 5 && !braked) {
    std_msgs::Int32 out;
    out.data = 1;
    brake.publish(out);
    braked = true;
  }
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "hand");
  ros::NodeHandle nh;
  brake = nh.advertise<std_msgs::Int32>("brake", 1);
  ros::Subscriber turns = nh.subscribe("turns", 10, count);
  ros::spin();
}
