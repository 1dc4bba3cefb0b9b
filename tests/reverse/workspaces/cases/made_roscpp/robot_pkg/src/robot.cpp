#include <base_pkg/base.hpp>
#include <ros/ros.h>

class Robot {
 public:
  explicit Robot(ros::NodeHandle& nh) {
    pub_ = nh.advertise<std_msgs::Int32>("alarm", 10);
    sub_ = nh.subscribe("level", 10, &Robot::cb, this);
  }

 private:
  void cb(const std_msgs::Int32::ConstPtr& msg) {
    if (msg->data == base_pkg::kCritical) {
      base_pkg::publishValue(pub_, 6);
    }
  }

  ros::Publisher pub_;
  ros::Subscriber sub_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "robot");
  ros::NodeHandle nh;
  base_pkg::startOther();
  Robot robot(nh);
  ros::spin();
}
