#include <ros/ros.h>
#include <std_msgs/Int32.h>
int main(int c, char** v) {
  ros::init(c, v, "node");
  ros::NodeHandle n, p("~");
  ros::Publisher pub = n.advertise<std_msgs::Int32>("out", 1);
  int speed;
  ros::Rate r(1);
  while (ros::ok()) {
    p.param("speed", speed, 2);
    std_msgs::Int32 o; o.data = speed; pub.publish(o);
    r.sleep();
  }
}
