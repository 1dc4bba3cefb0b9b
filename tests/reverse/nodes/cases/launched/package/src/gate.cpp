#include <ros/ros.h>

class Gate {
 public:
  Gate() { timer_ = nh_.createTimer(ros::Duration(1.0), &Gate::swing, this); }

 private:
  void swing(const ros::TimerEvent&) { open_ = !open_; }
  ros::NodeHandle nh_;
  ros::Timer timer_;
  bool open_ = false;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "gate");
  Gate gate;
  ros::spin();
  return 0;
}
