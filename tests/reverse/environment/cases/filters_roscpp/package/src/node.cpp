#include <ros/ros.h>
#include <std_msgs/Int32.h>
#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <geometry_msgs/PointStamped.h>
ros::Publisher pub;
void both(const geometry_msgs::PointStamped::ConstPtr& a, const geometry_msgs::PointStamped::ConstPtr& b) {
  if (a->point.x > 1 && b->point.x > 1) { std_msgs::Int32 o; o.data = 9; pub.publish(o); }
}
int main(int c, char** v) {
  ros::init(c, v, "node");
  ros::NodeHandle n;
  pub = n.advertise<std_msgs::Int32>("out", 1);
  message_filters::Subscriber<geometry_msgs::PointStamped> left(n, "left", 1);
  message_filters::Subscriber<geometry_msgs::PointStamped> right(n, "right", 1);
  message_filters::TimeSynchronizer<geometry_msgs::PointStamped, geometry_msgs::PointStamped> sync(left, right, 10);
  sync.registerCallback(&both);
  ros::spin();
}
