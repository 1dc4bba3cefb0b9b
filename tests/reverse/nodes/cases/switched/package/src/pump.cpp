// Timers that bodies stop and start, and one that gets another period.
#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Pump {
 public:
  Pump() {
    beat_ = nh_.createTimer(ros::Duration(2.0), &Pump::beat, this);
    alarm_ = nh_.createTimer(ros::Duration(5.0), &Pump::alarm, this, false, false);
    slow_ = nh_.createTimer(ros::Duration(3.0), &Pump::slow, this);
    on_out_ = nh_.advertise<std_msgs::Bool>("on", 10);
    on_in_ = nh_.subscribe("on", 10, &Pump::turn, this);
  }

 private:
  void turn(const std_msgs::Bool::ConstPtr& msg) {
    if (msg->data) {
      beat_.start();
      halt();
    } else {
      beat_.stop();
      this->alarm_.start();
    }
  }
  void halt() { alarm_.stop(); }
  void beat(const ros::TimerEvent&) {
    std_msgs::Bool out;
    out.data = ++count_ % 3 > 0;
    if (count_ > 9) beat_.stop();
    on_out_.publish(out);
  }
  void alarm(const ros::TimerEvent&) { count_ = 0; }
  void slow(const ros::TimerEvent&) { slow_.setPeriod(ros::Duration(4.0)); }
  ros::NodeHandle nh_;
  ros::Timer beat_, alarm_, slow_;
  ros::Publisher on_out_;
  ros::Subscriber on_in_;
  int count_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "pump");
  Pump pump;
  ros::spin();
  return 0;
}
