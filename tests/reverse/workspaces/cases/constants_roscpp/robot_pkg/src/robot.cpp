#include <ros/ros.h>
#include <std_msgs/Int32.h>
#include <robot_pkg/Level.h>
using robot_pkg::Level;
class Robot {
 public:
  explicit Robot(ros::NodeHandle& nh) {
    pub_ = nh.advertise<std_msgs::Int32>("alarm", 10);
    sub_ = nh.subscribe("level", 10, &Robot::cb, this);
  }
  void cb(const std_msgs::Int32::ConstPtr& msg) {
    std_msgs::Int32 m;
    m.data = Level::MAX;
    pub_.publish(m);
  }
  ros::Publisher pub_;
  ros::Subscriber sub_;
};
int main(int argc, char** argv) {
  ros::init(argc, argv, "robot");
  ros::NodeHandle nh;
  Robot robot(nh);
  ros::spin();
}
