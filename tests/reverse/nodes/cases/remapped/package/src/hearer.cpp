#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Hearer {
 public:
  Hearer() {
    left_ = nh_.subscribe("left", 5, &Hearer::onLeft, this);
    right_ = nh_.subscribe("right", 5, &Hearer::onRight, this);
  }

 private:
  void onLeft(const std_msgs::Int32& msg) { balance_ -= msg.data; }
  void onRight(const std_msgs::Int32& msg) { balance_ += msg.data; }

  ros::NodeHandle nh_;
  ros::Subscriber left_, right_;
  int balance_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "hearer");
  Hearer hearer;
  ros::spin();
}
