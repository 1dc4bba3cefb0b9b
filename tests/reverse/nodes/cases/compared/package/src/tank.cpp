// Members that get values of a library: some are only compared, others are more than that.
#include <ros/ros.h>
#include <std_msgs/Int32.h>
#include <gauge/gauge.h>

enum State { IDLE, FILLING, FULL };

class Tank {
 public:
  Tank() {
    timer_ = nh_.createTimer(ros::Duration(1.0), &Tank::look, this);
    pub_ = nh_.advertise<std_msgs::Int32>("alarm", 10);
    sub_ = nh_.subscribe("alarm", 10, &Tank::alarm, this);
  }

 private:
  void look(const ros::TimerEvent&) {
    level_ = angles::level();
    heat_ = angles::heat();
    state_ = angles::state();
    octet_ = angles::octet();
    passed_on_ = angles::level();
    ROS_INFO("level %d", level_);
    if (level_ > 90) open_ = false;
    if (level_ < LOW || level_ == 50) open_ = true;
    if (heat_ >= 1.5) count_++;
    switch (state_) {
      case FILLING: count_ = 1; break;
      case FULL: count_ = 2; break;
    }
    if (octet_ != 0) count_ = 3;
  }
  void alarm(const std_msgs::Int32::ConstPtr& msg) {
    if (this->level_ > 90 && msg->data == 1) {
      std_msgs::Int32 out;
      out.data = passed_on_;
      pub_.publish(out);
    }
  }
  static const int LOW = 10;
  ros::NodeHandle nh_;
  ros::Timer timer_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  int level_ = 0;
  double heat_ = 0.0;
  State state_ = IDLE;
  uint8_t octet_ = 0;
  int passed_on_ = 0;
  int count_ = 0;
  bool open_ = false;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "tank");
  Tank tank;
  ros::spin();
  return 0;
}
