// Timers that get the place of others, and an object that is called.
#include <ros/ros.h>
#include <std_msgs/Int32.h>

struct Dimmer {
  int level = 2;
  void operator()(const std_msgs::Int32::ConstPtr& msg) { level = msg->data; }
};

class Lamp {
 public:
  Lamp() {
    timer_ = nh_.createTimer(ros::Duration(1.0), &Lamp::glow, this);
    timer_ = nh_.createTimer(ros::Duration(2.0), &Lamp::flash, this);
    other_ = nh_.createTimer(ros::Duration(3.0), &Lamp::fade, this);
    if (quick_) other_ = nh_.createTimer(ros::Duration(4.0), &Lamp::flare, this);
    level_in_ = nh_.subscribe<std_msgs::Int32>("level", 10, Dimmer());
  }

 private:
  void glow(const ros::TimerEvent&) { count_ = 1; }
  void flash(const ros::TimerEvent&) { count_++; }
  void fade(const ros::TimerEvent&) { count_--; }
  void flare(const ros::TimerEvent&) { count_ = 9; }
  ros::NodeHandle nh_;
  ros::Timer timer_, other_;
  ros::Subscriber level_in_;
  int count_ = 0;
  bool quick_ = true;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "lamp");
  Lamp lamp;
  ros::spin();
  return 0;
}
