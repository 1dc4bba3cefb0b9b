#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Int32.h>

ros::Publisher total_pub;
ros::Publisher back_pub;
double total = 0.0;
int count = 0;
int backwards = 0;

void onCommand(const geometry_msgs::Twist::ConstPtr& msg) {
  count++;
  if (msg->linear.x < 0.0) {
    backwards++;
    std_msgs::Int32 out;
    out.data = backwards;
    back_pub.publish(out);
  }
  total += msg->linear.x * 0.5;
  if (count % 3 == 0) {  // every third
    std_msgs::Float64 out;
    out.data = total;
    total_pub.publish(out);
  }
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "odometer");
  ros::NodeHandle nh;
  total_pub = nh.advertise<std_msgs::Float64>("total", 10);
  back_pub = nh.advertise<std_msgs::Int32>("backwards", 10);
  ros::Subscriber sub = nh.subscribe("cmd_vel", 10, onCommand);
  ros::spin();
  return 0;
}
