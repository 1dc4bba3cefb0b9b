#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Talker {
 public:
  explicit Talker(ros::NodeHandle& nh) : count_(0) {
    pub_ = nh.advertise<std_msgs::Int32>("chatter", 10);
    timer_ = nh.createTimer(ros::Duration(2.0), &Talker::tick, this);
  }
  void tick(const ros::TimerEvent&) {
    std_msgs::Int32 msg;
    msg.data = count_;
    pub_.publish(msg);
    count_ = (count_ + 1) % 5;
  }
 private:
  ros::Publisher pub_;
  ros::Timer timer_;
  int count_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "talker");
  ros::NodeHandle nh;
  Talker talker(nh);
  ros::spin();
  return 0;
}
