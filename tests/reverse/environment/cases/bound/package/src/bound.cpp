#include <functional>
#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Bound {
 public:
  Bound() {
    out_ = node_.advertise<std_msgs::Int32>("out", 1);
    timer_ = node_.createTimer(ros::Duration(1.0), std::bind(&Bound::send, this, level_));
    level_ = 1;
  }

 private:
  void send(int level) {
    std_msgs::Int32 message;
    message.data = level;
    out_.publish(message);
  }

  ros::NodeHandle node_;
  ros::Publisher out_;
  ros::Timer timer_;
  int level_ = 7;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "bound");
  Bound bound;
  ros::spin();
}
