#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Int32.h>

class Driver {
 public:
  explicit Driver(ros::NodeHandle& nh) : mode_(FORWARD), ticks_(0) {
    cmd_pub_ = nh.advertise<geometry_msgs::Twist>("cmd_vel", 10);
    mode_pub_ = nh.advertise<std_msgs::Int32>("mode", 1, true);  // latched
    bumper_sub_ = nh.subscribe("bumper", 10, &Driver::onBumper, this);
    timer_ = nh.createTimer(ros::Duration(0.5), &Driver::onTimer, this);
    setMode(FORWARD);
  }

 private:
  enum Mode { FORWARD = 0, BACK = 1, TURN = 2 };

  void setMode(int mode) {
    mode_ = mode;
    ticks_ = 0;
    std_msgs::Int32 msg;
    msg.data = mode_;
    mode_pub_.publish(msg);
  }

  void onBumper(const std_msgs::Bool::ConstPtr& msg) {
    if (msg->data && mode_ != BACK) {
      setMode(BACK);
    }
  }

  void onTimer(const ros::TimerEvent&) {
    geometry_msgs::Twist cmd;
    if (mode_ == FORWARD) {
      cmd.linear.x = 0.4;
    } else if (mode_ == BACK) {
      cmd.linear.x = -0.2;
      ticks_++;
      if (ticks_ >= 3) {
        setMode(TURN);
      }
    } else {
      cmd.angular.z = 0.75;
      ticks_++;
      if (ticks_ >= 2) {
        setMode(FORWARD);
      }
    }
    cmd_pub_.publish(cmd);
  }

  int mode_;
  int ticks_;
  ros::Publisher cmd_pub_;
  ros::Publisher mode_pub_;
  ros::Subscriber bumper_sub_;
  ros::Timer timer_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "driver");
  ros::NodeHandle nh;
  Driver driver(nh);
  ros::spin();
  return 0;
}
