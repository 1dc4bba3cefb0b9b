#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Oven {
 public:
  Oven() : nh_("~"), heat_(20) {
    if (!nh_.getParam("target", target_)) {
      target_ = 100;
    }
    nh_.param<int>("steps", steps_, 2);
    fan_ = nh_.param("fan", false);
    nh_.param<std::string>("name", name_, "oven");
    int limit = ros::NodeHandle().param("limit", 300);
    if (target_ > limit) {
      target_ = limit;
    }
    timer_ = nh_.createTimer(ros::Duration(60), &Oven::warm, this);
  }

 private:
  void warm(const ros::TimerEvent&) {
    if (heat_ >= target_) return;
    heat_ += fan_ ? 2 * steps_ : steps_;
    ROS_INFO_STREAM(name_ << " is at " << heat_);
  }

  ros::NodeHandle nh_;
  ros::Timer timer_;
  std::string name_;
  int target_, steps_, heat_;
  bool fan_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "oven");
  Oven oven;
  ros::spin();
}
