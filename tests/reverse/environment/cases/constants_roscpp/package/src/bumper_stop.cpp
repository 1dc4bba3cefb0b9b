// Stops for either bumper; drives on when it is told to run.
#include <bumper_stop/Mode.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>

#include <vector>

class BumperStop {
 public:
  explicit BumperStop(ros::NodeHandle& nh) : mode_(bumper_stop::Mode::IDLE) {
    cmd_pub_ = nh.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    mode_pub_ = nh.advertise<bumper_stop::Mode>("mode", 1, true);
    subs_.push_back(nh.subscribe("bumper/left", 1, &BumperStop::onBumper, this));
    subs_.push_back(nh.subscribe("bumper/right", 1, &BumperStop::onBumper, this));
    mode_sub_ = nh.subscribe("mode_request", 1, &BumperStop::onMode, this);
    timer_ = nh.createTimer(ros::Duration(0.2), &BumperStop::onTimer, this);
  }

 private:
  void onBumper(const std_msgs::Bool::ConstPtr& msg) {
    if (msg->data) {
      setMode(bumper_stop::Mode::STOPPED);
      cmd_pub_.publish(makeTwist(0.0, 0.0));
    }
  }

  void onMode(const bumper_stop::Mode::ConstPtr& msg) {
    if (msg->mode == msg->RUN && mode_ == bumper_stop::Mode::IDLE) {
      setMode(bumper_stop::Mode::RUN);
    } else if (msg->mode == bumper_stop::Mode::IDLE) {
      setMode(bumper_stop::Mode::IDLE);
    }
  }

  void onTimer(const ros::TimerEvent& event) {
    if (mode_ == bumper_stop::Mode::RUN) {
      cmd_pub_.publish(makeTwist(0.3, 0.0));
    } else {
      cmd_pub_.publish(makeTwist(0.0, 0.0));
    }
  }

  geometry_msgs::Twist makeTwist(double linear, double angular) const {
    geometry_msgs::Twist twist;
    twist.linear.x = linear;
    twist.angular.z = angular;
    return twist;
  }

  void setMode(uint8_t mode) {
    mode_ = mode;
    bumper_stop::Mode msg;
    msg.mode = mode_;
    mode_pub_.publish(msg);
  }

  ros::Publisher cmd_pub_, mode_pub_;
  std::vector<ros::Subscriber> subs_;
  ros::Subscriber mode_sub_;
  ros::Timer timer_;
  uint8_t mode_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "bumper_stop");
  ros::NodeHandle nh;
  BumperStop node(nh);
  ros::spin();
  return 0;
}
