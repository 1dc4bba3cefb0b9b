#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Int32.h>

class Monitor {
 public:
  explicit Monitor(ros::NodeHandle& node) {
    left_ = node.subscribe("left/level", 4, &Monitor::onLeft, this);
    right_ = node.subscribe("right/level", 4, &Monitor::onRight, this);
    alarm_ = node.advertise<std_msgs::Bool>("alarm", 2);
  }

 private:
  void onLeft(const std_msgs::Int32::ConstPtr& msg) {
    sum_ = msg->data + 1;
    report();
  }

  void onRight(const std_msgs::Int32::ConstPtr& msg) {
    if (msg->data > 3) report();
  }

  void report() {
    std_msgs::Bool alarm;
    alarm.data = sum_ > 5;
    alarm_.publish(alarm);
  }

  int sum_ = 0;
  ros::Subscriber left_;
  ros::Subscriber right_;
  ros::Publisher alarm_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "monitor");
  ros::NodeHandle node;
  Monitor monitor(node);
  ros::spin();
  return 0;
}
