#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf/transform_broadcaster.h>

class Bumper {
 public:
  Bumper() {
    scan_ = nh_.subscribe("scan", 1, &Bumper::onScan, this);
    pub_ = nh_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    timer_ = nh_.createTimer(ros::Duration(1), &Bumper::drive, this);
  }

 private:
  void onScan(const sensor_msgs::LaserScan::ConstPtr& scan) {
    blocked_ = false;
    for (size_t i = 0; i < scan->ranges.size(); ++i) {
      if (scan->ranges[i] < 0.5) blocked_ = true;
    }
    broadcaster_.sendTransform(tf::StampedTransform());
  }
  void drive(const ros::TimerEvent&) {
    geometry_msgs::Twist twist;
    if (blocked_) {
      twist.angular.z = 1.0;
    } else {
      twist.linear.x = 0.25;
    }
    pub_.publish(twist);
  }

  ros::NodeHandle nh_;
  ros::Subscriber scan_;
  ros::Publisher pub_;
  ros::Timer timer_;
  tf::TransformBroadcaster broadcaster_;
  bool blocked_ = false;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "bumper");
  Bumper bumper;
  ros::spin();
}
