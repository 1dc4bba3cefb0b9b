#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Int32.h>

static int clamp(int value, int low, int high) {
  if (value < low) return low;
  return value > high ? high : value;
}

class Lift {
 public:
  Lift() {
    go_ = nh_.subscribe("go", 2, &Lift::go, this);
    home_ = nh_.subscribe("home", 2, &Lift::home, this);
    timer_ = nh_.createTimer(ros::Duration(10), &Lift::idle, this);
  }

 private:
  void go(const std_msgs::Int32::ConstPtr& msg) { moveTo(msg->data); }
  void home(const std_msgs::Empty&) { moveTo(0); }
  void idle(const ros::TimerEvent&) {
    std_msgs::Empty nothing;
    if (floor_ > 0) home(nothing);
  }
  void moveTo(int floor) {
    floor_ = clamp(floor, 0, 4);
    ros::Duration(2.0).sleep();
    moves_++;
  }

  ros::NodeHandle nh_;
  ros::Subscriber go_, home_;
  ros::Timer timer_;
  int floor_ = 0;
  long moves_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "lift");
  Lift lift;
  ros::spin();
}
